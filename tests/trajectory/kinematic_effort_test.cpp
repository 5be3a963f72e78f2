// What is asked of a robot along a trajectory: efforts, frames and distances; derivatives against
// differences, answers against closed forms. By a two-link arm in closed form.
#include <cmath>
#include <numbers>

#include "switchyard/model/check_program_derivatives.hpp"
#include "switchyard/trajectory/efforts.hpp"
#include "switchyard/trajectory/kinematic_trajectory_optimization.hpp"
#include "tests/model/said.hpp"
#include "tests/nonlinear/backends.hpp"
#include "tests/support/fake_dynamics.hpp"
#include "tests/trajectory/curves.hpp"

namespace switchyard::testing {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;
using Problem = KinematicTrajectoryOptimization;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kExact = 1e-7;

VectorXd Times(std::initializer_list<double> s) {
  VectorXd times(std::ssize(s));
  std::copy(s.begin(), s.end(), times.data());
  return times;
}

VectorXd SomePoint(const Problem& problem, double duration, unsigned seed) {
  VectorXd x = RandomCurves(seed).Matrix(problem.prog().num_vars(), 1);
  x[problem.num_positions() * problem.num_control_points()] = duration;
  return x;
}

BsplineTrajectory<double> CurveOf(const Problem& problem, const VectorXd& x) {
  MathematicalProgramResult result;
  std::vector<Variable> all;
  for (const Variable v : problem.prog().decision_variables()) all.push_back(v);
  result.SetPoint(all, x);
  return problem.ReconstructTrajectory(result);
}

class OfARobot : public ::testing::Test {
 protected:
  OfARobot() { problem.AddDurationConstraint(0.1, std::nullopt); }

  void ExpectExactDerivatives() const {
    for (const double duration : {0.4, 1.0, 3.7}) {
      const auto report = CheckDerivatives(problem.prog(), SomePoint(problem, duration, 3), kExact);
      EXPECT_TRUE(report.agrees()) << to_string(report);
      EXPECT_TRUE(report.notes.empty()) << to_string(report);
    }
  }

