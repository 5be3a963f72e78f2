// NLopt beyond its algorithms: options, proofs, and what it refuses or gives up.
#include <string>

#include "nlopt_solver.hpp"
#include "nonlinear_known.hpp"

namespace switchyard::test {
namespace {

class NloptSolver : public testing::Test {
 protected:
  void SetUp() override {
    if (Nlopt() == nullptr) GTEST_SKIP() << "NLopt is not built";
  }
};

/// The text of the refusal of an algorithm.
std::string Refusal(const char* option, const char* algorithm) {
  BareSolver solver(*Nlopt());
  sy_value value = {SY_TEXT, 0, {}};
  value.as.text = algorithm;
  EXPECT_EQ(solver.SetOption(option, value), SY_E_ARGUMENT) << algorithm;
  return solver.error().text;
}

TEST_F(NloptSolver, KnowsItsAlgorithmsLetterForLetter) {
  EXPECT_EQ(Refusal("algorithm", "LD_SLQSP"),
            "option algorithm: NLopt has no algorithm 'LD_SLQSP'; the nearest is LD_SLSQP");
  EXPECT_EQ(Refusal("algorithm", "ln_cobyla"),
            "option algorithm: NLopt has no algorithm 'ln_cobyla'");
  EXPECT_EQ(Refusal("algorithm", "LD_LBFGS_NOCEDAL"),
            "option algorithm: the NLopt that is here was built without LD_LBFGS_NOCEDAL");
  EXPECT_EQ(Refusal("local_algorithm", "G_MLSL"),
            "option local_algorithm: G_MLSL works through a local algorithm itself");
}

TEST_F(NloptSolver, RunsEveryOtherAlgorithmByItsName) {
  for (const char* algorithm : {"GN_DIRECT",
                                "GN_DIRECT_L_RAND",
                                "GN_DIRECT_NOSCAL",
                                "GN_ORIG_DIRECT",
                                "GN_ORIG_DIRECT_L",
                                "LD_LBFGS",
                                "LN_PRAXIS",
                                "LD_VAR1",
                                "LD_VAR2",
                                "LD_TNEWTON",
                                "LD_TNEWTON_PRECOND_RESTART",
                                "GN_CRS2_LM",
                                "GN_MLSL",
                                "GD_MLSL",
                                "GN_MLSL_LDS",
                                "GD_MLSL_LDS",
                                "LN_NEWUOA",
                                "LN_NEWUOA_BOUND",
                                "LN_NELDERMEAD",
                                "LN_SBPLX",
                                "LN_AUGLAG",
                                "LD_AUGLAG",
                                "LN_AUGLAG_EQ",
                                "LD_AUGLAG_EQ",
                                "AUGLAG",
                                "AUGLAG_EQ",
                                "G_MLSL",
                                "G_MLSL_LDS",
                                "LD_CCSAQ",
                                "GN_ESCH"}) {
    SCOPED_TRACE(algorithm);
    for (const bool constrained : {true, false}) {
      Nonlinear made = constrained ? Hs6() : Rosenbrock();
      made.data.x_lower = {-3, -3};
      made.data.x_upper = {3, 3};
      const HandWritten program(made.data, made.functions);
      Configured solver(algorithm);
      const NonlinearAnswer a = solver.From(program, {-1.2, 1});
      ExpectLocalOptimum(program, solver, a);
      EXPECT_NEAR(a.result.objective, 0, 1e-6);
      EXPECT_NE(a.text.find(algorithm), std::string::npos) << a.text;
    }
  }
}

TEST_F(NloptSolver, WorksThroughTheLocalAlgorithmThatIsAskedFor) {
  const Nonlinear made = Hs71();
  const HandWritten program(made.data, made.functions);
  Configured solver("AUGLAG");
  solver.Text("local_algorithm", "LD_VAR2");
  const NonlinearAnswer a = solver.From(program, {1, 5, 5, 1});
  ExpectLocalOptimum(program, solver, a);
  EXPECT_NE(a.text.find("AUGLAG of LD_VAR2"), std::string::npos) << a.text;
}

TEST_F(NloptSolver, WantsAFiniteBoxForAGlobalSearch) {
  ProblemData data = Box({-3, -3}, {3, 3});
  data.x_lower[1] = -kInfinity;
  const HandWritten program(data, Rosenbrock().functions);
  Configured solver("GN_DIRECT_L");
  solver.Load(program.problem());
  sy_result result = {};
  result.size = sizeof result;
  const sy_control control = Freely();
  EXPECT_EQ(solver.table().solve(solver.instance(), &control, &result, &solver.error()),
            SY_E_UNSUPPORTED);
  EXPECT_EQ(std::string(solver.error().text),
            "GN_DIRECT_L searches a finite box: x[1] has no lower bound");
}

TEST_F(NloptSolver, RefusesWhatIsTooLargeForDenseMatrices) {
  sy_problem large = {};
  large.size = sizeof large;
  large.num_vars = 9000;
  large.num_rows = 8000;
  BareSolver solver(*Nlopt());
  EXPECT_EQ(solver.table().supports(&solver.table(), &solver.host(), &large, &solver.error()),
            SY_E_UNSUPPORTED);
  EXPECT_EQ(std::string(solver.error().text),
            "NLopt's matrices are dense: 9000 variables by 8000 rows and 0 nonlinear constraints "
            "is more than 5e+07 numbers");
}

TEST_F(NloptSolver, ProvesWhatItsLinearPartProves) {
  ProblemData contradiction = Linear({0, 0}, {0, 0}, {kInfinity, kInfinity}, {{1, 1}, {1, 1}},
                                     {2, -kInfinity}, {kInfinity, 1});
  contradiction.P = Dense({{2, 1}, {0, 2}}, 2);
  contradiction.flags = SY_PROBLEM_CONVEX;
  for (const Functions& functions : {Functions(), Rosenbrock().functions, Hs6().functions}) {
    for (const bool derivatives : {true, false}) {
      Functions mine = functions;
      if (!derivatives) mine.gradient = nullptr, mine.jacobian = nullptr;
      const HandWritten program(contradiction, mine);
      const NonlinearAnswer a = Configured("auto").From(program, {});
      ExpectFarkas(contradiction, a);
      for (const double y : a.nlp_dual) EXPECT_EQ(y, 0);
    }
  }
  ProblemData falling =
      Linear({0, -1}, {-kInfinity, 0}, {kInfinity, kInfinity}, {{1, 0}}, {-kInfinity}, {5});
  falling.P = Dense({{2, 0}, {0, 0}}, 2);
  falling.flags = SY_PROBLEM_CONVEX;
  const HandWritten program(falling, {});
  ExpectRay(falling, Configured("auto").From(program, {}));
}

TEST_F(NloptSolver, SaysWhichConstantConstraintIsOutside) {
  Functions s = Square(4, 4).functions;
  ProblemData data = Box({3, 0}, {3, 1});
  s.jacobian_pattern = {{1, 0}};
  s.hessian_pattern = {};
  s.hessian = nullptr;
  s.jacobian = [](const Vector& x) -> Matrix { return {{2 * x[0], 0}}; };
  const HandWritten program(data, s);
  const NonlinearAnswer a = Configured("auto").From(program, {});
  EXPECT_EQ(a.result.termination, SY_INFEASIBLE);
  EXPECT_NE(a.text.find("c[0] is constant"), std::string::npos) << a.text;
}

TEST_F(NloptSolver, ClaimsNothingOfAnObjectiveThatFallsWithoutEnd) {
  Functions cubic;
  cubic.f = [](const Vector& x) { return x[0] * x[0] * x[0]; };
  cubic.gradient = [](const Vector& x) -> Vector { return {3 * x[0] * x[0]}; };
  const HandWritten program(Free(1), cubic);
  const NonlinearAnswer a = Configured("auto").From(program, {-1});
  EXPECT_EQ(a.result.termination, SY_NUMERICAL_TROUBLE);
  EXPECT_NE(a.text.find("the objective falls without end"), std::string::npos) << a.text;
}

TEST_F(NloptSolver, LeavesSaddlePointsWhereTheStartIsNotGiven) {
  // x y over a box: 0 is a saddle point, where the gradient is 0.
  Functions s;
  s.f = [](const Vector& x) { return x[0] * x[1]; };
  s.gradient = [](const Vector& x) -> Vector { return {x[1], x[0]}; };
  const HandWritten saddle(Box({-1, -1}, {1, 1}), s);
  EXPECT_NEAR(Configured("auto").From(saddle, {}).result.objective, -1, 1e-6);
  // x^2 = 1 has the gradient 0 there.
  const Nonlinear made = Square(1, 1);
  const HandWritten equation(made.data, made.functions);
  const NonlinearAnswer a = Configured("auto").From(equation, {});
  ASSERT_TRUE(IsSolved(a)) << a.text;
  EXPECT_NEAR(std::abs(a.x[0]), 1, 1e-6);
}

TEST_F(NloptSolver, PolishesUnlessItIsToldNotTo) {
  const Nonlinear made = Hs71();
  const HandWritten program(made.data, made.functions);
  const NonlinearAnswer polished = Configured("GN_ISRES").From(program, {});
  EXPECT_EQ(polished.result.termination, SY_LOCALLY_OPTIMAL) << polished.text;
  EXPECT_NE(polished.text.find("LD_SLSQP"), std::string::npos) << polished.text;
  Configured rough("GN_ISRES");
  rough.Integer("polish", 0);
  const NonlinearAnswer a = rough.From(program, {});
  EXPECT_EQ(a.result.termination, SY_ITERATION_LIMIT) << a.text;
  EXPECT_EQ(a.result.iterations, 10000);
  EXPECT_EQ(a.text.find("LD_SLSQP"), std::string::npos) << a.text;
}

TEST_F(NloptSolver, SaysHowFarAPointIsFromStationary) {
  const Nonlinear made = Rosenbrock();
  const HandWritten program(made.data, made.functions);
  Configured solver("LN_NELDERMEAD");
  sy_value loose = {SY_REAL, 0, {}};
  loose.as.real = 1e-2;
  solver.Integer("polish", 0);
  EXPECT_EQ(solver.SetOption("ftol_rel", loose), SY_OK);
  EXPECT_EQ(solver.SetOption("xtol_rel", loose), SY_OK);
  const NonlinearAnswer a = solver.From(program, {-1.2, 1});
  EXPECT_EQ(a.result.termination, SY_NUMERICAL_TROUBLE) << a.text;
  EXPECT_EQ(a.result.primal, SY_FEASIBLE);
  EXPECT_NE(a.text.find("not stationary: the residual is"), std::string::npos) << a.text;
}

TEST_F(NloptSolver, SearchesABoxWhoseMiddleIsOutsideOfTheDomain) {
  Functions s;  // log |x| is not defined on [-1, 1]
  s.f = [](const Vector& x) { return -x[0] * std::log(x[0] * x[0] - 1); };
  s.judge = [](const Vector& x) { return x[0] * x[0] > 1 ? SY_EVALUATED : SY_UNDEFINED; };
  const HandWritten program(Box({-0.99}, {1.5}), s);
  const NonlinearAnswer global = Configured("GN_DIRECT_L").From(program, {});
  ASSERT_TRUE(IsSolved(global)) << global.text;
  EXPECT_GT(global.x[0], 1);
  const HandWritten nowhere(Box({-0.9}, {0.9}), s);
  const NonlinearAnswer none = Configured("GN_DIRECT_L").From(nowhere, {});
  EXPECT_EQ(none.result.termination, SY_EVALUATION_FAILED);
  EXPECT_EQ(none.result.primal, SY_NO_POINT);
}

TEST_F(NloptSolver, ReachesTheLastDigitsWithAndWithoutSecondDerivatives) {
  // A chain of Rosenbrock's functions: its curvatures are 1 to 1000.
  const std::size_t n = 60;
  Functions s;
  s.f = [](const Vector& x) {
    double sum = 0;
    for (std::size_t j = 1; j < x.size(); ++j) {
      sum += 100 * std::pow(x[j] - x[j - 1] * x[j - 1], 2) + std::pow(1 - x[j - 1], 2);
    }
    return sum;
  };
  s.gradient = [](const Vector& x) {
    Vector g(x.size(), 0.0);
    for (std::size_t j = 1; j < x.size(); ++j) {
      const double t = x[j] - x[j - 1] * x[j - 1];
      g[j - 1] += -400 * x[j - 1] * t - 2 * (1 - x[j - 1]);
      g[j] += 200 * t;
    }
    return g;
  };
  Matrix rows(n / 2, Vector(n, 0.0));
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i][2 * i] = rows[i][2 * i + 1] = 1;
  const ProblemData data = Linear(Vector(n, 0.0), Vector(n, -2), Vector(n, 2), rows,
                                  Vector(n / 2, -kInfinity), Vector(n / 2, 1.5));
  const HandWritten program(data, s);
  Configured solver("auto");
  const NonlinearAnswer a = solver.From(program, {});
  ExpectLocalOptimum(program, solver, a);
  EXPECT_LE(program.farthest_outside, 0);
}

TEST_F(NloptSolver, TellsTheHostOfEachRun) {
  const Nonlinear made = Hs71();
  const HandWritten program(made.data, made.functions);
  Configured solver("GN_ISRES");
  std::string heard;
  solver.host().context = &heard;
  solver.host().log = [](void* context, sy_level, const char* text) noexcept {
    static_cast<std::string*>(context)->append(text).append("\n");
  };
  sy_control control = Freely();
  control.verbosity = 1;
  solver.From(program, {}, control);
  EXPECT_NE(heard.find("NLopt GN_ISRES: MAXEVAL_REACHED after 10000 evaluations"),
            std::string::npos)
      << heard;
}

}  // namespace
}  // namespace switchyard::test
