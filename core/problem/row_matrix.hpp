// core/problem/row_matrix.hpp - a sparse matrix written row by row.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "switchyard/problem.hpp"

namespace switchyard {

/// Behind `to`: from[first, last), each plus `shift`.
inline void AppendShifted(const std::vector<std::int32_t>& from, std::int32_t first,
                          std::int32_t last, std::int32_t shift, std::vector<std::int32_t>& to) {
  const std::size_t before = to.size();
  to.insert(to.end(), from.begin() + first, from.begin() + last);
  for (std::size_t k = before; k < to.size(); ++k) to[k] += shift;
}

/// Entries of one row in one column are summed. Written once, then read or taken by columns.
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
    const std::int64_t begin = cleared_ + by_rows_.start[by_rows_.start.size() - 2];
    if (last_[j] >= begin) {
      by_rows_.value[static_cast<std::size_t>(last_[j] - cleared_)] += value;
      return;
    }
    last_[j] = cleared_ + by_rows_.start.back()++;
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
  /// The rows [first, last) of another one, their columns further right.
  void Append(const RowMatrix& from, std::int32_t first, std::int32_t last, std::int32_t shift) {
    const Csc& rows = from.by_rows_;
    const std::int32_t begin = rows.start[static_cast<std::size_t>(first)];
    const std::int32_t end = rows.start[static_cast<std::size_t>(last)];
    const std::int32_t behind = by_rows_.start.back() - begin;
    AppendShifted(rows.start, first + 1, last + 1, behind, by_rows_.start);
    AppendShifted(rows.row, begin, end, shift, by_rows_.row);
    by_rows_.value.insert(by_rows_.value.end(), rows.value.begin() + begin,
                          rows.value.begin() + end);
    by_rows_.cols += last - first;
  }
  /// No rows; the memory stays.
  void Clear() {
    cleared_ += by_rows_.start.back();
    by_rows_.start.assign(1, 0);
    by_rows_.row.clear();
    by_rows_.value.clear();
    by_rows_.cols = 0;
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
  void WriteByColumns(std::int32_t columns, Csc& by_columns) const {
    sy_csc rows = by_rows_.View();
    rows.rows = columns;
    by_columns = Transpose(rows, std::move(by_columns));
    by_columns.value.resize(by_columns.row.size());
  }
  /// The matrix by columns; this one is empty then.
  Csc Take(std::int32_t columns) {
    Csc by_columns;
    WriteByColumns(columns, by_columns);
    *this = RowMatrix();
    return by_columns;
  }

 private:
  [[nodiscard]] std::size_t End() const { return static_cast<std::size_t>(by_rows_.start.back()); }

  Csc by_rows_;                     // the transpose: a column for each row
  std::vector<std::int64_t> last_;  // where each column's last entry is, behind all cleared ones
  std::int64_t cleared_ = 0;        // entries there were
};

}  // namespace switchyard
