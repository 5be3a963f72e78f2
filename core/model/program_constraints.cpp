#include <limits>
#include <utility>

#include "core/model/checks.hpp"
#include "core/model/quadratic_cone.hpp"
#include "core/model/scaled_identity.hpp"
#include "switchyard/model/program_terms.hpp"

namespace switchyard {
namespace {

Eigen::VectorXd One(double value) { return Eigen::VectorXd::Constant(1, value); }

}  // namespace

Binding<LinearConstraint> ProgramTerms::AddLinearConstraint(CoefficientMatrix A,
                                                            const VectorRef& lower,
                                                            const VectorRef& upper,
                                                            const VariableList& vars) {
  return AddConstraint(std::make_shared<LinearConstraint>(std::move(A), lower, upper), vars);
}

Binding<LinearConstraint> ProgramTerms::AddLinearConstraint(
    const Eigen::Ref<const Eigen::RowVectorXd>& a, double lower, double upper,
    const VariableList& vars) {
  return AddLinearConstraint(CoefficientMatrix(a), One(lower), One(upper), vars);
}

Binding<LinearEqualityConstraint> ProgramTerms::AddLinearEqualityConstraint(
    CoefficientMatrix A, const VectorRef& b, const VariableList& vars) {
  return AddConstraint(std::make_shared<LinearEqualityConstraint>(std::move(A), b), vars);
}

Binding<LinearEqualityConstraint> ProgramTerms::AddLinearEqualityConstraint(
    const Eigen::Ref<const Eigen::RowVectorXd>& a, double b, const VariableList& vars) {
  return AddLinearEqualityConstraint(CoefficientMatrix(a), One(b), vars);
}

Binding<BoundingBoxConstraint> ProgramTerms::AddBoundingBoxConstraint(const VectorRef& lower,
                                                                      const VectorRef& upper,
                                                                      const VariableList& vars) {
  return AddConstraint(std::make_shared<BoundingBoxConstraint>(lower, upper), vars);
}

Binding<BoundingBoxConstraint> ProgramTerms::AddBoundingBoxConstraint(double lower, double upper,
                                                                      const VariableList& vars) {
  return AddBoundingBoxConstraint(Eigen::VectorXd::Constant(vars.vector().size(), lower),
                                  Eigen::VectorXd::Constant(vars.vector().size(), upper), vars);
}

Binding<LorentzConeConstraint> ProgramTerms::AddLorentzConeConstraint(CoefficientMatrix A,
                                                                      const VectorRef& b,
                                                                      const VariableList& vars) {
  return AddConstraint(std::make_shared<LorentzConeConstraint>(std::move(A), b), vars);
}

Binding<LorentzConeConstraint> ProgramTerms::AddLorentzConeConstraint(const VariableList& vars) {
  return AddLorentzConeConstraint(ScaledIdentity(vars.vector().size(), 1),
                                  Eigen::VectorXd::Zero(vars.vector().size()), vars);
}

Binding<RotatedLorentzConeConstraint> ProgramTerms::AddRotatedLorentzConeConstraint(
    CoefficientMatrix A, const VectorRef& b, const VariableList& vars) {
  return AddConstraint(std::make_shared<RotatedLorentzConeConstraint>(std::move(A), b), vars);
}

Binding<RotatedLorentzConeConstraint> ProgramTerms::AddRotatedLorentzConeConstraint(
    const VariableList& vars) {
  return AddRotatedLorentzConeConstraint(ScaledIdentity(vars.vector().size(), 1),
                                         Eigen::VectorXd::Zero(vars.vector().size()), vars);
}

Binding<ExponentialConeConstraint> ProgramTerms::AddExponentialConeConstraint(
    CoefficientMatrix A, const VectorRef& b, const VariableList& vars) {
  return AddConstraint(std::make_shared<ExponentialConeConstraint>(std::move(A), b), vars);
}

Binding<PowerConeConstraint> ProgramTerms::AddPowerConeConstraint(CoefficientMatrix A,
                                                                  const VectorRef& b, double alpha,
                                                                  const VariableList& vars) {
  return AddConstraint(std::make_shared<PowerConeConstraint>(std::move(A), b, alpha), vars);
}

Binding<PositiveSemidefiniteConstraint> ProgramTerms::AddPositiveSemidefiniteConstraint(
    const Eigen::Ref<const MatrixXDecisionVariable>& X) {
  constexpr const char* kName = "positive semidefinite constraint";
  Require(X.rows() == X.cols(), kName, ": the matrix needs to be square, got ", X.rows(), " x ",
          X.cols());
  for (Eigen::Index j = 0; j < X.cols(); ++j) {
    for (Eigen::Index i = 0; i < j; ++i) {
      Require(X(i, j) == X(j, i), kName,
              ": the matrix needs to be symmetric, got two variables at (", i, ",", j, ") and (", j,
              ",", i, ")");
    }
  }
  return AddConstraint(std::make_shared<PositiveSemidefiniteConstraint>(static_cast<int>(X.rows())),
                       X);
}

Binding<LinearMatrixInequalityConstraint> ProgramTerms::AddLinearMatrixInequalityConstraint(
    const std::vector<Eigen::MatrixXd>& F, const VariableList& vars) {
  return AddConstraint(std::make_shared<LinearMatrixInequalityConstraint>(F), vars);
}

Binding<QuadraticConstraint> ProgramTerms::AddQuadraticConstraint(
    const CoefficientMatrix& Q, const VectorRef& b, double lower, double upper,
    const VariableList& vars, std::optional<QuadraticConstraint::HessianType> hessian_type) {
  return AddConstraint(std::make_shared<QuadraticConstraint>(Q, b, lower, upper, hessian_type),
                       vars);
}

Binding<RotatedLorentzConeConstraint> ProgramTerms::AddQuadraticAsRotatedLorentzConeConstraint(
    const CoefficientMatrix& Q, const VectorRef& b, double c, const VariableList& vars) {
  const QuadraticConstraint form(Q, b, -std::numeric_limits<double>::infinity(),
                                 -c);  // checks; the symmetric part of Q
  const RotatedCone cone = RotatedConeOf(form.Q(), b, -c);
  return AddRotatedLorentzConeConstraint(cone.A, cone.b, vars);
}

Binding<Constraint> ProgramTerms::AddFunctionConstraint(std::shared_ptr<const Function> function,
                                                        const VectorRef& lower,
                                                        const VectorRef& upper,
                                                        const VariableList& vars, bool is_convex) {
  return AddConstraint(Binding<Constraint>(
      std::make_shared<FunctionConstraint>(std::move(function), lower, upper, is_convex), vars));
}

}  // namespace switchyard
