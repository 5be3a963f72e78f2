// solvers/mip/close_columns.hpp - duals changed a little, so that reduced costs have the sign that
// a column without an upper, or a lower end can bear.
#pragma once

#include <vector>

#include "solvers/rounding/exact_duals.hpp"
#include "switchyard/abi.h"

namespace switchyard::mip {

/// A bound from duals is infinite where a column that is open to one side has a reduced cost of the
/// wrong sign, however small. The dual of one row of that column (or of the head of one of its
/// second-order cones, or of a nonnegative entry) is moved by a little more than what is missing,
/// where a side that is finite bears it; of several the row that has the fewest columns that may
/// open. A column without ends that stands in one row alone gives that row its dual, and rows of
/// columns without ends are left as they are. What was taken from others is mended in the next
/// pass. Any duals give a bound, so nothing is claimed: where no pass helps, the column stays open.
void CloseColumns(const sy_problem& problem, const std::vector<double>& lower,
                  const std::vector<double>& upper, rounding::Duals& duals);

}  // namespace switchyard::mip
