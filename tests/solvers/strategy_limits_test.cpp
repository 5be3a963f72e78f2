// Limits and hooks of relax-and-round: each ends it with what it has.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>

#include "tests/solvers/grid_graph.hpp"

namespace switchyard::test {
namespace {

class Limits : public testing::Test {
 protected:
  void SetUp() override {
    if (host_->Find("clp") == nullptr) GTEST_SKIP() << "clp was not built";
  }
  StrategyAnswer Solve(const sy_control& control) {
    return RelaxAndRoundOn(*host_, graph_.view(), {}, control);
  }
  std::unique_ptr<Host> host_ = HostWith({"clp"});
  GridGraph graph_{4, 4, EdgeCost::kOneNorm, 3};
};

TEST_F(Limits, NoTimeIsATimeLimit) {
  sy_control control = Unlimited();
  control.seconds = 0;
  const StrategyAnswer answer = Solve(control);
  EXPECT_EQ(answer.result.termination, SY_TIME_LIMIT) << answer.text;
  EXPECT_LE(answer.result.bound, Solve(Unlimited()).result.objective);
}

TEST_F(Limits, CancelledBeforeAnythingIsCancelled) {
  sy_control control = Unlimited();
  control.cancelled = [](void*) noexcept { return 1; };
  EXPECT_EQ(Solve(control).result.termination, SY_CANCELLED);
}

TEST_F(Limits, CancelledAtAnyQuestionKeepsWhatIsThere) {
  const StrategyAnswer whole = Solve(Unlimited());
  for (int after = 0; after < 60; after += 3) {
    for (const int threads : {1, 4}) {
      std::atomic<int> left = after;
      sy_control control = Unlimited(threads);
      control.context = &left;
      control.cancelled = [](void* context) noexcept {
        return static_cast<std::atomic<int>*>(context)->fetch_sub(1) <= 0 ? 1 : 0;
      };
      const StrategyAnswer answer = Solve(control);
      EXPECT_LE(answer.result.bound, whole.result.objective + 1e-9);
      if (answer.result.primal == SY_FEASIBLE) {
        EXPECT_GE(answer.result.objective, whole.result.objective - 1e-9);
      }
      if (left <= 0 && answer.result.termination != SY_OPTIMAL) {
        EXPECT_EQ(answer.result.termination, SY_CANCELLED);
      }
    }
  }
}

TEST_F(Limits, ProgressTellsTheBoundAndEachIncumbentAndMayStop) {
  struct Seen {
    double best = kInfinity, bound = -kInfinity;
    int stop_after = 1000;
  } seen;
  sy_control control = Unlimited();
  control.context = &seen;
  control.progress = [](void* context, const sy_progress* p) noexcept {
    auto& s = *static_cast<Seen*>(context);
    if (p->incumbent != nullptr) s.best = std::min(s.best, p->objective);
    s.bound = std::max(s.bound, p->bound);
    return --s.stop_after <= 0 ? 1 : 0;
  };
  const StrategyAnswer answer = Solve(control);
  EXPECT_EQ(seen.best, answer.result.objective);
  EXPECT_EQ(seen.bound, answer.result.bound);
  seen.stop_after = 1;
  EXPECT_EQ(Solve(control).result.termination, SY_CANCELLED);
}

TEST_F(Limits, ABoundAboveTheCutoffEndsItWithoutAPath) {
  const StrategyAnswer whole = Solve(Unlimited());
  sy_control control = Unlimited();
  control.cutoff = whole.result.bound - 1e-3;
  const StrategyAnswer answer = Solve(control);
  EXPECT_EQ(answer.result.termination, SY_CUTOFF);
  EXPECT_EQ(answer.result.primal, SY_NO_POINT);
}

TEST_F(Limits, GapsDecideWhatIsOptimal) {
  const StrategyAnswer whole = Solve(Unlimited());
  const double gap = whole.result.objective - whole.result.bound;
  sy_control control = Unlimited();
  control.relative_gap = 0;
  control.absolute_gap = gap * 1.01 + 1e-12;
  EXPECT_EQ(Solve(control).result.termination, SY_OPTIMAL);
  control.absolute_gap = gap * 0.5;
  control.target = whole.result.objective;
  EXPECT_EQ(Solve(control).result.termination, gap > 0 ? SY_TARGET : SY_OPTIMAL);
}

TEST_F(Limits, TheSeedAloneDecidesTheDraws) {
  sy_control control = Unlimited();
  control.seed = 42;
  const StrategyAnswer one = Solve(control), same = Solve(control);
  EXPECT_EQ(one.x, same.x);
}

}  // namespace
}  // namespace switchyard::test
