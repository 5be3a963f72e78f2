// pattern_builder.hpp - a symmetric pattern from places in any order.
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

#include "solvers/linalg/symmetric_pattern.hpp"

namespace switchyard::ipopt {

/// Places of a symmetric matrix gathered one by one, and the entry that each becomes.
class PatternBuilder {
 public:
  explicit PatternBuilder(linalg::Index n) { pattern_.n = n; }

  std::size_t Add(linalg::Index i, linalg::Index j) {
    const auto [low, high] = std::minmax(i, j);
    row_.push_back(low);
    col_.push_back(high);
    return row_.size() - 1;
  }
  [[nodiscard]] std::size_t size() const { return row_.size(); }

  /// The entry of each place, by columns.
  std::vector<linalg::Index> Finish() {
    const auto n = static_cast<std::size_t>(pattern_.n);
    std::vector<std::size_t> start(n + 1, 0), by_column(row_.size());
    for (const linalg::Index j : col_) ++start[static_cast<std::size_t>(j) + 1];
    std::partial_sum(start.begin(), start.end(), start.begin());
    std::vector<std::size_t> next(start.begin(), start.end() - 1);
    for (std::size_t k = 0; k < row_.size(); ++k) by_column[next[col_[k]]++] = k;
    std::vector<linalg::Index> entry(row_.size()), seen(n, -1);
    for (std::size_t j = 0; j < n; ++j) {
      const linalg::Index first = pattern_.nonzeros();
      for (std::size_t p = start[j]; p < start[j + 1]; ++p) {
        linalg::Index& at = seen[row_[by_column[p]]];
        if (at < first) {
          at = static_cast<linalg::Index>(pattern_.row.size());
          pattern_.row.push_back(row_[by_column[p]]);
        }
        entry[by_column[p]] = at;
      }
      pattern_.start.push_back(static_cast<linalg::Index>(pattern_.row.size()));
    }
    return entry;
  }
  [[nodiscard]] linalg::SymmetricPattern& pattern() { return pattern_; }

 private:
  linalg::SymmetricPattern pattern_;
  std::vector<linalg::Index> row_, col_;
};

}  // namespace switchyard::ipopt
