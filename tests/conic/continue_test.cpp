// Solves that may start where the last one ended.
#include <gtest/gtest.h>

#include "tests/conic/programs.hpp"

namespace switchyard::conic {
namespace {

sy_control Continuing() {
  sy_control control = Freely();
  control.flags = SY_CONTINUE;
  return control;
}

/// Costs moved a little, from `solver`'s program.
void MoveCosts(Solver& solver, Random& random, double share) {
  ProblemData d = solver.data();
  for (double& q : d.q) q *= 1 + share * random.Uniform(-1, 1);
  solver.Update(Whole(SY_UPDATES_VECTORS, Problem(d)));
}

class Continue : public ::testing::TestWithParam<Sort> {};

TEST_P(Continue, AfterASmallChangeOfCostsIsTheSameOptimumInNoMoreIterations) {
  std::int64_t cold = 0, warm = 0;
  for (unsigned seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const KnownAnswer known = Boxed(testing::KnownOptimum(GetParam().shape, random), random);
    Solver solver(known.problem, SY_UPDATES_VECTORS);
    ExpectOptimal(known.problem, solver.Solve());
    for (int change = 0; change < 3; ++change) {
      MoveCosts(solver, random, 1e-3);
      EXPECT_TRUE(solver.shares());
      const Found from_last = solver.Solve(Continuing());
      ExpectOptimal(solver.data(), from_last);
      const Found fresh = Solver(solver.data(), SY_UPDATES_VECTORS).Solve();
      ExpectSameOptimum(solver.data(), from_last, fresh.result.objective);
      warm += from_last.result.iterations;
      cold += fresh.result.iterations;
    }
  }
  EXPECT_LE(warm, cold);
}

TEST_P(Continue, WithoutAChangeIsTheSameOptimum) {
  for (unsigned seed = 0; seed < 6; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const KnownAnswer known = testing::KnownOptimum(GetParam().shape, random);
    Solver solver(known.problem);
    solver.Solve();
    for (int time = 0; time < 3; ++time) {
      const Found found = solver.Solve(Continuing());
      ExpectOptimal(known.problem, found);
      ExpectSameOptimum(known.problem, found, OptimumOf(known));
    }
  }
}

// A large change, or one of bounds that makes the old point infeasible, may cost, but not the
// answer.
TEST_P(Continue, AfterALargeChangeIsTheSameOptimum) {
  for (unsigned seed = 0; seed < 6; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const KnownAnswer known = Boxed(testing::KnownOptimum(GetParam().shape, random), random);
    Solver solver(known.problem, SY_UPDATES_VECTORS);
    solver.Solve();
    ProblemData d = known.problem;
    d.q = random.Normals(d.num_vars);
    solver.Update(Whole(SY_UPDATES_VECTORS, Problem(d)));
    const Found found = solver.Solve(Continuing());
    ExpectOptimal(d, found);
    ExpectSameOptimum(d, found, Solver(d).Solve().result.objective);
  }
}

INSTANTIATE_TEST_SUITE_P(Every, Continue, ::testing::ValuesIn(Sorts()),
                         [](const auto& of) { return of.param.name; });

TEST(ContinueFlag, WithoutItNothingIsRemembered) {
  Random random(9);
  const KnownAnswer known = testing::KnownOptimum({14, 6, {SecondOrder(5), Rotated(3)}}, random);
  Solver solver(known.problem, SY_UPDATES_VECTORS);
  const Found first = solver.Solve();
  MoveCosts(solver, random, 0.01);
  solver.Solve(Continuing());
  solver.Update(Whole(SY_UPDATES_VECTORS, Problem(known.problem)));
  const Found again = solver.Solve();
  EXPECT_EQ(again.at.x, first.at.x);
  EXPECT_EQ(again.at.cone_dual, first.at.cone_dual);
  EXPECT_EQ(again.result.iterations, first.result.iterations);
}

TEST(ContinueFlag, BeforeTheFirstSolveIsAColdStart) {
  Random random(9);
  const KnownAnswer known = testing::KnownOptimum({14, 6, {SecondOrder(5), Rotated(3)}}, random);
  EXPECT_EQ(Solver(known.problem).Solve(Continuing()).at.x, Solver(known.problem).Solve().at.x);
}

TEST(ContinueFlag, AfterAContradictionAndALimitIsTheOptimum) {
  Random random(4);
  const KnownAnswer known = testing::KnownOptimum({14, 6, {SecondOrder(5), Rotated(3)}}, random);
  Solver solver(known.problem, SY_UPDATES_BOUNDS);
  sy_control control = Continuing();
  control.iterations = 2;
  EXPECT_EQ(solver.Solve(control).result.termination, SY_ITERATION_LIMIT);
  ExpectOptimal(known.problem, solver.Solve(Continuing()));
}

}  // namespace
}  // namespace switchyard::conic
