// Rows and costs of a kinematic program: their derivatives against differences, their values
// against the trajectory.
#include <gtest/gtest.h>

#include "switchyard/model/check_program_derivatives.hpp"
#include "switchyard/trajectory/kinematic_trajectory_optimization.hpp"
#include "tests/trajectory/curves.hpp"

namespace switchyard::testing {
namespace {

using Eigen::Vector2d;
using Eigen::VectorXd;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kExact = 1e-7;  // relative

/// A point of all variables, T among them.
VectorXd SomePoint(const KinematicTrajectoryOptimization& problem, double duration, unsigned seed) {
  VectorXd x = RandomCurves(seed).Matrix(problem.prog().num_vars(), 1);
  x[problem.num_positions() * problem.num_control_points()] = duration;
  return x;
}

/// q(t) at such a point.
BsplineTrajectory<double> CurveOf(const KinematicTrajectoryOptimization& problem,
                                  const VectorXd& x) {
  MathematicalProgramResult result;
  std::vector<Variable> all;
  for (const Variable v : problem.prog().decision_variables()) all.push_back(v);
  result.SetPoint(all, x);
  return problem.ReconstructTrajectory(result);
}

void ExpectExactDerivatives(const KinematicTrajectoryOptimization& problem, int terms) {
  for (const double duration : {0.4, 1.0, 3.7}) {
    const auto report = CheckDerivatives(problem.prog(), SomePoint(problem, duration, 3), kExact);
    EXPECT_TRUE(report.agrees()) << to_string(report);
    EXPECT_TRUE(report.notes.empty()) << to_string(report);
    EXPECT_EQ(report.num_terms, terms);
  }
}

TEST(KinematicRows, OfAccelerationAndJerkHaveExactDerivatives) {
  KinematicTrajectoryOptimization problem(2, 9, 5, 2.0);
  problem.AddAccelerationBounds(Vector2d(-1, -kInfinity), Vector2d(2, 0.5));
  problem.AddJerkBounds(Vector2d(-3, 0.25), Vector2d(4, 0.25));
  // Two sides and one; two sides and an equation.
  EXPECT_EQ(problem.prog().generic_constraints().size(), 6);
  ExpectExactDerivatives(problem, 6);
}

// 0 <= (P M_k - T^k lb) / T_0^k <=> lb <= d^k q / dt^k at the control points of that derivative.
TEST(KinematicRows, AreDerivativesInTimeTimesAPowerOfTheDuration) {
  KinematicTrajectoryOptimization problem(1, 8, 4, 2.0);
  const VectorXd lb = VectorXd::Constant(1, -1.5), ub = VectorXd::Constant(1, 2.5);
  const auto velocity = problem.AddVelocityBounds(lb, ub);
  const auto acceleration = problem.AddAccelerationBounds(lb, ub);
  const auto jerk = problem.AddJerkBounds(lb, ub);
  const double T = 3;
  const VectorXd x = SomePoint(problem, T, 5);
  const auto curve = CurveOf(problem, x);
  const auto expect = [&](const Binding<Constraint>& rows, int k, double bound, double scale) {
    const auto made = curve.MakeDerivative(k);
    const auto& derivative = dynamic_cast<const BsplineTrajectory<double>&>(*made);
    const VectorXd values = problem.prog().EvalBinding(rows, x);
    ASSERT_EQ(values.size(), derivative.num_control_points());
    for (int j = 0; j < derivative.num_control_points(); ++j) {
      const double point = derivative.control_points()[static_cast<std::size_t>(j)](0);
      EXPECT_NEAR(values[j], std::pow(T, k) * (point - bound) * scale,
                  1e-11 * (1 + std::abs(values[j])));
    }
  };
  ASSERT_EQ(velocity.size(), 2);
  expect(velocity[0], 1, -1.5, 1);
  expect(velocity[1], 1, 2.5, 1);
  expect(acceleration[0], 2, -1.5, 1 / 4.0);
  expect(jerk[1], 3, 2.5, 1 / 8.0);
  EXPECT_EQ(acceleration[0].evaluator()->lower_bound()[0], 0);
  EXPECT_EQ(acceleration[0].evaluator()->upper_bound()[0], kInfinity);
}

TEST(KinematicRows, TakeTheDurationOfALaterGuessAsTheirScale) {
  KinematicTrajectoryOptimization problem(1, 6);
  const auto one = VectorXd::Ones(1);
  const auto rows = problem.AddAccelerationBounds(-one, one)[0];
  const VectorXd x = SomePoint(problem, 5, 1);
  const VectorXd before = problem.prog().EvalBinding(rows, x);
  KinematicTrajectoryOptimization other(1, 6, 4, 10.0);
  problem.SetInitialGuess(CurveOf(other, SomePoint(other, 10, 2)));
  EXPECT_LE((problem.prog().EvalBinding(rows, x) - before / 100).norm(), 1e-12);
}

TEST(KinematicRows, AreLinearWhereTheBoundIsZero) {
  KinematicTrajectoryOptimization problem(1, 6);
  problem.AddAccelerationBounds(VectorXd::Zero(1), VectorXd::Ones(1));
  EXPECT_EQ(problem.prog().affine_constraints().size(), 1);
  EXPECT_EQ(problem.prog().generic_constraints().size(), 1);
}

class AtTimes : public ::testing::Test {
 protected:
  AtTimes() { problem.AddDurationConstraint(0.1, std::nullopt); }

