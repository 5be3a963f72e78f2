// solvers/rounding/entries.hpp - rows that are being made, by their entries.
#pragma once

#include <cstdint>
#include <vector>

#include "switchyard/problem.hpp"

namespace switchyard::rounding {

struct Entry {
  std::int32_t variable;
  double value;
};
using Rows = std::vector<std::vector<Entry>>;

/// Rows as columns over `columns` variables.
inline Csc ByColumns(const Rows& rows, std::int32_t columns) {
  Csc by_rows(columns, static_cast<std::int32_t>(rows.size()));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (const Entry& e : rows[i]) {
      by_rows.row.push_back(e.variable);
      by_rows.value.push_back(e.value);
    }
    by_rows.start[i + 1] = static_cast<std::int32_t>(by_rows.row.size());
  }
  return Transpose(by_rows.View());
}

}  // namespace switchyard::rounding
