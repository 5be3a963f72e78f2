// solvers/mip/project_columns.hpp - duals whose reduced costs of columns without ends are exactly
// 0.
#pragma once

#include <vector>

#include "solvers/rounding/exact_duals.hpp"
#include "switchyard/abi.h"

namespace switchyard::mip {

/// A bound from duals is infinite where a column without ends has a reduced cost rho that is not 0.
/// With J those columns, and others that are open to a side, rows' duals y are moved by the least
/// sum d_i^2 / w_i for which A_J'd = rho_J: w_i is 1 where both signs may stand, else y_i^2 of the
/// largest, so that what is next to 0 stays there. That leaves rounding, which no arithmetic but an
/// exact one removes: where columns without ends can be put in an order, each with a row of two
/// sides and an entry +-2^k whose dual is all that is not settled yet of its column, that dual is
/// what the others leave (a forest of differences y_u - y_v, of definitions y = a'x + b). For it to
/// be a double, what stands in these columns is first rounded to multiples of a power of 2, the
/// smallest that will do.
///
/// Any duals give a bound, so nothing is claimed: where there is no such order, or all multiples
/// are too coarse, columns stay open. Nothing is done where J is large.
void ProjectColumns(const sy_problem& problem, const std::vector<double>& lower,
                    const std::vector<double>& upper, rounding::Duals& duals);

}  // namespace switchyard::mip
