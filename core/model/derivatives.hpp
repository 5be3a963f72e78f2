// core/model/derivatives.hpp - patterns and values of the derivatives of terms that are given by
// matrices.
#pragma once

#include "switchyard/model/evaluator.hpp"

namespace switchyard {

/// The places of a matrix' entries, column by column.
SparsityPattern PatternOf(const SparseMatrix& A);
/// Those with row <= col.
SparsityPattern UpperPatternOf(const SparseMatrix& Q);

/// values = Ax + b (b may be null), jacobian = A.
void EvaluateAffine(const SparseMatrix& A, const Eigen::VectorXd* b, const Evaluation& wanted);
/// values = 1/2 x'Qx + b'x + c, the Jacobian dense, the Hessian weights[0] Q in Q's upper pattern.
void EvaluateQuadratic(const SparseMatrix& Q, const Eigen::VectorXd& b, double c,
                       const Evaluation& wanted);

}  // namespace switchyard
