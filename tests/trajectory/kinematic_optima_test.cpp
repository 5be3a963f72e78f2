// Trajectories of least time, length and energy, by closed forms and invariances; what is said of
// arguments and answers that are wrong.
#include <cmath>

#include "switchyard/trajectory/composite_trajectory.hpp"
#include "switchyard/trajectory/kinematic_trajectory_optimization.hpp"
#include "tests/model/said.hpp"
#include "tests/nonlinear/backends.hpp"
#include "tests/trajectory/curves.hpp"

namespace switchyard::testing {
namespace {

using Eigen::Vector2d;
using Eigen::VectorXd;
using Problem = KinematicTrajectoryOptimization;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

VectorXd All(int n, double value) { return VectorXd::Constant(n, value); }

void Join(Problem& problem, const VectorXd& start, const VectorXd& goal) {
  problem.AddPathPositionConstraint(start, start, 0);
  problem.AddPathPositionConstraint(goal, goal, 1);
}

void RestAtBothEnds(Problem& problem) {
  const VectorXd zero = VectorXd::Zero(problem.num_positions());
  problem.AddPathVelocityConstraint(zero, zero, 0);
  problem.AddPathVelocityConstraint(zero, zero, 1);
}

class KinematicOptimum : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!IsThere("ipopt")) GTEST_SKIP() << "ipopt was not built";
  }
  static KinematicTrajectory Find(const Problem& problem) {
    const SolverInterface ipopt("ipopt", Built());
    return problem.FindTrajectory({}, &ipopt);
  }
  /// One joint from rest at 0 to rest at `distance`.
  static double LeastTime(double distance, double velocity, double acceleration, int points) {
    Problem problem(1, points);
    problem.AddDurationCost();
    problem.AddVelocityBounds(All(1, -velocity), All(1, velocity));
    problem.AddAccelerationBounds(All(1, -acceleration), All(1, acceleration));
    Join(problem, All(1, 0), All(1, distance));
    RestAtBothEnds(problem);
    const auto found = Find(problem);
    EXPECT_TRUE(found.result.is_success()) << found.result.message;
    return found.result.objective;
  }
};

// Full acceleration, full velocity, full deceleration: d / v + v / a.
TEST_F(KinematicOptimum, OfTimeComesNearTheTrapezoidFromAbove) {
  const double exact = 3.0 / 1.5 + 1.5 / 2;
  double before = kInfinity;
  for (const int points : {8, 16, 32, 64}) {
    const double time = LeastTime(3, 1.5, 2, points);
    EXPECT_GE(time, exact - 1e-6);
    EXPECT_LE(time, before + 1e-6);
    before = time;
  }
  EXPECT_LE(before, 1.01 * exact);
}

// The velocity bound out of reach: 2 sqrt(d / a).
TEST_F(KinematicOptimum, OfTimeComesNearTheBangBangFromAbove) {
  const double exact = 2 * std::sqrt(3.0 / 2);
  const double time = LeastTime(3, 100, 2, 64);
  EXPECT_GE(time, exact - 1e-6);
  EXPECT_LE(time, 1.01 * exact);
}

// With time in another unit bounds of derivative k are c^-k of what they were, and T is c times.
TEST_F(KinematicOptimum, IsIndifferentToTheUnitOfTime) {
  const double time = LeastTime(3, 1.5, 2, 16);
  for (const double c : {1e-2, 1e2}) {
    EXPECT_NEAR(LeastTime(3, 1.5 / c, 2 / (c * c), 16), c * time, 1e-5 * c * time);
  }
}

TEST_F(KinematicOptimum, IsSymmetricInStartAndGoal) {
  const auto find = [](const VectorXd& start, const VectorXd& goal) {
    Problem problem(2, 12);
    problem.AddDurationCost();
    problem.AddPathEnergyCost(0.1);
    problem.AddVelocityBounds(Vector2d(-1, -2), Vector2d(1, 2));
    problem.AddAccelerationBounds(Vector2d(-3, -2), Vector2d(3, 2));
    problem.AddJerkBounds(All(2, -20), All(2, 20));
    Join(problem, start, goal);
    RestAtBothEnds(problem);
    return Find(problem);
  };
  const Vector2d a(0.5, -1), b(2, 1.5);
  const auto there = find(a, b), back = find(b, a);
  ASSERT_TRUE(there.trajectory && back.trajectory);
  EXPECT_NEAR(there.result.objective, back.result.objective, 1e-6);
  const double T = there.trajectory->end_time();
  for (const double s : {0.0, 0.2, 0.5, 0.9, 1.0}) {
    EXPECT_LE(Distance(there.trajectory->value(s * T), back.trajectory->value((1 - s) * T)), 1e-4);
  }
}

