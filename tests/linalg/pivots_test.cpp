// What becomes of a pivot that is too small, of the wrong sign or infinite.
#include <gtest/gtest.h>

#include <limits>

#include "tests/linalg/ways.hpp"

namespace switchyard::linalg {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(PivotRule, AcceptsHalfTheLeastAndRaisesWhatHasLess) {
  const PivotRule rule{1e-6};
  int raised = 0;
  EXPECT_EQ(rule.Accept(3, 1, 1, raised), 3);
  EXPECT_EQ(rule.Accept(-3, -1, 1, raised), -3);
  EXPECT_EQ(rule.Accept(0.5e-6, 1, 1, raised), 0.5e-6);
  EXPECT_EQ(rule.Accept(kInfinity, 1, 1, raised), kInfinity);
  EXPECT_EQ(rule.Accept(-kInfinity, -1, 1, raised), -kInfinity);
  EXPECT_EQ(raised, 0);
  EXPECT_EQ(rule.Accept(0.4e-6, 1, 1, raised), 1e-6);
  EXPECT_EQ(rule.Accept(0, -1, 1, raised), -1e-6);
  EXPECT_EQ(rule.Accept(2, -1, 1, raised), -20);                // rounding was 2 or more
  EXPECT_DOUBLE_EQ(rule.Accept(-1e-9, 1, 1e12, raised), 1e-4);  // of terms that round so
  EXPECT_EQ(raised, 4);
}

/// Two columns that meet in a block of their own, or not.
std::vector<Way> WaysAndBlocks() {
  std::vector<Way> ways = Ways();
  const auto one_block = [](const SymmetricPattern& p, const Signs& s,
                            const std::vector<Index>&) -> std::unique_ptr<Factors> {
    return std::make_unique<ByBlocks>(p, s, std::vector<Index>(p.n, 0), 1);
  };
  const auto first_is_one = [](const SymmetricPattern& p, const Signs& s,
                               const std::vector<Index>&) -> std::unique_ptr<Factors> {
    std::vector<Index> block(p.n, -1);
    block[0] = 0;
    return std::make_unique<ByBlocks>(p, s, block, 1);
  };
  for (const Digits digits : {Digits::kPlain, Digits::kTwofold}) {
    const bool twofold = digits == Digits::kTwofold;
    ways.push_back({twofold ? "twofold_block" : "block", digits, false, one_block});
    ways.push_back(
        {twofold ? "twofold_block_and_rest" : "block_and_rest", digits, false, first_is_one, true});
  }
  return ways;
}

class RaisedPivots : public ::testing::TestWithParam<Way> {
 protected:
  /// The solution; how many pivots were raised.
  static std::pair<Eigen::VectorXd, int> Solve(const Signed& k, const PivotRule& rule,
                                               const Eigen::VectorXd& b) {
    std::vector<Index> order(k.pattern.n);
    for (Index j = 0; j < k.pattern.n; ++j) order[j] = j;
    const auto factors = GetParam().make(k.pattern, k.sign, order);
    const std::vector<double> low(k.value.size(), 0.0);
    const bool twofold = GetParam().digits == Digits::kTwofold;
    const int raised = factors->Factor({k.value.data(), twofold ? low.data() : nullptr}, rule);
    return {SolveBy(*factors, GetParam().digits, b), raised};
  }
};

const SymmetricPattern kTwo = {2, {0, 1, 3}, {0, 0, 1}};

// What rounding of 1e10 may leave decides how large the second pivot is made; a rest does not know
// what blocks subtracted from it.
TEST_P(RaisedPivots, AreAsLargeAsTheRoundingOfTheirTerms) {
  const double large = 1e10;
  const auto [x, raised] =
      Solve({kTwo, {large, large, large}, {1, 1}}, {1e-13}, Eigen::Vector2d(0, 1));
  EXPECT_EQ(raised, 1);
  EXPECT_NEAR(x[0] + x[1], 0, 1e-10 * std::abs(x[1]));
  if (GetParam().rest_apart) return;
  EXPECT_GT(std::abs(x[1]), 1 / (2.1e-16 * large));
  EXPECT_LT(std::abs(x[1]), 1 / (0.9e-16 * large));
}

// The last pivot is 0 - g^2 + g^2 - 0: of terms that come from several fronts, of which one may
// count again what another left.
TEST_P(RaisedPivots, KnowTheSizesOfTermsThatCancel) {
  if (GetParam().rest_apart) return;
  const double g = 1e8;
  const SymmetricPattern star = {4, {0, 1, 2, 3, 7}, {0, 1, 2, 0, 1, 2, 3}};
  const auto [x, raised] =
      Solve({star, {1, -1, 1, g, g, 0, 0}, {1, -1, 1, -1}}, {1e-13}, Eigen::Vector4d(0, 0, 0, 1));
  EXPECT_EQ(raised, 1);
  EXPECT_GT(-1 / x[3], 1.9e-16 * g * g);
  EXPECT_LT(-1 / x[3], 3.1e-16 * g * g);
}

TEST_P(RaisedPivots, AreTheLeastWhereNothingRounds) {
  const SymmetricPattern no_diagonal = {2, {0, 0, 0}, {}};
  const auto [x, raised] = Solve({no_diagonal, {}, {1, -1}}, {1e-3}, Eigen::Vector2d(2, 3));
  EXPECT_EQ(raised, 2);
  EXPECT_DOUBLE_EQ(x[0], 2000);
  EXPECT_DOUBLE_EQ(x[1], -3000);
}

// [4 2; 2 oo]: the second row and column do not count; nor do they with another sign.
TEST_P(RaisedPivots, ThatAreInfiniteTakeTheirRowAndColumnOut) {
  for (const auto sign : {std::int8_t{1}, std::int8_t{-1}}) {
    for (const double beside : {0.0, 2.0}) {
      const auto [x, raised] =
          Solve({kTwo, {4, beside, sign * kInfinity}, {1, sign}}, {1e-13}, Eigen::Vector2d(8, 3));
      EXPECT_EQ(raised, 0);
      EXPECT_EQ(x[0], 2);
      EXPECT_EQ(x[1], 0);
    }
  }
}

// Among many others, which they meet.
TEST_P(RaisedPivots, ThatAreInfiniteLeaveTheOthersAsTheyWouldBeAlone) {
  Random random(13);
  const Index n = 40;
  for (int trial = 0; trial < 5; ++trial) {
    Signed k = Quasidefinite(random, RandomSigns(random, n), SparsePairs(random, n, 0.3));
    const Index out = random.Below(n);
    Signed without = k;
    ForEntries(k.pattern, [&](Index i, Index j, Index e) {
      if (i == out && j == out) k.value[e] = k.sign[out] * kInfinity;
      if ((i == out) != (j == out)) without.value[e] = 0;
    });
    const Eigen::VectorXd b = Eigen::VectorXd::NullaryExpr(n, [&] { return random.Normal(); });
    const auto [x, raised] = Solve(k, {1e-13}, b);
    Eigen::VectorXd alone = Solve(without, {1e-13}, b).first;
    alone[out] = 0;
    EXPECT_EQ(raised, 0);
    EXPECT_LE((x - alone).norm(), 1e-12 * alone.norm());
  }
}

INSTANTIATE_TEST_SUITE_P(Every, RaisedPivots, ::testing::ValuesIn(WaysAndBlocks()),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace switchyard::linalg
