// Condensed systems against the whole ones: solutions by their residual, inertia by eigenvalues.
#include "ipopt/condensed_kkt.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <limits>

#include "tests/ipopt/random_kkt.hpp"

namespace switchyard::testing {
namespace {

using Eigen::VectorXd;
using ipopt::CondensedKkt;

constexpr double kBound = 1e-6;  // u of PivotedLdl

/// False where the system is singular to working precision, and nothing was asked.
bool IsSolved(RandomKkt& random, const Kkt& kkt) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(kkt.dense);
  const VectorXd sizes = eigen.eigenvalues().cwiseAbs();
  if (sizes.minCoeff() <= 1e-12 * sizes.maxCoeff()) return false;
  const auto condensed = CondensedKkt::Make(kkt.entries, kkt.counts);
  EXPECT_NE(condensed, nullptr);
  if (condensed == nullptr) return false;
  const auto inertia = condensed->Factor(kkt.values.data(), kBound);
  EXPECT_TRUE(inertia.has_value());
  if (!inertia) return false;
  EXPECT_EQ(inertia->zero, 0);
  EXPECT_EQ(inertia->negative, (eigen.eigenvalues().array() < 0).count());
  const VectorXd b = VectorXd::NullaryExpr(kkt.entries.n, [&] { return random.Normal(); });
  VectorXd x = b;
  EXPECT_TRUE(condensed->Solve(x.data()));
  EXPECT_LE((kkt.dense * x - b).norm(), 1e-13 * (kkt.dense.norm() * x.norm() + b.norm()));
  return true;
}

int CountSolved(const KktKind& kind, int variables, int equations, int inequalities) {
  int solved = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    RandomKkt random(seed);
    const Kkt kkt = random.Make(variables, equations, inequalities, kind);
    solved += IsSolved(random, kkt) ? 1 : 0;
  }
  return solved;
}

TEST(CondensedKkt, HasTheSolutionAndTheInertiaOfTheWholeSystem) {
  EXPECT_GE(CountSolved({}, 12, 4, 15), 35);
  EXPECT_GE(CountSolved({.density = 1}, 7, 3, 20), 35);
  EXPECT_GE(CountSolved({.density = 0.05}, 60, 10, 80), 35);
}

TEST(CondensedKkt, MayHaveAnyPerturbation) {
  EXPECT_GE(CountSolved({.delta_x = 1e-4}, 15, 4, 20), 35);
  EXPECT_GE(CountSolved({.delta_x = 10}, 15, 4, 20), 35);
  EXPECT_GE(CountSolved({.delta = 1e-8}, 15, 4, 20), 35);
  EXPECT_GE(CountSolved({.delta_x = 1, .delta = 1}, 15, 4, 20), 35);
}

TEST(CondensedKkt, MayLackEquationsInequalitiesOrBoth) {
  EXPECT_GE(CountSolved({}, 12, 0, 15), 35);
  EXPECT_GE(CountSolved({}, 12, 5, 0), 35);
  EXPECT_GE(CountSolved({}, 12, 0, 0), 35);
  EXPECT_GE(CountSolved({}, 1, 0, 1), 35);
}

TEST(CondensedKkt, MayHaveInequalitiesOfFixedVariablesAlone) {
  EXPECT_GE(CountSolved({.empty_rows = 0.5}, 12, 3, 15), 35);
  EXPECT_GE(CountSolved({.empty_rows = 1}, 12, 3, 15), 35);
}

// As many equations as variables: H has no say in the solution.
TEST(CondensedKkt, MayBeDeterminedByItsEquations) { EXPECT_GE(CountSolved({}, 10, 10, 8), 35); }

// S of 1e12 beside H of 1: refinement brings back what condensing loses.
TEST(CondensedKkt, IsAccurateWhereInequalitiesHoldAsEquations) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    RandomKkt random(seed);
    Kkt kkt = random.Make(10, 2, 12, {.density = 0.3, .delta_x = 20});
    for (int i = 0; i < 5; ++i) kkt.Add(kkt.s(i), kkt.s(i), 1e12);
    const auto condensed = CondensedKkt::Make(kkt.entries, kkt.counts);
    const auto inertia = condensed->Factor(kkt.values.data(), kBound);
    ASSERT_TRUE(inertia.has_value());
    EXPECT_EQ(inertia->negative, 14);  // 20 dominates H: each multiplier has one
    const VectorXd b = VectorXd::NullaryExpr(kkt.entries.n, [&] { return random.Normal(); });
    VectorXd x = b;
    ASSERT_TRUE(condensed->Solve(x.data()));
    const VectorXd terms = kkt.dense.cwiseAbs() * x.cwiseAbs() + b.cwiseAbs();
    EXPECT_LE(((kkt.dense * x - b).array().abs() / terms.array()).maxCoeff(), 1e-12);
  }
}

TEST(CondensedKkt, CountsAsZeroWhatEquationsSayTwice) {
  RandomKkt random(3);
  Kkt kkt(4, 2, 2);
  for (int j = 0; j < 4; ++j) {
    kkt.Add(j, j, 1 + j);
    const double a = random.Normal();
    kkt.Add(kkt.y_c(0), j, a);
    kkt.Add(kkt.y_c(1), j, 3 * a);
    kkt.Add(kkt.y_d(0), j, random.Normal());
  }
  for (int i = 0; i < 2; ++i) kkt.Add(kkt.s(i), kkt.s(i), 1);
  const auto condensed = CondensedKkt::Make(kkt.entries, kkt.counts);
  const auto inertia = condensed->Factor(kkt.values.data(), kBound);
  ASSERT_TRUE(inertia.has_value());
  EXPECT_EQ(inertia->zero, 1);
  EXPECT_EQ(inertia->negative, 3);
}

TEST(CondensedKkt, IsNotMadeOfWhatItCannotCondense) {
  Kkt kkt(2, 0, 1);
  for (int j = 0; j < 2; ++j) kkt.Add(j, j, 1);
  const auto condensed = CondensedKkt::Make(kkt.entries, kkt.counts);
  ASSERT_NE(condensed, nullptr);
  EXPECT_FALSE(condensed->Factor(kkt.values.data(), kBound)) << "a slack without a diagonal";
  kkt.Add(kkt.s(0), kkt.s(0), 1);
  kkt.Add(0, 0, std::numeric_limits<double>::quiet_NaN());
  EXPECT_FALSE(CondensedKkt::Make(kkt.entries, kkt.counts)->Factor(kkt.values.data(), kBound));
  kkt.Add(kkt.s(0), 1, 1);
  EXPECT_EQ(CondensedKkt::Make(kkt.entries, kkt.counts), nullptr) << "a slack beside a variable";
}

}  // namespace
}  // namespace switchyard::testing
