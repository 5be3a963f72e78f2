// The functions of a program as one sy_nlp: against the terms themselves, and what is kept.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <thread>

#include "core/lower/lowering.hpp"
#include "core/problem/difference.hpp"
#include "tests/support/answer_errors.hpp"

namespace switchyard::testing {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

/// x of 3 and y of 2; terms whose variables are in another order than the program's, and one in
/// which a variable stands twice.
struct Fixture {
  MathematicalProgram program;
  VectorXDecisionVariable x = program.NewContinuousVariables(3, "x");
  VectorXDecisionVariable y = program.NewContinuousVariables(2, "y");
  Binding<Cost> cost = program.AddCost(
      [](const auto& v) { return exp(v[0]) * v[1] + v[2] * v[2] * v[2]; }, {y[0], x[2], x[0]});
  Binding<Cost> twice =
      program.AddCost([](const auto& v) { return sin(v[0]) * v[1] * v[2]; }, {x[1], y[1], x[1]});
  Binding<QuadraticConstraint> quadratic = program.AddQuadraticConstraint(
      Eigen::Matrix2d{{2, 1}, {1, 4}}, Eigen::Vector2d(1, -1), -kInf, 3, {y[1], x[0]});
  Binding<Constraint> rows = program.AddConstraint(
      [](const auto& v) {
        using T = std::decay_t<decltype(v[0] * v[0])>;
        return std::vector<T>{v[0] * v[1], v[2] + exp(v[0])};
      },
      Eigen::Vector2d(-1, 0), Eigen::Vector2d(1, kInf), {x[2], x[1], y[0]});

  [[nodiscard]] Eigen::VectorXd Point(unsigned seed) const {
    Random random(seed);
    Eigen::VectorXd v(program.num_vars());
    for (double& e : v) e = random.Normal();
    return v;
  }
};

struct Answer {
  sy_verdict verdict = SY_EVALUATED;
  double objective = 0;
  Eigen::VectorXd gradient, constraints;
  Eigen::MatrixXd jacobian, hessian;
};

Answer Evaluate(const sy_nlp& nlp, const Eigen::VectorXd& x, double weight = 1,
                const Eigen::VectorXd& multipliers = {}) {
  const auto n = x.size();
  const Eigen::Index m = nlp.num_constraints;
  Answer a{SY_EVALUATED,
           0,
           Eigen::VectorXd(n),
           Eigen::VectorXd(m),
           Eigen::MatrixXd::Zero(m, n),
           Eigen::MatrixXd::Zero(n, n)};
  std::vector<double> J(static_cast<std::size_t>(nlp.jacobian.start[n]));
  std::vector<double> H(static_cast<std::size_t>(nlp.hessian.start[n]));
  const Eigen::VectorXd w = multipliers.size() == m ? multipliers : Eigen::VectorXd::Ones(m);
  sy_evaluation e{};
  e.size = sizeof e;
  e.want = SY_OBJECTIVE | SY_GRADIENT | SY_CONSTRAINTS | SY_JACOBIAN | SY_HESSIAN;
  e.x = x.data();
  e.weight = weight;
  e.multipliers = w.data();
  e.objective = &a.objective;
  e.gradient = a.gradient.data();
  e.constraints = a.constraints.data();
  e.jacobian = J.data();
  e.hessian = H.data();
  a.verdict = nlp.evaluate(nlp.context, &e);
  for (std::int32_t j = 0; j < n; ++j) {
    for (std::int32_t k = nlp.jacobian.start[j]; k < nlp.jacobian.start[j + 1]; ++k) {
      a.jacobian(nlp.jacobian.row[k], j) = J[static_cast<std::size_t>(k)];
    }
    for (std::int32_t k = nlp.hessian.start[j]; k < nlp.hessian.start[j + 1]; ++k) {
      const std::int32_t i = nlp.hessian.row[k];
      a.hessian(i, j) = a.hessian(j, i) = H[static_cast<std::size_t>(k)];
    }
  }
  return a;
}

TEST(Nonlinear, EvaluatesWhatTheTermsSay) {
  const Fixture f;
  const Lowering lowering(f.program);
  const sy_nlp& nlp = lowering.nonlinear()->record();
  ASSERT_EQ(nlp.num_constraints, 3);
  EXPECT_EQ(nlp.upper[0], 3);
  EXPECT_EQ(nlp.lower[1], -1);
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Eigen::VectorXd x = f.Point(seed);
    const Answer a = Evaluate(nlp, x);
    ASSERT_EQ(a.verdict, SY_EVALUATED);
    EXPECT_NEAR(a.objective, f.program.EvalCosts(x), 1e-12 * (1 + std::abs(a.objective)));
    EXPECT_NEAR(a.constraints[0], f.program.EvalBinding(f.quadratic, x)[0], 1e-12);
    EXPECT_NEAR((a.constraints.tail(2) - f.program.EvalBinding(f.rows, x)).norm(), 0, 1e-12);
  }
}

