// Limits over a backend that honors nothing, and only calls the hooks: the host keeps them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <optional>
#include <thread>

#include "tests/host/scripted.hpp"

namespace switchyard::test {
namespace {

constexpr std::int64_t kSteps = 400;  // a backend that nobody stops ends here

/// What a backend reports at step k.
sy_progress At(std::int64_t k) {
  sy_progress p{};
  p.size = sizeof p;
  p.iteration = k;
  p.nodes = 2 * k;
  p.objective = 100 - static_cast<double>(k);
  p.bound = static_cast<double>(k) - 100;
  return p;
}

/// Walks until a hook says stop; says how far it came.
class Walker {
 public:
  explicit Walker(std::uint64_t honors = 0, std::uint64_t traits = SY_GIVES_BOUND) {
    script_.table.honors = honors;
    script_.table.traits = traits;
    script_.solve = [this](const sy_control& control, sy_result& result) { Walk(control, result); };
    Add(host_, script_);
    session_.emplace(host_, script_);
    session_->Load(SmallLp());
  }
  Walker(const Walker&) = delete;
  Walker& operator=(const Walker&) = delete;

  sy_termination Solve(const sy_control& control) {
    const Answer answer = session_->Solve(control);
    EXPECT_EQ(answer.error, "");
    return answer.result.termination;
  }
  [[nodiscard]] std::int64_t steps() const { return step_; }
  bool reports = true;     // calls progress
  bool incumbents = true;  // with a point each time
  bool asks = true;        // calls cancelled
  std::chrono::microseconds pace{0};

 private:
  void Walk(const sy_control& control, sy_result& result) {
    const double x[2] = {0, 0};
    result.termination = SY_OPTIMAL;
    for (step_ = 1; step_ <= kSteps; ++step_) {
      std::this_thread::sleep_for(pace);
      sy_progress p = At(step_);
      if (incumbents) p.incumbent = x;
      const bool stop = (reports && control.progress(control.context, &p) != 0) ||
                        (asks && control.cancelled(control.context) != 0);
      if (!stop) continue;
      result.termination = SY_CANCELLED;
      return;
    }
  }

