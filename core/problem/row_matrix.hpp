// core/problem/row_matrix.hpp - a sparse matrix written row by row.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "switchyard/problem.hpp"

namespace switchyard {

/// Entries of one row in one column are summed. Written once, then taken by columns.
class RowMatrix {
 public:
  /// What follows belongs to a new row; returns its number.
  std::int32_t Begin() {
    by_rows_.start.push_back(by_rows_.start.back());
    return by_rows_.cols++;
  }
  void Add(std::int32_t column, double value) {
    if (value == 0) return;
    const auto j = static_cast<std::size_t>(column);
    if (j >= last_.size()) last_.resize(2 * j + 16, -1);
    const std::int32_t begin = by_rows_.start[by_rows_.start.size() - 2];
    if (last_[j] >= begin) {
      by_rows_.value[static_cast<std::size_t>(last_[j])] += value;
      return;
    }
    last_[j] = by_rows_.start.back()++;
    by_rows_.row.push_back(column);
    by_rows_.value.push_back(value);
  }
  /// Takes the row that was begun last away.
  void Drop() {
    by_rows_.start.pop_back();
    --by_rows_.cols;
    for (const std::int32_t j : std::span(by_rows_.row).subspan(End())) {
      last_[static_cast<std::size_t>(j)] = -1;
    }
    by_rows_.row.resize(End());
    by_rows_.value.resize(End());
  }
  [[nodiscard]] std::int32_t rows() const { return by_rows_.cols; }
  /// The columns of the row that was begun last, and their values.
  [[nodiscard]] std::span<const std::int32_t> Columns() const {
    return std::span(by_rows_.row)
        .subspan(static_cast<std::size_t>(by_rows_.start[by_rows_.start.size() - 2]));
  }
  [[nodiscard]] std::span<const double> Values() const {
    return std::span(by_rows_.value)
        .subspan(static_cast<std::size_t>(by_rows_.start[by_rows_.start.size() - 2]));
  }
  /// The matrix by columns; this one is empty then.
  Csc Take(std::int32_t columns) {
    by_rows_.rows = columns;
    Csc by_columns = Transpose(by_rows_.View());
    by_columns.value.resize(by_columns.row.size());
    *this = RowMatrix();
    return by_columns;
  }

 private:
  [[nodiscard]] std::size_t End() const { return static_cast<std::size_t>(by_rows_.start.back()); }

  Csc by_rows_;                     // the transpose: a column for each row
  std::vector<std::int32_t> last_;  // where each column's last entry is
};

}  // namespace switchyard
