// From a trajectory through regions to a motion: that it stays in its regions and under its limits,
// at all times and not at knots alone.
#include "switchyard/trajectory/smooth_trajectory.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "switchyard/trajectory/efforts.hpp"
#include "tests/nonlinear/backends.hpp"
#include "tests/support/fake_dynamics.hpp"
#include "tests/trajectory/gcs_problems.hpp"

namespace switchyard::testing {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

CompositeTrajectory<double> Line(const std::vector<VectorXd>& corners) {
  std::vector<TrajectoryPointer<double>> segments;
  for (std::size_t i = 1; i < corners.size(); ++i) {
    MatrixXd points(corners[0].size(), 2);
    points << corners[i - 1], corners[i];
    const auto t = static_cast<double>(i);
    segments.emplace_back(BezierCurve<double>(t - 1, t, points));
  }
  return CompositeTrajectory<double>(segments);
}

/// The largest |derivative| of each position, over 1000 times.
VectorXd LargestOf(const Trajectory<double>& curve, int k) {
  VectorXd largest = VectorXd::Zero(curve.rows());
  for (int i = 0; i <= 1000; ++i) {
    const VectorXd value = curve.EvalDerivative(curve.end_time() * i / 1000, k);
    largest = largest.cwiseMax(value.cwiseAbs());
  }
  return largest;
}

class Smoothed : public ::testing::Test {
 protected:
  void SetUp() override {
    SKIP_WITHOUT("ipopt");
    ipopt = std::make_unique<SolverInterface>("ipopt", Built());
    options.solver = ipopt.get();
  }
  void ExpectLimits(const SmoothedTrajectory& motion) const {
    const std::optional<VectorXd> limits[] = {options.velocity, options.acceleration, options.jerk};
    for (int k = 1; k <= 3; ++k) {
      if (!limits[k - 1]) continue;
      EXPECT_LE((LargestOf(*motion.trajectory, k) - *limits[k - 1]).maxCoeff(), 1e-5) << k;
    }
  }
  std::unique_ptr<SolverInterface> ipopt;
  SmoothingOptions options;
};

/// How far a point is from the union of the regions.
double Outside(const ConvexSets& regions, const VectorXd& x) {
  double least = kInfinity;
  for (const auto& region : regions) least = std::min(least, region->Violation(x));
  return least;
}

// Rooms of a maze, whose walls stand between them.
ConvexSets Maze() {
  const auto room = [](double x0, double y0, double x1, double y1) {
    return ConvexSetPointer(HPolyhedron::MakeBox(Vector2d(x0, y0), Vector2d(x1, y1)));
  };
  return {room(0, 0, 1, 4),     room(0, 3.2, 3, 4), room(2.2, 0.5, 3, 4), room(2.2, 0.5, 5, 1.2),
          room(4.3, 0.5, 5, 4), room(4.3, 3, 7, 4), room(0, 0, 1.8, 0.6)};
}

TEST_F(Smoothed, StaysInTheRoomsOfItsPath) {
  const Vector2d start(0.5, 0.4), goal(6.5, 3.5);
  Through maze(start, Maze(), goal, 3);
  maze.gcs.AddTimeCost();
  maze.gcs.AddPathLengthCost(0.1);
  maze.gcs.AddVelocityBounds(Vector2d(-1, -1), Vector2d(1, 1));
  const GcsTrajectory found = maze.Find();
  ASSERT_TRUE(found.result().is_success()) << found.result().message;
  options.velocity = Vector2d(1, 1);
  options.acceleration = Vector2d(3, 3);
  options.jerk = Vector2d(30, 30);
  const SmoothedTrajectory motion = SmoothTrajectory(maze.gcs, found, options);
  ASSERT_TRUE(motion.result.is_success()) << motion.result.message;
  const auto& curve = *motion.trajectory;
  EXPECT_LE(motion.region_violation, 1e-6);
  for (int i = 0; i <= 1000; ++i) {
    const VectorXd x = curve.value(curve.end_time() * i / 1000);
    EXPECT_LE(Outside(Maze(), x), motion.region_violation + 1e-12) << x.transpose();
  }
  ExpectLimits(motion);
  EXPECT_LE((curve.InitialValue() - start).norm(), 1e-6);
  EXPECT_LE((curve.FinalValue() - goal).norm(), 1e-6);
  for (const int k : {1, 2}) {
    EXPECT_LE(curve.EvalDerivative(0, k).norm(), 1e-5);
    EXPECT_LE(curve.EvalDerivative(curve.end_time(), k).norm(), 1e-5);
  }
  // It cannot be faster than what has no limit of acceleration.
  EXPECT_GT(curve.end_time(), found.trajectory.end_time());
}

// Without regions the way is straight; with them it goes around the corner.
TEST_F(Smoothed, GoesAroundCornersBecauseOfItsRegions) {
  const auto path =
      Line({Vector2d(0.5, 0.5), Vector2d(0.5, 2.5), Vector2d(4.5, 2.5), Vector2d(4.5, 0.5)});
  options.velocity = Vector2d(1, 1);
  options.acceleration = Vector2d(2, 2);
  options.length_weight = 0.1;
  const auto straight = SmoothTrajectory(path, {}, options);
  const auto around = SmoothTrajectory(path, Corridor(), options);
  ASSERT_TRUE(straight.result.is_success() && around.result.is_success());
  EXPECT_LE(LargestOf(straight.trajectory->CopyBlock(1, 0, 1, 1), 1)[0], 1e-3);
  EXPECT_EQ(straight.region_violation, 0);
  EXPECT_GT(Outside(Corridor(), straight.trajectory->value(straight.trajectory->end_time() / 2)),
            0.5);
  EXPECT_LE(around.region_violation, 1e-6);
  EXPECT_GT(around.trajectory->end_time(), straight.trajectory->end_time());
  EXPECT_EQ(straight.trajectory->num_control_points(), 40);
  EXPECT_GE(around.trajectory->num_control_points(), 3 * 4 + 4);  // 4 intervals a segment
}

// Rest to rest along a line: the closed form of the fastest motion under |acceleration| alone is
// 2 sqrt(d / a); splines come near it from above.
TEST_F(Smoothed, IsNearlyAsFastAsAnythingCanBe) {
  const auto path = Line({VectorXd::Zero(1), VectorXd::Constant(1, 2)});
  options.acceleration = VectorXd::Constant(1, 0.5);
  options.spline_order = 3;
  options.num_control_points = 40;
  const auto motion = SmoothTrajectory(path, {}, options);
  ASSERT_TRUE(motion.result.is_success());
  EXPECT_GE(motion.trajectory->end_time(), 4 - 1e-6);
  EXPECT_LE(motion.trajectory->end_time(), 4.1);
}

TEST_F(Smoothed, KeepsEffortsBetweenTheTimesWhereTheyWereAskedFor) {
  const RigidBodyModel arm = Fake("two_link");
  const auto path = Line({Vector2d(0, 0), Vector2d(0.8, -0.4), Vector2d(1.3, 0.2)});
  const ConvexSets regions =
      MakeConvexSets(Hyperrectangle(Vector2d(-0.1, -0.6), Vector2d(0.9, 0.1)),
                     Hyperrectangle(Vector2d(0.7, -0.6), Vector2d(1.4, 0.3)));
  options.model = arm;
  options.acceleration = Vector2d(40, 40);
  const auto motion = SmoothTrajectory(path, regions, options);
  ASSERT_TRUE(motion.result.is_success()) << motion.result.message;
  EXPECT_LE(motion.region_violation, 1e-6);
  EXPECT_LE(motion.effort_violation, 0.02);
  EXPECT_LE(EffortViolation(arm, *motion.trajectory, {}, {}, 2000).amount, 0.02);
  EXPECT_LE((LargestOf(*motion.trajectory, 1) - arm.velocity_limits()).maxCoeff(), 1e-5);
  // Efforts do limit it: with less of them it takes longer.
  options.effort = 0.8 * arm.effort_limits();
  const auto weaker = SmoothTrajectory(path, regions, options);
  ASSERT_TRUE(weaker.result.is_success()) << weaker.result.message;
  EXPECT_GT(weaker.trajectory->end_time(), 1.02 * motion.trajectory->end_time());
  EXPECT_LE(
      EffortViolation(arm, *weaker.trajectory, -*options.effort, *options.effort, 2000).amount,
      0.02);
}

TEST_F(Smoothed, TakesMoreThatIsAsked) {
  const auto path = Line({Vector2d(0, 0), Vector2d(2, 0)});
  options.velocity = Vector2d(1, 1);
  const Vector2d high(1, 1);
  options.more = [&](KinematicTrajectoryOptimization& problem) {
    problem.AddPathPositionConstraint(high, high, 0.5);
  };
  const auto motion = SmoothTrajectory(path, {}, options);
  ASSERT_TRUE(motion.result.is_success());
  EXPECT_LE((motion.trajectory->value(motion.trajectory->end_time() / 2) - high).norm(), 1e-6);
}

// A joint that turns on past pi: regions around the circle, each half a turn away from the last.
TEST_F(Smoothed, UnwrapsContinuousJointsAndTheirRegions) {
  GcsTrajectoryOptimization gcs(1, {0});
  auto& rooms = gcs.AddRegions(
      MakeConvexSets(Hyperrectangle(One(1.5), One(3.5)), Hyperrectangle(One(-3), One(-1))), 2);
  auto& start = gcs.AddRegions(At(One(2)), 0, 0, 0);
  auto& goal = gcs.AddRegions(At(One(-2)), 0, 0, 0);
  gcs.AddEdges(start, rooms);
  gcs.AddEdges(rooms, goal);
  gcs.AddTimeCost();
  gcs.AddVelocityBounds(One(-1), One(1));
  const auto found = gcs.FindPath(start, goal);
  ASSERT_TRUE(found.result().is_success()) << found.result().message;
  options.velocity = One(1);
  options.acceleration = One(5);
  const auto motion = SmoothTrajectory(gcs, found, options);
  ASSERT_TRUE(motion.result.is_success()) << motion.result.message;
  EXPECT_NEAR(motion.trajectory->FinalValue()(0) - motion.trajectory->InitialValue()(0),
              2 * std::numbers::pi - 4, 1e-6);
  EXPECT_LE(motion.region_violation, 1e-6);
}

// ---- Mistakes ----

TEST(SmoothingMistakes, OfTrajectoriesAndRegions) {
  SmoothingOptions options;
  options.velocity = Vector2d(1, 1);
  const auto path = Line({Vector2d(0, 0), Vector2d(1, 0), Vector2d(1, 1)});
  const auto said = [&](const CompositeTrajectory<double>& found, const ConvexSets& regions) {
    return Thrown([&] { (void)SmoothTrajectory(found, regions, options); });
  };
  EXPECT_EQ(said(CompositeTrajectory<double>({}), {}),
            "SmoothTrajectory needs a trajectory with a segment or more, got none");
  EXPECT_EQ(said(path, Box(Vector2d(0, 0), Vector2d(1, 1))),
            "SmoothTrajectory needs 2 regions, one for each segment, got 1");
  const ConvexSets flat = {Range(0, 1)[0], Range(0, 1)[0]};
  EXPECT_EQ(said(path, flat), "SmoothTrajectory: region 0 needs 2 dimensions, got 1");
  const auto first = Line({Vector2d(0, 0), Vector2d(1, 0)});
  const auto second = Line({Vector2d(1, 3), Vector2d(1, 1)}).StartingAt(1);
  EXPECT_EQ(said(CompositeTrajectory<double>({first, TrajectoryPointer<double>(*second)}), {}),
            "SmoothTrajectory needs segments that join: segment 1 starts 3 from where the one "
            "before ends");
  GcsTrajectoryOptimization gcs(2);
  EXPECT_EQ(Thrown([&] { (void)SmoothTrajectory(gcs, GcsTrajectory{}, options); }),
            "SmoothTrajectory needs a path with a segment or more, got none: ");
}

TEST(SmoothingMistakes, OfOptions) {
  const auto path = Line({Vector2d(0, 0), Vector2d(1, 0)});
  const auto said = [&](const SmoothingOptions& options) {
    return Thrown([&] { (void)SmoothTrajectory(path, {}, options); });
  };
  SmoothingOptions options;
  EXPECT_EQ(said(options),
            "SmoothTrajectory needs a limit of velocity, acceleration or jerk: without, the "
            "duration vanishes");
  options.velocity = One(1);
  EXPECT_EQ(
      said(options),
      "SmoothTrajectory: the limit of velocity needs 2 entries, one for each position, got 1");
  options.velocity = Vector2d(1, -1);
  EXPECT_EQ(said(options),
            "SmoothTrajectory: the limit of velocity needs entries above 0, got -1 at 1");
  options.velocity = Vector2d(1, 1);
  options.jerk = Vector2d(1, kInfinity);
  options.spline_order = 3;
  EXPECT_EQ(said(options),
            "SmoothTrajectory needs a spline_order of 4 or more for these limits, got 3");
  options.spline_order = 50;
  EXPECT_EQ(said(options), "SmoothTrajectory needs 50 control points or more for order 50, got 40");
  options.spline_order = 5;
  options.effort = Vector2d(1, 1);
  EXPECT_EQ(said(options), "SmoothTrajectory needs a model for a limit of efforts");
  options.effort.reset();
  options.model = Fake("two_link");
  const auto joint = Line({One(0), One(1)});
  options.velocity = One(1);
  options.jerk.reset();
  EXPECT_EQ(Thrown([&] { (void)SmoothTrajectory(joint, {}, options); }),
            "SmoothTrajectory needs a model of 1 joint, got \"two_link\" of 2");
}

}  // namespace
}  // namespace switchyard::testing
