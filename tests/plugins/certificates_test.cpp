#include "programs.hpp"

namespace switchyard::test {
namespace {

constexpr double kTolerance = 1e-6;

class LinearSolver : public testing::TestWithParam<Named> {};
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(LinearSolver);
INSTANTIATE_TEST_SUITE_P(Plugins, LinearSolver, testing::ValuesIn(SolversOf(kLinear)), NameOf);

class QuadraticSolver : public testing::TestWithParam<Named> {};
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(QuadraticSolver);
INSTANTIATE_TEST_SUITE_P(Plugins, QuadraticSolver,
                         testing::ValuesIn(SolversOf(kLinear | SY_ACCEPTS_QUADRATIC_OBJECTIVE)),
                         NameOf);

TEST_P(LinearSolver, CertifiesTheOptimumItReports) {
  for (const std::uint64_t updates : {std::uint64_t{0}, GetParam().table->updates}) {
    const Problem problem(Corner());
    BareSolver solver(GetParam());
    solver.Load(problem.view(), updates);
    const Answer a = solver.Solve();
    ExpectOptimal(problem.data(), solver, a, kTolerance);
    EXPECT_NEAR(a.result.objective, 5, 1e-5);
  }
}

TEST_P(LinearSolver, CertifiesRandomPrograms) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const Problem problem(Random(30, 20, seed));
    BareSolver solver(GetParam());
    solver.Load(problem.view());
    ExpectOptimal(problem.data(), solver, solver.Solve(), kTolerance);
  }
}

TEST_P(LinearSolver, ProvesThatRowsContradict) {
  // x + y >= 5 and x + y <= 3; then x + y >= 5 against the bounds; then free variables.
  const std::vector<ProblemData> programs = {
      Linear({1, 1}, {0, 0}, {10, 10}, {{1, 1}, {1, 1}}, {5, -kInfinity}, {kInfinity, 3}),
      Linear({1, -1}, {0, 0}, {2, 2}, {{1, 1}}, {5}, {kInfinity}),
      Linear({0, 0}, {-kInfinity, -kInfinity}, {kInfinity, kInfinity}, {{1, 2}, {2, 4}}, {1, 3},
             {1, 3}),
      Linear({1, 1, 1}, {0, 0, 0}, {kInfinity, kInfinity, kInfinity},
             {{1, -1, 0}, {0, 1, -1}, {-1, 0, 1}}, {1, 1, 1}, {kInfinity, kInfinity, kInfinity})};
  for (const ProblemData& data : programs) {
    const Problem problem(data);
    BareSolver solver(GetParam());
    solver.Load(problem.view());
    const Answer a = solver.Solve();
    if (solver.Has(SY_GIVES_CERTIFICATES)) {
      ExpectFarkas(data, a);
    } else {
      EXPECT_EQ(a.result.termination, SY_INFEASIBLE);
    }
  }
}

TEST_P(LinearSolver, ShowsARayWhereNothingStopsTheDescent) {
  const std::vector<ProblemData> programs = {
      Linear({-1, -1}, {0, 0}, {kInfinity, kInfinity}, {{1, -1}}, {-1}, {1}),
      Linear({1, 0}, {-kInfinity, 0}, {5, 1}, {{1, 1}}, {-kInfinity}, {3}),
      Linear({-1, -2, 1}, {0, 0, 0}, {kInfinity, kInfinity, kInfinity}, {{1, 1, -1}}, {-kInfinity},
             {4})};
  for (const ProblemData& data : programs) {
    const Problem problem(data);
    BareSolver solver(GetParam());
    solver.Load(problem.view());
    const Answer a = solver.Solve();
    if (solver.Has(SY_GIVES_CERTIFICATES)) {
      ExpectRay(data, a);
    } else {
      EXPECT_EQ(a.result.termination, SY_UNBOUNDED);
    }
  }
}

