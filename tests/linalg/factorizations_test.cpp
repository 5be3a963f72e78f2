// LDL' of quasi-definite matrices, whatever way it is made, against a dense factorization.
#include <gtest/gtest.h>

#include <Eigen/LU>

#include "tests/linalg/twofold_matrices.hpp"
#include "tests/linalg/ways.hpp"

namespace switchyard::linalg {
namespace {

class Factorizations : public ::testing::TestWithParam<std::tuple<Way, Case>> {
 protected:
  [[nodiscard]] const Way& way() const { return std::get<0>(GetParam()); }
  [[nodiscard]] const Case& shape() const { return std::get<1>(GetParam()); }
  [[nodiscard]] bool twofold() const { return way().digits == Digits::kTwofold; }

  std::unique_ptr<Factors> Make(const SymmetricPattern& pattern, const Signs& sign) {
    return way().make(pattern, sign, RandomOrder(random_, pattern.n));
  }
  Eigen::VectorXd RandomVector(Index n) {
    return Eigen::VectorXd::NullaryExpr(n, [&] { return random_.Normal(); });
  }
  Random random_{12};
};

class TwofoldFactorizations : public Factorizations {};
class FactorizationsInOrder : public Factorizations {};

// Twice with one symbolic part, and twice with one factor.
TEST_P(Factorizations, SolveAsADenseOneDoes) {
  for (int trial = 0; trial < 3; ++trial) {
    Signed k = RandomOf(shape(), random_);
    const std::unique_ptr<Factors> factors = Make(k.pattern, k.sign);
    for (const double scale : {1.0, -0.01}) {
      ForEntries(k.pattern, [&](Index i, Index j, Index e) { k.value[e] *= i == j ? 1 : scale; });
      const std::vector<double> low(k.value.size(), 0.0);
      EXPECT_EQ(factors->Factor({k.value.data(), twofold() ? low.data() : nullptr}, {}), 0);
      const Eigen::PartialPivLU<Eigen::MatrixXd> dense(Dense(k.pattern, k.value));
      for (int side = 0; side < 2 && k.pattern.n > 0; ++side) {
        const Eigen::VectorXd b = RandomVector(k.pattern.n);
        const Eigen::VectorXd x = dense.solve(b);
        EXPECT_LE((SolveBy(*factors, way().digits, b) - x).norm(), 1e-12 * x.norm());
      }
    }
  }
}

TEST_P(TwofoldFactorizations, LeaveOnlyTheirRounding) {
  for (int trial = 0; trial < 2; ++trial) {
    const TwofoldMatrix k = WithMoreDigits(random_, RandomOf(shape(), random_));
    const std::unique_ptr<Factors> factors = Make(k.pattern, k.sign);
    EXPECT_EQ(factors->Factor(k.numbers(), {}), 0);
    const std::vector<Quad> b = RandomQuads(random_, k.pattern.n);
    TwofoldVector found(b);
    factors->Solve(found.numbers());
    std::vector<Quad> left = Product(k, found.value());
    for (std::size_t i = 0; i < b.size(); ++i) left[i] -= b[i];
    EXPECT_LE(MaxAbs(left), 1e-29 * MaxAbs(b) * std::max<Index>(10, k.pattern.n));
    for (std::size_t i = 0; i < b.size(); ++i) {
      EXPECT_EQ(found.high[i], found.high[i] + found.low[i]);
    }
  }
}

// Of a right side that is twofold; a plain way knows the leading parts.
TEST_P(Factorizations, SolveWhatIsNearlySingularIfTheirDigitsAreTwofold) {
  const Quad eps = 1e-18;
  const Index n = shape().n;
  Signs sign = RandomSigns(random_, n);
  if (n > 0) sign[n / 2] = 1;
  const TwofoldMatrix k = NearSingular(random_, sign, shape().pairs(random_, n), eps);
  const std::unique_ptr<Factors> factors = Make(k.pattern, k.sign);
  const int raised = factors->Factor({k.high.data(), twofold() ? k.low.data() : nullptr}, {1e-18});
  const std::vector<Quad> x = RandomQuads(random_, n);
  TwofoldVector found(Product(k, x));
  std::vector<Quad> left = Product(k, x);
  factors->Solve({found.high.data(), twofold() ? found.low.data() : nullptr});
  const std::vector<Quad> solution = found.value();
  const std::vector<Quad> image = Product(k, solution);
  std::vector<Quad> error = x;
  for (std::size_t i = 0; i < x.size(); ++i) {
    error[i] -= solution[i];
    left[i] -= image[i];
  }
  if (twofold()) {
    EXPECT_EQ(raised, 0);
    EXPECT_LE(MaxAbs(error), 1e-9 * MaxAbs(x));
    EXPECT_LE(MaxAbs(left), 1e-28 * MaxAbs(x));
  } else if (k.nearly_dependent > 4) {
    EXPECT_GE(MaxAbs(error), 1e-2);
  }
}

TEST_P(Factorizations, CountAPivotOfTheWrongSign) {
  const Signed k = RandomOf(shape(), random_);
  const std::vector<double> low(k.value.size(), 0.0);
  for (Index j = 0; j < k.pattern.n; j += 1 + k.pattern.n / 4) {
    Signs wrong = k.sign;
    wrong[j] = static_cast<std::int8_t>(-wrong[j]);
    EXPECT_GE(
        Make(k.pattern, wrong)->Factor({k.value.data(), twofold() ? low.data() : nullptr}, {}), 1);
  }
}

// As the rule says, each in its turn.
TEST_P(FactorizationsInOrder, RaiseThePivotsThatADenseOneRaises) {
  for (int trial = 0; trial < 3; ++trial) {
    Signed k = RandomOf(shape(), random_);
    for (std::int8_t& s : k.sign) s = static_cast<std::int8_t>(random_.Chance(0.1) ? -s : s);
    const Elimination e = Eliminate(k.pattern, RandomOrder(random_, k.pattern.n));
    Signs sign;
    for (const Index j : e.order) sign.push_back(k.sign[j]);
    const PivotRule rule{1e-3};
    const DenseLdl<Quad> dense(Ordered(SquareOf<Quad>(k), e.order), sign, rule);
    const std::unique_ptr<Factors> factors = way().make(k.pattern, k.sign, e.order);
    const std::vector<double> low(k.value.size(), 0.0);
    EXPECT_EQ(factors->Factor({k.value.data(), twofold() ? low.data() : nullptr}, rule),
              dense.raised);
    const Eigen::VectorXd b = RandomVector(k.pattern.n);
    std::vector<Quad> expected;
    for (const Index j : e.order) expected.push_back(b[j]);
    expected = dense.Solve(expected);
    const Eigen::VectorXd found = SolveBy(*factors, way().digits, b);
    for (Index i = 0; i < k.pattern.n; ++i) {
      EXPECT_NEAR(found[e.order[i]], static_cast<double>(expected[i]), 1e-9 * MaxAbs(expected));
    }
  }
}

template <class Wanted>
auto All(Wanted&& wanted) {
  std::vector<Way> ways;
  for (const Way& way : Ways()) {
    if (wanted(way)) ways.push_back(way);
  }
  return ::testing::Combine(::testing::ValuesIn(ways), ::testing::ValuesIn(Cases()));
}
std::string NameOfBoth(const ::testing::TestParamInfo<std::tuple<Way, Case>>& test) {
  return std::string(std::get<0>(test.param).name) + "_of_" + std::get<1>(test.param).name;
}
INSTANTIATE_TEST_SUITE_P(Every, Factorizations, All([](const Way&) { return true; }), NameOfBoth);
INSTANTIATE_TEST_SUITE_P(Every, TwofoldFactorizations,
                         All([](const Way& w) { return w.digits == Digits::kTwofold; }),
                         NameOfBoth);
INSTANTIATE_TEST_SUITE_P(Every, FactorizationsInOrder, All([](const Way& w) { return w.in_order; }),
                         NameOfBoth);

}  // namespace
}  // namespace switchyard::linalg
