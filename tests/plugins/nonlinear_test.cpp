// Solvers of nonlinear programs: what they answer, checked by the optimality conditions.
#include <string>

#include "nonlinear_known.hpp"

namespace switchyard::test {
namespace {

class NonlinearSolver : public testing::TestWithParam<Named> {};
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(NonlinearSolver);
INSTANTIATE_TEST_SUITE_P(Plugins, NonlinearSolver,
                         testing::ValuesIn(SolversOf(kLinear | SY_ACCEPTS_NLP)), NameOf);

/// The same without second derivatives.
Nonlinear WithoutHessian(Nonlinear program) {
  program.functions.hessian = nullptr;
  program.functions.hessian_pattern.clear();
  return program;
}

TEST_P(NonlinearSolver, SolvesProgramsWithKnownOptima) {
  const Vector far = {-1.2, 1};
  for (const bool hessian : {true, false}) {
    const auto check = [&](Nonlinear made, const Vector& start, double optimum) {
      if (!hessian) made = WithoutHessian(std::move(made));
      const HandWritten program(std::move(made.data), std::move(made.functions));
      const BareSolver solver(GetParam());
      const NonlinearAnswer a = SolveFrom(GetParam(), program, start);
      ExpectLocalOptimum(program, solver, a);
      EXPECT_NEAR(a.result.objective, optimum, 10 * ToleranceOf(solver) * (1 + optimum));
      EXPECT_EQ(a.result.bound, -kInfinity) << "a local optimum bounds nothing";
    };
    check(Hs71(), {1, 5, 5, 1}, kHs71);
    check(Hs6(), far, 0);
    check(Rosenbrock(), far, 0);
  }
}

TEST_P(NonlinearSolver, CallsTheOptimumOfAConvexProgramOptimal) {
  Nonlinear made = Logarithm();
  HandWritten program(made.data, made.functions);
  for (const std::uint32_t flags : {std::uint32_t{SY_PROBLEM_CONVEX}, std::uint32_t{0}}) {
    program.Change([&](Functions&, ProblemData& d) { d.flags = flags; });
    BareSolver solver(GetParam());
    solver.Load(program.problem());
    const NonlinearAnswer a = Solve(solver, program);
    ExpectLocalOptimum(program, solver, a);
    const bool proven = flags != 0 || solver.Has(SY_PROVES_GLOBAL);
    EXPECT_EQ(a.result.termination, proven ? SY_OPTIMAL : SY_LOCALLY_OPTIMAL);
    EXPECT_NEAR(a.x[0], 1, 100 * ToleranceOf(solver));
  }
}

TEST_P(NonlinearSolver, FindsTheOptimaOfProgramsOfAllSections) {
  if (!BareSolver(GetParam()).Has(SY_GIVES_DUALS)) GTEST_SKIP() << "gives no duals";
  for (unsigned seed = 0; seed < 20; ++seed) {
    for (const bool hessian : {true, false}) {
      Certified made = RandomConvex(12, 4, 2, seed);
      if (!hessian) made.program = WithoutHessian(std::move(made.program));
      const HandWritten program(made.program.data, made.program.functions);
      BareSolver solver(GetParam());
      solver.Load(program.problem());
      const NonlinearAnswer a = Solve(solver, program);
      ExpectLocalOptimum(program, solver, a);
      const Vector& x = made.optimum;
      const double optimum = Objective(program.problem(), x.data()) + program.functions().f(x);
      EXPECT_NEAR(a.result.objective, optimum, 1e-5 * (1 + std::abs(optimum))) << seed;
    }
  }
}

/// sum f(x_j) + cost'x over x >= 0 where f'' ends at 0, and rows as they come.
Nonlinear OnTheEdge(ProblemData data, double (*f)(double), double (*slope)(double),
                    double (*curvature)(double)) {
  const std::size_t n = data.q.size();
  Functions s;
  s.f = [f](const Vector& x) {
    double sum = 0;
    for (const double v : x) sum += f(v);
    return sum;
  };
  s.gradient = [slope](Vector x) {
    for (double& v : x) v = slope(v);
    return x;
  };
  s.hessian = [curvature](const Vector& x, double w, const double*) {
    Matrix h(x.size(), Vector(x.size(), 0.0));
    for (std::size_t j = 0; j < x.size(); ++j) h[j][j] = w * curvature(x[j]);
    return h;
  };
  s.hessian_pattern = Matrix(n, Vector(n, 0.0));
  for (std::size_t j = 0; j < n; ++j) s.hessian_pattern[j][j] = 1;
  data.flags = SY_PROBLEM_CONVEX;
  return {std::move(data), s};
}

TEST_P(NonlinearSolver, StaysInsideBoundsWhereTheFunctionsEnd) {
  const BareSolver solver(GetParam());
  const auto check = [&](const Nonlinear& made, double optimum) {
    const HandWritten program(made.data, made.functions);
    const NonlinearAnswer a = SolveFrom(GetParam(), program, {0.3, 0.3, 0.4});
    ExpectLocalOptimum(program, solver, a);
    EXPECT_NEAR(a.result.objective, optimum, 10 * ToleranceOf(solver));
  };
  const Vector none = {0, 0, 0};
  const Vector open = {kInfinity, kInfinity, kInfinity};
  // x + x^(3/2) is least at 0, where there is no second derivative, and beside which it is nothing.
  check(OnTheEdge(
            Linear({1, 1, 1}, none, open, {}, {}, {}), [](double v) { return v * std::sqrt(v); },
            [](double v) { return 1.5 * std::sqrt(v); },
            [](double v) { return 0.75 / std::sqrt(v); }),
        0);
  // Entropy over the simplex is least at x ~ exp(-cost), where its worth is -log sum exp(-cost):
  // the last entry is 1e-13.
  const Vector cost = {0, 1, 30};
  double sum = 0;
  for (const double v : cost) sum += std::exp(-v);
  check(
      OnTheEdge(
          Linear(cost, none, open, {{1, 1, 1}}, {1}, {1}), [](double v) { return v * std::log(v); },
          [](double v) { return 1 + std::log(v); }, [](double v) { return 1 / v; }),
      -std::log(sum));
}

TEST_P(NonlinearSolver, AsksOnlyForWhatThereIs) {
  // Linear rows and the quadratic objective are data: functions are asked for f alone, or c alone.
  ProblemData rows = Linear({-1, -2}, {0, 0}, {3, 3}, {{1, 1}}, {-kInfinity}, {1});
  rows.P = Dense({{2, 0}, {0, 2}}, 2);
  const HandWritten objective(rows, Rosenbrock().functions);
  BareSolver solver(GetParam());
  solver.Load(objective.problem());
  ExpectLocalOptimum(objective, solver, Solve(solver, objective));
  EXPECT_EQ(objective.wanted & ~std::uint32_t{SY_OBJECTIVE | SY_GRADIENT | SY_HESSIAN}, 0u);

  Nonlinear made = Square(1, 4);
  const HandWritten constraints(made.data, made.functions);
  ExpectLocalOptimum(constraints, solver, SolveFrom(GetParam(), constraints, {-1.5}));
  EXPECT_EQ(constraints.wanted & (SY_OBJECTIVE | SY_GRADIENT), 0u);
}

TEST_P(NonlinearSolver, CallsNothingFeasibleThatIsNot) {
  Nonlinear made = Square(-kInfinity, -1);
  const HandWritten program(made.data, made.functions);
  const NonlinearAnswer a = SolveFrom(GetParam(), program, {0.5});
  EXPECT_FALSE(IsSolved(a));
  EXPECT_NE(a.result.primal, SY_FEASIBLE);
  if (BareSolver(GetParam()).Has(SY_GIVES_CERTIFICATES)) {
    EXPECT_EQ(a.result.termination, SY_LOCALLY_INFEASIBLE) << a.text;
  }
}

TEST_P(NonlinearSolver, ProvesThatLinearRowsContradictWhateverTheFunctionsAre) {
  if (!BareSolver(GetParam()).Has(SY_GIVES_CERTIFICATES)) GTEST_SKIP() << "gives no certificates";
  ProblemData data = Linear({0, 0}, {0, 0}, {kInfinity, kInfinity}, {{1, 1}, {1, 1}},
                            {2, -kInfinity}, {kInfinity, 1});
  Functions functions = Hs6().functions;
  for (const bool constrained : {true, false}) {
    if (!constrained) functions = Rosenbrock().functions;
    const HandWritten program(data, functions);
    BareSolver solver(GetParam());
    solver.Load(program.problem());
    const NonlinearAnswer a = Solve(solver, program);
    ExpectFarkas(data, a);
    for (const double y : a.nlp_dual) EXPECT_EQ(y, 0);
  }
}

TEST_P(NonlinearSolver, CallsNothingOptimalThatIsUnbounded) {
  Functions cubic;
  cubic.f = [](const Vector& x) { return x[0] * x[0] * x[0]; };
  cubic.gradient = [](const Vector& x) -> Vector { return {3 * x[0] * x[0]}; };
  cubic.hessian = [](const Vector& x, double w, const double*) -> Matrix {
    return {{6 * w * x[0]}};
  };
  cubic.hessian_pattern = {{1}};
  const HandWritten program(Free(1), cubic);
  const NonlinearAnswer a = SolveFrom(GetParam(), program, {-1});
  EXPECT_FALSE(IsSolved(a)) << a.text;
  EXPECT_NE(a.result.primal, SY_CERTIFICATE);
}

TEST_P(NonlinearSolver, TakesFixedVariablesFreeConstraintsAndTooManyEquations) {
  // x fixed at 2, y^2 = 4 twice over, 2 y^2 = 8, y x = 4, a constraint that is free, one of x
  // alone.
  Functions s;
  s.lower = {4, 8, 4, -kInfinity, 4};
  s.upper = {4, 8, 4, kInfinity, 4};
  s.f = [](const Vector& x) { return x[1]; };
  s.gradient = [](const Vector&) -> Vector { return {0, 1}; };
  s.c = [](const Vector& x) -> Vector {
    return {x[1] * x[1], 2 * x[1] * x[1], x[0] * x[1], x[0] + x[1], x[0] * x[0]};
  };
  s.jacobian = [](const Vector& x) -> Matrix {
    return {{0, 2 * x[1]}, {0, 4 * x[1]}, {x[1], x[0]}, {1, 1}, {2 * x[0], 0}};
  };
  s.hessian = [](const Vector&, double, const double* y) -> Matrix {
    return {{2 * y[4], y[2]}, {0, 2 * y[0] + 4 * y[1]}};
  };
  s.jacobian_pattern = {{0, 1}, {0, 1}, {1, 1}, {1, 1}, {1, 0}};
  s.hessian_pattern = {{1, 1}, {0, 1}};
  const HandWritten program(Box({2, 0}, {2, kInfinity}), s);
  BareSolver solver(GetParam());
  const NonlinearAnswer a = SolveFrom(GetParam(), program, {2, 1});
  ExpectLocalOptimum(program, solver, a);
  EXPECT_NEAR(a.x[1], 2, 10 * ToleranceOf(solver));
}

TEST_P(NonlinearSolver, AnswersWhereAllVariablesAreFixed) {
  for (const double x : {2.0, 3.0}) {
    Nonlinear made = Square(4, 4);
    made.data.x_lower = made.data.x_upper = {x};
    const HandWritten program(made.data, made.functions);
    BareSolver solver(GetParam());
    solver.Load(program.problem());
    const NonlinearAnswer a = Solve(solver, program);
    if (x == 2) {
      ExpectLocalOptimum(program, solver, a);
    } else {
      EXPECT_FALSE(IsSolved(a));
      EXPECT_NE(a.result.primal, SY_FEASIBLE);
    }
  }
}

TEST_P(NonlinearSolver, SolvesAsManyEquationsAsVariables) {
  // x^2 = y, x + y = 2
  Functions s;
  s.lower = s.upper = {0, 2};
  s.f = [](const Vector& x) { return x[0]; };
  s.gradient = [](const Vector&) -> Vector { return {1, 0}; };
  s.c = [](const Vector& x) -> Vector { return {x[0] * x[0] - x[1], x[0] + x[1]}; };
  s.jacobian = [](const Vector& x) -> Matrix { return {{2 * x[0], -1}, {1, 1}}; };
  s.hessian = [](const Vector&, double, const double* y) -> Matrix {
    return {{2 * y[0], 0}, {0, 0}};
  };
  s.jacobian_pattern = {{1, 1}, {1, 1}};
  s.hessian_pattern = {{1, 0}, {0, 0}};
  const HandWritten program(Free(2), s);
  BareSolver solver(GetParam());
  const NonlinearAnswer a = SolveFrom(GetParam(), program, {3, 1});
  ExpectLocalOptimum(program, solver, a);
  EXPECT_NEAR(a.x[0], 1, 10 * ToleranceOf(solver));
}

TEST_P(NonlinearSolver, RefusesFunctionsWithoutTheDerivativesItNeeds) {
  BareSolver solver(GetParam());
  if (!solver.Has(SY_NEEDS_GRADIENT)) GTEST_SKIP() << "needs none";
  ASSERT_NE(solver.table().supports, nullptr);
  for (const bool objective : {true, false}) {
    Nonlinear made = Hs71();
    if (objective) {
      made.functions.gradient = nullptr;
    } else {
      made.functions.jacobian = nullptr;
    }
    const HandWritten program(made.data, made.functions);
    EXPECT_EQ(solver.table().supports(&solver.table(), &solver.host(), &program.problem(),
                                      &solver.error()),
              SY_E_UNSUPPORTED);
    EXPECT_NE(std::string(solver.error().text).find(objective ? "gradient" : "Jacobian"),
              std::string::npos)
        << solver.error().text;
  }
}

TEST_P(NonlinearSolver, TellsItsResiduals) {
  const Nonlinear made = Hs71();
  const HandWritten program(made.data, made.functions);
  BareSolver solver(GetParam());
  if (GetParam().name != "ipopt") GTEST_SKIP() << "tells none";
  solver.Load(program.problem());
  std::vector<sy_progress> told;
  sy_control control = Freely();
  control.context = &told;
  control.progress = [](void* context, const sy_progress* progress) noexcept -> std::int32_t {
    static_cast<std::vector<sy_progress>*>(context)->push_back(*progress);
    return 0;
  };
  ExpectLocalOptimum(program, solver, Solve(solver, program, control));
  ASSERT_FALSE(told.empty());
  EXPECT_GE(told.front().primal_residual, 0);
  EXPECT_GE(told.front().dual_residual, 0);
}

TEST_P(NonlinearSolver, TakesTheHessianOrApproximatesItAsTheUserWishes) {
  if (GetParam().name != "ipopt") GTEST_SKIP() << "an option of Ipopt";
  const auto solve = [&](bool hessian, const char* word) {
    Nonlinear made = Hs71();
    if (!hessian) made = WithoutHessian(std::move(made));
    const HandWritten program(made.data, made.functions);
    BareSolver solver(GetParam());
    sy_value value = {SY_TEXT, 0, {}};
    value.as.text = word;
    EXPECT_EQ(solver.SetOption("hessian_approximation", value), SY_OK) << solver.error().text;
    solver.Load(program.problem());
    sy_result result = {};
    result.size = sizeof result;
    const sy_control control = Freely();
    const sy_status status =
        solver.table().solve(solver.instance(), &control, &result, &solver.error());
    const std::string text = solver.error().text;
    return std::tuple(status, result.termination, program.wanted & SY_HESSIAN, text);
  };
  EXPECT_EQ(solve(true, "limited-memory"), std::tuple(SY_OK, SY_LOCALLY_OPTIMAL, 0u, ""));
  EXPECT_EQ(solve(true, "exact"),
            std::tuple(SY_OK, SY_LOCALLY_OPTIMAL, std::uint32_t{SY_HESSIAN}, ""));
  const auto [status, termination, wanted, text] = solve(false, "exact");
  EXPECT_EQ(status, SY_E_ARGUMENT);
  EXPECT_NE(text.find("hessian_approximation"), std::string::npos) << text;
}

}  // namespace
}  // namespace switchyard::test
