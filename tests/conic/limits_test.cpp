// What stops a solve early, and what is honestly said of where it stood.
#include <gtest/gtest.h>

#include <vector>

#include "tests/conic/programs.hpp"

namespace switchyard::conic {
namespace {

KnownAnswer Large(unsigned seed) {
  Random random(seed);
  testing::Shape shape{30, 12, {SecondOrder(6), Semidefinite(3), Rotated(4), SecondOrder(3)}};
  if (seed % 3 == 0) shape.cones.push_back(Exponential());
  shape.quadratic = seed % 2 == 0;
  return Boxed(testing::KnownOptimum(shape, random), random);
}

/// D of abi.h at what was returned.
double DualObjective(const ProblemData& d, const Vectors& at) {
  return d.offset - 0.5 * QuadraticForm(d.P.View(), at.x.data()) + testing::SideSum(d, at);
}

double LeftOfStationarity(const ProblemData& d, const Vectors& at) {
  Values left = testing::Combined(d, at);
  for (std::size_t j = 0; j < left.size(); ++j) left[j] -= d.q[j];
  SymmetricMultiplyAdd(d.P.View(), -1, at.x.data(), left.data());
  return LargestOf(left);
}

/// The kinds say what the point is worth, to what `tolerance` was asked for.
void ExpectHonestKinds(const ProblemData& d, const Found& found, double tolerance) {
  const double error = testing::PrimalError(d, found.at.x);
  const double size = 1 + SizeOf(d, found.at);
  switch (found.result.primal) {
    case SY_FEASIBLE:
      EXPECT_LE(error, tolerance * size);
      break;
    case SY_NEARLY_FEASIBLE:
      EXPECT_LE(error, 1e-3 * size);
      EXPECT_GT(error, tolerance);
      break;
    case SY_INFEASIBLE_POINT:
      EXPECT_GT(error, 1e-3);
      break;
    default:
      ADD_FAILURE() << "no point";
  }
  EXPECT_NEAR(found.result.objective, Objective(Problem(d).view(), found.at.x.data()),
              1e-9 * size * size);
}

/// What is returned of a program in boxes bounds its optimum from below.
void ExpectABound(const KnownAnswer& known, const Found& found) {
  const ProblemData& d = known.problem;
  const double optimum = OptimumOf(known);
  const double size = 1 + SizeOf(d, found.at);
  EXPECT_LE(LeftOfStationarity(d, found.at), 1e-12 * size * d.num_vars);
  EXPECT_LE(testing::ConeDualError(d, found.at.cone_dual), 1e-9 * size);
  EXPECT_LE(DualObjective(d, found.at), optimum + 1e-9 * size * size);
  EXPECT_LE(found.result.bound, optimum + 1e-12 * size * size);
  EXPECT_GT(found.result.bound, -kInfinity);
  EXPECT_NEAR(found.result.bound, DualObjective(d, found.at), 1e-9 * size * size);
}

TEST(IterationLimit, ReturnsABoundAndAPointThatIsWhatItIsSaidToBe) {
  for (unsigned seed = 0; seed < 8; ++seed) {
    const KnownAnswer known = Large(seed);
    const auto needed = Solver(known.problem).Solve().result.iterations;
    ASSERT_GT(needed, 4);
    for (std::int64_t limit = 0; limit < needed; ++limit) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", limit " + std::to_string(limit));
      sy_control control = Freely();
      control.iterations = limit;
      const Found found = Solver(known.problem).Solve(control);
      ASSERT_EQ(found.result.termination, SY_ITERATION_LIMIT);
      EXPECT_EQ(found.result.iterations, limit);
      ExpectHonestKinds(known.problem, found, 1e-8);
      ExpectABound(known, found);
    }
  }
}

TEST(IterationLimit, ReturnsBetterPointsAndBoundsTheLaterItStops) {
  for (unsigned seed = 0; seed < 8; ++seed) {
    SCOPED_TRACE(seed);
    const KnownAnswer known = Large(seed);
    const double optimum = OptimumOf(known);
    std::vector<double> error, gap;
    const auto needed = Solver(known.problem).Solve().result.iterations;
    for (std::int64_t limit = 0; limit < needed; ++limit) {
      sy_control control = Freely();
      control.iterations = limit;
      const Found found = Solver(known.problem).Solve(control);
      error.push_back(testing::OptimumError(known.problem, found.at));
      gap.push_back(optimum - found.result.bound);
    }
    for (std::size_t k = 4; k < error.size(); ++k) {
      EXPECT_LE(error[k], std::max(0.9 * error[k - 4], 1e-6)) << k;
      EXPECT_LE(gap[k], std::max(0.9 * gap[k - 4], 1e-6)) << k;
    }
  }
}

TEST(IterationLimit, OfTheOptionAndOfTheBudgetTheSmallerOne) {
  const KnownAnswer known = Large(1);
  sy_control control = Freely();
  control.iterations = 5;
  EXPECT_EQ(Solver().Set("max_iterations", 2).Load(known.problem).Solve(control).result.iterations,
            2);
  EXPECT_EQ(Solver().Set("max_iterations", 50).Load(known.problem).Solve(control).result.iterations,
            5);
}

