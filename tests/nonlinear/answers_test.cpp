// What comes back from programs with functions: optimal, local, infeasible, undefined.
#include <cmath>
#include <numbers>

#include "switchyard/solve/solve.hpp"
#include "tests/nonlinear/backends.hpp"

namespace switchyard::testing {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

MathematicalProgramResult SolveBy(const char* name, const MathematicalProgram& program,
                                  const SolverOptions& options = {}) {
  return SolverInterface(name, Built()).Solve(program, std::nullopt, options);
}

class NonlinearAnswer : public ::testing::TestWithParam<const char*> {
 protected:
  void SetUp() override { SKIP_WITHOUT(GetParam()); }
  [[nodiscard]] MathematicalProgramResult Solve(const MathematicalProgram& program) const {
    return SolveBy(GetParam(), program);
  }
};
INSTANTIATE_TEST_SUITE_P(Backends, NonlinearAnswer, ::testing::Values("ipopt", "nlopt"));

// Hock-Schittkowski 71: its optimum is 17.0140173, and its duals make the point stationary.
TEST_P(NonlinearAnswer, IsALocalOptimumThatDualsSupport) {
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(4, "x");
  program.AddBoundingBoxConstraint(1, 5, x);
  program.AddCost([](const auto& v) { return v[0] * v[3] * (v[0] + v[1] + v[2]) + v[2]; }, x);
  program.AddConstraint([](const auto& v) { return v[0] * v[1] * v[2] * v[3]; },
                        Eigen::VectorXd::Constant(1, 25), Eigen::VectorXd::Constant(1, kInf), x);
  program.AddConstraint([](const auto& v) { return v.squaredNorm(); },
                        Eigen::VectorXd::Constant(1, 40), Eigen::VectorXd::Constant(1, 40), x);
  program.SetInitialGuess(x, Eigen::Vector4d(1, 5, 5, 1));
  const auto result = Solve(program);
  ASSERT_EQ(result.termination, Termination::kLocallyOptimal) << result.message;
  EXPECT_TRUE(result.is_success());
  EXPECT_NEAR(result.objective, 17.0140172891, 1e-6);
  EXPECT_LE(result.violation.nonlinear, 1e-6);
  EXPECT_EQ(result.dual, PointKind::kFeasible);
  EXPECT_TRUE(std::isnan(result.bound));  // nothing is proven of a nonconvex program
  EXPECT_GT(result.evaluations.objective, 0);
  EXPECT_GT(result.evaluations.jacobian, 0);
}

// min sum x log x over the simplex of n: the uniform point, worth -log n; bound by the duals.
TEST_P(NonlinearAnswer, OfADeclaredConvexProgramIsOptimalWithAProvenBound) {
  constexpr int kSize = 5;
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(kSize, "x");
  program.AddBoundingBoxConstraint(1e-3, 1, x);
  program.AddLinearEqualityConstraint(Eigen::RowVectorXd::Ones(kSize), 1, x);
  program.AddCost(
      [](const auto& v) {
        auto sum = v[0] * log(v[0]);
        for (int i = 1; i < v.size(); ++i) sum += v[i] * log(v[i]);
        return sum;
      },
      x, {.description = "entropy", .is_convex = true});
  program.SetInitialGuess(x, Eigen::VectorXd::LinSpaced(kSize, 0.1, 0.9));
  const auto result = Solve(program);
  ASSERT_EQ(result.termination, Termination::kOptimal) << result.message;
  EXPECT_NEAR(result.objective, -std::log(kSize), 1e-6);
  EXPECT_LE(result.bound, -std::log(kSize) + 1e-12);
  EXPECT_NEAR(result.bound, -std::log(kSize), 2e-6);
}

// A ball, a norm cost and a function that alone would move the point: cones and functions together.
TEST_P(NonlinearAnswer, OfConesAndFunctionsTogether) {
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(2, "x");
  Eigen::MatrixXd A(3, 2);
  A << 0, 0, 1, 0, 0, 1;
  const auto ball = program.AddLorentzConeConstraint(A, Eigen::Vector3d(1, 0, 0), x);  // |x| <= 1
  program.AddL2NormCost(Eigen::Matrix2d::Identity(), Eigen::Vector2d(-3, -4), x);  // |x - (3, 4)|
  program.AddCost([](const auto& v) { return exp(v[0] - v[0]) - 1 + 0 * v[0]; }, x,
                  {.is_convex = true});
  const auto result = Solve(program);
  ASSERT_EQ(result.termination, Termination::kOptimal) << result.message;
  EXPECT_NEAR(result.objective, 4, 1e-6);  // the ball's point nearest to (3, 4)
  EXPECT_NEAR((result.GetSolution(x) - Eigen::Vector2d(.6, .8)).norm(), 0, 1e-4);
  const Eigen::VectorXd dual = result.GetDualSolution(ball);  // a multiple of (1, -.6, -.8)
  EXPECT_NEAR(dual[0], 1, 1e-4);
  EXPECT_NEAR(dual[1], -.6, 1e-4);
}

TEST_P(NonlinearAnswer, IsLocallyInfeasibleWhereNothingIsFeasible) {
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(2, "x");
  program.AddBoundingBoxConstraint(-5, 5, x);
  program.AddConstraint([](const auto& v) { return v.squaredNorm(); },
                        Eigen::VectorXd::Constant(1, -kInf), Eigen::VectorXd::Constant(1, -1), x,
                        {.description = "negative square"});
  program.SetInitialGuess(x, Eigen::Vector2d(1, 2));
  const auto result = Solve(program);
  EXPECT_EQ(result.termination, Termination::kLocallyInfeasible) << result.message;
  EXPECT_FALSE(result.is_success());
  if (result.get_x_val().size() == 0) return;
  const auto names = result.GetInfeasibleConstraintNames(program);
  ASSERT_EQ(names.size(), 1u);
  EXPECT_EQ(names[0].substr(0, 24), "negative square[0]: -inf");
}

TEST_P(NonlinearAnswer, SaysThatTheStartIsUndefined) {
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(1, "x");
  program.AddCost([](const auto& v) { return v[0] - log(v[0]); }, x);
  program.SetInitialGuess(x, Eigen::VectorXd::Constant(1, -2));
  const auto result = Solve(program);
  EXPECT_EQ(result.termination, Termination::kEvaluationFailed) << result.message;
  EXPECT_FALSE(result.is_success());
}

TEST_P(NonlinearAnswer, ComesFromWithinTheDomain) {
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(1, "x");
  program.AddCost([](const auto& v) { return v[0] - log(v[0]); }, x, {.is_convex = true});
  program.SetInitialGuess(x, Eigen::VectorXd::Constant(1, 8));
  const auto result = Solve(program);
  ASSERT_TRUE(result.is_success()) << result.message;
  EXPECT_NEAR(result.GetSolution(x)[0], 1, 1e-4);
}

// A quadratic constraint that is not convex: the circle from outside.
TEST_P(NonlinearAnswer, OfANonconvexQuadraticConstraint) {
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(2, "x");
  const auto outside = program.AddQuadraticConstraint(2 * Eigen::Matrix2d::Identity(),
                                                      Eigen::Vector2d::Zero(), 4, kInf, x);
  program.AddQuadraticErrorCost(1, Eigen::Vector2d(1, 0), x);
  program.SetInitialGuess(x, Eigen::Vector2d(3, 0.5));
  const auto result = Solve(program);
  ASSERT_TRUE(result.is_success()) << result.message;
  EXPECT_NEAR(result.objective, 1, 1e-6);
  // (x_0 - 1)^2 at x_0 = sqrt(r): d/dr = (sqrt(r) - 1) / sqrt(r) = 1/2 at r = 4.
  EXPECT_NEAR(result.GetDualSolution(outside)[0], 0.5, 1e-4);
}

// Convex quadratic constraints alone go to any conic backend, as cones.
TEST(QuadraticConstraints, AreSolvedByConicBackends) {
  for (const char* name : {"conic", "clarabel", "ipopt"}) {
    if (!IsThere(name)) continue;
    MathematicalProgram program;
    const auto x = program.NewContinuousVariables(2, "x");
    const auto inside = program.AddQuadraticConstraint(2 * Eigen::Matrix2d::Identity(),
                                                       Eigen::Vector2d::Zero(), -kInf, 4, x);
    const auto mirrored = program.AddQuadraticConstraint(-2 * Eigen::Matrix2d::Identity(),
                                                         Eigen::Vector2d::Zero(), -9, kInf, x);
    program.AddLinearCost(Eigen::Vector2d(-1, 0), x);
    const auto result = SolveBy(name, program);
    ASSERT_EQ(result.termination, Termination::kOptimal) << name << result.message;
    EXPECT_NEAR(result.objective, -2, 1e-6) << name;
    EXPECT_NEAR(result.GetDualSolution(inside)[0], -0.25, 1e-4) << name;  // d(-sqrt r)/dr
    EXPECT_NEAR(result.GetDualSolution(mirrored)[0], 0, 1e-4) << name;
  }
}

TEST(Choice, SaysWhoNeedsDerivatives) {
  SKIP_WITHOUT("ipopt");
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(1, "x");
  program.AddCost([](const Eigen::VectorXd& v) { return std::cosh(v[0]); }, x);
  std::string why;
  EXPECT_FALSE(SolverInterface("ipopt", Built()).Accepts(program, &why));
  EXPECT_NE(why.find("needs derivatives, and a function of the problem has none"),
            std::string::npos)
      << why;
  if (!IsThere("nlopt")) return;
  program.AddBoundingBoxConstraint(-3, 2, x);
  const auto result = Solve(program);
  EXPECT_TRUE(result.is_success()) << result.message;
  EXPECT_EQ(result.solver, "org.nlopt.nlopt");
  EXPECT_NEAR(result.objective, 1, 1e-6);
}

TEST(Violation, OfAMatrixSaysWhichEigenvalueFails) {
  MathematicalProgram program;
  const auto X = program.NewSymmetricContinuousVariables(2, "X");
  program.AddPositiveSemidefiniteConstraint(X);
  MathematicalProgramResult result;
  result.SetPoint({X(0, 0), X(1, 0), X(1, 1)}, Eigen::Vector3d(1, 2, 1));
  const auto names = result.GetInfeasibleConstraintNames(program);
  ASSERT_EQ(names.size(), 1u);
  EXPECT_EQ(names[0], "positive semidefinite constraint: eigenvalue 0 of 2 is -1");
  EXPECT_THROW(
      program.AddQuadraticAsRotatedLorentzConeConstraint(
          Eigen::Matrix2d{{1, 2}, {2, 1}}, Eigen::Vector2d::Zero(), -1, {X(0, 0), X(1, 1)}),
      InvalidArgument);
}

}  // namespace
}  // namespace switchyard::testing
