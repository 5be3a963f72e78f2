#include "solvers/conic/blocks.hpp"

#include <algorithm>
#include <numeric>
#include <span>

#include "solvers/linalg/block_shapes.hpp"

namespace switchyard::conic {
namespace {

constexpr double kShare = 0.6;        // of the variables that blocks must hold to be worth it
constexpr std::size_t kShortRow = 4;  // entries
constexpr Index kSmall = 40;          // variables of a block
constexpr Index kFewest = 8;          // blocks

class Sets {
 public:
  explicit Sets(Index count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }
  Index Find(Index i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void Join(Index a, Index b) { parent_[Find(a)] = Find(b); }

 private:
  std::vector<Index> parent_;
};

std::span<const Index> RowOf(const linalg::SparseMatrix& a, Index r) {
  return {a.column.data() + a.row_start[r],
          static_cast<std::size_t>(a.row_start[r + 1] - a.row_start[r])};
}

/// What meets in P or in a cone.
void JoinInseparable(const Form& form, Sets& sets) {
  for (Index j = 0; j < form.shape.vars; ++j) {
    for (Index e = form.P.pattern.start[j]; e < form.P.pattern.start[j + 1]; ++e) {
      sets.Join(j, form.P.pattern.row[e]);
    }
  }
  for (const ConeGroup& g : form.cones) {
    for (Index c = 0; c < g.layout.count; ++c) {
      Index first = -1;
      for (Index i = 0; i < g.layout.dim; ++i) {
        for (const Index j : RowOf(form.A, g.first + g.layout.Row(c, i))) {
          if (first < 0) first = j;
          sets.Join(first, j);
        }
      }
    }
  }
}

/// Inequalities over the very same variables as another one.
void JoinRepeated(const Form& form, Sets& sets) {
  struct Key {
    std::uint64_t hash;
    Index row;
  };
  std::vector<Key> keys;
  for (Index r = form.shape.cone_rows; r < form.shape.conic_rows(); ++r) {
    std::uint64_t hash = 1469598103934665603ULL;
    for (const Index j : RowOf(form.A, r)) {
      hash = (hash ^ static_cast<std::uint64_t>(j)) * 1099511628211ULL;
      hash ^= hash >> 31;
    }
    keys.push_back({hash, r});
  }
  std::sort(keys.begin(), keys.end(), [](const Key& a, const Key& b) {
    return a.hash != b.hash ? a.hash < b.hash : a.row < b.row;
  });
  for (std::size_t k = 1; k < keys.size(); ++k) {
    const auto row = RowOf(form.A, keys[k].row), before = RowOf(form.A, keys[k - 1].row);
    if (keys[k].hash != keys[k - 1].hash || !std::ranges::equal(row, before)) continue;
    for (const Index j : row) sets.Join(row[0], j);
  }
}

/// Variables of the largest block.
Index Largest(const Blocks& blocks) {
  std::vector<Index> size(blocks.count, 0);
  for (const Index b : blocks.of_variable) {
    if (b >= 0) ++size[b];
  }
  return size.empty() ? 0 : *std::ranges::max_element(size);
}

/// Inequalities that are condensed for their few variables.
void JoinShortRows(const Form& form, Sets& sets) {
  for (Index r = form.shape.cone_rows; r < form.shape.conic_rows(); ++r) {
    const auto row = RowOf(form.A, r);
    if (row.size() > kShortRow) continue;
    for (const Index j : row) sets.Join(row[0], j);
  }
}

/// Numbers the sets that are blocks, and finds the rows within one.
Blocks FromSets(const Form& form, Sets& sets) {
  const Index n = form.shape.vars;
  std::vector<Index> size(n, 0), number(n, -1);
  for (Index j = 0; j < n; ++j) ++size[sets.Find(j)];
  Blocks blocks;
  blocks.of_variable.assign(n, -1);
  for (Index j = 0; j < n; ++j) {
    const Index root = sets.Find(j);
    if (size[root] < 2 || size[root] > linalg::kMostColumns) continue;
    if (number[root] < 0) number[root] = blocks.count++;
    blocks.of_variable[j] = number[root];
  }
  blocks.of_row.assign(form.A.rows, -1);
  for (Index r = 0; r < form.A.rows; ++r) {
    const auto row = RowOf(form.A, r);
    if (row.empty()) continue;
    const Index block = blocks.of_variable[row[0]];
    const bool within =
        std::ranges::all_of(row, [&](Index j) { return blocks.of_variable[j] == block; });
    if (within) blocks.of_row[r] = block;
  }
  return blocks;
}

}  // namespace

Blocks GivenBlocks(const Form& form, const std::vector<Index>& of_variable) {
  Sets sets(form.shape.vars);
  std::vector<Index> first;
  for (Index j = 0; j < form.shape.vars; ++j) {
    const Index block = of_variable[j];
    if (block < 0) continue;
    if (static_cast<std::size_t>(block) >= first.size()) first.resize(block + 1, -1);
    if (first[block] < 0) first[block] = j;
    sets.Join(j, first[block]);
  }
  JoinInseparable(form, sets);
  return FromSets(form, sets);
}

Blocks FindBlocks(const Form& form) {
  // First with what short rows join, as long as that makes small blocks of it all: in large ones
  // what little meets there would be eliminated as if all did.
  for (const bool short_rows : {true, false}) {
    Sets sets(form.shape.vars);
    JoinInseparable(form, sets);
    JoinRepeated(form, sets);
    if (short_rows) JoinShortRows(form, sets);
    Blocks blocks = FromSets(form, sets);
    const auto held = std::ranges::count_if(blocks.of_variable, [](Index b) { return b >= 0; });
    if (short_rows && Largest(blocks) > kSmall) continue;
    const bool worth = static_cast<double>(held) >= kShare * form.shape.vars;
    if (worth && blocks.count >= kFewest) return blocks;
  }
  return {};
}

}  // namespace switchyard::conic
