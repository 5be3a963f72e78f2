// What a user sets for a solve: limits, options, a start, progress; and which backend is asked.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/fake_backend.hpp"

namespace switchyard::testing {
namespace {

/// min x - 2 y, (x, y) in [0, 3] x [0, 4].
struct Box {
  Box() { program.AddLinearCost(Eigen::Vector2d(1, -2), x); }
  MathematicalProgram program;
  VectorXDecisionVariable x = program.NewContinuousVariables(2, "x");
  Binding<BoundingBoxConstraint> box =
      program.AddBoundingBoxConstraint(Eigen::Vector2d::Zero(), Eigen::Vector2d(3, 4), x);
};

TEST(Limits, WhatABackendDoesNotKeepIsSaid) {
  Box b;
  FakeBackend fake;
  const std::atomic<bool> cancelled = false;
  SolverOptions o;
  o.time_limit = 60;
  o.iteration_limit = 5;
  o.node_limit = 6;
  o.threads = 2;
  o.cutoff = 1e9;
  o.target = -1e9;
  o.feasibility_tolerance = o.optimality_tolerance = o.integrality_tolerance = 1e-7;
  o.seed = 3;
  o.cancelled = &cancelled;
  const auto result = fake.Solve(b.program, o);
  EXPECT_EQ(result.termination, Termination::kOptimal);
  const std::string watched = " itself: it is kept as far as it reports its progress";
  const std::vector<std::string> expected = {
      "test.fake does not keep the number of threads",
      "test.fake does not keep the time limit",
      "test.fake does not keep the iteration limit" + watched,
      "test.fake does not keep the node limit" + watched,
      "test.fake does not keep the cutoff" + watched,
      "test.fake does not keep the target" + watched,
      "test.fake does not keep the feasibility tolerance",
      "test.fake does not keep the optimality tolerance",
      "test.fake does not keep the integrality tolerance",
      "test.fake does not keep the seed",
      "test.fake does not keep cancelling"};
  EXPECT_EQ(result.notes, expected);
}

TEST(Limits, WhatABackendKeepsIsNotMentionedAndReachesIt) {
  Box b;
  b.program.set_objective_sense(ObjectiveSense::kMaximize);
  FakeBackend fake([](sy_solver& t) { t.honors = ~std::uint64_t{0}; });
  SolverOptions o;
  o.time_limit = 60;
  o.iteration_limit = 5;
  o.node_limit = 6;
  o.threads = 2;
  o.cutoff = 7;
  o.target = 8;
  o.feasibility_tolerance = 1e-3;
  o.absolute_gap = 1e-4;
  o.relative_gap = 1e-5;
  o.seed = 3;
  o.verbosity = 2;
  const auto result = fake.Solve(b.program, o);
  EXPECT_TRUE(result.notes.empty());
  const sy_control& c = fake.behaviour().control;
  EXPECT_LE(c.seconds, 60);
  EXPECT_GT(c.seconds, 50);
  EXPECT_EQ(c.iterations, 5);
  EXPECT_EQ(c.nodes, 6);
  EXPECT_EQ(c.threads, 2);
  EXPECT_EQ(c.cutoff, -7) << "in the sense of the problem, which minimizes";
  EXPECT_EQ(c.target, -8);
  EXPECT_EQ(c.feasibility, 1e-3);
  EXPECT_TRUE(std::isnan(c.optimality));
  EXPECT_EQ(c.absolute_gap, 1e-4);
  EXPECT_EQ(c.relative_gap, 1e-5);
  EXPECT_EQ(c.seed, 3u);
  EXPECT_EQ(c.verbosity, 2);
  EXPECT_EQ(c.flags & SY_CONTINUE, 0u);
}

TEST(Limits, WhatIsNotSetIsNoLimit) {
  Box b;
  FakeBackend fake;
  fake.Solve(b.program);
  const sy_control& c = fake.behaviour().control;
  EXPECT_EQ(c.seconds, kInfinity);
  EXPECT_EQ(c.iterations, std::numeric_limits<std::int64_t>::max());
  EXPECT_GE(c.threads, 1);
  EXPECT_EQ(c.cutoff, kInfinity);
  EXPECT_EQ(c.target, -kInfinity);
}

/// Waits, asking at each turn whether to stop, for five seconds at the most.
void Wait(const sy_problem& p, const sy_control& c, sy_result& r) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(5);
  while (std::chrono::steady_clock::now() < end) {
    if (c.cancelled(c.context) == 0) continue;
    SolveBox(p, c, r);
    r.termination = SY_CANCELLED;
    return;
  }
  throw std::runtime_error("it was never told to stop");
}

TEST(Limits, TheHostKeepsATimeLimitThroughABackendThatCanBeCancelled) {
  Box b;
  FakeBackend fake([](sy_solver& t) { t.honors = SY_HONORS_CANCELLED; });
  fake.behaviour().answer = Wait;
  const auto result = fake.Solve(b.program, With([](SolverOptions& o) { o.time_limit = 0.05; }));
  EXPECT_EQ(result.termination, Termination::kTimeLimit) << result.message;
  EXPECT_EQ(result.primal, PointKind::kFeasible);
  EXPECT_TRUE(result.notes.empty());
  EXPECT_LT(result.seconds.total, 1);
}

TEST(Limits, CancellingReachesTheBackend) {
  Box b;
  FakeBackend fake([](sy_solver& t) { t.honors = SY_HONORS_CANCELLED; });
  fake.behaviour().answer = Wait;
  const std::atomic<bool> cancelled = true;
  const auto result =
      fake.Solve(b.program, With([&](SolverOptions& o) { o.cancelled = &cancelled; }));
  EXPECT_EQ(result.termination, Termination::kCancelled) << result.message;
}

/// Reports iterations 1 to 100, and stops where it is told to.
void Report(const sy_problem& p, const sy_control& c, sy_result& r) {
  SolveBox(p, c, r);
  for (int k = 1; k <= 100 && c.progress != nullptr; ++k) {
    sy_progress progress{};
    progress.size = sizeof progress;
    progress.iteration = k;
    progress.objective = -3;
    progress.bound = -5;
    progress.nodes = 2 * k;
    progress.incumbent = k == 1 ? r.x : nullptr;
    progress.primal_residual = progress.dual_residual = std::nan("");
    r.iterations = k;
    if (c.progress(c.context, &progress) == 0) continue;
    r.termination = SY_CANCELLED;
    return;
  }
}

TEST(Limits, TheHostKeepsLimitsThroughProgress) {
  Box b;
  const auto ended = [&](auto edit) {
    FakeBackend fake;
    fake.behaviour().answer = Report;
    return fake.Solve(b.program, With(edit));
  };
  using O = SolverOptions;
  EXPECT_EQ(ended([](O& o) { o.iteration_limit = 10; }).termination, Termination::kIterationLimit);
  EXPECT_EQ(ended([](O& o) { o.iteration_limit = 10; }).iterations, 10);
  EXPECT_EQ(ended([](O& o) { o.node_limit = 10; }).termination, Termination::kNodeLimit);
  EXPECT_EQ(ended([](O& o) { o.cutoff = -5; }).termination, Termination::kCutoff);
  EXPECT_EQ(ended([](O& o) { o.target = -3; }).termination, Termination::kTarget);
  EXPECT_EQ(ended([](O&) {}).termination, Termination::kOptimal);
}

TEST(Progress, IsInTheProgramsSense) {
  Box b;
  b.program.set_objective_sense(ObjectiveSense::kMaximize);
  FakeBackend fake;
  fake.behaviour().answer = Report;
  std::vector<SolveProgress> seen;
  SolverOptions o;
  o.progress = [&](const SolveProgress& p) {
    seen.push_back(p);
    return p.iteration == 3;
  };
  const auto result = fake.Solve(b.program, o);
  EXPECT_EQ(result.termination, Termination::kCancelled);
  ASSERT_EQ(seen.size(), 3u);
  EXPECT_EQ(seen[0].objective, 3);
  EXPECT_EQ(seen[0].bound, 5);
  EXPECT_TRUE(seen[0].new_incumbent);
  EXPECT_FALSE(seen[1].new_incumbent);
  EXPECT_EQ(seen[2].nodes, 6);
}

struct Unusual : std::runtime_error {
  using std::runtime_error::runtime_error;
};

TEST(Progress, WhatItThrowsIsThrownAfterTheSolve) {
  Box b;
  FakeBackend fake;
  int reports = 0;
  bool finished = false;
  fake.behaviour().answer = [&](const sy_problem& p, const sy_control& c, sy_result& r) {
    Report(p, c, r);
    finished = true;
  };
  SolverOptions o;
  o.progress = [&](const SolveProgress&) -> bool {
    ++reports;
    throw Unusual("enough");
  };
  EXPECT_THROW(fake.Solve(b.program, o), Unusual);
  EXPECT_EQ(reports, 1);
  EXPECT_TRUE(finished);
}

TEST(InitialGuess, ReachesTheBackendWithUnknownsLeftUnknown) {
  Box b;
  b.program.AddL2NormCost(Eigen::Matrix2d::Identity(), Eigen::Vector2d::Zero(), b.x);
  FakeBackend fake;
  const SolverInterface solver("", fake.host());
  static_cast<void>(solver.Solve(b.program, Eigen::VectorXd(Eigen::Vector2d(3, 4))));
  EXPECT_EQ(fake.behaviour().start, (std::vector<double>{3, 4, 5}));
  static_cast<void>(solver.Solve(b.program, Eigen::VectorXd(Eigen::Vector2d(3, std::nan("")))));
  ASSERT_EQ(fake.behaviour().start.size(), 3u);
  EXPECT_EQ(fake.behaviour().start[0], 3);
  EXPECT_TRUE(std::isnan(fake.behaviour().start[1]));
  EXPECT_TRUE(std::isnan(fake.behaviour().start[2]));
}

TEST(InitialGuess, IsTheProgramsWhereNoneIsGiven) {
  Box b;
  FakeBackend fake;
  fake.Solve(b.program);
  EXPECT_TRUE(fake.behaviour().start.empty());
  b.program.SetInitialGuess(b.x[1], 2);
  fake.Solve(b.program);
  ASSERT_EQ(fake.behaviour().start.size(), 2u);
  EXPECT_EQ(fake.behaviour().start[1], 2);
}

TEST(InitialGuess, HasAnEntryForEachVariable) {
  Box b;
  FakeBackend fake;
  const SolverInterface solver("", fake.host());
  EXPECT_EQ(Thrown([&] {
              static_cast<void>(solver.Solve(b.program, Eigen::VectorXd(Eigen::Vector3d::Zero())));
            }),
            "the initial guess needs 2 entries, got 3");
}

TEST(Options, ReachTheBackendThatIsNamedOrChosen) {
  Box b;
  FakeBackend fake;
  SolverOptions o;
  o.SetOption(SolverId("fake"), "speed", 3);
  o.SetOption(SolverId(""), "mode", "careful");
  o.SetOption(SolverId("another"), "nonsense", 1.5);
  fake.Solve(b.program, o);
  EXPECT_EQ(fake.behaviour().options, (std::vector<std::string>{"mode=careful", "speed=3"}));
}

TEST(Options, AMistakeIsThrown) {
  Box b;
  const auto said = [&](const std::string& name, SolverOptions::OptionValue value) {
    FakeBackend fake;
    SolverOptions o;
    o.SetOption(SolverId("test.fake"), name, std::move(value));
    return Thrown([&] { fake.Solve(b.program, o); });
  };
  EXPECT_EQ(said("sped", 1), "test.fake has no option \"sped\"; the nearest is \"speed\"");
  EXPECT_EQ(said("completely-else", 1), "test.fake has no option \"completely-else\"");
  EXPECT_EQ(said("speed", 11), "option speed needs an integer from 0 to 10, got 11");
  EXPECT_EQ(said("speed", 1.5), "option speed needs an integer, got \"1.5\"");
  EXPECT_EQ(said("speed", "fast"), "option speed needs an integer, got \"fast\"");
}

TEST(NoBackend, SaysWhoWasAskedAndWhyNot) {
  Box b;
  FakeBackend fake;
  fake.behaviour().not_ready = "no license";
  auto result = fake.Solve(b.program);
  EXPECT_EQ(result.termination, Termination::kNoBackend);
  EXPECT_EQ(result.message, "test.fake: not ready: no license");
  fake.behaviour().not_ready.clear();
  fake.behaviour().supports = "x[1] is too much";
  result = fake.Solve(b.program);
  EXPECT_EQ(result.message, "test.fake: x(1) is too much");
  ASSERT_EQ(result.considered.size(), 1u);
  EXPECT_EQ(result.considered[0].solver, "test.fake");
  EXPECT_FALSE(result.considered[0].chosen);
}

TEST(NoBackend, SaysWhatIsNotTaken) {
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(3);
  program.AddExponentialConeConstraint(Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero(), x);
  FakeBackend fake([](sy_solver& t) { t.cones = 0; });
  EXPECT_EQ(fake.Solve(program).message, "test.fake: does not take exponential cones");
  program.RemoveConstraint(program.cone_constraints()[0]);
  program.AddQuadraticErrorCost(-1.0, Eigen::Vector3d::Zero(), x);
  program.NewIntegerVariables(1);
  FakeBackend convex([](sy_solver& t) { t.integer_accepts &= ~SY_ACCEPTS_NONCONVEX_OBJECTIVE; });
  EXPECT_EQ(convex.Solve(program).message,
            "test.fake: does not take a nonconvex objective together with integer variables");
}

TEST(NoBackend, SaysWhereNoneIsThere) {
  Box b;
  Host empty(HostOptions{{}, std::vector<std::string>{}, {}});
  EXPECT_EQ(SolverInterface("", empty).Solve(b.program).message, "no backend is there");
}

TEST(NoBackend, AMisspeltNameHasItsNearestAndWhatWouldServe) {
  Box b;
  FakeBackend fake;
  EXPECT_EQ(fake.Solve(b.program, {}, "fkae").message,
            "fkae: there is none of that name; the nearest is fake; would serve: fake");
  EXPECT_EQ(fake.Solve(b.program, {}, "somebody").message,
            "somebody: there is none of that name; would serve: fake");
  fake.behaviour().supports = "never";
  EXPECT_EQ(fake.Solve(b.program, {}, "somebody").message,
            "somebody: there is none of that name; no other backend would serve");
}

TEST(NoBackend, APreferenceFallsThroughToWhatIsThere) {
  Box b;
  FakeBackend fake;
  const auto result = fake.Solve(b.program, {}, "missing,fake");
  EXPECT_EQ(result.termination, Termination::kOptimal);
  ASSERT_EQ(result.considered.size(), 2u);
  EXPECT_TRUE(result.considered[1].chosen);
}

TEST(SolverInterface, SaysWhetherItIsThereAndWhatItTakes) {
  Box b;
  FakeBackend fake;
  EXPECT_TRUE(SolverInterface("fake", fake.host()).available());
  EXPECT_TRUE(SolverInterface("other,test.fake", fake.host()).available());
  EXPECT_FALSE(SolverInterface("other", fake.host()).available());
  std::string why;
  EXPECT_TRUE(SolverInterface("fake", fake.host()).Accepts(b.program, &why));
  EXPECT_FALSE(SolverInterface("other", fake.host()).Accepts(b.program, &why));
  EXPECT_EQ(why, "no such backend is there");
  fake.behaviour().not_ready = "no license";
  EXPECT_FALSE(SolverInterface("fake", fake.host()).available());
  EXPECT_FALSE(SolverInterface("fake", fake.host()).Accepts(b.program, &why));
}

}  // namespace
}  // namespace switchyard::testing
