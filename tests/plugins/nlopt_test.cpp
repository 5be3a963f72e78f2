// NLopt: each of its algorithms on what it claims, and verdicts that are the plugin's own.
#include <chrono>
#include <string>
#include <thread>

#include "nlopt_solver.hpp"
#include "nonlinear_known.hpp"

namespace switchyard::test {
namespace {

/// Hock and Schittkowski 21: linear rows, and P beside them: -99.96 at (2, 0).
Nonlinear Hs21() {
  Nonlinear made{Linear({0, 0}, {2, -50}, {50, 50}, {{10, -1}}, {10}, {kInfinity}, -100), {}};
  made.data.P = Dense({{0.02, 0}, {0, 2}}, 2);
  return made;
}

/// The smallest disc around (1, 0), (-1, 0) and (0, 1.5): min t, |x - a_i|^2 <= t.
Nonlinear SmallestDisc() {
  static const Matrix kPoints = {{1, 0}, {-1, 0}, {0, 1.5}};
  Functions s;
  s.lower = Vector(3, -kInfinity);
  s.upper = Vector(3, 0);
  s.c = [](const Vector& x) {
    Vector c;
    for (const Vector& a : kPoints) {
      c.push_back(std::pow(x[0] - a[0], 2) + std::pow(x[1] - a[1], 2) - x[2]);
    }
    return c;
  };
  s.jacobian = [](const Vector& x) {
    Matrix rows;
    for (const Vector& a : kPoints) rows.push_back({2 * (x[0] - a[0]), 2 * (x[1] - a[1]), -1});
    return rows;
  };
  s.jacobian_pattern = Matrix(3, Vector(3, 1));
  return {Linear({0, 0, 1}, {-5, -5, 0}, {5, 5, 40}, {}, {}, {}), s};
}
constexpr double kSmallestDisc = 169.0 / 144;  // the circumscribed circle, radius 13/12

/// Six humps, and six local minima; -1.0316285 is the least.
Nonlinear Camel() {
  Functions s;
  s.f = [](const Vector& v) {
    const double x = v[0] * v[0];
    const double y = v[1] * v[1];
    return (4 - 2.1 * x + x * x / 3) * x + v[0] * v[1] + (4 * y - 4) * y;
  };
  s.gradient = [](const Vector& v) -> Vector {
    const double x = v[0];
    const double y = v[1];
    return {8 * x - 8.4 * x * x * x + 2 * std::pow(x, 5) + y, x - 8 * y + 16 * y * y * y};
  };
  return {Box({-3, -2}, {3, 2}), s};
}
constexpr double kCamel = -1.0316284535;

Nonlinear InBox(Nonlinear made, double size) {
  for (double& l : made.data.x_lower) l = std::max(l, -size);
  for (double& u : made.data.x_upper) u = std::min(u, size);
  return made;
}

Nonlinear WithoutDerivatives(Nonlinear made) {
  made.functions.gradient = nullptr;
  made.functions.jacobian = nullptr;
  made.functions.jacobian_pattern.clear();
  made.functions.hessian = nullptr;
  return made;
}

struct KnownProgram {
  const char* name;
  Nonlinear program;
  Vector start;
  double optimum;
  bool equations, inequalities;
};

std::vector<KnownProgram> KnownPrograms() {
  return {{"hs71", Hs71(), {1, 5, 5, 1}, kHs71, true, true},
          {"hs6", InBox(Hs6(), 5), {-1.2, 1}, 0, true, false},
          {"hs21", Hs21(), {-1, -1}, -99.96, false, true},
          {"rosenbrock", InBox(Rosenbrock(), 5), {-1.2, 1}, 0, false, false},
          {"disc", SmallestDisc(), {3, 3, 30}, kSmallestDisc, false, true},
          {"camel", Camel(), {0.3, -0.9}, kCamel, false, false},
          {"logarithm", InBox(Logarithm(), 50), {}, 1, false, false}};
}

/// An algorithm, and what it takes by itself.
struct Claims {
  const char* algorithm;
  bool equations, inequalities, derivatives;
};
void PrintTo(const Claims& c, std::ostream* out) { *out << c.algorithm; }

constexpr Claims kClaims[] = {
    {"LD_SLSQP", true, true, true},   {"LD_MMA", false, true, true},
    {"LN_COBYLA", true, true, false}, {"LN_BOBYQA", false, false, false},
    {"GN_ISRES", true, true, false},  {"GN_DIRECT_L", false, false, false}};

std::string NameOfAlgorithm(const testing::TestParamInfo<Claims>& info) {
  return info.param.algorithm;
}

class NloptAlgorithm : public testing::TestWithParam<Claims> {
 protected:
  void SetUp() override {
    if (Nlopt() == nullptr) GTEST_SKIP() << "NLopt is not built";
  }
};
INSTANTIATE_TEST_SUITE_P(Nlopt, NloptAlgorithm, testing::ValuesIn(kClaims), NameOfAlgorithm);

TEST_P(NloptAlgorithm, SolvesWhatItClaimsAndTheRestBehindAnAugmentedLagrangian) {
  const Claims& claims = GetParam();
  for (const KnownProgram& known : KnownPrograms()) {
    SCOPED_TRACE(known.name);
    const HandWritten program(known.program.data, known.program.functions);
    Configured solver(claims.algorithm);
    const NonlinearAnswer a = solver.From(program, known.start);
    ExpectLocalOptimum(program, solver, a);
    EXPECT_NEAR(a.result.objective, known.optimum, 1e-5 * (1 + std::abs(known.optimum)));
    const bool takes =
        (claims.equations || !known.equations) && (claims.inequalities || !known.inequalities);
    EXPECT_EQ(a.text.find("AUGLAG") != std::string::npos, !takes) << a.text;
    const bool one = program.data().num_vars == 1 && claims.algorithm == std::string("LN_BOBYQA");
    EXPECT_NE(a.text.find(one ? "LN_COBYLA" : claims.algorithm), std::string::npos) << a.text;
  }
}

TEST_P(NloptAlgorithm, NeedsNoDerivativesUnlessItSaysSo) {
  for (const KnownProgram& known : KnownPrograms()) {
    SCOPED_TRACE(known.name);
    const Nonlinear made = WithoutDerivatives(known.program);
    const HandWritten program(made.data, made.functions);
    Configured solver(GetParam().algorithm);
    solver.Load(program.problem());
    sy_result unwanted = {};
    unwanted.size = sizeof unwanted;
    const sy_control control = Freely();
    const sy_status status =
        solver.table().solve(solver.instance(), &control, &unwanted, &solver.error());
    const bool has_functions = program.functions().f || program.functions().c;
    if (GetParam().derivatives && has_functions) {
      EXPECT_EQ(status, SY_E_UNSUPPORTED);
      EXPECT_NE(std::string(solver.error().text).find("asks for derivatives"), std::string::npos);
      continue;
    }
    const NonlinearAnswer a = solver.From(program, known.start);
    ASSERT_TRUE(IsSolved(a)) << a.text;
    EXPECT_EQ(a.result.primal, SY_FEASIBLE);
    EXPECT_NEAR(a.result.objective, known.optimum, 1e-4 * (1 + std::abs(known.optimum)));
    EXPECT_EQ(a.result.dual, has_functions ? SY_NO_POINT : SY_FEASIBLE);
    EXPECT_EQ(program.wanted & (SY_GRADIENT | SY_JACOBIAN), 0u);
  }
}

TEST_P(NloptAlgorithm, TakesFixedVariablesAndRowsThatSayNothing) {
  const Nonlinear known = SmallestDisc();
  ProblemData data = Linear({0, 0, 1}, {0, -5, 0}, {0, 5, 40}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 0}},
                            {-1, -kInfinity, -1}, {kInfinity, kInfinity, 1});
  const HandWritten program(data, known.functions);
  Configured solver(GetParam().algorithm);
  const NonlinearAnswer a = solver.From(program, {3, 3, 30});
  ExpectLocalOptimum(program, solver, a);
  EXPECT_EQ(a.x[0], 0);
  EXPECT_NEAR(a.result.objective, kSmallestDisc, 1e-5);
}

