#include "solvers/presolve/row_store.hpp"

#include <utility>

namespace switchyard::presolve {

RowStore::RowStore(const Csc& a, bool without_zeros)
    : start_(static_cast<std::size_t>(a.rows) + 1, 0),
      column_start_(a.start),
      row_(a.row),
      replaced_(static_cast<std::size_t>(a.rows), -1),
      later_(static_cast<std::size_t>(a.cols)) {
  const auto is_left_out = [&](std::size_t k) { return without_zeros && a.value[k] == 0; };
  for (std::size_t k = 0; k < a.row.size(); ++k) start_[a.row[k] + 1] += is_left_out(k) ? 0 : 1;
  for (Index i = 0; i < a.rows; ++i) start_[i + 1] += start_[i];
  entry_.resize(start_.back());
  std::vector<Index> next(start_.begin(), start_.end() - 1);
  for (Index j = 0; j < a.cols; ++j) {
    for (Index k = a.start[j]; k < a.start[j + 1]; ++k) {
      if (!is_left_out(k)) entry_[next[a.row[k]]++] = {j, a.value[k]};
    }
  }
}

void RowStore::Replace(Index i, std::vector<Entry> row) {
  // Both are sorted: what the new one has and the old one has not.
  const std::span<const Entry> old = Row(i);
  std::size_t k = 0;
  for (const Entry& e : row) {
    while (k < old.size() && old[k].column < e.column) ++k;
    if (k == old.size() || old[k].column != e.column) later_[e.column].push_back(i);
  }
  if (replaced_[i] < 0) {
    replaced_[i] = static_cast<Index>(replacement_.size());
    replacement_.emplace_back();
  }
  replacement_[replaced_[i]] = std::move(row);
}

}  // namespace switchyard::presolve
