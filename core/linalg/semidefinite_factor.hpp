// core/linalg/semidefinite_factor.hpp - P = S'S for a sparse positive semidefinite P.
#pragma once

#include <optional>

#include "switchyard/problem.hpp"

namespace switchyard {

/// Of a matrix that is not positive semidefinite: a pivot that shows it, and where.
struct NegativePivot {
  double pivot = 0;
  std::int32_t column = 0;  // one of its connected component
};

struct SemidefiniteFactor {
  Csc S;  // rank x cols
  std::optional<NegativePivot> not_semidefinite;
};

/// P by its upper triangle. A pivoted Cholesky factor of each connected component, dense:
/// components of objectives are small or diagonal. Each pivot is the largest entry that the steps
/// before it left on the diagonal, so a semidefinite P of any rank ends with a rest that is 0 to
/// rounding; a rest above 1e-9 of the component's largest entry says that P is not.
SemidefiniteFactor FactorSemidefinite(const Csc& P);

}  // namespace switchyard
