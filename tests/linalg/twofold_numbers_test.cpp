// Numbers of twice the digits: exactness, and agreement with 113 bits.
#include <gtest/gtest.h>

#include <limits>

#include "solvers/linalg/twofold.hpp"
#include "tests/linalg/reference.hpp"

namespace switchyard::linalg {
namespace {

using One = Twofold<double>;
using Eight = Twofold<Lanes>;

constexpr int kTrials = 2000;
constexpr double kUnit = 0x1p-104;  // of a few roundings

/// Of any sign and a wide range of sizes.
double Any(Random& random) { return std::ldexp(random.Normal(), random.Below(80) - 40); }

One AnyTwofold(Random& random) {
  const double high = Any(random);
  return One::QuickSum(high, high * 0x1p-53 * random.Uniform(-0.9, 0.9));
}

bool IsNormal(const One& v) { return v.high + v.low == v.high; }

void ExpectNear(const One& found, Quad expected, Quad size) {
  EXPECT_TRUE(IsNormal(found)) << found.high << " " << found.low;
  EXPECT_LE(static_cast<double>(Abs(Value(found) - expected)), static_cast<double>(size) * kUnit);
}

// 113 bits hold a sum of doubles whose exponents differ by up to 60.
TEST(Twofold, SumsOfDoublesAreExact) {
  Random random(18);
  for (int trial = 0; trial < kTrials; ++trial) {
    const double a = std::ldexp(random.Normal(), random.Below(40));
    const double b = trial % 5 == 0 ? -a * (1 + random.Below(3) * 0x1p-52)
                                    : std::ldexp(random.Normal(), random.Below(40));
    const One sum = One::Sum(a, b);
    EXPECT_EQ(sum.high, a + b);
    EXPECT_TRUE(Value(sum) == Quad{a} + b);
    const One quick = std::abs(a) >= std::abs(b) ? One::QuickSum(a, b) : One::QuickSum(b, a);
    EXPECT_EQ(quick.high, sum.high);
    EXPECT_EQ(quick.low, sum.low);
  }
}

TEST(Twofold, ProductsOfDoublesAreExact) {
  Random random(19);
  for (int trial = 0; trial < kTrials; ++trial) {
    const double a = Any(random), b = Any(random);
    const One product = One::Product(a, b);
    EXPECT_EQ(product.high, a * b);
    EXPECT_TRUE(Value(product) == Quad{a} * b);
  }
}

TEST(Twofold, AgreeWithMoreDigits) {
  Random random(20);
  for (int trial = 0; trial < kTrials; ++trial) {
    const One a = AnyTwofold(random), b = AnyTwofold(random);
    const double c = Any(random);
    const Quad p = Value(a), q = Value(b);
    ExpectNear(a + b, p + q, Abs(p) + Abs(q));
    ExpectNear(a - b, p - q, Abs(p) + Abs(q));
    ExpectNear(a * b, p * q, Abs(p * q));
    ExpectNear(a * c, p * c, Abs(p * c));
    const One inverse = Reciprocal(a);
    EXPECT_LE(std::abs(inverse.low), 0x1.001p-52 * std::abs(inverse.high));
    ExpectNear(One::QuickSum(inverse.high, inverse.low), 1 / p, Abs(1 / p));
    EXPECT_TRUE(Value(-a) == -p);
    EXPECT_EQ(High(a), a.high);
    One sum = a, difference = a, product = a;
    sum += b;
    difference -= b;
    product *= b;
    EXPECT_TRUE(Value(sum) == Value(a + b));
    EXPECT_TRUE(Value(difference) == Value(a - b));
    EXPECT_TRUE(Value(product) == Value(a * b));
  }
}

TEST(Twofold, LoseNothingWhereTheLeadingPartsCancel) {
  Random random(21);
  for (int trial = 0; trial < kTrials; ++trial) {
    const One a = AnyTwofold(random);
    const double units = random.Below(5) - 2;
    const double next = a.high * (1 + units * 0x1p-52);
    const One b = One::QuickSum(next, next * 0x1p-53 * random.Uniform(-0.9, 0.9));
    const Quad exact = Value(a) - Value(b);
    ExpectNear(a - b, exact, std::abs(a.high));
    EXPECT_TRUE(Value(a - a) == 0);
  }
}

TEST(Twofold, AddManyTermsToTheirRounding) {
  Random random(22);
  One sum;
  Quad exact = 0, size = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const One a = AnyTwofold(random), b = AnyTwofold(random);
    sum += a * b;
    exact += Value(a) * Value(b);
    size += Abs(Value(a) * Value(b));
  }
  ExpectNear(sum, exact, size);
}

TEST(Twofold, AreTheSameEightAtATime) {
  Random random(23);
  for (int trial = 0; trial < kTrials / kLanes; ++trial) {
    One a[kLanes], b[kLanes];
    Eight as, bs;
    for (int i = 0; i < kLanes; ++i) {
      a[i] = AnyTwofold(random);
      b[i] = AnyTwofold(random);
      as.high[i] = a[i].high;
      as.low[i] = a[i].low;
      bs.high[i] = b[i].high;
      bs.low[i] = b[i].low;
    }
    const Eight sum = as + bs, difference = as - bs, product = as * bs, inverse = Reciprocal(as);
    const auto same = [](const Eight& v, int i, const One& w) {
      return v.high[i] == w.high && v.low[i] == w.low;
    };
    for (int i = 0; i < kLanes; ++i) {
      EXPECT_TRUE(same(sum, i, a[i] + b[i]));
      EXPECT_TRUE(same(difference, i, a[i] - b[i]));
      EXPECT_TRUE(same(product, i, a[i] * b[i]));
      EXPECT_TRUE(same(inverse, i, Reciprocal(a[i])));
      EXPECT_EQ(High(sum)[i], sum.high[i]);
    }
  }
}

TEST(Twofold, HaveTheReciprocalZeroOfInfinity) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double sign : {1.0, -1.0}) {
    const One inverse = Reciprocal(One{sign * infinity, 0});
    EXPECT_EQ(inverse.high, 0);
    EXPECT_EQ(inverse.low, 0);
    EXPECT_EQ(Reciprocal(sign * infinity), 0);
  }
}

TEST(Digits, AreThoseOfTheNumbersThatAreThere) {
  const double v = 0;
  EXPECT_EQ((Numbers{&v, nullptr}.digits()), Digits::kPlain);
  EXPECT_EQ((Numbers{&v, &v}.digits()), Digits::kTwofold);
  EXPECT_EQ(PartsOf(Digits::kPlain), 1);
  EXPECT_EQ(PartsOf(Digits::kTwofold), 2);
}

}  // namespace
}  // namespace switchyard::linalg
