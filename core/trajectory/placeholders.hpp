// core/trajectory/placeholders.hpp - variables that stand for those of every segment, or of the two
// segments of every joint, in a cost or constraint that is written once.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/trajectory/segment_terms.hpp"
#include "switchyard/model/parse.hpp"
#include "switchyard/symbolic/name_table.hpp"

namespace switchyard {

/// Of one segment or two; the id of each is that of the first plus its place.
class Placeholders {
 public:
  struct Segment {
    SegmentShape shape;
    std::string name;  // of the variables in texts
  };
  explicit Placeholders(const std::vector<Segment>& segments);
  [[nodiscard]] const std::vector<MatrixXDecisionVariable>& points() const { return points_; }
  [[nodiscard]] const std::vector<Variable>& durations() const { return durations_; }

  /// The binding by places. Throws InvalidArgument, in a sentence that begins with `caller`, where
  /// a variable is not one of these.
  template <class C>
  [[nodiscard]] PlacedTerm<C> Place(const Binding<C>& binding,
                                    GraphOfConvexSets::TranscriptionSet in,
                                    const std::string& caller) const {
    return {binding.evaluator(), PlacesOf(binding.variables(), caller), in};
  }
  [[nodiscard]] PlacedCost Place(const Expression& e, GraphOfConvexSets::TranscriptionSet in,
                                 const std::string& caller) const;
  [[nodiscard]] PlacedConstraint Place(const FormulaList& formulas,
                                       GraphOfConvexSets::TranscriptionSet in,
                                       const std::string& caller) const;

 private:
  [[nodiscard]] std::vector<int> PlacesOf(const VectorXDecisionVariable& variables,
                                          const std::string& caller) const;

  int size_ = 0;
  Variable::Id first_;
  std::vector<MatrixXDecisionVariable> points_;
  std::vector<Variable> durations_;
  std::vector<std::shared_ptr<const NameBlock>> names_;
};

}  // namespace switchyard
