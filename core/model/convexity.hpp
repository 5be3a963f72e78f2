// core/model/convexity.hpp - is a quadratic form convex?
#pragma once

#include "switchyard/model/evaluator.hpp"

namespace switchyard {

/// Is the symmetric Q positive semidefinite?
///
/// x'Qx is a sum over the connected components of Q's pattern, and each is decided alone: large
/// entries of one cannot hide what is negative in another, and separable forms cost no more than
/// reading them. A component B counts as semidefinite where B + 1e-12 max|B_ij| I has a Cholesky
/// factorization. That is stable without pivoting exactly where it succeeds, so the shift, above
/// its rounding, takes the place of the pivoting that a singular B would need; it serves the dense
/// factorization of small components and the sparse one of large ones alike.
bool IsPositiveSemidefinite(const SparseMatrix& Q);

/// (Q + Q')/2, exactly Q where Q is symmetric.
SparseMatrix SymmetricPart(const SparseMatrix& Q);

}  // namespace switchyard
