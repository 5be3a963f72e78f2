// core/functions/pattern_index.hpp - where a place stands in a sparsity pattern.
#pragma once

#include <string_view>
#include <utility>
#include <vector>

#include "switchyard/functions/function.hpp"

namespace switchyard {

class PatternIndex {
 public:
  explicit PatternIndex(const SparsityPattern& pattern);

  /// The k with (row[k], col[k]) = (i, j), -1 where there is none. Time O(log of the column).
  [[nodiscard]] int Find(int i, int j) const;

  /// The same, or InvalidArgument: `what` has an entry where the declared pattern has none.
  [[nodiscard]] int Need(std::string_view what, int i, int j) const;

 private:
  std::vector<int> start_;                   // of each column
  std::vector<std::pair<int, int>> row_at_;  // row, k; ascending in each column
};

/// Throws InvalidArgument where `pattern` is not one of a rows x cols matrix, or has a place twice.
void CheckPattern(std::string_view what, const SparsityPattern& pattern, int rows, int cols);

}  // namespace switchyard