  Problem problem{2, 9, 5, 1.5};
  RigidBodyModel arm = Fake("two_link", true);
  RigidBodyModel head = Fake("pan_tilt");
};

TEST_F(OfARobot, EffortsHaveExactDerivatives) {
  problem.AddEffortBoundsAtNormalizedTimes(arm, Times({0, 0.3, 0.5, 1}));
  ExpectExactDerivatives();
}

TEST_F(OfARobot, EffortsAreThoseOfTheMotion) {
  const VectorXd s = Times({0, 0.3, 1});
  const auto rows = problem.AddEffortBoundsAtNormalizedTimes(arm, s);
  ASSERT_EQ(rows.size(), 3);
  const double T = 1.7;
  const VectorXd x = SomePoint(problem, T, 5);
  const auto curve = CurveOf(problem, x);
  const MatrixXd efforts = EffortsAlong(arm, curve, T * s);
  for (int k = 0; k < 3; ++k) {
    const auto& row = rows[static_cast<std::size_t>(k)];
    EXPECT_LE((problem.prog().EvalBinding(row, x) - efforts.col(k)).norm(), 1e-10);
    EXPECT_EQ(row.evaluator()->upper_bound(), Vector2d(25, 8));
    EXPECT_EQ(row.evaluator()->lower_bound(), Vector2d(-25, -8));
  }
  EXPECT_EQ(rows[1].variables().size(), 2 * 5 + 1);  // the active control points, and T
}

TEST_F(OfARobot, EffortsOfJointsWithoutBoundsAreLeftOut) {
  const auto rows = problem.AddEffortBoundsAtNormalizedTimes(
      arm, Times({0.4}), Vector2d(-kInfinity, -3), Vector2d(kInfinity, kInfinity));
  ASSERT_EQ(rows[0].evaluator()->num_constraints(), 1);
  EXPECT_EQ(rows[0].evaluator()->lower_bound()[0], -3);
  ExpectExactDerivatives();
}

TEST_F(OfARobot, FramesHaveExactDerivatives) {
  const Matrix3d D = Eigen::AngleAxisd(0.7, Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  for (const RigidBodyModel& model : {arm, head}) {
    problem.AddFramePositionConstraint(model, "tip", Vector3d::Constant(-1), Vector3d::Ones(), 0.3,
                                       Vector3d(0.1, -0.2, 0.3));
    problem.AddFrameOrientationConstraint(model, "tip", D, 0.2, 0.5);
    problem.AddFrameOrientationConstraint(model, "forearm", D, 0, 1);
  }
  ExpectExactDerivatives();
}

TEST_F(OfARobot, FramesAreWhereTheMotionTakesThem) {
  const Vector3d point(0.1, -0.2, 0.3);
  const auto position = problem.AddFramePositionConstraint(head, "tip", Vector3d::Zero(),
                                                           Vector3d::Ones(), 0.3, point);
  const VectorXd x = SomePoint(problem, 2, 7);
  const VectorXd q = CurveOf(problem, x).value(0.6);
  const FramePose pose = head.PoseOf("tip", q);
  EXPECT_LE(
      (problem.prog().EvalBinding(position, x) - (pose.position + pose.rotation * point)).norm(),
      1e-12);
  // The axes of the frame itself, turned by an angle: within that angle, and no less.
  for (const double angle : {0.05, 1.0, 3.0}) {
    const Matrix3d turned =
        pose.rotation *
        Eigen::AngleAxisd(angle, Vector3d(0.3, -1, 2).normalized()).toRotationMatrix();
    const auto violation = [&](double tolerance) {
      const auto rows = problem.AddFrameOrientationConstraint(head, "tip", turned, tolerance, 0.3);
      const VectorXd y = problem.prog().EvalBinding(rows, x);
      return std::max((rows.evaluator()->lower_bound() - y).maxCoeff(),
                      (y - rows.evaluator()->upper_bound()).maxCoeff());
    };
    EXPECT_LE(violation(angle + 1e-9), 1e-14);
    // Its slope is cos(angle / 2): in radians where angles are small.
    EXPECT_NEAR(violation(angle - 1e-5), 1e-5 * std::cos(angle / 2), 1e-8);
    EXPECT_GT(violation(0), 0.04);
  }
}

TEST_F(OfARobot, DistancesHaveTheirDerivatives) {
  const auto rows = problem.AddMinimumDistanceConstraint(arm, 0.05, Times({0.1, 0.8}));
  ASSERT_EQ(rows.size(), 2);
  ExpectExactDerivatives();
  const VectorXd x = SomePoint(problem, 2, 7);
  EXPECT_NEAR(problem.prog().EvalBinding(rows[0], x)[0],
              arm.Distances(CurveOf(problem, x).value(0.2), {0})[0], 1e-12);
}

// ---- Answers ----

class RobotMotion : public ::testing::Test {
 protected:
  void SetUp() override { SKIP_WITHOUT("ipopt"); }
  static KinematicTrajectory Find(const Problem& problem) {
    const SolverInterface ipopt("ipopt", Built());
    return problem.FindTrajectory({}, &ipopt);
  }
  static std::unique_ptr<Problem> Swing(const RigidBodyModel& arm, const Vector2d& goal) {
    auto problem = std::make_unique<Problem>(2, 16, 5, 2.0);
    const VectorXd zero = Vector2d::Zero();
    problem->AddDurationCost();
    problem->AddDurationConstraint(0.05, std::nullopt);
    problem->AddJointLimits(arm);
    problem->AddPathPositionConstraint(zero, zero, 0);
    problem->AddPathPositionConstraint(goal, goal, 1);
    problem->AddPathVelocityConstraint(zero, zero, 0);
    problem->AddPathVelocityConstraint(zero, zero, 1);
    return problem;
  }
};

TEST_F(RobotMotion, UnderEffortBoundsIsSlowerAndKeepsThem) {
  const RigidBodyModel arm = Fake("two_link");
  const auto swing = Swing(arm, Vector2d(1.2, -0.5));
  const auto free = Find(*swing);
  ASSERT_TRUE(free.result.is_success()) << free.result.message;
  EXPECT_GT(EffortViolation(arm, *free.trajectory).amount, 10);
  EXPECT_EQ(free.effort_violation, 0);  // none was asked for
  swing->AddEffortBoundsAtNormalizedTimes(arm, VectorXd::LinSpaced(61, 0, 1));
  const auto bound = Find(*swing);
  ASSERT_TRUE(bound.result.is_success()) << bound.result.message;
  EXPECT_GT(bound.trajectory->end_time(), 1.1 * free.trajectory->end_time());
  EXPECT_LE(bound.effort_violation, 0.25);  // between the times, 1 % of the limit
  const VectorXd times = VectorXd::LinSpaced(61, 0, bound.trajectory->end_time());
  const MatrixXd efforts = EffortsAlong(arm, *bound.trajectory, times);
  for (int i = 0; i < 2; ++i) {
    EXPECT_LE(efforts.row(i).cwiseAbs().maxCoeff(), TwoLink::kEffort[i] + 1e-5);
  }
  EXPECT_NEAR(bound.effort_violation, EffortViolation(arm, *bound.trajectory, {}, {}, 320).amount,
              1e-12);
}

// Held still, an arm needs what its weight needs; with less there is no motion.
TEST_F(RobotMotion, WithTooLittleEffortToHoldItselfIsInfeasible) {
  const RigidBodyModel arm = Fake("two_link");
  const auto swing = Swing(arm, Vector2d(std::numbers::pi / 2, 0));
  const Vector2d held =
      arm.InverseDynamics(Vector2d(std::numbers::pi / 2, 0), Vector2d::Zero(), Vector2d::Zero());
  swing->AddPathAccelerationConstraint(Vector2d::Zero(), Vector2d::Zero(), 1);
  swing->AddEffortBoundsAtNormalizedTimes(arm, Times({1}), 0.9 * -held, 0.9 * held);
  EXPECT_FALSE(Find(*swing).result.is_success());
}

TEST_F(RobotMotion, BringsItsFrameWhereItIsAskedTo) {
  const RigidBodyModel head = Fake("pan_tilt");
  Problem problem(2, 8, 4, 1.0);
  problem.AddDurationConstraint(1, 1);
  problem.AddPathEnergyCost();
  problem.AddPathPositionConstraint(Vector2d(0.1, 0.2), Vector2d(0.1, 0.2), 0);
  // Pan a, tilt b: the tip is at 0.8 (cos b cos a, cos b sin a, -sin b).
  const double a = 0.9, b = -0.4;
  const Vector3d tip =
      0.8 * Vector3d(std::cos(b) * std::cos(a), std::cos(b) * std::sin(a), 0.389418);
  const Vector3d slack = Vector3d::Constant(1e-5);
  problem.AddFramePositionConstraint(head, "tip", tip - slack, tip + slack, 0.5);
  const Matrix3d R = head.PoseOf("tip", Vector2d(-0.3, 0.6)).rotation;
  problem.AddFrameOrientationConstraint(head, "tip", R, 0, 1);
  const auto found = Find(problem);
  ASSERT_TRUE(found.result.is_success()) << found.result.message;
  EXPECT_LE(Distance(found.trajectory->value(0.5), Vector2d(a, b)), 1e-4);
  EXPECT_LE(Distance(found.trajectory->value(1), Vector2d(-0.3, 0.6)), 1e-6);
}

// A ball at the tip swings around one in its way.
TEST_F(RobotMotion, KeepsItsDistance) {
  const RigidBodyModel arm = Fake("two_link", true);
  Problem problem(2, 10, 4, 2.0);
  problem.AddDurationConstraint(2, 4);
  problem.AddPathEnergyCost();
  // Too slow to be on one side of the other ball at one time, and on the other at the next.
  problem.AddVelocityBounds(Vector2d(-2, -2), Vector2d(2, 2));
  const Vector2d start(2.2, 0.3), goal(3.6, 0.3);
  problem.AddPathPositionConstraint(start, start, 0);
  problem.AddPathPositionConstraint(goal, goal, 1);
  const auto through = Find(problem);
  ASSERT_TRUE(through.result.is_success()) << through.result.message;
  const auto nearest = [&](const KinematicTrajectory& found) {
    double least = kInfinity;
    for (int k = 0; k <= 300; ++k) {
      const VectorXd q = found.trajectory->value(found.trajectory->end_time() * k / 300);
      least = std::min(least, arm.Distances(q, {0})[0]);
    }
    return least;
  };
  EXPECT_LT(nearest(through), 0);
  problem.SetInitialGuess(*through.trajectory);
  problem.AddMinimumDistanceConstraint(arm, 0.02, VectorXd::LinSpaced(41, 0, 1));
  const auto around = Find(problem);
  ASSERT_TRUE(around.result.is_success()) << around.result.message;
  EXPECT_GE(nearest(around), 0.02 - 5e-3);
  EXPECT_GT(around.result.objective, through.result.objective);
}

// ---- Mistakes ----

TEST(RobotMistakes, OfEfforts) {
  const RigidBodyModel arm = Fake("two_link");
  Problem problem(2, 8);
  EXPECT_EQ(Said([&] { problem.AddEffortBoundsAtNormalizedTimes(arm, Times({0.5})); }),
            "AddEffortBoundsAtNormalizedTimes divides by the duration, which needs a bound above "
            "0: call AddDurationConstraint first");
  problem.AddDurationConstraint(0.1, 5);
  EXPECT_EQ(Said([&] {
              problem.AddEffortBoundsAtNormalizedTimes(arm, Times({0.5, 1.5}));
            }),
            "AddEffortBoundsAtNormalizedTimes: s needs to be from 0 to 1, got 1.5");
  EXPECT_EQ(Said([&] {
              problem.AddEffortBoundsAtNormalizedTimes(arm, Times({0.5}), Vector2d(0, 2),
                                                       Vector2d(1, 1));
            }),
            "AddEffortBoundsAtNormalizedTimes: lb[1] = 2 is above ub[1] = 1");
  EXPECT_EQ(
      Said([&] { problem.AddEffortBoundsAtNormalizedTimes(arm, Times({0.5}), Vector3d(0, 0, 0)); }),
      "AddEffortBoundsAtNormalizedTimes: lb needs 2 entries, one for each position, got 3");
  EXPECT_EQ(
      Said([&] { problem.AddEffortBoundsAtNormalizedTimes(Fake("pan_tilt"), Times({0.5})); }),
      "AddEffortBoundsAtNormalizedTimes needs a joint with a finite bound: \"pan_tilt\" has none");
  EXPECT_EQ(Said([&] {
              problem.AddEffortBoundsAtNormalizedTimes(arm, Times({0.5}),
                                                       VectorXd::Constant(2, -kInfinity),
                                                       VectorXd::Constant(2, kInfinity));
            }),
            "AddEffortBoundsAtNormalizedTimes needs a joint with a finite bound: those given have "
            "none");
  Problem other(3, 8);
  EXPECT_EQ(Said([&] { other.AddEffortBoundsAtNormalizedTimes(arm, Times({0.5})); }),
            "AddEffortBoundsAtNormalizedTimes needs a model of 3 joints, one for each position, "
            "got \"two_link\" of 2");
  EXPECT_EQ(Said([&] { other.AddJointLimits(arm); }),
            "AddJointLimits needs a model of 3 joints, one for each position, got \"two_link\" of "
            "2");
  EXPECT_TRUE(problem.prog().generic_constraints().empty());
}

TEST(RobotMistakes, OfFrames) {
  const RigidBodyModel arm = Fake("two_link");
  Problem problem(2, 8);
  const Vector3d one = Vector3d::Ones();
  EXPECT_EQ(Said([&] { problem.AddFramePositionConstraint(arm, "tipp", -one, one, 0.5); }),
            "\"two_link\" has no frame \"tipp\"; is \"tip\" meant?");
  EXPECT_EQ(Said([&] { problem.AddFramePositionConstraint(arm, "tip", one, -one, 0.5); }),
            "AddFramePositionConstraint: lower[0] = 1 is above upper[0] = -1");
  EXPECT_EQ(Said([&] { problem.AddFramePositionConstraint(arm, "tip", -one, one, -0.5); }),
            "AddFramePositionConstraint: s needs to be from 0 to 1, got -0.5");
  EXPECT_EQ(Said([&] {
              problem.AddFrameOrientationConstraint(arm, "tip", 2 * Matrix3d::Identity(), 0.1, 0);
            }),
            "AddFrameOrientationConstraint needs axes that are a rotation: orthonormal columns, of "
            "determinant 1");
  EXPECT_EQ(
      Said([&] { problem.AddFrameOrientationConstraint(arm, "tip", Matrix3d::Identity(), 4, 0); }),
      "AddFrameOrientationConstraint needs a tolerance from 0 to below pi, got 4");
}

TEST(RobotMistakes, OfDistancesAndEffortsAlong) {
  const RigidBodyModel arm = Fake("two_link"), shaped = Fake("two_link", true);
  Problem problem(2, 8);
  EXPECT_EQ(Said([&] { problem.AddMinimumDistanceConstraint(arm, 0.1, Times({0.5})); }),
            "AddMinimumDistanceConstraint needs a pair of shapes or more, and \"two_link\" has "
            "none: load it with geometry");
  EXPECT_EQ(Said([&] {
              problem.AddMinimumDistanceConstraint(shaped, 0.1, Times({0.5}), std::vector<int>{3});
            }),
            "DistanceFunction: a pair of \"two_link\" needs an index from 0 to below 1, got 3");
  const BsplineTrajectory<double> curve({4, 5}, RandomCurves(1).Matrices(5, 3, 1));
  EXPECT_EQ(Said([&] { (void)EffortViolation(arm, curve); }),
            "EffortsAlong needs a trajectory of 2 x 1, one for each joint of \"two_link\", got 3 x "
            "1");
  EXPECT_EQ(Said([&] { (void)EffortViolation(arm, curve, {}, {}, 0); }),
            "EffortViolation needs 1 sample or more, got 0");
}

}  // namespace
}  // namespace switchyard::testing
