// switchyard/symbolic/decompose.hpp - expressions as matrices, norms and functions.
//
// In each form the variables stand in the order in which they first appear. What does not have the
// form throws InvalidArgument, with the expression and the reason.
#pragma once

#include <Eigen/SparseCore>
#include <memory>
#include <optional>
#include <vector>

#include "switchyard/export.hpp"
#include "switchyard/functions/function.hpp"
#include "switchyard/symbolic/expression.hpp"
#include "switchyard/symbolic/matrices.hpp"

namespace switchyard {

using SparseMatrix = Eigen::SparseMatrix<double>;
using ExpressionVectorRef = Eigen::Ref<const Eigen::VectorX<Expression>>;

/// Ax + b.
struct AffineForm {
  SparseMatrix A;
  Eigen::VectorXd b;
  VectorXDecisionVariable variables;
};
/// Row i is e_i. A variable whose terms cancel in every row is none of the form's.
SWITCHYARD_EXPORT AffineForm DecomposeAffine(const ExpressionVectorRef& e);
[[nodiscard]] inline bool IsAffine(const Expression& e) { return e.nonlinear().empty(); }

/// 1/2 x'Qx + b'x + c, Q symmetric.
struct QuadraticForm {
  SparseMatrix Q;
  Eigen::VectorXd b;
  double c = 0;
  VectorXDecisionVariable variables;
};
/// A sum of affine expressions, of products of two of them and of their squares?
SWITCHYARD_EXPORT bool IsQuadratic(const Expression& e);
/// Products and squares are multiplied out.
SWITCHYARD_EXPORT QuadraticForm DecomposeQuadratic(const Expression& e);

/// The degree in the variables that the form of the expression shows; nothing where it is not a
/// polynomial. Nothing is multiplied out: what would cancel counts.
SWITCHYARD_EXPORT std::optional<int> PolynomialDegree(const Expression& e);

/// e = |Ax + b|_2, where e is a positive multiple of sqrt(q).
///
/// Where q is a sum of squares of affine expressions with positive coefficients, and a positive
/// constant, each is a row. Any other quadratic q = 1/2 x'Qx + r'x + s is completed: Q/2 = R'R by a
/// pivoted factorization, R'd = r/2, and what s - d'd leaves. It is not one where a pivot is below
/// -psd_tol; pivots up to psd_tol count as 0. It is not one either where the coefficients of
/// |Ax + b|^2 are further than coefficient_tol from those of q.
SWITCHYARD_EXPORT std::optional<AffineForm> RecognizeL2Norm(const Expression& e,
                                                            double psd_tol = 1e-8,
                                                            double coefficient_tol = 1e-8);

/// Output i of the function is e_i at the values of the variables.
struct CompiledExpressions {
  std::shared_ptr<const Function> function;
  VectorXDecisionVariable variables;
};
/// A node that stands at several places is computed once, and so are equal operations.
SWITCHYARD_EXPORT CompiledExpressions CompileExpressions(const ExpressionVectorRef& e);

}  // namespace switchyard
