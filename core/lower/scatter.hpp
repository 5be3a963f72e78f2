// core/lower/scatter.hpp - values written at places of a sparse matrix in any order, places that
// meet added up.
#pragma once

#include <cstdint>
#include <vector>

#include "switchyard/problem.hpp"

namespace switchyard {

/// Where each of a list of places stands in the values of a compressed matrix.
struct Scatter {
  Csc pattern;                     // without values
  std::vector<std::int32_t> slot;  // of each place

  Scatter() = default;
  /// Of places (row[k], col[k]), some perhaps alike; in time linear in their number but for the
  /// sorting of columns.
  Scatter(std::int32_t rows, std::int32_t cols, const std::vector<std::int32_t>& row,
          const std::vector<std::int32_t>& col);
};

}  // namespace switchyard
