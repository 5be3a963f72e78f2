// LDL' of bordered block-diagonal matrices against a dense factorization.
#include "solvers/linalg/block_ldl.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "tests/linalg/bordered.hpp"
#include "tests/linalg/twofold_matrices.hpp"

namespace switchyard::linalg {
namespace {

class Blocks : public ::testing::TestWithParam<BorderedCase> {
 protected:
  Signed Matrix() {
    shape_ = RandomOf(GetParam(), random_);
    return Quasidefinite(random_, shape_.sign, shape_.pairs);
  }
  template <class Matrix>
  BlockLdl Factors(const Matrix& k) {
    return {k.pattern, k.sign, {}, shape_.block, shape_.count};
  }
  /// That K x = b to the rounding of its digits.
  void ExpectSolves(const BlockLdl& factors, const Signed& k) {
    if (k.pattern.n == 0) return factors.Solve({nullptr, nullptr});
    const Eigen::VectorXd b =
        Eigen::VectorXd::NullaryExpr(k.pattern.n, [&] { return random_.Normal(); });
    Eigen::VectorXd found = b;
    factors.Solve({found.data(), nullptr});
    const Eigen::VectorXd x = Dense(k.pattern, k.value).partialPivLu().solve(b);
    EXPECT_LE((found - x).norm(), 1e-12 * x.norm());
  }
  void ExpectSolves(const BlockLdl& factors, const TwofoldMatrix& k) {
    const std::vector<Quad> b = RandomQuads(random_, k.pattern.n);
    TwofoldVector found(b);
    factors.Solve(found.numbers());
    std::vector<Quad> left = Product(k, found.value());
    for (std::size_t i = 0; i < b.size(); ++i) left[i] -= b[i];
    EXPECT_LE(MaxAbs(left), 1e-29 * MaxAbs(b) * std::max<Index>(10, k.pattern.n));
  }
  Random random_{17};
  Bordered shape_;
};

TEST_P(Blocks, SolveAsADenseFactorizationDoes) {
  for (int trial = 0; trial < 3; ++trial) {
    Signed k = Matrix();
    BlockLdl factors = Factors(k);
    for (const double scale : {1.0, 0.1}) {
      ForEntries(k.pattern, [&](Index i, Index j, Index e) { k.value[e] *= i == j ? 1 : scale; });
      EXPECT_EQ(factors.Factor({k.value.data(), nullptr}, {}), 0);
      ExpectSolves(factors, k);
      ExpectSolves(factors, k);
    }
  }
}

TEST_P(Blocks, OfTwofoldDigitsLeaveOnlyTheirRounding) {
  const Signed plain = Matrix();
  const TwofoldMatrix k = WithMoreDigits(random_, plain);
  BlockLdl factors = Factors(k);
  EXPECT_EQ(factors.Factor(k.numbers(), {}), 0);
  ExpectSolves(factors, k);
  // Digits may change from one factorization to the next.
  EXPECT_EQ(factors.Factor({plain.value.data(), nullptr}, {}), 0);
  ExpectSolves(factors, plain);
  EXPECT_EQ(factors.Factor(k.numbers(), {}), 0);
  ExpectSolves(factors, k);
}

// A right side may have fewer digits than the factors, or more.
TEST_P(Blocks, SolveForARightSideOfOtherDigits) {
  const Signed plain = Matrix();
  const TwofoldMatrix k = WithMoreDigits(random_, plain);
  BlockLdl factors = Factors(k);
  const TwofoldVector b(RandomQuads(random_, k.pattern.n));
  for (const Numbers& values : {k.numbers(), Numbers{k.high.data(), nullptr}}) {
    factors.Factor(values, {});
    std::vector<double> high = b.high, other = b.high, low(b.high.size(), 0.0);
    factors.Solve({high.data(), nullptr});
    factors.Solve({other.data(), low.data()});
    EXPECT_EQ(high, other);
  }
}

TEST_P(Blocks, SolveWhatIsNearlySingularIfTheirDigitsAreTwofold) {
  shape_ = RandomOf(GetParam(), random_);
  const TwofoldMatrix k = NearSingular(random_, shape_.sign, shape_.pairs, 1e-18);
  BlockLdl factors = Factors(k);
  const std::vector<Quad> x = RandomQuads(random_, k.pattern.n);
  for (const Digits digits : {Digits::kTwofold, Digits::kPlain}) {
    const bool twofold = digits == Digits::kTwofold;
    const int raised = factors.Factor({k.high.data(), twofold ? k.low.data() : nullptr}, {1e-18});
    TwofoldVector found(Product(k, x));
    factors.Solve({found.high.data(), twofold ? found.low.data() : nullptr});
    std::vector<Quad> error = found.value();
    for (std::size_t i = 0; i < x.size(); ++i) error[i] -= x[i];
    if (twofold) {
      EXPECT_EQ(raised, 0);
      EXPECT_LE(MaxAbs(error), 1e-9 * MaxAbs(x));
    } else if (k.nearly_dependent > 4) {
      EXPECT_GE(MaxAbs(error), 1e-2);
    }
  }
}

// Pivots of blocks declared of the wrong sign; the rest is diagonally dominant all the same.
TEST_P(Blocks, RaiseThePivotsThatADenseFactorizationRaises) {
  Signed k = Matrix();
  ForEntries(k.pattern, [&](Index i, Index j, Index e) {
    if (i == j && shape_.block[j] < 0) k.value[e] *= 1e4;
  });
  for (Index j = 0; j < k.pattern.n; ++j) {
    if (shape_.block[j] >= 0 && random_.Chance(0.1)) {
      k.sign[j] = static_cast<std::int8_t>(-k.sign[j]);
    }
  }
  std::vector<Index> order;
  for (const BlockClass& c : ClassifyBlocks(k.pattern, k.sign, shape_.block, shape_.count)) {
    order.insert(order.end(), c.column.begin(), c.column.end());
  }
  for (Index j = 0; j < k.pattern.n; ++j) {
    if (shape_.block[j] < 0) order.push_back(j);
  }
  Signs sign;
  for (const Index j : order) sign.push_back(k.sign[j]);
  const DenseLdl<Quad> dense(Ordered(SquareOf<Quad>(k), order), sign, {1e-3});
  const std::vector<Quad> b = RandomQuads(random_, k.pattern.n);
  std::vector<Quad> x;
  for (const Index j : order) x.push_back(b[j]);
  x = dense.Solve(x);
  BlockLdl factors = Factors(k);
  const std::vector<double> low(k.value.size(), 0.0);
  for (const double* lows : {static_cast<const double*>(nullptr), low.data()}) {
    EXPECT_EQ(factors.Factor({k.value.data(), lows}, {1e-3}), dense.raised);
    TwofoldVector found(b);
    factors.Solve(found.numbers());
    for (std::size_t i = 0; i < x.size(); ++i) {
      EXPECT_NEAR(found.high[order[i]], static_cast<double>(x[i]), 1e-9 * MaxAbs(x));
    }
  }
}

TEST_P(Blocks, TakeOutInfinitePivotsInOneLaneOnly) {
  Signed k = Matrix();
  Signed without = k;
  std::vector<Index> out(k.pattern.n, 0);
  for (Index& o : out) o = random_.Chance(0.05) ? 1 : 0;
  ForEntries(k.pattern, [&](Index i, Index j, Index e) {
    if (i == j && out[j] != 0) k.value[e] *= HUGE_VAL;
    if (i != j && out[i] + out[j] > 0) without.value[e] = 0;
  });
  const std::vector<double> low(k.value.size(), 0.0);
  BlockLdl factors = Factors(k), alone = Factors(k);
  for (const double* lows : {static_cast<const double*>(nullptr), low.data()}) {
    EXPECT_EQ(factors.Factor({k.value.data(), lows}, {}), 0);
    EXPECT_EQ(alone.Factor({without.value.data(), lows}, {}), 0);
    TwofoldVector found(RandomQuads(random_, k.pattern.n)), expected = found;
    factors.Solve(found.numbers());
    alone.Solve(expected.numbers());
    for (Index j = 0; j < k.pattern.n; ++j) {
      EXPECT_NEAR(found.high[j], out[j] != 0 ? 0 : expected.high[j], 1e-10);
    }
  }
}

TEST_P(Blocks, CountTheirFactors) {
  const Signed k = Matrix();
  const BlockLdl factors = Factors(k);
  double work = factors.rest().work(), size = factors.rest().factor_size();
  for (const BlockClass& c : ClassifyBlocks(k.pattern, k.sign, shape_.block, shape_.count)) {
    for (Index j = 0; j < c.shape.columns; ++j) {
      const double below = c.shape.column_start[j + 1] - c.shape.column_start[j] - 1;
      size += below * c.count;
      work += below * (below + 1) / 2 * c.count;
    }
  }
  EXPECT_EQ(factors.factor_size(), size);
  EXPECT_EQ(factors.work(), work);
}

TEST_P(Blocks, CopiedHaveFactorsOfTheirOwn) {
  const Signed k = Matrix();
  BlockLdl factors = Factors(k);
  factors.Factor({k.value.data(), nullptr}, {});
  BlockLdl copy(factors);
  Signed other = k;
  for (double& v : other.value) v *= 2;
  copy.Factor({other.value.data(), nullptr}, {});
  ExpectSolves(factors, k);
  ExpectSolves(copy, other);
}

INSTANTIATE_TEST_SUITE_P(Every, Blocks, ::testing::ValuesIn(BorderedCases()), NameOfBordered);

}  // namespace
}  // namespace switchyard::linalg
