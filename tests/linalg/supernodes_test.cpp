// Columns that are eliminated together.
#include "solvers/linalg/supernodes.hpp"

#include <gtest/gtest.h>

#include "solvers/linalg/ordering.hpp"
#include "tests/linalg/reference.hpp"

namespace switchyard::linalg {
namespace {

class Fronts : public ::testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    pattern_ = PatternOf(random_, GetParam().n, GetParam().pairs(random_, GetParam().n));
    elimination_ = Eliminate(pattern_, MinimumDegreeOrder(pattern_));
    tree_ = FindSupernodes(elimination_);
  }
  /// Of a front's row, pivots first: the column of the matrix.
  [[nodiscard]] Index Column(const Supernode& s, Index row) const {
    return row < s.pivots ? s.first + row : tree_.row[s.row_start + row - s.pivots];
  }
  Random random_{10};
  SymmetricPattern pattern_;
  Elimination elimination_;
  Supernodes tree_;
};

TEST_P(Fronts, PartitionTheColumns) {
  Index next = 0;
  for (const Supernode& s : tree_.nodes) {
    EXPECT_EQ(s.first, next);
    EXPECT_GE(s.pivots, 1);
    next = s.first + s.pivots;
  }
  EXPECT_EQ(next, pattern_.n);
}

TEST_P(Fronts, HoldEveryEntryOfTheFactor) {
  const Square<char> l = Filled(pattern_, elimination_.order);
  for (const Supernode& s : tree_.nodes) {
    std::vector<char> held(pattern_.n, 0);
    for (Index k = 0; k < s.rows; ++k) {
      const Index row = Column(s, s.pivots + k);
      ASSERT_GE(row, s.first + s.pivots);
      if (k > 0) {
        EXPECT_GT(row, Column(s, s.pivots + k - 1));
      }
      held[row] = 1;
      // None that no column needs.
      bool needed = false;
      for (Index j = s.first; j < s.first + s.pivots; ++j) needed = needed || l(row, j) != 0;
      EXPECT_TRUE(needed);
    }
    for (Index j = s.first; j < s.first + s.pivots; ++j) {
      for (Index i = s.first + s.pivots; i < pattern_.n; ++i) {
        EXPECT_LE(l(i, j), held[i]);
      }
    }
  }
}

TEST_P(Fronts, FindTheirRowsInTheirParents) {
  std::vector<Index> children(tree_.nodes.size(), 0);
  for (std::size_t k = 0; k < tree_.nodes.size(); ++k) {
    const Supernode& s = tree_.nodes[k];
    EXPECT_EQ(s.parent < 0, s.rows == 0);
    if (s.parent < 0) continue;
    ASSERT_GT(s.parent, static_cast<Index>(k));
    ++children[s.parent];
    const Supernode& parent = tree_.nodes[s.parent];
    for (Index i = 0; i < s.rows; ++i) {
      const Index place = tree_.in_parent[s.row_start + i];
      ASSERT_LT(place, parent.pivots + parent.rows);
      EXPECT_EQ(Column(parent, place), tree_.row[s.row_start + i]);
    }
  }
  EXPECT_EQ(children, tree_.num_children);
}

TEST_P(Fronts, TakeEachEntryOfTheMatrixOnce) {
  std::vector<Pair> place(pattern_.nonzeros());
  ForEntries(pattern_, [&](Index i, Index j, Index e) { place[e] = {i, j}; });
  std::vector<int> taken(pattern_.nonzeros(), 0);
  for (std::size_t k = 0; k < tree_.nodes.size(); ++k) {
    const Supernode& s = tree_.nodes[k];
    const std::size_t end = k + 1 < tree_.nodes.size()
                                ? static_cast<std::size_t>(tree_.nodes[k + 1].entry_start)
                                : tree_.entry.size();
    for (auto e = static_cast<std::size_t>(s.entry_start); e < end; ++e) {
      const FrontEntry& at = tree_.entry[e];
      EXPECT_GE(at.row, at.column);
      const Index i = elimination_.order[Column(s, at.row)];
      const Index j = elimination_.order[Column(s, at.column)];
      EXPECT_EQ(Pair(std::minmax(i, j)), place[at.entry]);
      ++taken[at.entry];
    }
  }
  EXPECT_EQ(taken, std::vector<int>(pattern_.nonzeros(), 1));
}

TEST_P(Fronts, AddZerosButFewerThanSixInTen) {
  EXPECT_GE(tree_.FactorSize(), elimination_.FactorSize() + pattern_.n);
  double entries = 0;
  for (const Supernode& s : tree_.nodes) {
    for (Index k = 0; k < s.pivots; ++k) entries += s.pivots - k + s.rows;
  }
  EXPECT_EQ(tree_.FactorSize(), entries);
  EXPECT_LE(0.4 * entries, elimination_.FactorSize() + pattern_.n);
}

INSTANTIATE_TEST_SUITE_P(Every, Fronts, ::testing::ValuesIn(Cases()), NameOf);

TEST(Supernodes, MakeOneFrontOfAFullMatrixAndOneForEachPieceOfADiagonalOne) {
  Random random(11);
  const SymmetricPattern full = PatternOf(random, 60, SparsePairs(random, 60, 1));
  EXPECT_EQ(FindSupernodes(Eliminate(full, RandomOrder(random, 60))).nodes.size(), 1U);
  const SymmetricPattern diagonal = PatternOf(random, 60, {});
  EXPECT_EQ(FindSupernodes(Eliminate(diagonal, RandomOrder(random, 60))).nodes.size(), 60U);
}

}  // namespace
}  // namespace switchyard::linalg
