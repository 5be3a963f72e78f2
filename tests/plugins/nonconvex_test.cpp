// Solvers that take any quadratic objective, and what a solver of nonlinear programs finds awkward.
#include <string>

#include "programs.hpp"

namespace switchyard::test {
namespace {

constexpr double kTolerance = 1e-6;

class NonconvexSolver : public testing::TestWithParam<Named> {};
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(NonconvexSolver);
INSTANTIATE_TEST_SUITE_P(Plugins, NonconvexSolver,
                         testing::ValuesIn(SolversOf(kLinear | SY_ACCEPTS_QUADRATIC_OBJECTIVE |
                                                     SY_ACCEPTS_NONCONVEX_OBJECTIVE)),
                         NameOf);

TEST_P(NonconvexSolver, CallsALocalOptimumLocal) {
  // min x^2 - y^2 + y over [-1, 1]^2: local minima (0, 1), worth 0, and (0, -1), worth -2.
  ProblemData data = Linear({0, 1}, {-1, -1}, {1, 1}, {}, {}, {});
  data.P = Dense({{2, 0}, {0, -2}}, 2);
  const Problem problem(data);
  BareSolver solver(GetParam());
  solver.Load(problem.view());
  const Answer a = solver.Solve();
  const bool global = solver.Has(SY_PROVES_GLOBAL);
  EXPECT_EQ(a.result.termination, global ? SY_OPTIMAL : SY_LOCALLY_OPTIMAL) << a.text;
  EXPECT_NEAR(a.x[0], 0, 1e-4);
  EXPECT_NEAR(std::abs(a.x[1]), 1, kTolerance);
  EXPECT_LE(a.result.bound, -2 + kTolerance);
  EXPECT_LE(Stationarity(data, a, false), kTolerance);
}

TEST_P(NonconvexSolver, TakesMoreEquationsThanVariables) {
  ProblemData data = Linear({1, 2}, {-kInfinity, -kInfinity}, {kInfinity, kInfinity},
                            {{1, 1}, {1, -1}, {2, 1}}, {3, 1, 5}, {3, 1, 5});
  const Problem problem(data);
  BareSolver solver(GetParam());
  solver.Load(problem.view());
  ExpectOptimal(data, solver, solver.Solve(), kTolerance);
}

TEST_P(NonconvexSolver, TakesVariablesThatAreFixedAndRowsThatSayNothing) {
  const ProblemData some = Linear({1, 1}, {2, 0}, {2, kInfinity}, {{1, 0}, {1, 1}, {0, 0}, {1, 1}},
                                  {2, 3, 0, -kInfinity}, {2, kInfinity, 1, kInfinity});
  const ProblemData all = Linear({1, 1}, {2, 1}, {2, 1}, {{1, 1}}, {3}, {3}, 1);
  for (const ProblemData& data : {some, all}) {
    const Problem problem(data);
    BareSolver solver(GetParam());
    solver.Load(problem.view());
    ExpectOptimal(data, solver, solver.Solve(), kTolerance);
  }
  const ProblemData wrong = Linear({1, 1}, {2, 1}, {2, kInfinity}, {{1, 0}}, {3}, {kInfinity});
  const Problem problem(wrong);
  BareSolver solver(GetParam());
  solver.Load(problem.view());
  ExpectFarkas(wrong, solver.Solve());
}

TEST_P(NonconvexSolver, StartsFromAPointAndItsDualsWithFewerSteps) {
  const Problem problem(Random(60, 40, 5));
  BareSolver solver(GetParam());
  solver.Load(problem.view());
  const Answer cold = solver.Solve();
  sy_start start = {};
  start.size = sizeof start;
  start.x = cold.x.data();
  start.x_dual = cold.x_dual.data();
  start.row_dual = cold.row_dual.data();
  solver.WarmStart(start);
  const Answer warm = solver.Solve();
  ExpectOptimal(problem.data(), solver, warm, kTolerance);
  EXPECT_LT(warm.result.iterations, cold.result.iterations);
}

TEST_P(NonconvexSolver, JudgesOptionsItDoesNotList) {
  BareSolver solver(GetParam());
  if (!solver.Has(SY_OPEN_OPTIONS) || GetParam().name != "ipopt") GTEST_SKIP() << "lists them all";
  const auto set = [&](const char* name, const char* text) {
    sy_value value = {SY_TEXT, 0, {}};
    value.as.text = text;
    return solver.SetOption(name, value);
  };
  EXPECT_EQ(set("kappa_sigma", "1e8"), SY_OK) << solver.error().text;
  EXPECT_EQ(set("max_soc", "2"), SY_OK) << solver.error().text;
  EXPECT_EQ(set("expect_infeasible_problem", "yes"), SY_OK) << solver.error().text;
  EXPECT_EQ(set("max_soc", "1.5"), SY_E_ARGUMENT);
  EXPECT_EQ(set("kappa_sigma", "much"), SY_E_ARGUMENT);
  EXPECT_EQ(set("expect_infeasible_problem", "perhaps"), SY_E_ARGUMENT);
  EXPECT_NE(std::string(solver.error().text).find("expect_infeasible_problem"), std::string::npos);
}

}  // namespace
}  // namespace switchyard::test