  Script script_;
  Host host_{Nowhere()};
  std::optional<Session> session_;
  std::int64_t step_ = 0;
};

TEST(Limits, WithoutOneABackendRunsToItsEnd) {
  Walker walker;
  EXPECT_EQ(walker.Solve(Freely()), SY_OPTIMAL);
  EXPECT_GT(walker.steps(), kSteps);
}

TEST(Limits, IterationsNodesTargetAndCutoffStopAtTheStepThatReachesThem) {
  Walker walker;
  sy_control control = Freely();
  control.iterations = 7;
  EXPECT_EQ(walker.Solve(control), SY_ITERATION_LIMIT);
  EXPECT_EQ(walker.steps(), 7);
  control = Freely();
  control.nodes = 7;
  EXPECT_EQ(walker.Solve(control), SY_NODE_LIMIT);
  EXPECT_EQ(walker.steps(), 4);
  control = Freely();
  control.target = 90;
  EXPECT_EQ(walker.Solve(control), SY_TARGET);
  EXPECT_EQ(walker.steps(), 10);
  control = Freely();
  control.cutoff = -95;
  EXPECT_EQ(walker.Solve(control), SY_CUTOFF);
  EXPECT_EQ(walker.steps(), 5);
}

TEST(Limits, TimeIsKeptWhetherABackendReportsOrOnlyAsks) {
  for (const bool reports : {true, false}) {
    Walker walker;
    walker.reports = reports;
    walker.asks = !reports;
    walker.pace = std::chrono::milliseconds(5);
    sy_control control = Freely();
    control.seconds = 0.05;
    EXPECT_EQ(walker.Solve(control), SY_TIME_LIMIT);
    EXPECT_LT(walker.steps(), kSteps);
  }
}

TEST(Limits, CancellingIsPassedOn) {
  Walker walker;
  sy_control control = Freely();
  int asked = 0;
  control.context = &asked;
  control.cancelled = [](void* context) noexcept -> std::int32_t {
    return ++*static_cast<int*>(context) > 5 ? 1 : 0;
  };
  EXPECT_EQ(walker.Solve(control), SY_CANCELLED);
  EXPECT_LE(walker.steps(), 6);
  control.cancelled = nullptr;
  control.progress = [](void*, const sy_progress* p) noexcept -> std::int32_t {
    return p->iteration == 3 ? 1 : 0;
  };
  EXPECT_EQ(walker.Solve(control), SY_CANCELLED);
  EXPECT_EQ(walker.steps(), 3);
}

TEST(Limits, WhatABackendHonorsIsLeftToIt) {
  Walker walker(SY_HONORS_ITERATIONS | SY_HONORS_NODES | SY_HONORS_TARGET | SY_HONORS_CUTOFF |
                SY_HONORS_SECONDS);
  sy_control control = Freely();
  control.iterations = control.nodes = 1;
  control.target = 1000;
  control.cutoff = -1000;
  control.seconds = 0;
  EXPECT_EQ(walker.Solve(control), SY_OPTIMAL);
}

TEST(Limits, ABackendThatCallsNoHookIsNotSaidToBeStopped) {
  Walker walker;
  walker.reports = walker.asks = false;
  sy_control control = Freely();
  control.iterations = 1;
  control.seconds = 0;
  EXPECT_EQ(walker.Solve(control), SY_OPTIMAL);
}

TEST(Limits, ATargetNeedsAPoint) {
  Walker walker;
  walker.incumbents = false;
  sy_control control = Freely();
  control.target = 90;
  EXPECT_EQ(walker.Solve(control), SY_OPTIMAL);
}

TEST(Limits, ACutoffNeedsABoundThatTheBackendSaysItGives) {
  Walker walker(0, 0);
  sy_control control = Freely();
  control.cutoff = -95;
  EXPECT_EQ(walker.Solve(control), SY_OPTIMAL);
}

// A relaxation without a point has the bound infinity: at no cutoff that is no cutoff.
TEST(Limits, NoCutoffIsReachedByNoNumber) {
  Script script;
  script.table.traits = SY_GIVES_BOUND;
  script.solve = [](const sy_control& control, sy_result& result) {
    sy_progress p = At(1);
    const double x[2] = {0, 0};
    p.incumbent = x;
    p.bound = kInfinity;
    p.objective = -kInfinity;
    result.termination = control.progress(control.context, &p) != 0 ? SY_CANCELLED : SY_INFEASIBLE;
  };
  Host host(Nowhere());
  Add(host, script);
  Session session(host, script);
  session.Load(SmallLp());
  EXPECT_EQ(session.Solve().result.termination, SY_INFEASIBLE);
}

TEST(Limits, AnAnswerThatWasFoundBeforeTheStopStands) {
  Script script;
  script.solve = [](const sy_control& control, sy_result& result) {
    sy_progress p = At(9);
    EXPECT_NE(control.progress(control.context, &p), 0);
    result.termination = SY_OPTIMAL;
  };
  Host host(Nowhere());
  Add(host, script);
  Session session(host, script);
  session.Load(SmallLp());
  sy_control control = Freely();
  control.iterations = 5;
  EXPECT_EQ(session.Solve(control).result.termination, SY_OPTIMAL);
}

TEST(Limits, ARecordOfAnOlderAuthorIsReadAsFarAsItGoes) {
  Script script;
  script.solve = [](const sy_control& control, sy_result& result) {
    sy_progress p = At(1);
    p.size = offsetof(sy_progress, incumbent);
    p.nodes = 1000;  // behind the end
    result.termination = control.progress(control.context, &p) != 0 ? SY_CANCELLED : SY_OPTIMAL;
  };
  Host host(Nowhere());
  Add(host, script);
  Session session(host, script);
  session.Load(SmallLp());
  sy_control control = Freely();
  control.nodes = 5;
  EXPECT_EQ(session.Solve(control).result.termination, SY_OPTIMAL);
}

}  // namespace
}  // namespace switchyard::test
