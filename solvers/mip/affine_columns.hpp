// solvers/mip/affine_columns.hpp - what equations of two variables say: one as a multiple of the
// other.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "solvers/mip/interval_math.hpp"
#include "solvers/mip/node_boxes.hpp"
#include "switchyard/abi.h"

namespace switchyard::mip {

/// factor x_variable + constant, with a factor and a constant somewhere in intervals; variable -1:
/// the constant.
struct Affine {
  std::int32_t variable = -1;
  Interval factor = {0, 0}, constant = {0, 0};
};

/// Every variable as an affine function of one, at all feasible points: of an integer where
/// equations lead to one, of itself where they say nothing. Variables that `boxes` fix, up to
/// rounding, are constants. In time linear in the nonzeros of A.
std::vector<Affine> AffineColumns(const sy_problem& problem, const NodeBoxes& boxes);

/// A row of F as columns say it: sum of entries + g, where it depends on one variable at most.
std::optional<Affine> AffineRow(const Csc& by_rows, std::int32_t row, double constant,
                                const std::vector<Affine>& columns);

}  // namespace switchyard::mip
