// What is predicted of an elimination, and the choice of its order.
#include "solvers/linalg/elimination.hpp"

#include <gtest/gtest.h>

#include "solvers/linalg/ordering.hpp"
#include "tests/linalg/reference.hpp"

namespace switchyard::linalg {
namespace {

class Eliminations : public ::testing::TestWithParam<Case> {
 protected:
  SymmetricPattern Pattern(bool diagonal = true) {
    return PatternOf(random_, GetParam().n, GetParam().pairs(random_, GetParam().n), diagonal);
  }
  /// In a random order and in one that fills in little.
  std::vector<Elimination> Both(const SymmetricPattern& p) {
    return {Eliminate(p, RandomOrder(random_, p.n)), Eliminate(p, MinimumDegreeOrder(p))};
  }
  Random random_{8};
};

TEST_P(Eliminations, PredictTheFactorAndTheWorkThatADenseOneCounts) {
  for (const bool diagonal : {true, false}) {
    const SymmetricPattern p = Pattern(diagonal);
    for (const Elimination& e : Both(p)) {
      const Square<char> l = Filled(p, e.order);
      double entries = 0, multiplications = 0;
      for (Index k = 0; k < p.n; ++k) {
        Index size = 0;
        for (Index i = k + 1; i < p.n; ++i) size += l(i, k);
        EXPECT_EQ(e.column_size[k], size);
        entries += size;
        multiplications += size;  // by the inverse pivot
        for (Index i = k + 1; i < p.n; ++i) {
          for (Index j = k + 1; j <= i; ++j) multiplications += l(i, k) * l(j, k);
        }
      }
      EXPECT_EQ(e.FactorSize(), entries);
      EXPECT_EQ(e.Work(), multiplications);
    }
  }
}

TEST_P(Eliminations, HaveTheFirstRowOfEachColumnForItsParent) {
  const SymmetricPattern p = Pattern();
  for (const Elimination& e : Both(p)) {
    const Square<char> l = Filled(p, e.order);
    for (Index k = 0; k < p.n; ++k) {
      Index first = -1;
      for (Index i = p.n - 1; i > k; --i) {
        if (l(i, k) != 0) first = i;
      }
      EXPECT_EQ(e.parent[k], first);
    }
  }
}

TEST_P(Eliminations, AreInAPostorderThatFillsInAsTheGivenOrder) {
  const SymmetricPattern p = Pattern();
  const std::vector<Index> order = RandomOrder(random_, p.n);
  const Elimination e = Eliminate(p, order);
  std::vector<Index> descendants(p.n, 0);
  for (Index k = 0; k < p.n; ++k) {
    // The columns of the subtree of k are the ones right before it.
    for (Index i = k - descendants[k]; i < k; ++i) EXPECT_TRUE(e.parent[i] > i && e.parent[i] <= k);
    if (e.parent[k] >= 0) descendants[e.parent[k]] += descendants[k] + 1;
  }
  const Square<char> l = Filled(p, order);
  double entries = 0;
  for (Index k = 0; k < p.n; ++k) {
    for (Index i = k + 1; i < p.n; ++i) entries += l(i, k);
  }
  EXPECT_EQ(e.FactorSize(), entries);
}

bool Respects(const SymmetricPattern& p, const std::vector<Index>& group, const Elimination& e) {
  const std::vector<Index> place = Inverse(e.order);
  bool respects = true;
  ForEntries(p, [&](Index i, Index j, Index) {
    if (group[i] != group[j]) respects = respects && (group[i] < group[j]) == (place[i] < place[j]);
  });
  return respects;
}

TEST_P(Eliminations, RespectGroupsWhereTheySayTheyDo) {
  const SymmetricPattern p = Pattern();
  std::vector<Index> group(p.n);
  for (Index& g : group) g = random_.Below(2);
  const Planned planned = LeastWork(p, {group, 20});
  ASSERT_EQ(static_cast<Index>(planned.elimination.order.size()), p.n);
  if (planned.respects_groups) {
    EXPECT_TRUE(Respects(p, group, planned.elimination));
  }
}

TEST_P(Eliminations, OfNoGroupsTakeNoMoreWorkThanByMinimumDegree) {
  const SymmetricPattern p = Pattern();
  const Planned planned = LeastWork(p, {});
  EXPECT_LE(planned.elimination.Work(), Eliminate(p, MinimumDegreeOrder(p)).Work());
  EXPECT_TRUE(planned.respects_groups);
}

INSTANTIATE_TEST_SUITE_P(Every, Eliminations, ::testing::ValuesIn(Cases()), NameOf);

// To delay the tip is free; to make all the others wait for it would fill in everything.
TEST(LeastWork, DropsGroupsOnlyWhereTheyCostMostOfTheWork) {
  Random random(9);
  const Index n = 200;
  const SymmetricPattern p = PatternOf(random, n, ArrowPairs(n, 0));
  std::vector<Index> tip(n, 0), others(n, 1);
  tip[0] = 1;
  others[0] = 0;
  EXPECT_TRUE(LeastWork(p, {tip, 20}).respects_groups);
  const Planned free = LeastWork(p, {others, 20});
  EXPECT_FALSE(free.respects_groups);
  EXPECT_EQ(free.elimination.FactorSize(), n - 1);
}

}  // namespace
}  // namespace switchyard::linalg