TEST_F(KinematicOptimum, KeepsItsBoundsBetweenControlPointsToo) {
  Problem problem(2, 10);
  problem.AddDurationCost();
  problem.AddPathLengthCost(0.5);
  const Vector2d v(1, 0.7), a(3, 2), j(15, 10);
  problem.AddPositionBounds(All(2, -1), All(2, 2.5));
  problem.AddVelocityBounds(-v, v);
  problem.AddAccelerationBounds(-a, a);
  problem.AddJerkBounds(-j, j);
  Join(problem, Vector2d(0, 0), Vector2d(2, -0.9));
  RestAtBothEnds(problem);
  const auto found = Find(problem);
  ASSERT_TRUE(found.result.is_success()) << found.result.message;
  const auto& curve = *found.trajectory;
  const Vector2d bound[] = {v, a, j};
  for (int i = 0; i <= 1000; ++i) {
    const double t = curve.end_time() * i / 1000;
    for (int k = 1; k <= 3; ++k) {
      EXPECT_LE((curve.EvalDerivative(t, k).cwiseAbs() - bound[k - 1]).maxCoeff(), 1e-5);
    }
    EXPECT_LE((curve.value(t) - All(2, 2.5)).maxCoeff(), 1e-6);
    EXPECT_LE((All(2, -1) - curve.value(t)).maxCoeff(), 1e-6);
  }
  ASSERT_EQ(found.bound_violation.size(), 4);
  for (const double one : found.bound_violation) EXPECT_LE(one, 1e-5);
}

// A straight line from start to goal, whatever the form of the cost.
TEST_F(KinematicOptimum, OfLengthIsTheDistance) {
  for (const bool conic : {false, true}) {
    Problem problem(2, 8);
    problem.AddDurationConstraint(1, 2);
    const auto costs = problem.AddPathLengthCost(2, conic);
    EXPECT_EQ(costs.size(), 7);
    Join(problem, Vector2d(0, 0), Vector2d(3, 4));
    const auto found = Find(problem);
    ASSERT_TRUE(found.result.is_success()) << found.result.message;
    EXPECT_NEAR(found.result.objective, 10, 1e-5);
  }
}

// sum w |p_j - p_{j-1}|^2 over N - 1 legs: w d^2 / (N - 1), by equal legs.
TEST_F(KinematicOptimum, OfEnergyHasEqualLegs) {
  Problem problem(2, 6);
  problem.AddDurationConstraint(1, 2);
  problem.AddPathEnergyCost(3);
  Join(problem, Vector2d(1, 0), Vector2d(4, 4));
  const auto found = Find(problem);
  ASSERT_TRUE(found.result.is_success()) << found.result.message;
  EXPECT_NEAR(found.result.objective, 3 * 25.0 / 5, 1e-6);
  const Eigen::MatrixXd P = found.result.GetSolution(problem.control_points());
  for (int j = 1; j < 6; ++j) {
    EXPECT_LE((P.col(j) - P.col(j - 1) - Vector2d(0.6, 0.8)).norm(), 1e-5);
  }
}

TEST_F(KinematicOptimum, IsWhatTheProgramSaysAtEveryTime) {
  Problem problem(2, 10);
  problem.AddDurationCost();
  problem.AddVelocityBounds(All(2, -1), All(2, 1));
  Join(problem, Vector2d(0, 0), Vector2d(1, -1));
  problem.AddPathPositionConstraint(Vector2d(0.8, 0.2), Vector2d(0.9, 0.3), 0.35);
  const auto found = Find(problem);
  ASSERT_TRUE(found.result.is_success()) << found.result.message;
  const auto curve = problem.ReconstructTrajectory(found.result);
  const Eigen::MatrixXd P = found.result.GetSolution(problem.control_points());
  EXPECT_NEAR(curve.end_time(), found.result.GetSolution(problem.duration()), 1e-15);
  for (const double s : {0.0, 0.3, 0.35, 0.8, 1.0}) {
    const VectorXd r = P * problem.basis().EvaluateLinearInControlPoints(s);
    EXPECT_LE(Distance(curve.value(s * curve.end_time()), r), 1e-12);
  }
  const VectorXd through = curve.value(0.35 * curve.end_time());
  EXPECT_GE(through[0], 0.8 - 1e-6);
  EXPECT_LE(through[1], 0.3 + 1e-6);
}

