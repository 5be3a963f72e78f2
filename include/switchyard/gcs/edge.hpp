// switchyard/gcs/edge.hpp - an edge of a graph of convex sets: costs and constraints of the points
// at its two ends.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "switchyard/gcs/graph.hpp"
#include "switchyard/gcs/vertex.hpp"
#include "switchyard/symbolic/lists.hpp"

namespace switchyard {

/// All members but id() and name() throw InvalidArgument where it was removed.
class SWITCHYARD_EXPORT GraphOfConvexSets::Edge final {
 public:
  Edge(const Edge&) = delete;
  Edge& operator=(const Edge&) = delete;
  [[nodiscard]] EdgeId id() const { return id_; }
  /// The name given, or "(u, v)".
  [[nodiscard]] std::string name() const;
  [[nodiscard]] const Vertex& u() const { return *Live("u").u_; }
  [[nodiscard]] Vertex& u() { return *Live("u").u_; }
  [[nodiscard]] const Vertex& v() const { return *Live("v").v_; }
  [[nodiscard]] Vertex& v() { return *Live("v").v_; }
  /// Its flow; a placeholder, for MathematicalProgramResult::GetSolution.
  [[nodiscard]] Variable phi() const { return Variable(Live("phi").first_id_); }
  [[nodiscard]] const VectorXDecisionVariable& xu() const { return Live("xu").u_->x_; }
  [[nodiscard]] const VectorXDecisionVariable& xv() const { return Live("xv").v_->x_; }
  /// `rows` variables that belong to the edge, for its own costs and constraints. In results they
  /// are phi times their value. Throws InvalidArgument for a negative number.
  VectorXDecisionVariable NewSlackVariables(int rows, const std::string& name = "s");
  /// All of them, in the order of addition.
  [[nodiscard]] const VectorXDecisionVariable& slacks() const { return Live("slacks").slacks_; }

  /// Expressions and formulas become what they are: linear, quadratic, norms, cones, functions (see
  /// parse.hpp). Throws InvalidArgument where a variable is not one of xu(), xv() and the slacks.
  Binding<Cost> AddCost(const Expression& e, TranscriptionSet in = {});
  Binding<Cost> AddCost(const Binding<Cost>& binding, TranscriptionSet in = {});
  Binding<Constraint> AddConstraint(const FormulaList& formula, TranscriptionSet in = {});
  Binding<Constraint> AddConstraint(const Binding<Constraint>& binding, TranscriptionSet in = {});
  /// true: on the path; false: not on it. The last call holds.
  void AddPhiConstraint(bool phi_value);
  void ClearPhiConstraints();
  [[nodiscard]] std::optional<bool> phi_value() const { return Live("phi_value").phi_value_; }
  /// Those that count in one of these.
  [[nodiscard]] std::vector<Binding<Cost>> GetCosts(TranscriptionSet in = {}) const;
  [[nodiscard]] std::vector<Binding<Constraint>> GetConstraints(TranscriptionSet in = {}) const;
  [[nodiscard]] const std::vector<Tagged<Binding<Cost>>>& costs() const {
    return Live("costs").costs_;
  }
  [[nodiscard]] const std::vector<Tagged<Binding<Constraint>>>& constraints() const {
    return Live("constraints").constraints_;
  }

  /// What its costs add to the objective, recomputed from points: the sum of phi g(y / phi), y the
  /// stored phi x_u, phi x_v and phi s, 0 where phi is. Counted are the costs tagged for the
  /// relaxation where phi is fractional, and those tagged for the restriction where it is 1, on a
  /// path, whose objective is its restriction's. None where the result knows no flow of it.
  [[nodiscard]] std::optional<double> GetSolutionCost(
      const MathematicalProgramResult& result) const;
  /// The same of one cost, however it is tagged. Throws InvalidArgument where it is not of this
  /// edge.
  [[nodiscard]] std::optional<double> GetSolutionCost(const MathematicalProgramResult& result,
                                                      const Binding<Cost>& cost) const;
  /// None where the result knows no flow of the edge.
  [[nodiscard]] std::optional<Eigen::VectorXd> GetSolutionPhiXu(
      const MathematicalProgramResult& result) const;
  [[nodiscard]] std::optional<Eigen::VectorXd> GetSolutionPhiXv(
      const MathematicalProgramResult& result) const;

 private:
  friend class GraphOfConvexSets;
  friend class GraphOfConvexSets::Vertex;
  Edge(EdgeId id, Vertex* u, Vertex* v, std::string name);
  const Edge& Live(const char* call) const {
    if (removed_) [[unlikely]] {
      RefuseRemoved(call);
    }
    return *this;
  }
  Edge& Live(const char* call) {
    if (removed_) [[unlikely]] {
      RefuseRemoved(call);
    }
    return *this;
  }
  [[noreturn]] void RefuseRemoved(const char* call) const;
  void CheckVariables(const EvaluatorBase& evaluator,
                      const VectorXDecisionVariable& variables) const;
  [[nodiscard]] double ValueOver(double phi, Variable variable,
                                 const MathematicalProgramResult& result) const;

  EdgeId id_;
  bool removed_ = false;
  std::optional<bool> phi_value_;
  Vertex* u_;
  Vertex* v_;
  std::string name_;
  Variable::Id first_id_;  // of phi, then phi x_u, then phi x_v
  VectorXDecisionVariable slacks_;
  std::vector<Tagged<Binding<Cost>>> costs_;
  std::vector<Tagged<Binding<Constraint>>> constraints_;
};

}  // namespace switchyard