TEST_P(NloptAlgorithm, GoesRoundWhereTheFunctionsEnd) {
  // min 3x - y - log(1 - x^2 - y^2) - log(x + 1/2): defined in a piece of the unit disc alone.
  Functions s;
  s.f = [](const Vector& x) {
    return 3 * x[0] - x[1] - std::log(1 - x[0] * x[0] - x[1] * x[1]) - std::log(x[0] + 0.5);
  };
  s.gradient = [](const Vector& x) -> Vector {
    const double d = 1 - x[0] * x[0] - x[1] * x[1];
    return {3 + 2 * x[0] / d - 1 / (x[0] + 0.5), -1 + 2 * x[1] / d};
  };
  s.judge = [](const Vector& x) {
    return x[0] * x[0] + x[1] * x[1] < 1 && x[0] > -0.5 ? SY_EVALUATED : SY_UNDEFINED;
  };
  for (const bool derivatives : {true, false}) {
    if (!derivatives && GetParam().derivatives) continue;
    Nonlinear made{Box({-5, -5}, {5, 5}), s};
    if (!derivatives) made = WithoutDerivatives(made);
    const HandWritten program(made.data, made.functions);
    Configured solver(GetParam().algorithm);
    const NonlinearAnswer a = solver.From(program, {0.9, -0.4});
    ASSERT_TRUE(IsSolved(a)) << a.text;
    const Vector gradient = s.gradient(a.x);
    EXPECT_NEAR(gradient[0], 0, derivatives ? 1e-5 : 1e-3);
    EXPECT_NEAR(gradient[1], 0, derivatives ? 1e-5 : 1e-3);
  }
}

