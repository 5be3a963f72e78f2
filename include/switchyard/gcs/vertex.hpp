// switchyard/gcs/vertex.hpp - a vertex of a graph of convex sets: a set, a placeholder of the point
// in it, costs and constraints of that point.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "switchyard/gcs/graph.hpp"
#include "switchyard/symbolic/lists.hpp"

namespace switchyard {

/// All members but id() and name() throw InvalidArgument where it was removed.
class SWITCHYARD_EXPORT GraphOfConvexSets::Vertex final {
 public:
  Vertex(const Vertex&) = delete;
  Vertex& operator=(const Vertex&) = delete;
  [[nodiscard]] VertexId id() const { return id_; }
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] int ambient_dimension() const { return set().ambient_dimension(); }
  /// Placeholders of its point, for costs and constraints; ids are consecutive.
  [[nodiscard]] const VectorXDecisionVariable& x() const {
    RequireLive("x");
    return x_;
  }
  [[nodiscard]] const ConvexSet& set() const {
    RequireLive("set");
    return *set_;
  }
  [[nodiscard]] const std::shared_ptr<const ConvexSet>& shared_set() const {
    RequireLive("shared_set");
    return set_;
  }

  /// Expressions and formulas become what they are: linear, quadratic, norms, cones, functions (see
  /// parse.hpp). Throws InvalidArgument where a variable is not one of x().
  Binding<Cost> AddCost(const Expression& e, TranscriptionSet in = {});
  Binding<Cost> AddCost(const Binding<Cost>& binding, TranscriptionSet in = {});
  Binding<Constraint> AddConstraint(const FormulaList& formula, TranscriptionSet in = {});
  Binding<Constraint> AddConstraint(const Binding<Constraint>& binding, TranscriptionSet in = {});
  /// Those that count in one of these.
  [[nodiscard]] std::vector<Binding<Cost>> GetCosts(TranscriptionSet in = {}) const;
  [[nodiscard]] std::vector<Binding<Constraint>> GetConstraints(TranscriptionSet in = {}) const;
  [[nodiscard]] const std::vector<Tagged<Binding<Cost>>>& costs() const {
    RequireLive("costs");
    return costs_;
  }
  [[nodiscard]] const std::vector<Tagged<Binding<Constraint>>>& constraints() const {
    RequireLive("constraints");
    return constraints_;
  }

  /// What its costs add to the objective, recomputed from points: the sum of phi g(y / phi) over
  /// its outgoing edges, y = phi x (at the target over the incoming ones), where flows are
  /// fractional, of the costs tagged for the relaxation; g(x) on a path, of those tagged for the
  /// restriction, whose objective a path has. None where there is no flow.
  [[nodiscard]] std::optional<double> GetSolutionCost(
      const MathematicalProgramResult& result) const;
  /// The same of one cost, however it is tagged. Throws InvalidArgument where it is not of this
  /// vertex.
  [[nodiscard]] std::optional<double> GetSolutionCost(const MathematicalProgramResult& result,
                                                      const Binding<Cost>& cost) const;
  /// Its point; none where no flow passes. Without entries where the dimension is 0.
  [[nodiscard]] std::optional<Eigen::VectorXd> GetSolution(
      const MathematicalProgramResult& result) const;
  /// By id.
  [[nodiscard]] const std::vector<Edge*>& incoming_edges() const {
    RequireLive("incoming_edges");
    return incoming_;
  }
  [[nodiscard]] const std::vector<Edge*>& outgoing_edges() const {
    RequireLive("outgoing_edges");
    return outgoing_;
  }

 private:
  friend class GraphOfConvexSets;
  friend class GraphOfConvexSets::Edge;
  Vertex(GraphOfConvexSets* graph, VertexId id, std::shared_ptr<const ConvexSet> set,
         std::string name);
  void RequireLive(const char* call) const {
    if (set_ == nullptr) [[unlikely]] {
      RefuseRemoved(call);
    }
  }
  [[noreturn]] void RefuseRemoved(const char* call) const;
  void CheckVariables(const EvaluatorBase& evaluator,
                      const VectorXDecisionVariable& variables) const;
  [[nodiscard]] std::optional<double> CostOver(const std::vector<Edge*>& edges,
                                               const Binding<Cost>& cost,
                                               const MathematicalProgramResult& result) const;

  GraphOfConvexSets* graph_;
  VertexId id_;
  std::shared_ptr<const ConvexSet> set_;  // null: removed
  std::string name_;
  VectorXDecisionVariable x_;
  std::vector<Tagged<Binding<Cost>>> costs_;
  std::vector<Tagged<Binding<Constraint>>> constraints_;
  std::vector<Edge*> incoming_;
  std::vector<Edge*> outgoing_;
};

}  // namespace switchyard
