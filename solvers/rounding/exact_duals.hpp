// solvers/rounding/exact_duals.hpp - duals changed a little, so that the residual of each epigraph
// variable is exactly 0: what a safe bound needs of a variable without a box.
#pragma once

#include <vector>

#include "switchyard/abi.h"

namespace switchyard::rounding {

/// Duals of rows and cones; NULL sections are empty.
struct Duals {
  std::vector<double> row, cone;
};

/// Changes `duals` of `problem` so that q_j = A_j'y + F_j'z holds exactly for each column j that
/// has no box on both sides, no P, and is of one of two shapes:
///
///   alone     its one entry f is in a cone: the dual there becomes q_j / f, and others of the cone
///             what membership needs (see KeepEntry). Where q_j / f is no double, it is the next
///             one that leaves a residual of the sign which a finite end bears
///   a share   all entries a are +-2^k, in one-sided rows or nonnegative cones, and a y has q_j's
///             sign where y has the sign of its side (the rows of a 1-norm, two to a column; of an
///             infinity-norm, many): the a y become whole multiples of q_j's last place that add up
///             to q_j, in the proportions they have
///
/// Where q_j is not bearable (its sign is wrong, or q_j / f rounds and there is no finite end), the
/// column is left as it is. Any duals give a bound, so nothing is claimed of the others' residuals.
void MakeExact(const sy_problem& problem, const double* lower, const double* upper, Duals& duals);

}  // namespace switchyard::rounding