TEST_P(LinearSolver, SolvesWhatIsHardlyThere) {
  ProblemData no_rows = Linear({1, -1}, {2, 0}, {7, 3}, {}, {}, {}, 4);
  const ProblemData no_variables = Linear({}, {}, {}, {{}}, {-1}, {1}, 3);
  const ProblemData nothing = Linear({}, {}, {}, {}, {}, {}, 2);
  const std::vector<std::pair<ProblemData, double>> known = {
      {no_rows, 3}, {no_variables, 3}, {nothing, 2}};
  for (const auto& [data, optimum] : known) {
    const Problem problem(data);
    BareSolver solver(GetParam());
    solver.Load(problem.view());
    const Answer a = solver.Solve();
    EXPECT_EQ(a.result.termination, SY_OPTIMAL) << a.text;
    EXPECT_NEAR(a.result.objective, optimum, kTolerance);
  }
  const Problem contradiction(Linear({}, {}, {}, {{}}, {1}, {2}));
  BareSolver solver(GetParam());
  solver.Load(contradiction.view());
  EXPECT_EQ(solver.Solve().result.termination, SY_INFEASIBLE);
}

TEST_P(LinearSolver, TakesNullForWhatIsAbsent) {
  sy_problem p = {};  // min x0, x0 and x1 free, 1 <= x0 + x1 <= 1, x1 <= 2 by a row
  const Csc a = Dense({{1, 1}, {0, 1}}, 2);
  const sy_csc view = a.View();
  const double q[] = {1, 0};
  const double lower[] = {1, -kInfinity};
  const double upper[] = {1, 2};
  p.size = sizeof p;
  p.num_vars = p.num_rows = 2;
  p.q = q;
  p.A = &view;
  p.row_lower = lower;
  p.row_upper = upper;
  BareSolver solver(GetParam());
  solver.Load(p);
  EXPECT_NEAR(solver.Solve().result.objective, -1, kTolerance);
  sy_result unwanted = {};
  unwanted.size = sizeof unwanted;
  const sy_control control = Freely();
  EXPECT_EQ(solver.table().solve(solver.instance(), &control, &unwanted, &solver.error()), SY_OK);
  EXPECT_NEAR(unwanted.objective, -1, kTolerance);
}

TEST_P(QuadraticSolver, CertifiesTheOptimumItReports) {
  // min 1/2 |x|^2 + x0 x1 / 2 - x0 over x0 + x1 >= 2, x1 <= 0.5
  ProblemData data =
      Linear({-1, 0}, {-kInfinity, -kInfinity}, {kInfinity, 0.5}, {{1, 1}}, {2}, {kInfinity}, 1);
  data.P = Dense({{1, 0.5}, {0, 1}}, 2);
  data.flags = SY_PROBLEM_CONVEX;
  const Problem problem(data);
  BareSolver solver(GetParam());
  solver.Load(problem.view());
  ExpectOptimal(data, solver, solver.Solve(), kTolerance);
}

TEST_P(QuadraticSolver, ProvesInfeasibleAndUnbounded) {
  ProblemData infeasible =
      Linear({1, 1}, {0, 0}, {10, 10}, {{1, 1}, {1, 1}}, {5, -kInfinity}, {kInfinity, 3});
  infeasible.P = Dense({{2, 1}, {0, 2}}, 2);
  infeasible.flags = SY_PROBLEM_CONVEX;
  ProblemData unbounded =
      Linear({0, -1}, {-kInfinity, 0}, {kInfinity, kInfinity}, {{1, 0}}, {-kInfinity}, {5});
  unbounded.P = Dense({{2, 0}, {0, 0}}, 2);
  unbounded.flags = SY_PROBLEM_CONVEX;
  const Problem first(infeasible);
  const Problem second(unbounded);
  BareSolver solver(GetParam());
  if (!solver.Has(SY_GIVES_CERTIFICATES)) GTEST_SKIP() << "declares no certificates";
  solver.Load(first.view());
  ExpectFarkas(infeasible, solver.Solve());
  solver.Load(second.view());
  ExpectRay(unbounded, solver.Solve());
}

}  // namespace
}  // namespace switchyard::test
