// Solvers of nonlinear programs beyond one answer: functions that refuse, limits, updates, starts.
#include <atomic>
#include <chrono>
#include <string>
#include <thread>

#include "nonlinear_known.hpp"

namespace switchyard::test {
namespace {

class NonlinearLife : public testing::TestWithParam<Named> {};
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(NonlinearLife);
INSTANTIATE_TEST_SUITE_P(Plugins, NonlinearLife,
                         testing::ValuesIn(SolversOf(kLinear | SY_ACCEPTS_NLP)), NameOf);

// Limits hold within 5 % + 250 ms on an idle machine; a test has others beside it.
constexpr double kSlack = 0.75;

TEST_P(NonlinearLife, EndsAtOnceWhereAFunctionEndsTheSolve) {
  for (std::int64_t last = 1; last <= 60; ++last) {
    Nonlinear made = Hs71();
    std::int64_t left = last;
    made.functions.judge = [&](const Vector&) { return --left <= 0 ? SY_ABORT : SY_EVALUATED; };
    const HandWritten program(made.data, made.functions);
    const NonlinearAnswer a = SolveFrom(GetParam(), program, {1, 5, 5, 1});
    if (left > 0) break;  // solved with fewer calls
    EXPECT_EQ(a.result.termination, SY_EVALUATION_FAILED) << a.text;
    EXPECT_NE(a.text.find("ended the solve"), std::string::npos) << a.text;
    EXPECT_EQ(program.calls_after_abort, 0);
  }
}

TEST_P(NonlinearLife, SaysWhereTheFunctionsAreNotDefinedAtTheStart) {
  for (const bool nan : {false, true}) {
    Nonlinear made = Hs71();
    if (nan) {
      made.functions.f = [](const Vector&) { return kNaN; };
    } else {
      made.functions.judge = [](const Vector&) { return SY_UNDEFINED; };
    }
    const HandWritten program(made.data, made.functions);
    const NonlinearAnswer a = SolveFrom(GetParam(), program, {1, 5, 5, 1});
    EXPECT_EQ(a.result.termination, SY_EVALUATION_FAILED) << a.text;
    EXPECT_NE(a.text.find("start"), std::string::npos) << a.text;
  }
}

TEST_P(NonlinearLife, ShortensStepsThatLeaveTheDomain) {
  // log(x) and log(4 - x) have no bounds beside them: only the verdict says where they end.
  Functions s;
  s.f = [](const Vector& x) { return -std::log(x[0]) - 3 * std::log(4 - x[0]); };
  s.gradient = [](const Vector& x) -> Vector { return {-1 / x[0] + 3 / (4 - x[0])}; };
  s.hessian = [](const Vector& x, double w, const double*) -> Matrix {
    return {{w * (1 / (x[0] * x[0]) + 3 / ((4 - x[0]) * (4 - x[0])))}};
  };
  s.hessian_pattern = {{1}};
  s.judge = [](const Vector& x) { return x[0] > 0 && x[0] < 4 ? SY_EVALUATED : SY_UNDEFINED; };
  const HandWritten program(Free(1), s);
  const BareSolver solver(GetParam());
  const NonlinearAnswer a = SolveFrom(GetParam(), program, {3.99});
  ExpectLocalOptimum(program, solver, a);
  EXPECT_NEAR(a.x[0], 1, 100 * ToleranceOf(solver));
}

TEST_P(NonlinearLife, StartsAnywhereItMayWhereTheStartIsNotKnown) {
  const Nonlinear made = Hs71();
  const HandWritten program(made.data, made.functions);
  const BareSolver solver(GetParam());
  ExpectLocalOptimum(program, solver, SolveFrom(GetParam(), program, {kNaN, 5, kNaN, -7}));
}

TEST_P(NonlinearLife, KeepsItsTimeAlsoInLongEvaluations) {
  BareSolver solver(GetParam());
  if (!solver.Honors(SY_HONORS_SECONDS)) GTEST_SKIP() << "keeps no time limit";
  for (const bool refuses : {false, true}) {
    // After a while nothing is defined any more: a line search is then long.
    Nonlinear made = Rosenbrock();
    std::int64_t calls = 0;
    made.functions.judge = [&](const Vector&) {
      std::this_thread::sleep_for(std::chrono::milliseconds(refuses ? 30 : 1));
      return refuses && ++calls > 12 ? SY_UNDEFINED : SY_EVALUATED;
    };
    const HandWritten program(made.data, made.functions);
    const Vector x = {-1.2, 1};
    sy_start start = {};
    start.size = sizeof start;
    start.x = x.data();
    solver.Load(program.problem());
    solver.WarmStart(start);
    sy_control control = Freely();
    control.seconds = refuses ? 0.45 : 0.03;
    const NonlinearAnswer a = Solve(solver, program, control);
    EXPECT_EQ(a.result.termination, SY_TIME_LIMIT) << a.text;
    EXPECT_LE(a.result.seconds, control.seconds + kSlack);
  }
}

TEST_P(NonlinearLife, LeavesItsPointWhenItsTimeIsUp) {
  BareSolver solver(GetParam());
  if (!solver.Honors(SY_HONORS_SECONDS)) GTEST_SKIP() << "keeps no time limit";
  Nonlinear made = Rosenbrock();
  made.functions.judge = [&](const Vector&) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return SY_EVALUATED;
  };
  const HandWritten program(made.data, made.functions);
  solver.Load(program.problem());
  sy_control control = Freely();
  control.seconds = 0.03;
  const NonlinearAnswer a = Solve(solver, program, control);
  ASSERT_EQ(a.result.termination, SY_TIME_LIMIT) << a.text;
  EXPECT_EQ(a.result.primal, SY_FEASIBLE);
  EXPECT_NEAR(a.result.objective, program.functions().f(a.x), 1e-9 * (1 + a.result.objective));
}

TEST_P(NonlinearLife, StopsWhenCancelledWithinAFunction) {
  BareSolver solver(GetParam());
  if (!solver.Honors(SY_HONORS_CANCELLED)) GTEST_SKIP() << "cannot be cancelled";
  Nonlinear made = Rosenbrock();
  std::int64_t calls = 0;
  made.functions.judge = [&](const Vector&) {
    ++calls;
    return SY_EVALUATED;
  };
  const HandWritten program(made.data, made.functions);
  solver.Load(program.problem());
  sy_control control = Freely();
  control.context = &calls;
  control.cancelled = [](void* context) noexcept -> std::int32_t {
    return *static_cast<std::int64_t*>(context) >= 9 ? 1 : 0;
  };
  const NonlinearAnswer a = Solve(solver, program, control);
  EXPECT_EQ(a.result.termination, SY_CANCELLED) << a.text;
  EXPECT_LE(calls, 9 + 8) << "asked on";
}

TEST_P(NonlinearLife, CountsItsIterations) {
  BareSolver solver(GetParam());
  if (!solver.Honors(SY_HONORS_ITERATIONS)) GTEST_SKIP() << "counts no iterations";
  const Nonlinear made = Rosenbrock();
  const HandWritten program(made.data, made.functions);
  solver.Load(program.problem());
  sy_control control = Freely();
  control.iterations = 3;
  const NonlinearAnswer a = Solve(solver, program, control);
  EXPECT_EQ(a.result.termination, SY_ITERATION_LIMIT) << a.text;
  EXPECT_LE(a.result.iterations, 4);
}

TEST_P(NonlinearLife, TakesNewFunctionsAndTheirSides) {
  BareSolver solver(GetParam());
  if (!solver.Updates(SY_UPDATES_NLP)) GTEST_SKIP() << "not declared";
  const Nonlinear made = Hs71();
  HandWritten program(made.data, made.functions);
  solver.Load(program.problem(), SY_UPDATES_NLP);
  const Vector x = {1, 5, 5, 1};
  sy_start start = {};
  start.size = sizeof start;
  start.x = x.data();
  solver.WarmStart(start);
  const NonlinearAnswer before = Solve(solver, program);
  ExpectLocalOptimum(program, solver, before);

  program.Change([](Functions& s, ProblemData&) {
    s.lower = {20, 45};
    s.upper = {kInfinity, 45};
    s.f = [f = s.f](const Vector& at) { return 2 * f(at) + at[0]; };
    s.gradient = [g = s.gradient](const Vector& at) {
      Vector gradient = g(at);
      for (double& v : gradient) v *= 2;
      gradient[0] += 1;
      return gradient;
    };
    s.hessian = [h = s.hessian](const Vector& at, double w, const double* y) {
      return h(at, 2 * w, y);
    };
  });
  sy_update update = {};
  update.size = sizeof update;
  update.whole = SY_UPDATES_NLP;
  update.problem = &program.problem();
  solver.Update(update);
  const NonlinearAnswer fresh = SolveFrom(GetParam(), program, x);
  for (const std::uint32_t flags : {std::uint32_t{SY_CONTINUE}, std::uint32_t{0}}) {
    sy_control control = Freely();
    control.flags = flags;
    const NonlinearAnswer a = Solve(solver, program, control);
    ExpectLocalOptimum(program, solver, a);
    EXPECT_NEAR(a.result.objective, fresh.result.objective, 100 * ToleranceOf(solver));
  }
}

TEST_P(NonlinearLife, TakesOtherFunctionsForConvexOnlyWhereTheyAre) {
  BareSolver solver(GetParam());
  if (GetParam().name != "ipopt") GTEST_SKIP() << "keeps the flags it was loaded with";
  const Nonlinear made = Logarithm();
  HandWritten program(made.data, made.functions);
  solver.Load(program.problem(), SY_UPDATES_NLP);
  EXPECT_EQ(Solve(solver, program).result.termination, SY_OPTIMAL);
  program.Change([](Functions&, ProblemData& d) { d.flags = 0; });
  sy_update update = {};
  update.size = sizeof update;
  update.whole = SY_UPDATES_NLP;
  update.problem = &program.problem();
  solver.Update(update);
  const NonlinearAnswer a = Solve(solver, program);
  const bool global = solver.Has(SY_PROVES_GLOBAL);
  EXPECT_EQ(a.result.termination, global ? SY_OPTIMAL : SY_LOCALLY_OPTIMAL) << a.text;
}

TEST_P(NonlinearLife, StartsFromAPointAndAllItsDualsWithFewerSteps) {
  BareSolver solver(GetParam());
  if (!solver.Has(SY_GIVES_DUALS)) GTEST_SKIP() << "gives no duals";
  const Certified made = RandomConvex(12, 4, 2, 7);
  const HandWritten program(made.program.data, made.program.functions);
  solver.Load(program.problem());
  const NonlinearAnswer cold = Solve(solver, program);
  ExpectLocalOptimum(program, solver, cold);
  sy_control proceed = Freely();
  proceed.flags = SY_CONTINUE;
  const NonlinearAnswer proceeded = Solve(solver, program, proceed);
  ExpectLocalOptimum(program, solver, proceeded);
  EXPECT_LT(proceeded.result.iterations, cold.result.iterations);
  sy_start start = {};
  start.size = sizeof start;
  start.x = cold.x.data();
  start.x_dual = cold.x_dual.data();
  start.row_dual = cold.row_dual.data();
  start.nlp_dual = cold.nlp_dual.data();
  BareSolver other(GetParam());
  other.Load(program.problem());
  other.WarmStart(start);
  const NonlinearAnswer warm = Solve(other, program);
  ExpectLocalOptimum(program, other, warm);
  const bool second_order = solver.Has(SY_NEEDS_GRADIENT);
  EXPECT_LE(warm.result.iterations, second_order ? 3 : cold.result.iterations - 1);
  EXPECT_NEAR(warm.result.objective, cold.result.objective, 1e-6);
}

TEST_P(NonlinearLife, DependsOnNothingItWasNotGiven) {
  const Nonlinear made = Hs71();
  const HandWritten program(made.data, made.functions);
  BareSolver solver(GetParam());
  solver.Load(program.problem());
  const NonlinearAnswer first = Solve(solver, program);
  const NonlinearAnswer second = Solve(solver, program);
  EXPECT_EQ(first.x, second.x);
  EXPECT_EQ(first.result.iterations, second.result.iterations);
  EXPECT_EQ(program.wrong_numbers, 0);
}

}  // namespace
}  // namespace switchyard::test
