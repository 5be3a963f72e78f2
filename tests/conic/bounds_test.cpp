// Cutoffs and loose tolerances: what is said to be proven is.
#include <gtest/gtest.h>

#include "tests/conic/programs.hpp"

namespace switchyard::conic {
namespace {

KnownAnswer Large(unsigned seed) {
  Random random(seed);
  testing::Shape shape{30, 12, {SecondOrder(6), Semidefinite(3), Rotated(4), SecondOrder(3)}};
  if (seed % 3 == 0) shape.cones.push_back(Exponential());
  if (seed % 3 == 1) shape.cones.push_back(Power(0.3));
  shape.quadratic = seed % 2 == 0;
  return testing::KnownOptimum(shape, random);
}
KnownAnswer LargeInBoxes(unsigned seed) {
  Random random(seed + 50);
  return Boxed(Large(seed), random);
}

constexpr unsigned kSeeds = 12;

TEST(Cutoff, BelowTheOptimumIsProvenEarly) {
  std::int64_t with = 0, without = 0;
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    const KnownAnswer known = LargeInBoxes(seed);
    const double optimum = OptimumOf(known);
    without += Solver(known.problem).Solve().result.iterations;
    for (const double below : {1e-3, 0.1, 10.0}) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", below by " + std::to_string(below));
      sy_control control = Freely();
      control.cutoff = optimum - below * (1 + std::abs(optimum));
      const Found found = Solver(known.problem).Solve(control);
      ASSERT_EQ(found.result.termination, SY_CUTOFF) << found.text;
      EXPECT_GE(found.result.bound, control.cutoff);
      EXPECT_LE(found.result.bound, optimum + 1e-11 * (1 + std::abs(optimum)));
      if (below == 0.1) with += found.result.iterations;
    }
  }
  EXPECT_LT(with, 0.8 * static_cast<double>(without));
}

TEST(Cutoff, AboveTheOptimumChangesNothing) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    for (const KnownAnswer& known : {Large(seed), LargeInBoxes(seed)}) {
      const double optimum = OptimumOf(known);
      const Found expected = Solver(known.problem).Solve();
      for (const double above : {1e-5, 0.1, 100.0}) {
        SCOPED_TRACE("seed " + std::to_string(seed) + ", above by " + std::to_string(above));
        sy_control control = Freely();
        control.cutoff = optimum + above * (1 + std::abs(optimum));
        const Found found = Solver(known.problem).Solve(control);
        ExpectOptimal(known.problem, found);
        EXPECT_EQ(found.at.x, expected.at.x);
      }
    }
  }
}

// Where variables are free there may be no proof; but never a wrong one.
TEST(Cutoff, WithoutBoxesIsProvenOrTheOptimumIs) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE(seed);
    const KnownAnswer known = Large(seed);
    const double optimum = OptimumOf(known);
    sy_control control = Freely();
    control.cutoff = optimum - 0.5;
    const Found found = Solver(known.problem).Solve(control);
    if (found.result.termination != SY_CUTOFF) {
      ExpectOptimal(known.problem, found);
      continue;
    }
    EXPECT_GE(found.result.bound, control.cutoff);
    EXPECT_LE(found.result.bound, optimum + 1e-11 * (1 + std::abs(optimum)));
  }
}

// Nothing bounds the variables but |x| <= 5 in a cone.
TEST(Cutoff, WhereAConeIsTheBoxIsProvenEarly) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    testing::Shape shape{8, 3, {SecondOrder(3)}};
    shape.bounds = false;
    ProblemData d = testing::RandomFrame(shape, random);
    Csc ball(9, 8);
    for (std::int32_t j = 0; j < 8; ++j) {
      ball.row.push_back(j + 1);
      ball.value.push_back(1);
      ball.start[static_cast<std::size_t>(j) + 1] = j + 1;
    }
    d.F = StackRows(d.F, ball);
    d.cones.push_back(SecondOrder(9));
    d.g = {3, 0, 0, 5, 0, 0, 0, 0, 0, 0, 0, 0};
    d.q = random.Normals(8);
    const double optimum = Solver(d).Solve(WithTolerance(1e-10)).result.objective;
    sy_control control = Freely();
    control.cutoff = optimum - 0.1;
    const Found found = Solver(d).Solve(control);
    ASSERT_EQ(found.result.termination, SY_CUTOFF) << found.text;
    EXPECT_GE(found.result.bound, control.cutoff);
    EXPECT_LE(found.result.bound, optimum + 1e-8);
  }
}

TEST(Cutoff, OfAContradictionIsEitherAnswer) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    ProblemData d = testing::KnownContradiction({12, 6, {SecondOrder(4)}}, random).problem;
    d.q.assign(d.q.size(), 0.0);
    sy_control control = Freely();
    control.cutoff = 1;
    const Found found = Solver(d).Solve(control);
    if (found.result.termination != SY_CUTOFF) ExpectContradiction(d, found);
  }
}

/// |what is left of stationarity| times how far the boxes let each variable move, and the gap.
double WorthInBoxes(const ProblemData& d, Vectors& at) {
  Values left = testing::Combined(d, at);
  for (std::size_t j = 0; j < left.size(); ++j) left[j] = d.q[j] - left[j];
  SymmetricMultiplyAdd(d.P.View(), 1, at.x.data(), left.data());
  double worth = 0;
  for (std::size_t j = 0; j < left.size(); ++j) {
    at.x_dual[j] += left[j];
    worth += std::abs(left[j]) * (d.x_upper[j] - d.x_lower[j]);
  }
  return worth;
}

TEST(LooseTolerance, TakesFewerIterationsAndItsDualsStillBound) {
  std::int64_t loose = 0, tight = 0;
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE(seed);
    const KnownAnswer known = LargeInBoxes(seed);
    const ProblemData& d = known.problem;
    const double optimum = OptimumOf(known);
    Found found = Solver(d).Solve(WithTolerance(1e-3));
    ExpectOptimal(d, found, 1e-3);
    loose += found.result.iterations;
    tight += Solver(d).Solve().result.iterations;
    const double size = 1 + SizeOf(d, found.at);
    const double worth = WorthInBoxes(d, found.at);
    const double dual = d.offset - 0.5 * QuadraticForm(d.P.View(), found.at.x.data()) +
                        testing::SideSum(d, found.at);
    EXPECT_LE(dual, optimum + 1e-9 * size * size);
    const double gap = 1e-3 * (1 + std::abs(optimum));
    EXPECT_GE(dual, optimum - 3 * gap - 2 * worth - 1e-3 * size * size);
    EXPECT_NEAR(found.result.objective, optimum, gap + 1e-3 * size * size);
  }
  EXPECT_LT(static_cast<double>(loose), 0.75 * static_cast<double>(tight));
}

TEST(LooseTolerance, IsTheSmallerOfTwo) {
  const KnownAnswer known = LargeInBoxes(1);
  sy_control one = Freely();
  one.feasibility = 1e-3;
  sy_control other = Freely();
  other.optimality = 1e-3;
  sy_control both = WithTolerance(1e-3);
  both.optimality = 1e-9;
  const auto loose = Solver(known.problem).Solve(WithTolerance(1e-3)).result.iterations;
  EXPECT_EQ(Solver(known.problem).Solve(one).result.iterations, loose);
  EXPECT_EQ(Solver(known.problem).Solve(other).result.iterations, loose);
  const Found found = Solver(known.problem).Solve(both);
  ExpectOptimal(known.problem, found, 1e-9);
}

}  // namespace
}  // namespace switchyard::conic
