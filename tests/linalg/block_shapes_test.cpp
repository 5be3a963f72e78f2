// Blocks sorted by shape.
#include "solvers/linalg/block_shapes.hpp"

#include <gtest/gtest.h>

#include "tests/linalg/bordered.hpp"
#include "tests/linalg/reference.hpp"

namespace switchyard::linalg {
namespace {

class BlockShapes : public ::testing::TestWithParam<BorderedCase> {
 protected:
  void SetUp() override {
    matrix_ = RandomOf(GetParam(), random_);
    n_ = static_cast<Index>(matrix_.block.size());
    pattern_ = PatternOf(random_, n_, matrix_.pairs);
    classes_ = ClassifyBlocks(pattern_, matrix_.sign, matrix_.block, matrix_.count);
  }
  /// The part of a list that is the k-th block's.
  static std::vector<Index> Part(const std::vector<Index>& lists, std::size_t each, Index k) {
    const auto begin = lists.begin() + static_cast<std::ptrdiff_t>(each) * k;
    return {begin, begin + static_cast<std::ptrdiff_t>(each)};
  }
  /// What a block's rows are in the whole matrix: own ones in the order of elimination, border.
  static std::vector<Index> Rows(const BlockClass& c, Index k) {
    std::vector<Index> rows = Part(c.column, c.shape.columns, k);
    for (const Index r : Part(c.border, c.shape.border, k)) rows.push_back(r);
    return rows;
  }
  Random random_{14};
  Bordered matrix_;
  Index n_ = 0;
  SymmetricPattern pattern_;
  std::vector<BlockClass> classes_;
};

TEST_P(BlockShapes, AreAsManyAsThereAreKindsAndHoldAllBlocks) {
  ASSERT_EQ(classes_.size(), GetParam().kinds.size());
  std::vector<int> seen(n_, 0);
  for (const BlockKind& kind : GetParam().kinds) {
    const auto same = [&](const BlockClass& c) { return c.shape.columns == kind.columns; };
    const auto c = std::find_if(classes_.begin(), classes_.end(), same);
    ASSERT_NE(c, classes_.end());
    EXPECT_EQ(c->count, kind.count);
    EXPECT_EQ(c->shape.border, kind.border);
    for (const Index j : c->column) ++seen[j];
  }
  for (Index j = 0; j < n_; ++j) EXPECT_EQ(seen[j], matrix_.block[j] >= 0 ? 1 : 0);
}

TEST_P(BlockShapes, TakeEachEntryOfTheirColumnsOnce) {
  std::vector<Pair> place(pattern_.nonzeros());
  std::vector<int> due(pattern_.nonzeros()), taken(pattern_.nonzeros(), 0);
  ForEntries(pattern_, [&](Index i, Index j, Index e) {
    place[e] = {i, j};
    due[e] = matrix_.block[i] >= 0 || matrix_.block[j] >= 0 ? 1 : 0;
  });
  for (const BlockClass& c : classes_) {
    const BlockShape& s = c.shape;
    std::vector<Index> column_of;  // of each position
    for (Index k = 0; k < s.columns; ++k) {
      column_of.insert(column_of.end(), s.column_start[k + 1] - s.column_start[k], k);
    }
    for (Index k = 0; k < c.count; ++k) {
      const std::vector<Index> rows = Rows(c, k);
      const std::vector<Index> entries = Part(c.entry, s.entry_position.size(), k);
      for (std::size_t e = 0; e < entries.size(); ++e) {
        const Index p = s.entry_position[e];
        const Index i = rows[s.row[p]], j = rows[column_of[p]];
        EXPECT_EQ(Pair(std::minmax(i, j)), place[entries[e]]);
        ++taken[entries[e]];
      }
    }
  }
  EXPECT_EQ(taken, due);
}

std::vector<Index> RowsOf(const BlockShape& s, Index column) {
  return {s.row.begin() + s.column_start[column], s.row.begin() + s.column_start[column + 1]};
}

// And a few zeros, where columns are eliminated together.
TEST_P(BlockShapes, HoldWhatADenseEliminationFills) {
  std::size_t entries = 0, filled = 0;
  for (const BlockClass& c : classes_) {
    const BlockShape& s = c.shape;
    for (Index k = 0; k < c.count; ++k) {
      std::vector<Index> order = Rows(c, k);
      std::vector<char> named(n_, 0);
      for (const Index j : order) named[j] = 1;
      for (Index j = 0; j < n_; ++j) {
        if (named[j] == 0) order.push_back(j);
      }
      const Square<char> l = Filled(pattern_, order);
      for (Index j = 0; j < s.columns; ++j) {
        std::vector<Index> rows = {j};
        for (Index i = j + 1; i < n_; ++i) {
          if (l(i, j) != 0) rows.push_back(i);
        }
        const std::vector<Index> held = RowsOf(s, j);
        EXPECT_TRUE(std::ranges::includes(held, rows));
        filled += rows.size();
        entries += held.size();
        EXPECT_EQ(s.sign[j], matrix_.sign[order[j]]);
      }
    }
  }
  EXPECT_LE(static_cast<double>(entries - filled), 0.12 * static_cast<double>(entries));
}

TEST_P(BlockShapes, EliminateTogetherWhatHasTheSameRows) {
  for (const BlockClass& c : classes_) {
    const BlockShape& s = c.shape;
    for (Index k = 0; k < s.columns; k += s.panel[k]) {
      EXPECT_TRUE(s.panel[k] == 1 || s.panel[k] == 2 || s.panel[k] == 4);
      ASSERT_LE(k + s.panel[k], s.columns);
      for (Index j = k; j + 1 < k + s.panel[k]; ++j) {
        std::vector<Index> next = RowsOf(s, j + 1);
        next.insert(next.begin(), j);
        EXPECT_EQ(RowsOf(s, j), next);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Every, BlockShapes, ::testing::ValuesIn(BorderedCases()), NameOfBordered);

TEST(BlockShapes, AreTwoWhereOnlyASignDiffers) {
  Random random(15);
  const SymmetricPattern p = PatternOf(random, 4, {});
  EXPECT_EQ(ClassifyBlocks(p, {1, 1, -1, 1}, {0, 1, 2, 3}, 4).size(), 2U);
}

// Blocks {0, 1} and {2, 3} both meet 4 and 5, but in turn.
TEST(BlockShapes, AreOneWhereTheBorderStandsInAnotherOrder) {
  Random random(16);
  const SymmetricPattern p = PatternOf(random, 6, {{0, 4}, {1, 4}, {1, 5}, {2, 5}, {3, 5}, {3, 4}});
  EXPECT_EQ(ClassifyBlocks(p, {1, 1, 1, 1, 1, 1}, {0, 0, 1, 1, -1, -1}, 2).size(), 1U);
}

}  // namespace
}  // namespace switchyard::linalg
