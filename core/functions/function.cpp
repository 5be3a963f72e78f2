#include "switchyard/functions/function.hpp"

#include <cstddef>

namespace switchyard {
namespace {

SparsityPattern WithRoom(int rows, int cols, std::size_t entries) {
  SparsityPattern pattern{.rows = rows, .cols = cols, .row = {}, .col = {}};
  pattern.row.reserve(entries);
  pattern.col.reserve(entries);
  return pattern;
}

}  // namespace

SparsityPattern SparsityPattern::Dense(int rows, int cols) {
  SparsityPattern pattern =
      WithRoom(rows, cols, static_cast<std::size_t>(rows) * static_cast<std::size_t>(cols));
  for (int j = 0; j < cols; ++j) {
    for (int i = 0; i < rows; ++i) pattern.Add(i, j);
  }
  return pattern;
}

SparsityPattern SparsityPattern::DenseUpperTriangle(int size) {
  const auto n = static_cast<std::size_t>(size);
  SparsityPattern pattern = WithRoom(size, size, n * (n + 1) / 2);
  for (int j = 0; j < size; ++j) {
    for (int i = 0; i <= j; ++i) pattern.Add(i, j);
  }
  return pattern;
}

}  // namespace switchyard
