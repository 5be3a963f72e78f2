#include "core/lower/scatter.hpp"

#include <algorithm>
#include <numeric>

namespace switchyard {

Scatter::Scatter(std::int32_t rows, std::int32_t cols, const std::vector<std::int32_t>& row,
                 const std::vector<std::int32_t>& col)
    : pattern(rows, cols), slot(row.size()) {
  const auto at = [](std::int32_t i) { return static_cast<std::size_t>(i); };
  std::vector<std::int32_t> start(at(cols) + 1, 0);
  for (const std::int32_t j : col) ++start[at(j) + 1];
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<std::int32_t> order(row.size());
  std::vector<std::int32_t> next(start.begin(), start.end() - 1);
  for (std::size_t k = 0; k < col.size(); ++k) {
    order[at(next[at(col[k])]++)] = static_cast<std::int32_t>(k);
  }
  const auto by_row = [&](std::int32_t a, std::int32_t b) { return row[at(a)] < row[at(b)]; };
  pattern.row.reserve(row.size());
  for (std::int32_t j = 0; j < cols; ++j) {
    const auto first = order.begin() + start[at(j)];
    const auto last = order.begin() + start[at(j) + 1];
    if (!std::is_sorted(first, last, by_row)) std::sort(first, last, by_row);
    for (auto k = first; k != last; ++k) {
      const bool repeats = k != first && row[at(*k)] == pattern.row.back();
      if (!repeats) pattern.row.push_back(row[at(*k)]);
      slot[at(*k)] = static_cast<std::int32_t>(pattern.row.size()) - 1;
    }
    pattern.start[at(j) + 1] = static_cast<std::int32_t>(pattern.row.size());
  }
}

}  // namespace switchyard