  /// What an expression of q, qdot and qddot is worth at each time.
  template <class Worth>
  void ExpectSum(const std::vector<Binding<Cost>>& costs, const VectorXd& s, Worth worth) {
    const VectorXd x = SomePoint(problem, 1.7, 8);
    const auto curve = CurveOf(problem, x);
    ASSERT_EQ(costs.size(), static_cast<std::size_t>(s.size()));
    for (int k = 0; k < s.size(); ++k) {
      const double t = 1.7 * s[k];
      const double value =
          worth(curve.value(t), curve.EvalDerivative(t, 1), curve.EvalDerivative(t, 2));
      const double found = problem.prog().EvalBinding(costs[static_cast<std::size_t>(k)], x)[0];
      EXPECT_NEAR(found, value, 1e-10 * (1 + std::abs(value))) << "at " << s[k];
    }
  }

  KinematicTrajectoryOptimization problem{2, 8, 4, 1.5};
  const VectorXd times = (VectorXd(5) << 0, 0.13, 0.5, 0.77, 1).finished();
  const VectorXDecisionVariable q = problem.q(), v = problem.qdot(), a = problem.qddot();
};

TEST_F(AtTimes, FunctionsOfTheMotionAreExactWithTheirDerivatives) {
  const auto costs = problem.AddCostAtNormalizedTimes(
      sin(q[0]) * v[1] + a[0] * a[0] * q[1] + v[0] * v[0] * exp(q[0]), times);
  ExpectSum(costs, times, [](const auto& p, const auto& u, const auto& w) {
    return std::sin(p(0)) * u(1) + w(0) * w(0) * p(1) + u(0) * u(0) * std::exp(p(0));
  });
  ExpectExactDerivatives(problem, 5);
}

TEST_F(AtTimes, ConstraintsOfSeveralRowsHaveExactDerivatives) {
  problem.AddConstraintAtNormalizedTimes({{sin(q[0]) * v[0] <= 1, a[0] * v[1] - q[1] * q[1] >= -2}},
                                         times);
  ExpectExactDerivatives(problem, 5);
  for (const auto& rows : problem.prog().generic_constraints()) {
    EXPECT_LE(rows.variables().size(), 2 * 4 + 1);  // active control points alone
  }
}

TEST_F(AtTimes, IntegralsOverTimeHaveExactDerivatives) {
  problem.AddTimeIntegralCost(sin(q[0]) * v[0] * v[0] + a[1] * a[1], 2);
  problem.AddTimeIntegralCost(q[0] * q[0] * q[1], 1);
  problem.AddPathIntegralCost(v[0] * v[1] * q[1], 1);
  ExpectExactDerivatives(problem, 5 * 2 + 5 + 5);
}

// The square of a velocity is of degree 4 on each interval: 3 nodes are exact.
TEST_F(AtTimes, IntegralsOverTimeAreThoseOfFineSums) {
  const auto costs = problem.AddTimeIntegralCost(v[0] * v[0] + 3 * q[1], 3);
  const VectorXd x = SomePoint(problem, 1.7, 8);
  const auto curve = CurveOf(problem, x);
  const double found = problem.prog().EvalBindings(costs, x).sum();
  double sum = 0;
  constexpr int kParts = 20000;
  for (int i = 0; i < kParts; ++i) {
    const double t = 1.7 * (i + 0.5) / kParts;
    const double u = curve.EvalDerivative(t)(0);
    sum += 1.7 / kParts * (u * u + 3 * curve.value(t)(1));
  }
  EXPECT_NEAR(found, sum, 1e-6 * std::abs(sum));
}

TEST_F(AtTimes, WhatIsLinearStaysLinear) {
  const auto of = [&](const Formula& formula) {
    return problem.AddConstraintAtNormalizedTimes(formula, times)[1].evaluator()->Kind();
  };
  EXPECT_EQ(of(q[0] + q[1] <= 1), "linear constraint");
  EXPECT_EQ(of(v[0] - v[1] <= 1), "linear constraint");
  EXPECT_EQ(of(a[0] - a[1] <= 1), "bounds of a derivative");
  EXPECT_EQ(problem.AddCostAtNormalizedTimes(q[0] * q[0] + q[1], times)[1].evaluator()->Kind(),
            "quadratic cost");
  ExpectExactDerivatives(problem, 5);
}

TEST_F(AtTimes, ConesStayCones) {
  const auto disk = std::make_shared<LorentzConeConstraint>(
      (Eigen::MatrixXd(3, 2) << 0, 0, 1, 0, 0, 1).finished(), Eigen::Vector3d(1, 0.25, -0.5));
  const auto at = problem.AddPathPositionConstraint(disk, 0.4);
  EXPECT_EQ(problem.prog().cone_constraints().size(), 1);
  const VectorXd x = SomePoint(problem, 1.7, 8);
  const Eigen::MatrixXd point = CurveOf(problem, x).value(0.4 * 1.7);
  const Eigen::Vector3d z(1, point(0) + 0.25, point(1) - 0.5);
  EXPECT_LE((problem.prog().EvalBinding(at, x) - z).norm(), 1e-12);
}

TEST_F(AtTimes, GenericConstraintsOfPositionAndVelocityAreOfBoth) {
  const auto function =
      MakeFunction(4, [](const auto& x) { return x[0] * x[3] + sin(x[1]) * x[2]; });
  const auto rows = std::make_shared<FunctionConstraint>(function, VectorXd::Constant(1, -1),
                                                         VectorXd::Constant(1, 1));
  const auto at = problem.AddVelocityConstraintAtNormalizedTime(rows, 0.6);
  ExpectExactDerivatives(problem, 1);
  const VectorXd x = SomePoint(problem, 1.7, 8);
  const auto curve = CurveOf(problem, x);
  const Eigen::MatrixXd p = curve.value(0.6 * 1.7), u = curve.EvalDerivative(0.6 * 1.7);
  EXPECT_NEAR(problem.prog().EvalBinding(at, x)[0], p(0) * u(1) + std::sin(p(1)) * u(0), 1e-10);
}

TEST_F(AtTimes, LinearConstraintsOfVelocityAreOneBindingForEachSide) {
  const Binding<LinearConstraint> binding(
      std::make_shared<LinearConstraint>(Eigen::Matrix2d::Identity(), Vector2d(-1, -kInfinity),
                                         Vector2d(2, 3)),
      v);
  const auto sides = problem.AddVelocityConstraintAtNormalizedTime(binding, 0);
  ASSERT_EQ(sides.size(), 2);
  const VectorXd x = SomePoint(problem, 1.7, 8);
  const Eigen::MatrixXd u = CurveOf(problem, x).EvalDerivative(0);
  const VectorXd lower = problem.prog().EvalBinding(sides[0], x);
  const VectorXd upper = problem.prog().EvalBinding(sides[1], x);
  ASSERT_EQ(lower.size(), 1);
  ASSERT_EQ(upper.size(), 2);
  EXPECT_NEAR(lower[0], 1.7 * (u(0) + 1), 1e-10);
  EXPECT_NEAR(upper[0], 1.7 * (u(0) - 2), 1e-10);
  EXPECT_NEAR(upper[1], 1.7 * (u(1) - 3), 1e-10);
  EXPECT_EQ(upper.size() + lower.size(), 3);
}

}  // namespace
}  // namespace switchyard::testing