TEST_F(KinematicOptimum, WithAllBoundsAndManyControlPointsIsFound) {
  Problem problem(3, 200);
  problem.AddDurationCost();
  problem.AddVelocityBounds(All(3, -1), All(3, 1));
  problem.AddAccelerationBounds(All(3, -3), All(3, 3));
  problem.AddJerkBounds(All(3, -20), All(3, 20));
  Join(problem, All(3, 0), Eigen::Vector3d(1, -0.5, 0.3));
  RestAtBothEnds(problem);
  const auto found = Find(problem);
  EXPECT_TRUE(found.result.is_success()) << found.result.message;
}

TEST_F(KinematicOptimum, StartingOutsideOfThePositionBoundsIsInfeasible) {
  Problem problem(1, 6);
  problem.AddDurationCost();
  problem.AddPositionBounds(All(1, -1), All(1, 1));
  Join(problem, All(1, 2), All(1, 0));
  const auto found = Find(problem);
  EXPECT_EQ(found.result.termination, Termination::kInfeasible);
  EXPECT_FALSE(found.trajectory);
}

// Without a bound on it nothing keeps the duration from 0 where start and goal are one.
TEST_F(KinematicOptimum, WhoseDurationVanishesIsNoTrajectory) {
  Problem problem(1, 6);
  problem.AddDurationConstraint(0, 0);
  Join(problem, All(1, 1), All(1, 1));
  problem.AddPathEnergyCost();
  const auto found = Find(problem);
  EXPECT_FALSE(found.trajectory);
  EXPECT_EQ(found.result.termination, Termination::kNumericalTrouble);
  ASSERT_FALSE(found.result.notes.empty());
  EXPECT_EQ(found.result.notes.back(), "the duration vanishes: 0 s, where the guess has 1 s");
  EXPECT_EQ(Said([&] { (void)problem.ReconstructTrajectory(found.result); }),
            "ReconstructTrajectory: the duration vanishes: 0 s, where the guess has 1 s");
}

// ---- Guesses ----

Eigen::MatrixXd GuessOf(const Problem& problem) {
  return problem.prog()
      .GetInitialGuess(problem.control_points())
      .reshaped(problem.num_positions(), problem.num_control_points());
}

TEST(KinematicGuess, IsZeroForTheDuration) {
  const Problem problem(2, 5, 4, 3.0);
  EXPECT_EQ(GuessOf(problem).norm(), 0);
  EXPECT_EQ(problem.prog().GetInitialGuess(problem.duration()), 3);
}

TEST(KinematicGuess, OfASplineIsItsPointsWhateverItsStart) {
  RandomCurves random(4);
  const BsplineTrajectory<double> curve({4, 7, KnotVectorType::kClampedUniform, 5, 7.5},
                                        random.Matrices(7, 3, 1));
  Problem built(curve), set(3, 7);
  set.SetInitialGuess(curve);
  for (const Problem* problem : {&built, &set}) {
    EXPECT_EQ(problem->prog().GetInitialGuess(problem->duration()), 2.5);
    for (int j = 0; j < 7; ++j) {
      EXPECT_EQ(GuessOf(*problem).col(j), curve.control_points()[static_cast<std::size_t>(j)]);
    }
  }
}

// A spline of 7 points is one of 7 + 4 with those knots inserted: interpolation finds it.
TEST(KinematicGuess, OfMorePointsIsTheSameCurve) {
  RandomCurves random(4);
  BsplineTrajectory<double> curve({4, 7, KnotVectorType::kClampedUniform, 0, 2},
                                  random.Matrices(7, 2, 1));
  Problem problem(2, 11);  // knots at eighths, those of the curve at quarters
  problem.SetInitialGuess(curve);
  MathematicalProgramResult result;
  std::vector<Variable> all;
  for (const Variable v : problem.prog().decision_variables()) all.push_back(v);
  result.SetPoint(all, problem.prog().initial_guess());
  ExpectSameCurve(problem.ReconstructTrajectory(result), curve, 1e-11);
}

// ---- Mistakes ----

TEST(KinematicMistakes, OfConstruction) {
  EXPECT_EQ(Said([] { Problem(2, 3); }),
            "KinematicTrajectoryOptimization needs 4 control points or more for order 4, got 3");
  EXPECT_EQ(Said([] { Problem(0, 5); }),
            "KinematicTrajectoryOptimization needs a position or more, got 0");
  EXPECT_EQ(Said([] { Problem(1, 5, 4, 0); }),
            "KinematicTrajectoryOptimization needs a duration above 0 and finite, got 0");
}

