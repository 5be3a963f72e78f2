#include <atomic>
#include <chrono>
#include <thread>

#include "programs.hpp"

namespace switchyard::test {
namespace {

// Limits hold within 5 % + 250 ms on an idle machine; a test has others beside it.
constexpr double kSlack = 3;

class LimitedSolver : public testing::TestWithParam<Named> {
 protected:
  static const Problem& Hard() {
    static const Problem problem(Random(1500, 1500, 1, 0.05));
    return problem;
  }
};
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(LimitedSolver);
INSTANTIATE_TEST_SUITE_P(Plugins, LimitedSolver, testing::ValuesIn(SolversOf(kLinear)), NameOf);

TEST_P(LimitedSolver, StopsWhenItsTimeIsUp) {
  BareSolver solver(GetParam());
  if (!solver.Honors(SY_HONORS_SECONDS)) GTEST_SKIP() << "keeps no time limit";
  solver.Load(Hard().view());
  sy_control control = Freely();
  control.seconds = 0.3;
  const Answer a = solver.Solve(control);
  EXPECT_TRUE(a.result.termination == SY_TIME_LIMIT || a.result.termination == SY_OPTIMAL)
      << a.text;
  EXPECT_LE(a.result.seconds, 0.3 + kSlack);
}

TEST_P(LimitedSolver, StopsAtOnceWithoutTime) {
  BareSolver solver(GetParam());
  if (!solver.Honors(SY_HONORS_SECONDS)) GTEST_SKIP() << "keeps no time limit";
  solver.Load(Hard().view());
  sy_control control = Freely();
  control.seconds = 0;
  EXPECT_EQ(solver.Solve(control).result.termination, SY_TIME_LIMIT);
}

TEST_P(LimitedSolver, CountsIterations) {
  BareSolver solver(GetParam());
  if (!solver.Honors(SY_HONORS_ITERATIONS)) GTEST_SKIP() << "counts no iterations";
  solver.Load(Hard().view());
  sy_control control = Freely();
  control.iterations = 5;
  const Answer a = solver.Solve(control);
  EXPECT_EQ(a.result.termination, SY_ITERATION_LIMIT) << a.text;
  EXPECT_LE(a.result.iterations, 6);
}

TEST_P(LimitedSolver, StopsWhenCancelledFromAnotherThread) {
  BareSolver solver(GetParam());
  if (!solver.Honors(SY_HONORS_CANCELLED)) GTEST_SKIP() << "cannot be cancelled";
  solver.Load(Hard().view());
  std::atomic<bool> cancelled = false;
  sy_control control = Freely();
  control.context = &cancelled;
  control.cancelled = [](void* context) noexcept -> std::int32_t {
    return static_cast<std::atomic<bool>*>(context)->load() ? 1 : 0;
  };
  std::thread other([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    cancelled = true;
  });
  const Answer a = solver.Solve(control);
  other.join();
  EXPECT_TRUE(a.result.termination == SY_CANCELLED || a.result.termination == SY_OPTIMAL) << a.text;
  EXPECT_LE(a.result.seconds, 0.1 + kSlack);
}

TEST_P(LimitedSolver, StopsWhereProgressSaysSo) {
  BareSolver solver(GetParam());
  solver.Load(Hard().view());
  sy_control control = Freely();
  control.progress = [](void*, const sy_progress* progress) noexcept -> std::int32_t {
    return progress->seconds >= 0 ? 1 : 0;
  };
  const Answer a = solver.Solve(control);
  EXPECT_TRUE(a.result.termination == SY_CANCELLED || a.result.termination == SY_OPTIMAL) << a.text;
}

TEST_P(LimitedSolver, ProvesItsCutoff) {
  const Problem problem(Random(60, 40, 2));
  BareSolver solver(GetParam());
  if (!solver.Honors(SY_HONORS_CUTOFF)) GTEST_SKIP() << "takes no cutoff";
  solver.Load(problem.view());
  const double optimum = solver.Solve().result.objective;
  sy_control control = Freely();
  control.cutoff = 0.5 * optimum;
  const Answer below = solver.Solve(control);
  if (below.result.termination == SY_CUTOFF) {
    EXPECT_GE(below.result.bound, control.cutoff);
    EXPECT_LE(below.result.bound, optimum + 1e-6);
  } else {
    EXPECT_EQ(below.result.termination, SY_OPTIMAL);
  }
  control.cutoff = optimum + 1;
  EXPECT_EQ(solver.Solve(control).result.termination, SY_OPTIMAL);
}

}  // namespace
}  // namespace switchyard::test
