// Many solves: in parallel, from many starts, again after a change; and who is chosen.
#include <cmath>

#include "switchyard/solve/choose_solver.hpp"
#include "switchyard/solve/multi_start.hpp"
#include "switchyard/solve/solve.hpp"
#include "switchyard/solve/solve_in_parallel.hpp"
#include "tests/nonlinear/backends.hpp"

namespace switchyard::testing {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

// Minima in each dent of a wave on a bowl; the lowest at x = -0.3063...
struct Wave {
  MathematicalProgram program;
  VectorXDecisionVariable x = program.NewContinuousVariables(1, "x");
  Binding<Cost> cost =
      program.AddCost([](const auto& v) { return 0.1 * v[0] * v[0] + sin(5 * v[0]); }, x);
  Wave() { program.AddBoundingBoxConstraint(-6, 6, x); }
};

TEST(ManyStarts, FindTheLowestDent) {
  SKIP_WITHOUT("ipopt");
  Wave wave;
  wave.program.SetInitialGuess(wave.x[0], 5.5);
  const auto one = SolverInterface("ipopt", Built()).Solve(wave.program);
  ASSERT_TRUE(one.is_success());
  MultiStartOptions options;
  options.num_starts = 20;
  options.seed = 3;
  options.solver = SolverId("ipopt");
  const auto many = SolveFromManyStarts(wave.program, options);
  ASSERT_TRUE(many.best.is_success());
  EXPECT_EQ(many.starts[0][0], 5.5);
  // The lowest of a fine grid is no lower.
  double lowest = kInf;
  for (int k = -60000; k <= 60000; ++k) {
    const double v = 1e-4 * k;
    lowest = std::min(lowest, 0.1 * v * v + std::sin(5 * v));
  }
  EXPECT_LT(many.best.objective, one.objective - 0.1);
  EXPECT_NEAR(many.best.objective, lowest, 1e-6);
  for (const auto& result : many.results) {
    if (!result.is_success()) continue;
    EXPECT_GE(result.objective, many.best.objective);
  }
}

TEST(ManyStarts, AreTheSameForAnyNumberOfThreads) {
  SKIP_WITHOUT("ipopt");
  Wave wave;
  MultiStartOptions options;
  options.num_starts = 8;
  options.seed = 5;
  options.solver = SolverId("ipopt");
  options.parallelism = Parallelism(1);
  const auto alone = SolveFromManyStarts(wave.program, options);
  options.parallelism = Parallelism(4);
  const auto together = SolveFromManyStarts(wave.program, options);
  EXPECT_EQ(alone.best_start, together.best_start);
  for (std::size_t k = 0; k < alone.results.size(); ++k) {
    EXPECT_EQ(alone.starts[k], together.starts[k]);
    EXPECT_EQ(alone.results[k].get_x_val(), together.results[k].get_x_val());
  }
}

TEST(Parallel, SolvesAreTheSameForAnyNumberOfThreads) {
  if (!IsThere("conic") && !IsThere("clarabel")) GTEST_SKIP() << "no conic backend was built";
  std::vector<std::unique_ptr<MathematicalProgram>> owned;
  std::vector<const MathematicalProgram*> programs;
  for (int k = 0; k < 12; ++k) {
    owned.push_back(std::make_unique<MathematicalProgram>());
    const auto x = owned.back()->NewContinuousVariables(3, "x");
    owned.back()->AddBoundingBoxConstraint(-1, 1, x);
    owned.back()->AddL2NormCost(Eigen::Matrix3d::Identity(), Eigen::Vector3d(k, 1, std::sqrt(k)),
                                x);
    programs.push_back(owned.back().get());
  }
  const auto one = SolveInParallel(programs, nullptr, nullptr, std::nullopt, Parallelism(1));
  for (const bool dynamic : {true, false}) {
    const auto four =
        SolveInParallel(programs, nullptr, nullptr, std::nullopt, Parallelism(4), dynamic);
    for (std::size_t k = 0; k < one.size(); ++k) {
      ASSERT_TRUE(one[k].is_success());
      EXPECT_EQ(one[k].get_x_val(), four[k].get_x_val());
    }
  }
}

TEST(Parallel, ListsOfAnotherLengthAreRefused) {
  const MathematicalProgram program;
  const std::vector<const Eigen::VectorXd*> guesses(3, nullptr);
  EXPECT_THROW(SolveInParallel({&program, &program}, &guesses), InvalidArgument);
}

// The bound of a function and a coefficient of a quadratic form reach the backend as updates.
TEST(Session, ChangesOfFunctionsAreUpdates) {
  SKIP_WITHOUT("ipopt");
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(2, "x");
  program.AddCost([](const auto& v) { return exp(v[0]) + exp(v[1]); }, x, {.is_convex = true});
  const auto function = std::make_shared<FunctionConstraint>(
      MakeFunction(2, [](const auto& v) { return v.squaredNorm(); }),
      Eigen::VectorXd::Constant(1, -kInf), Eigen::VectorXd::Constant(1, 2), true);
  program.AddConstraint(function, x);
  SolverSession session(program, "ipopt", {}, Built());
  for (const double radius : {2.0, 8.0, 18.0}) {
    function->UpdateBounds(Eigen::VectorXd::Constant(1, -kInf),
                           Eigen::VectorXd::Constant(1, radius));
    const auto result = session.Solve();
    ASSERT_EQ(result.termination, Termination::kOptimal) << result.message;
    EXPECT_NEAR(result.objective, 2 * std::exp(-std::sqrt(radius / 2)), 1e-5);
  }
  EXPECT_EQ(session.num_loads(), 1);
  EXPECT_EQ(session.num_updates(), 2);
}

TEST(Choice, IsByTheClassOfTheProgram) {
  SKIP_WITHOUT("ipopt");
  SKIP_WITHOUT("clp");
  MathematicalProgram linear;
  const auto x = linear.NewContinuousVariables(1, "x");
  linear.AddBoundingBoxConstraint(0, 1, x);
  linear.AddLinearCost(Eigen::VectorXd::Ones(1), x);
  EXPECT_EQ(GetProgramType(linear), ProgramType::kLP);
  Wave wave;
  EXPECT_EQ(GetProgramType(wave.program), ProgramType::kNLP);
  EXPECT_EQ(ChooseBestSolver(wave.program, Built()).name(), "org.coin-or.ipopt");

  Built().Prefer(ProgramType::kLP, "clp");
  EXPECT_EQ(ChooseBestSolver(linear, Built()).name(), "org.coin-or.clp");
  const auto considered = ExplainChoice(linear, Built());
  EXPECT_EQ(considered.front().why, "takes it as it is; preferred for lp by the program");
  EXPECT_EQ(ChooseBestSolver(wave.program, Built()).name(), "org.coin-or.ipopt");
  Built().Prefer(ProgramType::kLP, "");
  setenv("SWITCHYARD_SOLVERS", "ipopt; lp = clp", 1);
  EXPECT_EQ(ChooseBestSolver(linear, Built()).name(), "org.coin-or.clp");
  setenv("SWITCHYARD_SOLVERS", "lpp = clp", 1);
  try {
    static_cast<void>(ChooseBestSolver(linear, Built()));
    ADD_FAILURE() << "nothing was thrown";
  } catch (const InvalidArgument& e) {
    EXPECT_STREQ(e.what(),
                 "SWITCHYARD_SOLVERS:1: there is no class of programs \"lpp\"; the nearest is "
                 "\"lp\"");
  }
  unsetenv("SWITCHYARD_SOLVERS");
  EXPECT_THROW(Built().Prefer(std::nullopt, "clpp"), InvalidArgument);
  const auto available = GetAvailableSolvers(ProgramType::kNLP, Built());
  EXPECT_NE(std::find(available.begin(), available.end(), SolverId("org.coin-or.ipopt")),
            available.end());
  EXPECT_THROW(MakeSolver(SolverId("ipoptt"), Built()), InvalidArgument);
  EXPECT_EQ(
      MakeFirstAvailableSolver({SolverId("absent"), SolverId("clp")}, Built())->solver_id().name(),
      "org.coin-or.clp");
}

TEST(Options, OfACallGoBeforeThoseOfTheProgram) {
  SolverOptions call;
  call.time_limit = 3;
  call.SetOption(SolverId("clp"), "a", 1);
  SolverOptions program;
  program.time_limit = 7;
  program.threads = 2;
  program.SetOption(SolverId("clp"), "a", 5);
  program.SetOption(SolverId("clp"), "b", 6);
  call.Merge(program);
  EXPECT_EQ(call.time_limit, 3);
  EXPECT_EQ(call.threads, 2);
  EXPECT_EQ(std::get<int>(call.options["clp"]["a"]), 1);
  EXPECT_EQ(std::get<int>(call.options["clp"]["b"]), 6);
  EXPECT_THROW(call.SetOption(CommonSolverOption::kMaxThreads, 0), InvalidArgument);
  EXPECT_THROW(call.SetOption(CommonSolverOption::kMaxThreads, std::string("two")),
               InvalidArgument);
}

}  // namespace
}  // namespace switchyard::testing