// Differences of what was just checked.
TEST(Nonlinear, HasTheDerivativesOfItsValues) {
  const Fixture f;
  const Lowering lowering(f.program);
  const sy_nlp& nlp = lowering.nonlinear()->record();
  const Eigen::Vector3d w(0.3, -2, 0.7);
  constexpr double kStep = 1e-5;
  for (unsigned seed = 0; seed < 10; ++seed) {
    const Eigen::VectorXd x = f.Point(seed);
    const Answer at = Evaluate(nlp, x, 1.5, w);
    const double scale = 1 + at.hessian.cwiseAbs().maxCoeff();
    for (Eigen::Index j = 0; j < x.size(); ++j) {
      Eigen::VectorXd up = x;
      Eigen::VectorXd down = x;
      up[j] += kStep;
      down[j] -= kStep;
      const Answer a = Evaluate(nlp, up);
      const Answer b = Evaluate(nlp, down);
      EXPECT_NEAR(at.gradient[j], (a.objective - b.objective) / (2 * kStep), 1e-7 * scale);
      const Eigen::VectorXd slope = (a.constraints - b.constraints) / (2 * kStep);
      EXPECT_NEAR((at.jacobian.col(j) - slope).norm(), 0, 1e-7 * scale);
      const Eigen::VectorXd curved =
          (1.5 * (a.gradient - b.gradient) + (a.jacobian - b.jacobian).transpose() * w) /
          (2 * kStep);
      EXPECT_NEAR((at.hessian.col(j) - curved).norm(), 0, 1e-7 * scale) << "column " << j;
    }
  }
}

TEST(Nonlinear, MaximizingIsMinimizingTheNegative) {
  Fixture f;
  f.program.set_objective_sense(ObjectiveSense::kMaximize);
  const Lowering lowering(f.program);
  const Eigen::VectorXd x = f.Point(1);
  EXPECT_NEAR(Evaluate(lowering.nonlinear()->record(), x).objective, -f.program.EvalCosts(x),
              1e-12);
}

TEST(Nonlinear, EvaluatesAPointOnce) {
  const Fixture f;
  const Lowering lowering(f.program);
  NonlinearPart& part = *lowering.nonlinear();
  const Answer first = Evaluate(part.record(), f.Point(1));
  const Answer again = Evaluate(part.record(), f.Point(1));
  EXPECT_EQ(first.gradient, again.gradient);
  EXPECT_EQ(first.jacobian, again.jacobian);
  EXPECT_EQ(part.counts().objective, 1);
  EXPECT_EQ(part.counts().jacobian, 1);
  EXPECT_EQ(part.counts().hessian, 2);  // it has other multipliers every time
  Evaluate(part.record(), f.Point(2));
  EXPECT_EQ(part.counts().objective, 2);
  part.ClearCounts();
  EXPECT_EQ(part.counts().objective, 0);
}

TEST(Nonlinear, AnswersSeveralThreadsAtOnce) {
  const Fixture f;
  const Lowering lowering(f.program);
  const sy_nlp& nlp = lowering.nonlinear()->record();
  ASSERT_NE(nlp.flags & SY_NLP_CONCURRENT, 0u);
  const auto run = [&](unsigned from) {
    for (unsigned k = 0; k < 500; ++k) {
      const Eigen::VectorXd x = f.Point(from + k % 7);
      const Answer a = Evaluate(nlp, x);
      ASSERT_NEAR(a.objective, f.program.EvalCosts(x), 1e-12 * (1 + std::abs(a.objective)));
    }
  };
  std::thread other(run, 100);
  run(0);
  other.join();
}

TEST(Nonlinear, SaysUndefinedWhereAValueIsNoNumber) {
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(1, "x");
  program.AddCost([](const auto& v) { return log(v[0]); }, x);
  const Lowering lowering(program);
  const sy_nlp& nlp = lowering.nonlinear()->record();
  EXPECT_EQ(Evaluate(nlp, Eigen::VectorXd::Constant(1, -1)).verdict, SY_UNDEFINED);
  EXPECT_EQ(Evaluate(nlp, Eigen::VectorXd::Constant(1, 1)).verdict, SY_EVALUATED);
}

struct Mine : std::runtime_error {
  using std::runtime_error::runtime_error;
};

