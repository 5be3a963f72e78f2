#include "core/trajectory/placeholders.hpp"

#include "switchyard/model/new_ids.hpp"
#include "switchyard/symbolic/variable_names.hpp"

namespace switchyard {
namespace {

/// What a parser says, behind the words that say where it stands.
template <class Parse>
auto At(const std::string& caller, Parse parse) {
  try {
    return parse();
  } catch (const InvalidArgument& e) {
    Refuse(caller, ": ", e.what());
  }
}

}  // namespace

Placeholders::Placeholders(const std::vector<Segment>& segments) {
  for (const Segment& segment : segments) size_ += segment.shape.size();
  first_ = NewVariableIds(size_);
  Variable::Id next = first_;
  for (const Segment& segment : segments) {
    const int n = segment.shape.num_positions, count = segment.shape.order + 1;
    const auto name = [&](NameBlock block) {
      names_.push_back(std::make_shared<const NameBlock>(std::move(block)));
      RegisterNames(next, names_.back());
    };
    name(NameBlock::Shaped(segment.name + "points", n, count));
    MatrixXDecisionVariable& points = points_.emplace_back(n, count);
    for (int j = 0; j < count; ++j) {
      for (int i = 0; i < n; ++i) points(i, j) = Variable(next++);
    }
    name(NameBlock::Shaped(segment.name + "duration", 1, 0));
    durations_.emplace_back(next++);
  }
}

PlacedCost Placeholders::Place(const Expression& e, GraphOfConvexSets::TranscriptionSet in,
                               const std::string& caller) const {
  return Place(At(caller, [&] { return ParseCost(e); }), in, caller);
}

PlacedConstraint Placeholders::Place(const FormulaList& formulas,
                                     GraphOfConvexSets::TranscriptionSet in,
                                     const std::string& caller) const {
  return Place(At(caller, [&] { return ParseConstraint(formulas); }), in, caller);
}

std::vector<int> Placeholders::PlacesOf(const VectorXDecisionVariable& variables,
                                        const std::string& caller) const {
  std::vector<int> places;
  places.reserve(static_cast<std::size_t>(variables.size()));
  for (const Variable v : variables) {
    const Variable::Id place = v.get_id() - first_;
    Require(place >= 0 && place < size_, caller,
            " needs its placeholders of durations and control points as variables, got ",
            NameOf(v));
    places.push_back(static_cast<int>(place));
  }
  return places;
}

}  // namespace switchyard
