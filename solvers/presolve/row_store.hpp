// solvers/presolve/row_store.hpp - a sparse matrix by rows, of which some are replaced.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "switchyard/problem.hpp"

namespace switchyard::presolve {

using Index = std::int32_t;

struct Entry {
  Index column;
  double value;
};

/// Rows with ascending columns. What columns hold is known too, with some that once held it.
class RowStore {
 public:
  /// Entries that are 0 may be left out.
  RowStore(const Csc& a, bool without_zeros);

  [[nodiscard]] Index rows() const { return static_cast<Index>(start_.size()) - 1; }
  [[nodiscard]] std::span<const Entry> Row(Index i) const {
    if (replaced_[i] >= 0) return replacement_[replaced_[i]];
    return std::span(entry_).subspan(start_[i], start_[i + 1] - start_[i]);
  }
  void Replace(Index i, std::vector<Entry> row);

  /// Calls back with the number of every row that holds, or held, column j; once or more often.
  template <class Take>
  void EachRowOf(Index j, Take&& take) const {
    for (Index k = column_start_[j]; k < column_start_[j + 1]; ++k) take(row_[k]);
    for (const Index i : later_[j]) take(i);
  }

 private:
  std::vector<Index> start_;
  std::vector<Entry> entry_;
  std::vector<Index> column_start_, row_;
  std::vector<Index> replaced_;  // of each row: its place in replacement_; -1: it stands as it was
  std::vector<std::vector<Entry>> replacement_;
  std::vector<std::vector<Index>> later_;  // of each column: rows that came to hold it
};

}  // namespace switchyard::presolve
