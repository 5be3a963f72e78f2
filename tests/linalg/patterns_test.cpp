// A symmetric pattern in another order.
#include <gtest/gtest.h>

#include "tests/linalg/matrices.hpp"

namespace switchyard::linalg {
namespace {

class Patterns : public ::testing::TestWithParam<Case> {};

TEST_P(Patterns, PermutedHoldTheSameMatrixWithRowsAscending) {
  Random random(3);
  const Signed k = RandomOf(GetParam(), random);
  const std::vector<Index> order = RandomOrder(random, k.pattern.n);
  const PermutedPattern made = Permuted(k.pattern, order);
  ASSERT_EQ(made.pattern.nonzeros(), k.pattern.nonzeros());
  ASSERT_EQ(made.entry.size(), k.value.size());
  std::vector<double> value;
  for (const Index e : made.entry) value.push_back(k.value[e]);
  const Eigen::MatrixXd given = Dense(k.pattern, k.value), found = Dense(made.pattern, value);
  for (Index i = 0; i < k.pattern.n; ++i) {
    for (Index j = 0; j < k.pattern.n; ++j) ASSERT_EQ(found(i, j), given(order[i], order[j]));
  }
  ForEntries(made.pattern, [&](Index i, Index j, Index e) {
    EXPECT_LE(i, j);
    if (e > made.pattern.start[j]) {
      EXPECT_LT(made.pattern.row[e - 1], i);
    }
  });
}

TEST_P(Patterns, InverseUndoesAnOrder) {
  Random random(4);
  const std::vector<Index> order = RandomOrder(random, GetParam().n);
  const std::vector<Index> place = Inverse(order);
  ASSERT_EQ(place.size(), order.size());
  for (Index k = 0; k < GetParam().n; ++k) EXPECT_EQ(place[order[k]], k);
}

INSTANTIATE_TEST_SUITE_P(Every, Patterns, ::testing::ValuesIn(Cases()), NameOf);

}  // namespace
}  // namespace switchyard::linalg
