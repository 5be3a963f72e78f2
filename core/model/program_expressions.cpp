#include "switchyard/model/parse.hpp"
#include "switchyard/model/program.hpp"

namespace switchyard {

Binding<LinearCost> MathematicalProgram::AddLinearCost(const Expression& e) {
  return AddCost(ParseLinearCost(e));
}

Binding<QuadraticCost> MathematicalProgram::AddQuadraticCost(const Expression& e,
                                                             std::optional<bool> is_convex) {
  return AddCost(ParseQuadraticCost(e, is_convex));
}

Binding<L2NormCost> MathematicalProgram::AddL2NormCost(const Expression& e, double psd_tol,
                                                       double coefficient_tol) {
  return AddCost(ParseL2NormCost(e, psd_tol, coefficient_tol));
}

Binding<Cost> MathematicalProgram::AddCost(const Expression& e) { return AddCost(ParseCost(e)); }

Binding<LinearConstraint> MathematicalProgram::AddLinearConstraint(const Expression& e,
                                                                   double lower, double upper) {
  return AddConstraint(ParseLinearConstraint(e, lower, upper));
}

Binding<LinearConstraint> MathematicalProgram::AddLinearConstraint(const ExpressionList& e,
                                                                   const MatrixRef& lower,
                                                                   const MatrixRef& upper) {
  return AddConstraint(ParseLinearConstraint(e, lower, upper));
}

Binding<LinearConstraint> MathematicalProgram::AddLinearConstraint(const FormulaList& formulas) {
  return AddConstraint(ParseLinearConstraint(formulas));
}

Binding<LinearEqualityConstraint> MathematicalProgram::AddLinearEqualityConstraint(
    const Expression& e, double b) {
  return AddConstraint(ParseLinearEqualityConstraint(e, b));
}

Binding<LinearEqualityConstraint> MathematicalProgram::AddLinearEqualityConstraint(
    const ExpressionList& e, const MatrixRef& b, bool lower_triangle) {
  return AddConstraint(ParseLinearEqualityConstraint(e, b, lower_triangle));
}

Binding<LinearEqualityConstraint> MathematicalProgram::AddLinearEqualityConstraint(
    const FormulaList& formulas) {
  return AddConstraint(ParseLinearEqualityConstraint(formulas));
}

Binding<QuadraticConstraint> MathematicalProgram::AddQuadraticConstraint(
    const Expression& e, double lower, double upper,
    std::optional<QuadraticConstraint::HessianType> hessian_type) {
  return AddConstraint(ParseQuadraticConstraint(e, lower, upper, hessian_type));
}

Binding<Constraint> MathematicalProgram::AddConstraint(const Expression& e, double lower,
                                                       double upper) {
  return AddConstraint(ParseConstraint(e, lower, upper));
}

Binding<Constraint> MathematicalProgram::AddConstraint(const ExpressionList& e,
                                                       const MatrixRef& lower,
                                                       const MatrixRef& upper) {
  return AddConstraint(ParseConstraint(e, lower, upper));
}

Binding<Constraint> MathematicalProgram::AddConstraint(const FormulaList& formulas) {
  return AddConstraint(ParseConstraint(formulas));
}

Binding<LorentzConeConstraint> MathematicalProgram::AddLorentzConeConstraint(
    const Formula& formula, double psd_tol, double coefficient_tol) {
  return AddConstraint(ParseLorentzConeConstraint(formula, psd_tol, coefficient_tol));
}

Binding<LorentzConeConstraint> MathematicalProgram::AddLorentzConeConstraint(
    const Expression& linear, const Expression& quadratic, double tolerance) {
  return AddConstraint(ParseLorentzConeConstraint(linear, quadratic, tolerance));
}

Binding<RotatedLorentzConeConstraint> MathematicalProgram::AddRotatedLorentzConeConstraint(
    const Expression& linear1, const Expression& linear2, const Expression& quadratic,
    double tolerance) {
  return AddConstraint(ParseRotatedLorentzConeConstraint(linear1, linear2, quadratic, tolerance));
}

Binding<LinearConstraint>
MathematicalProgram::AddPositiveDiagonallyDominantDualConeMatrixConstraint(
    const ExpressionList& X) {
  return AddConstraint(ParsePositiveDiagonallyDominantDualCone(X));
}

}  // namespace switchyard