TEST(TimeLimit, OfNothingReturnsNothing) {
  const KnownAnswer known = Large(2);
  sy_control control = Freely();
  control.seconds = 0;
  const Found found = Solver(known.problem).Solve(control);
  EXPECT_EQ(found.result.termination, SY_TIME_LIMIT);
  EXPECT_EQ(found.result.primal, SY_NO_POINT);
  EXPECT_EQ(found.result.dual, SY_NO_POINT);
  EXPECT_EQ(found.result.iterations, 0);
  EXPECT_EQ(found.result.bound, -kInfinity);
  EXPECT_TRUE(std::isnan(found.result.objective));
  for (const double x : found.at.x) EXPECT_TRUE(std::isnan(x));
}

TEST(TimeLimit, OfNextToNothingReturnsABound) {
  const KnownAnswer known = Large(2);
  sy_control control = Freely();
  control.seconds = 1e-9;
  const Found found = Solver(known.problem).Solve(control);
  EXPECT_EQ(found.result.termination, SY_TIME_LIMIT);
  ExpectHonestKinds(known.problem, found, 1e-8);
  ExpectABound(known, found);
}

/// Stops after so many questions.
struct Patience {
  int left;
  std::vector<sy_progress> told = {};
};

TEST(Cancelling, ReturnsWhereItStood) {
  for (const bool by_progress : {false, true}) {
    for (const int patience : {1, 3, 5}) {
      SCOPED_TRACE(std::to_string(patience) + (by_progress ? " by progress" : " by cancelled"));
      const KnownAnswer known = Large(4);
      Patience context{patience};
      sy_control control = Freely();
      control.context = &context;
      if (by_progress) {
        control.progress = [](void* c, const sy_progress*) noexcept -> std::int32_t {
          return --static_cast<Patience*>(c)->left == 0 ? 1 : 0;
        };
      } else {
        control.cancelled = [](void* c) noexcept -> std::int32_t {
          return --static_cast<Patience*>(c)->left <= 0 ? 1 : 0;
        };
      }
      Solver solver(known.problem);
      const Found found = solver.Solve(control);
      EXPECT_EQ(found.result.termination, SY_CANCELLED);
      EXPECT_EQ(found.result.iterations, patience - 1) << "asked once an iteration";
      ExpectHonestKinds(known.problem, found, 1e-8);
      ExpectABound(known, found);
      ExpectOptimal(known.problem, solver.Solve());
    }
  }
}

TEST(Progress, TellsOfEachIterationOnce) {
  const KnownAnswer known = Large(5);
  Patience context{1000};
  sy_control control = Freely();
  control.context = &context;
  control.progress = [](void* c, const sy_progress* p) noexcept -> std::int32_t {
    static_cast<Patience*>(c)->told.push_back(*p);
    return 0;
  };
  const Found found = Solver(known.problem).Solve(control);
  ExpectOptimal(known.problem, found);
  ASSERT_EQ(static_cast<std::int64_t>(context.told.size()), found.result.iterations + 1);
  for (std::size_t k = 0; k < context.told.size(); ++k) {
    const sy_progress& p = context.told[k];
    EXPECT_EQ(p.iteration, static_cast<std::int64_t>(k));
    EXPECT_GE(p.seconds, k == 0 ? 0 : context.told[k - 1].seconds);
    EXPECT_LE(p.bound, OptimumOf(known));
    EXPECT_EQ(p.incumbent, nullptr);
  }
  EXPECT_NEAR(context.told.back().objective, found.result.objective,
              1e-6 * (1 + std::abs(found.result.objective)));
  EXPECT_LE(context.told.back().primal_residual, 1e-8);
}

// x >= 1 by a cone that is off: below a cutoff of 0.5 there is everything from -10 on.
TEST(Cutoff, RestsOnNoConeThatIsOff) {
  ProblemData d;
  d.num_vars = 1;
  d.q = {1};
  d.x_lower = {-10};
  d.x_upper = {10};
  d.P = d.A = Csc(0, 1);
  d.P.rows = 1;
  d.F = Csc(1, 1);
  d.F.row = {0};
  d.F.value = {1};
  d.F.start = {0, 1};
  d.g = {-1};
  d.cones = {{SY_CONE_NONNEGATIVE, 1, 0}};
  Solver solver(d, SY_UPDATES_SWITCH);
  sy_control control = Freely();
  const std::int32_t cone[] = {0};
  const std::uint8_t off[] = {0};
  sy_update update = Nothing();
  update.num_cones = 1;
  update.cone = cone;
  update.cone_on = off;
  solver.Update(update);
  control.cutoff = 0.5;
  const Found found = solver.Solve(control);
  EXPECT_EQ(found.result.termination, SY_OPTIMAL) << found.text;
  EXPECT_NEAR(found.result.objective, -10, 1e-6);
}

}  // namespace
}  // namespace switchyard::conic
