#include "core/functions/pattern_index.hpp"

#include <algorithm>

#include "switchyard/error.hpp"

namespace switchyard {

PatternIndex::PatternIndex(const SparsityPattern& pattern)
    : start_(pattern.cols + 1, 0), row_at_(pattern.size()) {
  for (const int j : pattern.col) ++start_[j + 1];
  for (int j = 0; j < pattern.cols; ++j) start_[j + 1] += start_[j];
  std::vector<int> end(start_.begin(), start_.end() - 1);
  for (int k = 0; k < pattern.size(); ++k) row_at_[end[pattern.col[k]]++] = {pattern.row[k], k};
  for (int j = 0; j < pattern.cols; ++j) {
    std::sort(row_at_.begin() + start_[j], row_at_.begin() + start_[j + 1]);
  }
}

int PatternIndex::Find(int i, int j) const {
  const auto end = row_at_.begin() + start_[j + 1];
  const auto at = std::lower_bound(row_at_.begin() + start_[j], end, std::pair(i, 0));
  return at != end && at->first == i ? at->second : -1;
}

int PatternIndex::Need(std::string_view what, int i, int j) const {
  const int k = Find(i, j);
  Require(k >= 0, what, ": the entry in row ", i, " and column ", j,
          " is not in the declared pattern");
  return k;
}

void CheckPattern(std::string_view what, const SparsityPattern& pattern, int rows, int cols) {
  Require(pattern.rows == rows && pattern.cols == cols, what, ": the declared pattern needs to be ",
          rows, " x ", cols, ", got ", pattern.rows, " x ", pattern.cols);
  Require(pattern.row.size() == pattern.col.size(), what,
          ": the declared pattern needs a column for each row, got ", pattern.row.size(),
          " rows and ", pattern.col.size(), " columns");
  for (int k = 0; k < pattern.size(); ++k) {
    const int i = pattern.row[k];
    const int j = pattern.col[k];
    Require(i >= 0 && i < rows && j >= 0 && j < cols, what, ": place ", k,
            " of the declared pattern, row ", i, " and column ", j, ", is outside ", rows, " x ",
            cols);
  }
  const PatternIndex index(pattern);
  for (int k = 0; k < pattern.size(); ++k) {
    // Of two equal places one finds the other.
    Require(index.Find(pattern.row[k], pattern.col[k]) == k, what,
            ": the declared pattern has row ", pattern.row[k], " and column ", pattern.col[k],
            " twice");
  }
}

}  // namespace switchyard
