#include "switchyard/symbolic/name_table.hpp"

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

NameBlock NameBlock::Shaped(std::string base, int rows, int cols) {
  return {Form::kShaped, cols == 0 ? rows : rows * cols, std::move(base), rows, cols};
}

NameBlock NameBlock::Symmetric(std::string base, int rows) {
  return {Form::kSymmetric, static_cast<int>(ColumnStart(rows, rows)), std::move(base), rows, rows};
}

NameBlock NameBlock::Listed(std::vector<std::string> names) {
  const int count = static_cast<int>(names.size());
  NameBlock block(Form::kListed, count, {}, count, 0);
  block.listed_ = std::move(names);
  return block;
}

std::string NameBlock::Name(int k) const {
  switch (form_) {
    case Form::kListed:
      return listed_[static_cast<std::size_t>(k)];
    case Form::kSymmetric: {
      const std::int64_t column = ColumnOf(rows_, k);
      return Text(base_, "(", column + k - ColumnStart(rows_, column), ",", column, ")");
    }
    case Form::kShaped:
      break;
  }
  if (cols_ > 0) return Text(base_, "(", k % rows_, ",", k / rows_, ")");
  return rows_ == 1 ? base_ : Text(base_, "(", k, ")");
}

void NameTable::Add(std::shared_ptr<const NameBlock> block) {
  const int count = block->size();
  if (count == 0) return;
  entries_.push_back({size_, std::move(block)});
  size_ += count;
}

std::string NameTable::Name(int i) const {
  Require(i >= 0 && i < size_, "name ", i, ": there are ", size_);
  const auto behind = std::upper_bound(entries_.begin(), entries_.end(), i,
                                       [](int at, const Entry& e) { return at < e.first; });
  const Entry& entry = *std::prev(behind);
  return entry.block->Name(i - entry.first);
}

}  // namespace switchyard
