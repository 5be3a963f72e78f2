#include "switchyard/safe_bound.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "switchyard/boxes.hpp"
#include "tests/shared_headers/random_problem.hpp"

namespace switchyard::testing {
namespace {

/// A convex problem built around its optimum, all in small integers and halves, so that point,
/// duals and optimum are exact.
struct Known {
  ProblemData data;
  Vector x, row_dual, cone_dual;
  double optimum = 0;

  [[nodiscard]] SafeBound Bound(const Vector& at, const Vector& rows, const Vector& cones) const {
    const Problem problem(data);
    return SafeDualBound(problem.view(), at.data(), rows.data(), cones.data(), nullptr, nullptr);
  }
};

/// A point s of a cone's boundary and a dual y with s'y = 0, exact in doubles.
struct Pair {
  sy_cone cone;
  Vector s, y;
};

const std::vector<Pair>& ComplementaryPairs() {
  static const std::vector<Pair> pairs = {{{SY_CONE_ZERO, 2, 0}, {0, 0}, {3, -2}},
                                          {{SY_CONE_NONNEGATIVE, 3, 0}, {0, 2, 0}, {1, 0, 0}},
                                          {{SY_CONE_SECOND_ORDER, 3, 0}, {5, 3, 4}, {10, -6, -8}},
                                          {{SY_CONE_SECOND_ORDER, 3, 0}, {5, 1, 2}, {0, 0, 0}},
                                          {{SY_CONE_ROTATED, 3, 0}, {2, 1, 2}, {1, 2, -2}},
                                          {{SY_CONE_PSD, 3, 0}, {2, 0, 0}, {0, 0, 0}},
                                          {{SY_CONE_EXPONENTIAL, 3, 0}, {0, 1, 1}, {-1, -1, 1}},
                                          {{SY_CONE_POWER, 3, 0.5}, {1, 1, 1}, {0.5, 0.5, -1}}};
  return pairs;
}

double SmallInteger(Random& random) { return random.Below(7) - 3; }

Csc SmallIntegers(Random& random, std::int32_t rows, std::int32_t cols, double density) {
  Csc a = random.Sparse(rows, cols, density);
  for (double& value : a.value) value = SmallInteger(random);
  return a;
}

enum class Sides { kFinite, kSomeInfinite };

/// Bounds and rows around x, the duals with the sign of the side that is active.
double AddBox(Random& random, double at, Sides sides, Vector& lower, Vector& upper) {
  const double below = 1 + random.Below(3), above = 1 + random.Below(3);
  const bool open = sides == Sides::kSomeInfinite;
  const std::int32_t active = random.Below(3);  // none, lower, upper
  const double far_below = open && random.Chance(0.5) ? -kInfinity : at - below;
  const double far_above = open && random.Chance(0.5) ? kInfinity : at + above;
  lower.push_back(active == 1 ? at : far_below);
  upper.push_back(active == 2 ? at : far_above);
  if (active == 0) return 0;
  return active == 1 ? random.Below(4) : -random.Below(4);
}

/// P = G'G, upper triangle.
Csc Gram(const Csc& g) {
  Csc p(g.cols, g.cols);
  for (std::int32_t j = 0; j < g.cols; ++j) {
    Vector column(static_cast<std::size_t>(g.cols), 0.0),
        e = column, image(static_cast<std::size_t>(g.rows), 0.0);
    e[static_cast<std::size_t>(j)] = 1;
    MultiplyAdd(g.View(), 1, e.data(), image.data());
    TransposedMultiplyAdd(g.View(), 1, image.data(), column.data());
    for (std::int32_t i = 0; i <= j; ++i) {
      if (column[static_cast<std::size_t>(i)] == 0) continue;
      p.row.push_back(i);
      p.value.push_back(column[static_cast<std::size_t>(i)]);
    }
    p.start[static_cast<std::size_t>(j) + 1] = static_cast<std::int32_t>(p.row.size());
  }
  return p;
}

Known RandomKnown(Random& random, Sides sides) {
  Known k;
  ProblemData& d = k.data;
  d.num_vars = 3 + random.Below(6);
  const auto n = static_cast<std::size_t>(d.num_vars);
  d.flags = SY_PROBLEM_CONVEX;
  d.offset = SmallInteger(random);
  d.q.assign(n, 0.0);
  for (std::size_t j = 0; j < n; ++j) {
    k.x.push_back(SmallInteger(random));
    d.q[j] += AddBox(random, k.x[j], sides, d.x_lower, d.x_upper);
  }
  d.P = random.Chance(0.5) ? Gram(SmallIntegers(random, 2, d.num_vars, 0.3))
                           : Csc(d.num_vars, d.num_vars);
  const std::int32_t rows = random.Below(5);
  d.A = SmallIntegers(random, rows, d.num_vars, 0.5);
  Vector ax(static_cast<std::size_t>(rows), 0.0);
  if (rows > 0) MultiplyAdd(d.A.View(), 1, k.x.data(), ax.data());
  for (const double a : ax) {
    k.row_dual.push_back(AddBox(random, a, sides, d.row_lower, d.row_upper));
  }
  for (std::int32_t c = random.Below(4); c > 0; --c) {
    const Pair& pair = ComplementaryPairs()[static_cast<std::size_t>(random.Below(8))];
    d.cones.push_back(pair.cone);
    d.g.insert(d.g.end(), pair.s.begin(), pair.s.end());
    k.cone_dual.insert(k.cone_dual.end(), pair.y.begin(), pair.y.end());
  }
  d.F = SmallIntegers(random, d.num_cone_rows(), d.num_vars, 0.4);
  if (d.F.nonzeros() > 0) MultiplyAdd(d.F.View(), -1, k.x.data(), d.g.data());  // g = s - F x
  if (d.P.nonzeros() > 0) SymmetricMultiplyAdd(d.P.View(), -1, k.x.data(), d.q.data());
  if (d.A.nonzeros() > 0) TransposedMultiplyAdd(d.A.View(), 1, k.row_dual.data(), d.q.data());
  if (d.F.nonzeros() > 0) TransposedMultiplyAdd(d.F.View(), 1, k.cone_dual.data(), d.q.data());
  k.optimum = Objective(Problem(d).view(), k.x.data());
  return k;
}

Vector Disturbed(Random& random, Vector v, double size) {
  for (double& e : v) e += size * random.Normal();
  return v;
}

TEST(SafeBound, IsTheOptimumAtExactDuals) {
  Random random(1);
  for (int trial = 0; trial < 2000; ++trial) {
    const Known k = RandomKnown(random, trial % 2 == 0 ? Sides::kFinite : Sides::kSomeInfinite);
    const SafeBound bound = k.Bound(k.x, k.row_dual, k.cone_dual);
    EXPECT_LE(bound.value, k.optimum);
    EXPECT_NEAR(bound.value, k.optimum, 1e-9);
    EXPECT_EQ(bound.value, bound.estimate);
    EXPECT_EQ(bound.open_column, -1);
  }
}

TEST(SafeBound, IsNeverAboveTheOptimum) {
  Random random(2);
  int proven = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    const Known k = RandomKnown(random, trial % 2 == 0 ? Sides::kFinite : Sides::kSomeInfinite);
    const double size = std::pow(10.0, random.Uniform(-16, 1));
    const SafeBound bound =
        k.Bound(Disturbed(random, k.x, size), Disturbed(random, k.row_dual, size),
                Disturbed(random, k.cone_dual, size));
    EXPECT_LE(bound.value, k.optimum) << "duals off by " << size;
    if (bound.value > -kInfinity) ++proven;
    if (trial % 2 == 0 && size < 0.01) {
      EXPECT_GE(bound.value, k.optimum - 1e4 * size - 1e-9);
    }
  }
  EXPECT_GT(proven, 2000);
}

TEST(SafeBound, TakesZerosForWhatIsMissingOrNotANumber) {
  Random random(3);
  for (int trial = 0; trial < 100; ++trial) {
    const Known k = RandomKnown(random, Sides::kFinite);
    const Problem problem(k.data);
    const Vector nan(20, std::numeric_limits<double>::quiet_NaN());
    const Vector zero(20, 0.0);
    const auto at = [&](const double* v) {
      return SafeDualBound(problem.view(), v, v, v, nullptr, nullptr).value;
    };
    EXPECT_EQ(at(nullptr), at(zero.data()));
    EXPECT_LE(at(nullptr), k.optimum);
    // A dual of 0 in an exponential or a power cone stays 0, so both are the same point.
    EXPECT_EQ(at(nan.data()), at(zero.data()));
  }
}

ProblemData OneFreeVariable() {  // minimize x, x >= 1 as a row, x itself free
  ProblemData d;
  d.num_vars = 1;
  d.q = {1};
  d.A = Csc(1, 1);
  d.A.row = {0};
  d.A.value = {1};
  d.A.start = {0, 1};
  d.row_lower = {1};
  d.row_upper = {kInfinity};
  return d;
}

SafeBound BoundAt(const ProblemData& d, double row_dual, const double* lower = nullptr,
                  const double* upper = nullptr) {
  const Problem problem(d);
  return SafeDualBound(problem.view(), nullptr, &row_dual, nullptr, lower, upper);
}

TEST(SafeBound, NamesTheColumnThatIsOpen) {
  const SafeBound exact = BoundAt(OneFreeVariable(), 1);
  EXPECT_NEAR(exact.value, 1, 1e-14);
  EXPECT_LE(exact.value, 1);
  const SafeBound open = BoundAt(OneFreeVariable(), 0.999);
  EXPECT_EQ(open.value, -kInfinity);
  EXPECT_EQ(open.open_column, 0);
  EXPECT_NEAR(open.open_residual, 0.001 / 3, 1e-12);
  EXPECT_NEAR(open.estimate, 0.999, 1e-12);
}

TEST(SafeBound, ClosesAColumnByABox) {
  const double lower = -1000, upper = 1000;
  EXPECT_NEAR(BoundAt(OneFreeVariable(), 0.999, &lower, &upper).value, 0.999 - 1, 1e-9);
  EXPECT_EQ(BoundAt(OneFreeVariable(), 0.999, nullptr, &upper).value, -kInfinity);
}

// P = diag(2^k) + Gram: every column is curved, so none stays open, however wrong the duals are.
TEST(SafeBound, ClosesFreeColumnsByTheirCurvatureAndStaysBelowTheOptimum) {
  Random random(4);
  for (int trial = 0; trial < 2000; ++trial) {
    Known k = RandomKnown(random, Sides::kSomeInfinite);
    ProblemData& d = k.data;
    const Csc gram = d.P;
    d.P = Csc(d.num_vars, d.num_vars);
    for (std::int32_t j = 0; j < d.num_vars; ++j) {
      const auto at = static_cast<std::size_t>(j);
      const double curve = std::ldexp(1.0, random.Below(9) - 4);
      d.q[at] -= curve * k.x[at];  // the optimum stays where it is
      bool written = false;
      for (std::int32_t e = gram.start[at]; e < gram.start[at + 1]; ++e) {
        const auto from = static_cast<std::size_t>(e);
        const bool diagonal = gram.row[from] == j;
        written = written || diagonal;
        d.P.row.push_back(gram.row[from]);
        d.P.value.push_back(gram.value[from] + (diagonal ? curve : 0));
      }
      if (!written) {
        d.P.row.push_back(j);
        d.P.value.push_back(curve);
      }
      d.P.start[at + 1] = static_cast<std::int32_t>(d.P.row.size());
    }
    const Problem problem(d);
    const double optimum = Objective(problem.view(), k.x.data());
    const Vector curvature = Curvature(problem.view());
    const double size = std::pow(10.0, random.Uniform(-12, 0));
    const Vector x = Disturbed(random, k.x, size);
    const Vector rows = Disturbed(random, k.row_dual, size);
    const Vector cones = Disturbed(random, k.cone_dual, size);
    const SafeBound bound =
        SafeDualBound(problem.view(), x.data(), rows.data(), cones.data(), nullptr, nullptr,
                      curvature.empty() ? nullptr : curvature.data());
    EXPECT_LE(bound.value, optimum) << "duals off by " << size;
    if (gram.nonzeros() > 0) continue;  // dominance may leave a column without
    EXPECT_EQ(bound.open_column, -1);
    if (size < 1e-8) {
      EXPECT_NEAR(bound.value, optimum, 1e4 * size + 1e-9);
    }
  }
}

TEST(SafeBound, DropsADualAgainstAnInfiniteSide) {
  ProblemData d = OneFreeVariable();
  d.x_lower = {-3};
  d.x_upper = {3};
  EXPECT_NEAR(BoundAt(d, -5).value, -3, 1e-12);
}

TEST(SafeBound, ProvesNothingOfANonlinearProblem) {
  Problem problem(OneFreeVariable());
  const sy_nlp nlp{};
  problem.Change([&](ProblemData& d) { d.nlp = &nlp; });
  const SafeBound bound =
      SafeDualBound(problem.view(), nullptr, nullptr, nullptr, nullptr, nullptr);
  EXPECT_EQ(bound.value, -kInfinity);
  EXPECT_EQ(bound.open_column, -1);
}

__extension__ typedef __int128 Wide;

// Addends are integers times 2^-40, so that their products and sums are exact in 128 bits.
TEST(ErrorFreeSum, EnclosesTheTrueSum) {
  using safe_bound_detail::ErrorFreeSum;
  Random random(5);
  constexpr double kUnit = 1.0 / (1LL << 40);
  for (int trial = 0; trial < 3000; ++trial) {
    ErrorFreeSum sum;
    Wide exact = 0;  // in units of 2^-80
    std::vector<std::pair<std::int64_t, std::int64_t>> factors;
    for (int i = 1 + random.Below(30); i > 0; --i) {
      const double large = std::ldexp(1.0, random.Below(52));
      factors.emplace_back(std::llround(random.Uniform(-1, 1) * large),
                           std::llround(random.Uniform(-1, 1) * large));
    }
    const std::size_t count = factors.size();
    if (random.Chance(0.5)) {  // so that the large ones cancel
      for (std::size_t i = 0; i + 1 < count; ++i) {
        factors.emplace_back(-factors[i].first, factors[i].second);
      }
    }
    for (const auto& [a, b] : factors) {
      sum.AddProduct(static_cast<double>(a) * kUnit, static_cast<double>(b) * kUnit);
      exact += static_cast<Wide>(a) * b;
    }
    const Interval found = sum.Enclosure();
    const auto scaled = [](double v) {  // v 2^80, to integers below and above
      const long double units = std::ldexp(static_cast<long double>(v), 80);
      return std::pair(static_cast<Wide>(std::floor(units)), static_cast<Wide>(std::ceil(units)));
    };
    EXPECT_TRUE(scaled(found.lower).first <= exact && exact <= scaled(found.upper).second);
    EXPECT_LE(found.upper - found.lower, 1e-15 * std::abs(found.upper) + 1e-28);
  }
}

TEST(ErrorFreeSum, IsAPointWhereNothingWasRounded) {
  safe_bound_detail::ErrorFreeSum sum;
  for (const double v : {1.0, 0x1p-60, 0.1, -1.0, -0.1, -0x1p-60}) sum.Add(v);
  EXPECT_EQ(sum.Enclosure().lower, 0);
  EXPECT_EQ(sum.Enclosure().upper, 0);
  sum.AddProduct(0.1, 0.1);
  EXPECT_LT(sum.Enclosure().lower, sum.Enclosure().upper);
}

TEST(ErrorFreeSum, CountsUnderflow) {
  safe_bound_detail::ErrorFreeSum sum;
  sum.AddProduct(1e-200, 1e-200);
  EXPECT_LT(sum.Enclosure().lower, 0);
  EXPECT_GT(sum.Enclosure().upper, 1e-320);
}

}  // namespace
}  // namespace switchyard::testing