TEST(Nonlinear, KeepsWhatAFunctionThrewUntilItIsAskedFor) {
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(1, "x");
  bool fails = false;
  program.AddCost(
      [&fails](const Eigen::VectorXd& v) -> double {
        if (fails) throw Mine("mine");
        return v[0];
      },
      x);
  const Lowering lowering(program);
  const sy_nlp& nlp = lowering.nonlinear()->record();
  EXPECT_EQ(nlp.provides, static_cast<std::uint32_t>(SY_OBJECTIVE | SY_CONSTRAINTS));
  fails = true;
  double value = 0;
  const double at = 1;
  sy_evaluation e{};
  e.size = sizeof e;
  e.want = SY_OBJECTIVE;
  e.x = &at;
  e.objective = &value;
  EXPECT_EQ(nlp.evaluate(nlp.context, &e), SY_ABORT);
  EXPECT_THROW(lowering.nonlinear()->RethrowWhatWasThrown(), Mine);
  EXPECT_NO_THROW(lowering.nonlinear()->RethrowWhatWasThrown());
}

TEST(Nonlinear, QuadraticConstraintsAreConesWhereNothingElseIsAFunction) {
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(2, "x");
  program.AddQuadraticConstraint(2 * Eigen::Matrix2d::Identity(), Eigen::Vector2d::Zero(), -kInf, 1,
                                 x);  // |x|^2 <= 1
  program.AddQuadraticConstraint(-2 * Eigen::Matrix2d::Identity(), Eigen::Vector2d(1, 0), -4, kInf,
                                 x);  // |x|^2 - x_0 <= 4
  const Lowering lowering(program);
  EXPECT_EQ(lowering.nonlinear(), nullptr);
  ASSERT_EQ(lowering.problem().data().num_cones(), 2);
  for (unsigned seed = 0; seed < 50; ++seed) {
    Random random(seed);
    const Eigen::Vector2d at(1.5 * random.Normal(), 1.5 * random.Normal());
    const bool inside = at.squaredNorm() <= 1 && at.squaredNorm() - at[0] <= 4;
    const double error = PrimalError(lowering.problem().data(), {at[0], at[1]});
    EXPECT_EQ(error <= 1e-12, inside) << at.transpose();
  }
}

TEST(Nonlinear, QuadraticConstraintsThatAreNotConvexAreRowsOfTheFunctions) {
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(2, "x");
  const auto outside = program.AddQuadraticConstraint(2 * Eigen::Matrix2d::Identity(),
                                                      Eigen::Vector2d::Zero(), 1, kInf, x);
  EXPECT_FALSE(outside.evaluator()->is_convex());
  const Lowering lowering(program);
  ASSERT_NE(lowering.nonlinear(), nullptr);
  EXPECT_EQ(lowering.problem().data().num_cones(), 0);
  EXPECT_EQ(lowering.problem().view().flags & SY_PROBLEM_CONVEX, 0u);
  EXPECT_EQ(lowering.WithNames(program, "c[0] is violated"), "quadratic constraint[0] is violated");
}

TEST(Nonlinear, ChangedBoundsAndCoefficientsAreAnUpdate) {
  Fixture f;
  Lowering lowering(f.program);
  const sy_nlp* before = lowering.problem().view().nlp;
  auto& rows = dynamic_cast<FunctionConstraint&>(*f.rows.evaluator());
  rows.UpdateBounds(Eigen::Vector2d(-5, 0), Eigen::Vector2d(1, kInf));
  EXPECT_EQ(lowering.Refresh(f.program), static_cast<std::uint64_t>(SY_UPDATES_NLP));
  EXPECT_EQ(before->lower[1], -1);  // whoever holds the old one finds it unchanged
  EXPECT_EQ(lowering.problem().view().nlp->lower[1], -5);
  lowering.ForgetReplaced();
  f.quadratic.evaluator()->UpdateCoefficients(Eigen::Matrix2d{{3, 1}, {1, 4}},
                                              Eigen::Vector2d(1, -1), -kInf, 3);
  EXPECT_EQ(lowering.Refresh(f.program), static_cast<std::uint64_t>(SY_UPDATES_NLP));
  const Eigen::VectorXd x = f.Point(3);
  EXPECT_NEAR(Evaluate(*lowering.problem().view().nlp, x).constraints[0],
              f.program.EvalBinding(f.quadratic, x)[0], 1e-12);
  f.quadratic.evaluator()->UpdateCoefficients(Eigen::Matrix2d{{3, 0}, {0, 4}},
                                              Eigen::Vector2d(1, -1), -kInf, 3);
  EXPECT_EQ(lowering.Refresh(f.program), kStructureChanged);
  f.program.AddCost([](const auto& v) { return cos(v[0]); }, {f.x[0]});
  EXPECT_EQ(lowering.Refresh(f.program), kStructureChanged);
}

}  // namespace
}  // namespace switchyard::testing