TEST_P(NloptAlgorithm, CallsAProgramWithoutFeasiblePointsLocallyInfeasible) {
  const Nonlinear made = InBox(Square(-kInfinity, -1), 5);
  const HandWritten program(made.data, made.functions);
  Configured solver(GetParam().algorithm);
  const NonlinearAnswer a = solver.From(program, {0.5});
  EXPECT_EQ(a.result.termination, SY_LOCALLY_INFEASIBLE) << a.text;
  EXPECT_EQ(a.result.primal, SY_INFEASIBLE_POINT);
  EXPECT_NEAR(a.x[0], 0, 1e-4);
}

TEST_P(NloptAlgorithm, EndsAtOnceWhereAFunctionEndsTheSolve) {
  for (std::int64_t last = 1; last <= 40; ++last) {
    Nonlinear made = Hs71();
    std::int64_t left = last;
    made.functions.judge = [&](const Vector&) { return --left <= 0 ? SY_ABORT : SY_EVALUATED; };
    const HandWritten program(made.data, made.functions);
    Configured solver(GetParam().algorithm);
    const NonlinearAnswer a = solver.From(program, {1, 5, 5, 1});
    if (left > 0) break;
    EXPECT_EQ(a.result.termination, SY_EVALUATION_FAILED) << a.text;
    EXPECT_NE(a.text.find("a function ended the solve"), std::string::npos) << a.text;
    EXPECT_EQ(program.calls_after_abort, 0);
  }
}

TEST_P(NloptAlgorithm, KeepsItsLimits) {
  Nonlinear made = Hs71();
  std::int64_t calls = 0;
  bool sleeps = false;
  made.functions.judge = [&](const Vector&) {
    ++calls;
    if (sleeps) std::this_thread::sleep_for(std::chrono::milliseconds(2));
    return SY_EVALUATED;
  };
  const HandWritten program(made.data, made.functions);
  sy_control few = Freely();
  few.iterations = 4;
  const NonlinearAnswer counted = Configured(GetParam().algorithm).From(program, {}, few);
  EXPECT_EQ(counted.result.termination, SY_ITERATION_LIMIT) << counted.text;
  EXPECT_LE(counted.result.iterations, 5);
  EXPECT_NE(counted.result.primal, SY_NO_POINT);

  sy_control cancelled = Freely();
  calls = 0;
  cancelled.context = &calls;
  cancelled.cancelled = [](void* context) noexcept -> std::int32_t {
    return *static_cast<std::int64_t*>(context) >= 12 ? 1 : 0;
  };
  const NonlinearAnswer stopped = Configured(GetParam().algorithm).From(program, {}, cancelled);
  EXPECT_EQ(stopped.result.termination, SY_CANCELLED) << stopped.text;
  EXPECT_LE(calls, 12 + 8);

  sleeps = true;
  sy_control brief = Freely();
  brief.seconds = 0.03;
  const NonlinearAnswer late = Configured(GetParam().algorithm).From(program, {}, brief);
  EXPECT_EQ(late.result.termination, SY_TIME_LIMIT) << late.text;
  EXPECT_LE(late.result.seconds, 0.03 + 0.75);
}

TEST_P(NloptAlgorithm, StopsAtItsTarget) {
  const Nonlinear made = Hs71();
  const HandWritten program(made.data, made.functions);
  Configured solver(GetParam().algorithm);
  sy_control control = Freely();
  control.target = 40;
  const NonlinearAnswer a = solver.From(program, {1, 5, 5, 1}, control);
  // One that comes from outside of the constraints may have its optimum before a feasible point.
  ASSERT_TRUE(a.result.termination == SY_TARGET || IsSolved(a)) << a.text;
  EXPECT_EQ(a.result.primal, SY_FEASIBLE);
  EXPECT_LE(a.result.objective, 40);
}

TEST_P(NloptAlgorithm, DrawsTheSameNumbersForTheSameSeed) {
  const Nonlinear made = Hs71();
  const HandWritten program(made.data, made.functions);
  Configured solver(GetParam().algorithm);
  solver.Integer("polish", 0).Integer("maxeval", 400);
  sy_control control = Freely();
  control.seed = 7;
  const NonlinearAnswer first = solver.From(program, {}, control);
  const NonlinearAnswer second = solver.From(program, {}, control);
  EXPECT_EQ(first.x, second.x);
  EXPECT_EQ(first.result.iterations, second.result.iterations);
  control.seed = 8;
  const NonlinearAnswer other = solver.From(program, {}, control);
  EXPECT_EQ(first.x != other.x, GetParam().algorithm == std::string("GN_ISRES"));
}

}  // namespace
}  // namespace switchyard::test
