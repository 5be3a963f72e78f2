#include <utility>

#include "core/model/checks.hpp"
#include "core/model/scaled_identity.hpp"
#include "switchyard/model/program_terms.hpp"

namespace switchyard {
Binding<LinearCost> ProgramTerms::AddLinearCost(const VectorRef& a, double b,
                                                const VariableList& vars) {
  return AddCost(std::make_shared<LinearCost>(a, b), vars);
}

Binding<LinearCost> ProgramTerms::AddLinearCost(const VectorRef& a, const VariableList& vars) {
  return AddLinearCost(a, 0, vars);
}

Binding<QuadraticCost> ProgramTerms::AddQuadraticCost(const CoefficientMatrix& Q,
                                                      const VectorRef& b, double c,
                                                      const VariableList& vars,
                                                      std::optional<bool> is_convex) {
  return AddCost(std::make_shared<QuadraticCost>(Q, b, c, is_convex), vars);
}

Binding<QuadraticCost> ProgramTerms::AddQuadraticCost(const CoefficientMatrix& Q,
                                                      const VectorRef& b, const VariableList& vars,
                                                      std::optional<bool> is_convex) {
  return AddQuadraticCost(Q, b, 0, vars, is_convex);
}

// (x - d)'Q(x - d) = 1/2 x'(Q + Q')x - ((Q + Q')d)'x + d'Qd.
Binding<QuadraticCost> ProgramTerms::AddQuadraticErrorCost(const CoefficientMatrix& Q,
                                                           const VectorRef& x_desired,
                                                           const VariableList& vars) {
  constexpr const char* kName = "quadratic error cost";
  CheckSize(kName, "x_desired", x_desired, vars.vector().size());
  CheckShape(kName, "Q", Q.sparse(), vars.vector().size(), vars.vector().size());
  CheckFinite(kName, "x_desired", x_desired);
  const SparseMatrix transposed = Q.sparse().transpose();
  const SparseMatrix twice = Q.sparse() + transposed;
  const Eigen::VectorXd slope = twice * x_desired;
  return AddQuadraticCost(twice, -slope, 0.5 * slope.dot(x_desired), vars);
}

Binding<QuadraticCost> ProgramTerms::AddQuadraticErrorCost(double w, const VectorRef& x_desired,
                                                           const VariableList& vars) {
  return AddQuadraticErrorCost(ScaledIdentity(vars.vector().size(), w), x_desired, vars);
}

// |Ax - b|^2 = 1/2 x'(2 A'A)x - (2 A'b)'x + b'b: convex by its form.
Binding<QuadraticCost> ProgramTerms::Add2NormSquaredCost(const CoefficientMatrix& A,
                                                         const VectorRef& b,
                                                         const VariableList& vars) {
  constexpr const char* kName = "2-norm squared cost";
  CheckShape(kName, "A", A.sparse(), b.size(), vars.vector().size());
  CheckFinite(kName, "A", A.sparse());
  CheckFinite(kName, "b", b);
  const SparseMatrix transposed = A.sparse().transpose();
  const SparseMatrix gram = transposed * A.sparse();
  return AddQuadraticCost(2 * gram, -2 * (transposed * b), b.squaredNorm(), vars, true);
}

Binding<L2NormCost> ProgramTerms::AddL2NormCost(const CoefficientMatrix& A, const VectorRef& b,
                                                const VariableList& vars) {
  return AddCost(std::make_shared<L2NormCost>(A, b), vars);
}

Binding<L1NormCost> ProgramTerms::AddL1NormCost(const CoefficientMatrix& A, const VectorRef& b,
                                                const VariableList& vars) {
  return AddCost(std::make_shared<L1NormCost>(A, b), vars);
}

Binding<LInfNormCost> ProgramTerms::AddLInfNormCost(const CoefficientMatrix& A, const VectorRef& b,
                                                    const VariableList& vars) {
  return AddCost(std::make_shared<LInfNormCost>(A, b), vars);
}

Binding<PerspectiveQuadraticCost> ProgramTerms::AddPerspectiveQuadraticCost(
    const CoefficientMatrix& A, const VectorRef& b, const VariableList& vars) {
  return AddCost(std::make_shared<PerspectiveQuadraticCost>(A, b), vars);
}

// min s over s >= |Ax + b|: the cone holds (s, Ax + b).
std::tuple<Variable, Binding<LinearCost>, Binding<LorentzConeConstraint>>
ProgramTerms::AddL2NormCostUsingConicConstraint(const CoefficientMatrix& A, const VectorRef& b,
                                                const VariableList& vars) {
  constexpr const char* kName = "L2-norm cost";
  CheckShape(kName, "A", A.sparse(), b.size(), vars.vector().size());
  std::vector<Eigen::Triplet<double>> entries = {{0, 0, 1.0}};
  for (int j = 0; j < A.sparse().outerSize(); ++j) {
    for (SparseMatrix::InnerIterator entry(A.sparse(), j); entry; ++entry) {
      entries.emplace_back(static_cast<int>(entry.row()) + 1, j + 1, entry.value());
    }
  }
  SparseMatrix with_slack(b.size() + 1, vars.vector().size() + 1);
  with_slack.setFromTriplets(entries.begin(), entries.end());
  Eigen::VectorXd offset = Eigen::VectorXd::Zero(b.size() + 1);
  offset.tail(b.size()) = b;
  const auto cone = std::make_shared<LorentzConeConstraint>(std::move(with_slack), offset);
  const VectorXDecisionVariable slack = NewContinuousVariables(1, "slack");
  auto constraint = AddConstraint(cone, VariableList{slack, vars.vector()});
  return {slack[0], AddLinearCost(Eigen::VectorXd::Ones(1), slack), std::move(constraint)};
}

Binding<Cost> ProgramTerms::AddFunctionCost(std::shared_ptr<const Function> function,
                                            const VariableList& vars, bool is_convex) {
  return AddCost(
      Binding<Cost>(std::make_shared<FunctionCost>(std::move(function), is_convex), vars));
}

}  // namespace switchyard
