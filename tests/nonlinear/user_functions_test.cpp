// The three forms of a user's function, what they throw, and their derivatives.
#include <cmath>
#include <stdexcept>

#include "switchyard/model/check_program_derivatives.hpp"
#include "switchyard/solve/solve.hpp"
#include "tests/nonlinear/backends.hpp"

namespace switchyard::testing {
namespace {

// Rosenbrock's valley with derivatives of its own.
struct Valley {
  double slip = 0;  // an error in the gradient

  double operator()(const Eigen::VectorXd& x) const {
    return 100 * std::pow(x[1] - x[0] * x[0], 2) + std::pow(1 - x[0], 2);
  }
  [[nodiscard]] Eigen::VectorXd Gradient(const Eigen::VectorXd& x) const {
    const double bend = x[1] - x[0] * x[0];
    return Eigen::Vector2d(-400 * x[0] * bend - 2 * (1 - x[0]) + slip, 200 * bend);
  }
  [[nodiscard]] Eigen::MatrixXd Hessian(const Eigen::VectorXd& x) const {
    return Eigen::Matrix2d{{-400 * (x[1] - 3 * x[0] * x[0]) + 2, -400 * x[0]}, {-400 * x[0], 200}};
  }
};

TEST(UserFunction, InEachFormLeadsToTheSameOptimum) {
  SKIP_WITHOUT("ipopt");
  for (int form = 0; form < 3; ++form) {
    MathematicalProgram program;
    const auto x = program.NewContinuousVariables(2, "x");
    if (form == 0) {
      program.AddCost(
          [](const auto& v) {
            const auto bend = v[1] - v[0] * v[0];
            return 100 * bend * bend + (1 - v[0]) * (1 - v[0]);
          },
          x);
    } else if (form == 1) {
      program.AddCost(Valley{}, x);
    } else {
      program.AddCost(100 * pow(x[1] - pow(x[0], 2), 2) + pow(1 - x[0], 2));
    }
    program.SetInitialGuess(x, Eigen::Vector2d(-1.2, 1));
    const auto result = SolverInterface("ipopt", Built()).Solve(program);
    ASSERT_TRUE(result.is_success()) << form << result.message;
    EXPECT_NEAR((result.GetSolution(x) - Eigen::Vector2d(1, 1)).norm(), 0, 1e-5) << form;
    EXPECT_GT(result.evaluations.hessian, 0) << form;
  }
}

struct Mine : std::runtime_error {
  using std::runtime_error::runtime_error;
};

TEST(UserFunction, ThrowsItsOwnExceptionThroughTheSolve) {
  for (const char* name : {"ipopt", "nlopt"}) {
    if (!IsThere(name)) continue;
    MathematicalProgram program;
    const auto x = program.NewContinuousVariables(1, "x");
    int calls = 0;
    program.AddCost(
        [&calls](const auto& v) {
          if (++calls > 3) throw Mine("the fourth call");
          return v[0] > 100 ? v[0] : v[0] * v[0];  // decides by value: called at every point
        },
        x);
    program.SetInitialGuess(x, Eigen::VectorXd::Constant(1, 9));
    try {
      static_cast<void>(SolverInterface(name, Built()).Solve(program));
      ADD_FAILURE() << name << ": nothing was thrown";
    } catch (const Mine& e) {
      EXPECT_STREQ(e.what(), "the fourth call");
    }
    EXPECT_LE(calls, 5) << name << " went on";
  }
}

// MUMPS solves one at a time: a solve within a function of a solve would wait for itself.
TEST(UserFunction, ThatSolvesByTheSameBackendIsToldSo) {
  SKIP_WITHOUT("ipopt");
  MathematicalProgram inner;
  const auto y = inner.NewContinuousVariables(1, "y");
  inner.AddCost([](const auto& v) { return exp(v[0]) - v[0]; }, y);
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(1, "x");
  MathematicalProgramResult within;
  program.AddCost(
      [&](const auto& v) {
        // Called before and after the solve too, where it is free.
        auto result = SolverInterface("ipopt", Built()).Solve(inner);
        if (!result.is_success()) within = std::move(result);
        return v[0] > 0 ? v[0] * v[0] : v[0] * v[0];
      },
      x);
  const auto result = SolverInterface("ipopt", Built()).Solve(program);
  EXPECT_TRUE(result.is_success()) << result.message;
  EXPECT_EQ(within.termination, Termination::kNoBackend);
  EXPECT_NE(within.message.find("ipopt"), std::string::npos) << within.message;
}

TEST(CheckDerivatives, NamesTheRowAndTheColumn) {
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(2, "x");
  program.AddCost(Valley{.slip = 0.5}, x, {.description = "valley"});
  auto fine =
      program.AddConstraint([](const auto& v) { return sin(v[0]) * v[1]; },
                            Eigen::VectorXd::Constant(1, -1), Eigen::VectorXd::Constant(1, 1), x);
  fine.evaluator()->set_row_names({"wave"});
  const auto report = CheckDerivatives(program, Eigen::Vector2d(0.3, -0.7));
  ASSERT_EQ(report.wrong.size(), 1u);
  EXPECT_EQ(report.wrong[0].row, "valley");
  EXPECT_EQ(report.wrong[0].column, "x(0)");
  EXPECT_NEAR(report.wrong[0].entry.ours - report.wrong[0].entry.by_differences, 0.5, 1e-6);
  EXPECT_NE(to_string(report).find("derivative of valley by x(0) is "), std::string::npos);
}

TEST(CheckDerivatives, AgreesWithEveryBuiltInTerm) {
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(4, "x");
  const Eigen::MatrixXd A = Eigen::MatrixXd::Random(3, 4);
  const Eigen::VectorXd b = Eigen::VectorXd::Random(3);
  const Eigen::MatrixXd Q = Eigen::MatrixXd::Random(4, 4);
  Eigen::VectorXd positive = b;
  positive[0] = 30;  // keeps the denominator of the perspective away from 0
  std::vector<std::shared_ptr<EvaluatorBase>> terms = {
      std::make_shared<LinearCost>(Eigen::VectorXd::Random(4), 2),
      std::make_shared<QuadraticCost>(Q, Eigen::VectorXd::Random(4), 3),
      std::make_shared<L1NormCost>(A, b),
      std::make_shared<L2NormCost>(A, b),
      std::make_shared<LInfNormCost>(A, b),
      std::make_shared<PerspectiveQuadraticCost>(A, positive),
      std::make_shared<LinearConstraint>(A, b, b),
      std::make_shared<LorentzConeConstraint>(A, b),
      std::make_shared<RotatedLorentzConeConstraint>(A, b),
      std::make_shared<ExponentialConeConstraint>(A, b),
      std::make_shared<PowerConeConstraint>(A, b, 0.3),
      std::make_shared<QuadraticConstraint>(Q, Eigen::VectorXd::Random(4), -1, 1)};
  for (int k = 0; k < 100; ++k) {
    const Eigen::VectorXd at = Eigen::VectorXd::Random(4);
    for (const auto& term : terms) {
      const auto function = AsFunction(term);
      const Eigen::VectorXd w = Eigen::VectorXd::Random(function->num_outputs());
      const auto report = CheckDerivatives(*function, at, w, 1e-7);
      EXPECT_TRUE(report.agrees()) << term->Name() << "\n" << to_string(report);
    }
  }
}

}  // namespace
}  // namespace switchyard::testing
