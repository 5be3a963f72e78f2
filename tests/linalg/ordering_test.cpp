// Orders of elimination.
#include "solvers/linalg/ordering.hpp"

#include <gtest/gtest.h>

#include "solvers/linalg/elimination.hpp"
#include "tests/linalg/matrices.hpp"

namespace switchyard::linalg {
namespace {

bool IsOrder(std::vector<Index> order, Index n) {
  std::sort(order.begin(), order.end());
  for (std::size_t k = 0; k < order.size(); ++k) {
    if (order[k] != static_cast<Index>(k)) return false;
  }
  return static_cast<Index>(order.size()) == n;
}

class Orders : public ::testing::TestWithParam<Case> {
 protected:
  SymmetricPattern Pattern(bool diagonal = true) {
    return PatternOf(random_, GetParam().n, GetParam().pairs(random_, GetParam().n), diagonal);
  }
  Random random_{5};
};

TEST_P(Orders, NameEveryColumnOnce) {
  for (const bool diagonal : {true, false}) {
    const SymmetricPattern p = Pattern(diagonal);
    EXPECT_TRUE(IsOrder(MinimumDegreeOrder(p), p.n));
    const std::vector<Index> dissection = NestedDissectionOrder(p);
    const bool has_pairs = p.nonzeros() > (diagonal ? p.n : 0);
    if (has_pairs) {
      EXPECT_TRUE(IsOrder(dissection, p.n));
    } else {
      EXPECT_TRUE(dissection.empty());
    }
  }
}

TEST_P(Orders, AreTheSameOnEveryRun) {
  const SymmetricPattern p = Pattern();
  EXPECT_EQ(MinimumDegreeOrder(p), MinimumDegreeOrder(p));
  EXPECT_EQ(NestedDissectionOrder(p), NestedDissectionOrder(p));
}

// A column of group 1 goes with the last of those it waits for, and nothing else changes place.
TEST_P(Orders, DelayedLetColumnsWaitForTheirNeighboursAndNoLonger) {
  for (int trial = 0; trial < 5; ++trial) {
    const SymmetricPattern p = Pattern();
    std::vector<Index> group(p.n);
    for (Index& g : group) g = random_.Below(2);
    const std::vector<Index> order = RandomOrder(random_, p.n);
    const std::vector<Index> delayed = Delayed(p, group, order);
    ASSERT_TRUE(IsOrder(delayed, p.n));
    std::vector<Index> due = Inverse(order);
    const std::vector<Index> given = due, place = Inverse(delayed);
    ForEntries(p, [&](Index i, Index j, Index) {
      if (group[i] == group[j]) return;
      const Index waits = group[i] == 1 ? i : j, first = i + j - waits;
      EXPECT_LT(place[first], place[waits]);
      due[waits] = std::max(due[waits], given[first]);
    });
    for (Index k = 1; k < p.n; ++k) EXPECT_LE(due[delayed[k - 1]], due[delayed[k]]);
  }
}

INSTANTIATE_TEST_SUITE_P(Every, Orders, ::testing::ValuesIn(Cases()), NameOf);

// What tells an order from its inverse.
TEST(Ordering, FillsInAGridFarLessThanItsRowsInTurnDo) {
  Random random(6);
  const Index side = 40;
  SymmetricPattern p = PatternOf(random, side * side, GridPairs(side, side));
  std::vector<Index> in_turn(p.n);
  for (Index k = 0; k < p.n; ++k) in_turn[k] = k;
  const double work = Eliminate(p, in_turn).Work();
  EXPECT_LT(Eliminate(p, MinimumDegreeOrder(p)).Work(), 0.35 * work);
  EXPECT_LT(Eliminate(p, NestedDissectionOrder(p)).Work(), 0.35 * work);
}

TEST(Ordering, LeavesTheTipOfAnArrowForLast) {
  Random random(7);
  for (const Index tip : {0, 40, 79}) {
    const SymmetricPattern p = PatternOf(random, 80, ArrowPairs(80, tip));
    EXPECT_EQ(Eliminate(p, MinimumDegreeOrder(p)).FactorSize(), 79);
    EXPECT_EQ(LeastWork(p, {}).elimination.FactorSize(), 79);
  }
}

}  // namespace
}  // namespace switchyard::linalg