TEST(KinematicMistakes, OfBounds) {
  Problem problem(2, 5);
  const int rows = static_cast<int>(problem.prog().GetAllConstraints().size());
  EXPECT_EQ(Said([&] { problem.AddVelocityBounds(Vector2d(0, 2), Vector2d(1, 1)); }),
            "AddVelocityBounds: lb[1] = 2 is above ub[1] = 1");
  EXPECT_EQ(Said([&] { problem.AddAccelerationBounds(All(3, 0), All(3, 1)); }),
            "AddAccelerationBounds: lb needs 2 entries, one for each position, got 3");
  EXPECT_EQ(Said([&] { problem.AddPositionBounds(All(2, std::nan("")), All(2, 1)); }),
            "AddPositionBounds: lb[0] needs to be a number, got nan");
  EXPECT_EQ(Said([&] { problem.AddDurationConstraint(-1, 2); }),
            "AddDurationConstraint needs lb of 0 or more and finite, got -1");
  EXPECT_EQ(Said([&] { problem.AddDurationConstraint(3, 2); }),
            "AddDurationConstraint: lb = 3 is above ub = 2");
  EXPECT_EQ(Said([&] { Problem(1, 5, 3).AddJerkBounds(All(1, 0), All(1, 1)); }),
            "AddJerkBounds needs a spline of order 4 or more, got 3");
  EXPECT_EQ(static_cast<int>(problem.prog().GetAllConstraints().size()), rows);
}

TEST(KinematicMistakes, OfTimesAndPlaceholders) {
  Problem problem(2, 5);
  const auto zero = All(2, 0);
  EXPECT_EQ(Said([&] { problem.AddPathPositionConstraint(zero, zero, 1.5); }),
            "AddPathPositionConstraint: s needs to be from 0 to 1, got 1.5");
  EXPECT_EQ(Said([&] { problem.AddPathVelocityConstraint(zero, zero, std::nan("")); }),
            "AddPathVelocityConstraint: s needs to be from 0 to 1, got nan");
  EXPECT_EQ(Said([&] { problem.AddCostAtNormalizedTimes(problem.duration() * 2, All(1, 0)); }),
            "AddCostAtNormalizedTimes needs its variables among q(), qdot() and qddot(), got "
            "duration");
  EXPECT_EQ(Said([&] { problem.AddCostAtNormalizedTimes(sin(problem.qdot()[0]), All(1, 0)); }),
            "AddCostAtNormalizedTimes divides by the duration, which needs a bound above 0: call "
            "AddDurationConstraint first");
  const auto rows = std::make_shared<LinearConstraint>(Eigen::Matrix2d::Identity(), zero, zero);
  EXPECT_EQ(Said([&] {
              problem.AddVelocityConstraintAtNormalizedTime(std::shared_ptr<Constraint>(rows), 0);
            }),
            "AddVelocityConstraintAtNormalizedTime needs a constraint of 4 variables, positions "
            "and then velocities, got one of 2");
  EXPECT_EQ(Said([&] {
              problem.AddVelocityConstraintAtNormalizedTime(
                  Binding<LinearConstraint>(rows, problem.q()), 0);
            }),
            "AddVelocityConstraintAtNormalizedTime needs a linear constraint of qdot() alone, got "
            "linear constraint of q() or qddot()");
}

TEST(KinematicMistakes, OfWeightsGuessesAndResults) {
  Problem problem(2, 5);
  EXPECT_EQ(Said([&] { problem.AddPathLengthCost(-1); }),
            "AddPathLengthCost needs a weight of 0 or more and finite, got -1");
  EXPECT_EQ(Said([&] { problem.AddTimeIntegralCost(problem.q()[0] * 1, 0); }),
            "AddTimeIntegralCost needs from 1 to 100 points for each interval, got 0");
  EXPECT_EQ(Said([&] {
              problem.SetInitialGuess(
                  BsplineTrajectory<double>({4, 5}, RandomCurves(1).Matrices(5, 3, 1)));
            }),
            "SetInitialGuess needs a trajectory of 2 x 1, got 3 x 1");
  EXPECT_EQ(Said([&] { (void)problem.ReconstructTrajectory({}); }),
            "ReconstructTrajectory needs a result with a point of prog(), got none: not_solved");
}

}  // namespace
}  // namespace switchyard::testing
