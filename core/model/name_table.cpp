#include "switchyard/model/name_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "switchyard/error.hpp"

namespace switchyard {
namespace {

// The first place of column j in the lower triangle of n rows, column by column.
std::int64_t ColumnStart(std::int64_t n, std::int64_t j) { return j * n - j * (j - 1) / 2; }

// The column that place k of that triangle lies in: the largest j with ColumnStart(n, j) <= k. The
// root of the quadratic gives it up to rounding.
std::int64_t ColumnOf(std::int64_t n, std::int64_t k) {
  const double twice = 2 * static_cast<double>(n) + 1;
  const double root = std::sqrt(std::max(0.0, twice * twice - 8 * static_cast<double>(k)));
  auto j = std::clamp<std::int64_t>(static_cast<std::int64_t>((twice - root) / 2), 0, n - 1);
  while (j > 0 && ColumnStart(n, j) > k) --j;
  while (j + 1 < n && ColumnStart(n, j + 1) <= k) ++j;
  return j;
}

}  // namespace

void NameTable::AddShaped(std::string base, int rows, int cols) {
  const int count = cols == 0 ? rows : rows * cols;
  if (count == 0) return;
  blocks_.push_back({size_, Form::kShaped, std::move(base), rows, cols, {}});
  size_ += count;
}

void NameTable::AddSymmetric(std::string base, int rows) {
  if (rows == 0) return;
  blocks_.push_back({size_, Form::kSymmetric, std::move(base), rows, rows, {}});
  size_ += static_cast<int>(ColumnStart(rows, rows));
}

void NameTable::AddListed(std::vector<std::string> names) {
  if (names.empty()) return;
  const int count = static_cast<int>(names.size());
  blocks_.push_back({size_, Form::kListed, {}, count, 0, std::move(names)});
  size_ += count;
}

std::string NameTable::Name(int i) const {
  Require(i >= 0 && i < size_, "name ", i, ": there are ", size_);
  const auto behind = std::upper_bound(blocks_.begin(), blocks_.end(), i,
                                       [](int at, const Block& b) { return at < b.first; });
  const Block& block = *std::prev(behind);
  const int k = i - block.first;
  switch (block.form) {
    case Form::kListed:
      return block.listed[static_cast<std::size_t>(k)];
    case Form::kSymmetric: {
      const std::int64_t column = ColumnOf(block.rows, k);
      return Text(block.base, "(", column + k - ColumnStart(block.rows, column), ",", column, ")");
    }
    case Form::kShaped:
      break;
  }
  if (block.cols > 0) return Text(block.base, "(", k % block.rows, ",", k / block.rows, ")");
  return block.rows == 1 ? block.base : Text(block.base, "(", k, ")");
}

}  // namespace switchyard
