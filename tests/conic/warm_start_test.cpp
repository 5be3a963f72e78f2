// Solves that start from a solution which the caller gives.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/conic/programs.hpp"

namespace switchyard::conic {
namespace {

sy_start StartOf(const Found& found) {
  sy_start start = {};
  start.size = sizeof start;
  start.x = found.at.x.data();
  start.row_dual = found.at.row_dual.data();
  start.cone_dual = found.at.cone_dual.data();
  return start;
}

class WarmStart : public ::testing::TestWithParam<Sort> {};

TEST_P(WarmStart, FromTheSolutionOfANearProblemIsItsOptimumInNoMoreIterations) {
  std::int64_t cold = 0, warm = 0;
  for (unsigned seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const KnownAnswer known = Boxed(testing::KnownOptimum(GetParam().shape, random), random);
    const Found before = Solver(known.problem).Solve();
    ProblemData moved = known.problem;
    for (double& q : moved.q) q *= 1 + 1e-3 * random.Uniform(-1, 1);
    const Problem problem(moved);
    Conic conic(QuietHost());
    conic.Load(problem.view(), 0);
    conic.WarmStart(StartOf(before));
    const Found from = SolveWith(conic, moved, Freely());
    ExpectOptimal(moved, from);
    const Found fresh = Solver(moved).Solve();
    ExpectSameOptimum(moved, from, fresh.result.objective);
    warm += from.result.iterations;
    cold += fresh.result.iterations;
  }
  EXPECT_LE(warm, cold);
}

INSTANTIATE_TEST_SUITE_P(Every, WarmStart, ::testing::ValuesIn(Sorts()),
                         [](const auto& of) { return of.param.name; });

TEST(WarmStartOf, PartsOrNaNsIsAColdStart) {
  Random random(3);
  const KnownAnswer known = testing::KnownOptimum(Sorts()[0].shape, random);
  const Problem problem(known.problem);
  Found before = Solver(known.problem).Solve();
  const std::int64_t cold = before.result.iterations;
  before.at.x[0] = kNaN;
  sy_start without_duals = StartOf(before);
  without_duals.row_dual = nullptr;
  for (const sy_start& start : {StartOf(before), without_duals}) {
    Conic conic(QuietHost());
    conic.Load(problem.view(), 0);
    conic.WarmStart(start);
    EXPECT_EQ(SolveWith(conic, known.problem, Freely()).result.iterations, cold);
  }
}

}  // namespace
}  // namespace switchyard::conic
