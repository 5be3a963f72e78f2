// Costs, velocities, regions and what is said of a trajectory, by closed forms.
#include <cmath>
#include <thread>

#include "switchyard/sets/hyperellipsoid.hpp"
#include "switchyard/sets/vpolytope.hpp"
#include "tests/trajectory/gcs_problems.hpp"

namespace switchyard {
namespace {

using namespace switchyard::testing;

constexpr double kInf = std::numeric_limits<double>::infinity();

TEST(GcsTrajectory, TheShortestWayInOneRegionIsStraight) {
  for (const int order : {1, 3, 6}) {
    Through problem(Vector2d(0, 0), Box(Vector2d(-1, -1), Vector2d(5, 5)), Vector2d(3, 4), order);
    problem.gcs.AddPathLengthCost();
    const GcsTrajectory found = problem.Find();
    ASSERT_TRUE(found.result().is_success()) << found.result().message;
    EXPECT_NEAR(found.result().objective, 5, 1e-6);
    EXPECT_LE(found.result().bound, 5 + 1e-6);
    EXPECT_TRUE(found.is_continuous);
    EXPECT_LT(found.violation.max(), 1e-6);
    EXPECT_EQ(found.vertices.size(), 3u);
    ASSERT_EQ(found.segment_vertices.size(), 1u);
    EXPECT_EQ(found.segment_vertices[0], problem.rooms.Vertices()[0]);
  }
}

TEST(GcsTrajectory, TheShortestWayRoundACornerTouchesIt) {
  Through problem(kCorridorStart, Corridor(), kCorridorGoal, 3);
  problem.gcs.AddPathLengthCost();
  const GcsTrajectory found = problem.Find();
  ASSERT_TRUE(found.result().is_success()) << found.result().message;
  EXPECT_NEAR(found.result().objective, kCorridorLength, 1e-5);
  EXPECT_NEAR(found.search.relaxation_cost, kCorridorLength, 1e-5);
  ASSERT_EQ(found.trajectory.get_number_of_segments(), 3);
  const auto& q = found.trajectory;
  EXPECT_LT((q.value(q.start_time()) - kCorridorStart).norm(), 1e-6);
  EXPECT_LT((q.value(q.end_time()) - kCorridorGoal).norm(), 1e-6);
  EXPECT_LT((q.value(q.end_time(0)) - Vector2d(1, 2)).norm(), 1e-3);
  EXPECT_LT((q.value(q.end_time(1)) - Vector2d(4, 2)).norm(), 1e-3);
}

TEST(GcsTrajectory, TheShortestTimeIsTheDistanceOverTheLargestVelocity) {
  Through problem(Vector2d(0, 0), Box(Vector2d(-1, -1), Vector2d(9, 9)), Vector2d(3, 4), 3);
  problem.gcs.AddTimeCost();
  problem.gcs.AddVelocityBounds(Vector2d(-1, -0.5), Vector2d(1, 0.5));
  const auto [q, result] = problem.gcs.SolvePath(problem.start, problem.goal);
  ASSERT_TRUE(result.is_success()) << result.message;
  EXPECT_NEAR(result.objective, 8, 1e-6);
  EXPECT_NEAR(q.end_time() - q.start_time(), 8, 1e-6);
  for (double t = 0; t < 8; t += 0.25) {
    const VectorXd v = q.EvalDerivative(t);
    EXPECT_LE(std::abs(v[0]), 1 + 1e-6);
    EXPECT_LE(std::abs(v[1]), 0.5 + 1e-6);
  }
}

TEST(GcsTrajectory, AnInfiniteVelocityBoundIsNone) {
  Through problem(Vector2d(0, 0), Box(Vector2d(-1, -1), Vector2d(9, 9)), Vector2d(3, 4), 2);
  problem.gcs.AddTimeCost();
  problem.rooms.AddVelocityBounds(Vector2d(-kInf, -kInf), Vector2d(1, kInf));
  EXPECT_NEAR(problem.Find().result().objective, 3, 1e-6);
  const auto rows = problem.rooms.Vertices()[0]->GetConstraints();
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].evaluator()->num_constraints(), 2);  // of one joint, of two control points
  problem.rooms.AddVelocityBounds(Vector2d(-kInf, -kInf), Vector2d(kInf, kInf));
  EXPECT_EQ(problem.rooms.Vertices()[0]->GetConstraints().size(), 1u);
}

TEST(GcsTrajectory, WeightsOfLengthAndEnergyAreAsDocumented) {
  const MatrixXd W = Vector2d(1, 2).asDiagonal();
  const auto cost = [&](auto add) {
    Through problem(Vector2d(0, 0), Box(Vector2d(-1, -1), Vector2d(9, 9)), Vector2d(3, 4), 1);
    add(problem.gcs);
    return problem.Find().result().objective;
  };
  using Gcs = GcsTrajectoryOptimization;
  EXPECT_NEAR(cost([](Gcs& g) { g.AddPathLengthCost(2); }), 10, 1e-5);
  EXPECT_NEAR(cost([&](Gcs& g) { g.AddPathLengthCost(W); }), std::sqrt(73.0), 1e-5);
  EXPECT_NEAR(cost([](Gcs& g) { g.AddPathEnergyCost(2); }), 50, 1e-4);
  EXPECT_NEAR(cost([&](Gcs& g) { g.AddPathEnergyCost(W); }), 73, 1e-4);
  const MatrixXd root = std::sqrt(2.0) * MatrixXd::Identity(2, 2);
  EXPECT_NEAR(cost([&](Gcs& g) { g.AddPathEnergyCost(root); }), 50, 1e-4);
}

TEST(GcsTrajectory, EnergyIsSpreadEvenlyOverTheLegs) {
  Through problem(One(0), Range(-1, 9), One(6), 3);
  problem.gcs.AddPathEnergyCost();
  EXPECT_NEAR(problem.Find().result().objective, 3 * 4, 1e-5);
}

TEST(GcsTrajectory, RegionsMayBeAnyConvexSets) {
  const MatrixXd corners = (MatrixXd(2, 4) << 0, 2, 2, 0, 0, 0, 2, 2).finished();
  const ConvexSets regions =
      MakeConvexSets(VPolytope(corners), Hyperellipsoid::MakeHypersphere(1.5, Vector2d(3, 1)));
  Through problem(Vector2d(0, 0), regions, Vector2d(4, 1), 2);
  problem.gcs.AddPathLengthCost();
  const GcsTrajectory found = problem.Find();
  ASSERT_TRUE(found.result().is_success()) << found.result().message;
  EXPECT_NEAR(found.result().objective, std::sqrt(17.0), 1e-4);
  EXPECT_LT(found.violation.regions, 1e-5);
}

TEST(GcsTrajectory, OfSeveralStartsAndGoalsTheBestIsTaken) {
  GcsTrajectoryOptimization gcs(2);
  auto& rooms = gcs.AddRegions(Corridor(), 3, 1e-6, 20, "rooms");
  auto& starts =
      gcs.AddRegions(MakeConvexSets(Point(Vector2d(0.5, 0.5)), Point(Vector2d(0.5, 2.5))), 0, 0, 0);
  auto& goals =
      gcs.AddRegions(MakeConvexSets(Point(Vector2d(4.5, 0.5)), Point(Vector2d(4.5, 2.5))), 0, 0, 0);
  gcs.AddEdges(starts, rooms);
  gcs.AddEdges(rooms, goals);
  gcs.AddPathLengthCost();
  const int vertices = gcs.graph_of_convex_sets().num_vertices();
  const GcsTrajectory found = gcs.FindPath(starts, goals);
  ASSERT_TRUE(found.result().is_success()) << found.result().message;
  EXPECT_NEAR(found.result().objective, 4, 1e-5);
  EXPECT_EQ(gcs.graph_of_convex_sets().num_vertices(), vertices);
  ASSERT_EQ(found.vertices.front(), starts.Vertices()[1]);
  ASSERT_EQ(found.vertices.back(), goals.Vertices()[1]);
  EXPECT_EQ(found.search.edges.size() + 1, found.vertices.size());
  for (const auto* edge : found.search.edges) {
    EXPECT_TRUE(gcs.graph_of_convex_sets().IsValid(*edge));
    EXPECT_NEAR(found.result().GetSolution(edge->phi()), 1, 1e-9);
  }
  const auto x = found.vertices.back()->GetSolution(found.result());
  ASSERT_TRUE(x.has_value());
  EXPECT_NEAR((*x)[1], 2.5, 1e-6);
  EXPECT_EQ(found.search.relaxed_flow.size(), gcs.graph_of_convex_sets().Edges().size());
  for (const RoundedPath& path : found.search.rounded) {
    for (const auto* edge : path.edges) EXPECT_TRUE(gcs.graph_of_convex_sets().IsValid(*edge));
  }
  // From a set of places to itself there is no way to go.
  const GcsTrajectory nowhere = gcs.FindPath(goals, goals);
  EXPECT_TRUE(nowhere.result().is_success()) << nowhere.result().message;
  EXPECT_EQ(nowhere.vertices.size(), 1u);
  EXPECT_EQ(nowhere.trajectory.get_number_of_segments(), 0);
}

TEST(GcsTrajectory, ThereMayBeNoWay) {
  GcsTrajectoryOptimization gcs(1);
  auto& left = gcs.AddRegions(Range(0, 1), 2, 0.1, 20, "left");
  auto& right = gcs.AddRegions(Range(2, 3), 2, 0.1, 20, "right");
  const GcsTrajectory found = gcs.FindPath(left, right);
  EXPECT_FALSE(found.result().is_success());
  EXPECT_EQ(found.result().termination, Termination::kInfeasible);
  EXPECT_FALSE(found.result().message.empty());
  EXPECT_EQ(found.trajectory.get_number_of_segments(), 0);
}

/// An error of the duals counts as often as the durations are long; but no segment takes longer
/// than all of the relaxation costs.
TEST(GcsTrajectory, ARelaxationIsSupportedHoweverLongSegmentsMayTake) {
  ConvexSets tiles;
  for (int k = 0; k < 16; ++k) {
    const Vector2d at(k / 4, k % 4), half(0.65, 0.6);
    tiles.emplace_back(Hyperrectangle(at - half, at + half));
  }
  Through problem(Vector2d(0, 0), tiles, Vector2d(3, 3), 3, 1e-2, 1e5);
  problem.gcs.AddTimeCost();
  problem.gcs.AddPathLengthCost();
  problem.gcs.AddVelocityBounds(Vector2d(-1, -1), Vector2d(1, 1));
  problem.gcs.AddPathContinuityConstraints(1);
  GraphOfConvexSetsOptions options;
  options.max_rounded_paths = 0;
  const GcsTrajectory relaxed = problem.Find(options);
  const double cost = relaxed.search.relaxation_cost;
  EXPECT_GE(relaxed.result().bound, cost - 1e-6 * (1 + cost));
  EXPECT_NE(relaxed.result().termination, Termination::kNumericalTrouble);
  const GcsTrajectory found = problem.Find();
  ASSERT_TRUE(found.result().is_success()) << found.result().message;
  EXPECT_LE(relaxed.result().bound, found.result().objective + 1e-9);
}

TEST(GcsTrajectory, ALooseRelaxationAloneIsNoSolution) {
  // Two ways of the same length round a hole: the flow halves, and means of both are on neither.
  const auto box = [](double l, double b, double r, double t) {
    return Hyperrectangle(Vector2d(l, b), Vector2d(r, t));
  };
  const ConvexSets ring =
      MakeConvexSets(box(0, 0, 1, 5), box(0, 4, 5, 5), box(0, 0, 5, 1), box(4, 0, 5, 5));
  Through problem(Vector2d(0, 2.5), ring, Vector2d(5, 2.5), 2);
  problem.gcs.AddPathLengthCost();
  GraphOfConvexSetsOptions options;
  options.max_rounded_paths = 0;
  const GcsTrajectory loose = problem.Find(options);
  EXPECT_FALSE(loose.result().is_success());
  EXPECT_EQ(loose.result().termination, Termination::kNoPath);
  EXPECT_FALSE(loose.is_continuous);
  EXPECT_GT(loose.violation.continuity[0], 0.1);
  EXPECT_LT(loose.violation.regions, 1e-5);  // each piece is one of its region, divided once
  EXPECT_GT(loose.trajectory.get_number_of_segments(), 0);
  EXPECT_LE(loose.result().bound, loose.search.relaxation_cost + 1e-6);
  const GcsTrajectory rounded = problem.Find();
  EXPECT_TRUE(rounded.is_continuous);
  EXPECT_LE(loose.search.relaxation_cost, rounded.result().objective + 1e-6);
  // A tight one is a solution.
  Through tight(kCorridorStart, Corridor(), kCorridorGoal, 3);
  tight.gcs.AddPathLengthCost();
  const GcsTrajectory alone = tight.Find(options);
  EXPECT_TRUE(alone.result().is_success()) << alone.result().message;
  EXPECT_TRUE(alone.is_continuous);
}

TEST(GcsTrajectory, SegmentsWithoutTimeAreLeftOut) {
  // A stop is a segment, a place that is passed is none.
  GcsTrajectoryOptimization gcs(1);
  auto& start = gcs.AddRegions(At(One(0)), 0, 0.5, 2, "stop");
  auto& room = gcs.AddRegions(Range(0, 1), 1, 0, 20, "room");
  auto& goal = gcs.AddRegions(At(One(1)), 0, 0, 20, "goal");
  gcs.AddEdges(start, room);
  gcs.AddEdges(room, goal);
  gcs.AddTimeCost();
  room.AddVelocityBounds(One(-1), One(1));
  const GcsTrajectory found = gcs.FindPath(start, goal);
  ASSERT_TRUE(found.result().is_success()) << found.result().message;
  ASSERT_EQ(found.trajectory.get_number_of_segments(), 2);
  EXPECT_NEAR(found.trajectory.end_time(), 1.5, 1e-5);
  EXPECT_EQ(found.segment_vertices.size(), 2u);
  EXPECT_EQ(found.vertices.size(), 3u);
}

TEST(GcsTrajectory, ALengthWithoutTimeIsNoTrajectory) {
  Through problem(One(0), Range(-1, 2), One(1), 2, 0, 20);
  problem.gcs.AddTimeCost();
  const GcsTrajectory found = problem.Find();
  EXPECT_FALSE(found.result().is_success());
  EXPECT_EQ(found.result().message,
            "segment of zero duration and nonzero length at subgraph rooms: set h_min or velocity "
            "bounds");
}

TEST(GcsTrajectory, OneConstProblemIsSearchedByManyThreads) {
  Through problem(kCorridorStart, Corridor(), kCorridorGoal, 4);
  problem.gcs.AddPathLengthCost();
  problem.gcs.AddTimeCost();
  problem.gcs.AddVelocityBounds(Vector2d(-1, -1), Vector2d(1, 1));
  const GcsTrajectoryOptimization& gcs = problem.gcs;
  const Subgraph &start = problem.start, &goal = problem.goal;
  GraphOfConvexSetsOptions options;
  options.parallelism = Parallelism::None();
  const double alone = gcs.SolvePath(start, goal, options).second.objective;
  std::vector<double> found(4, 0.0);
  std::vector<std::thread> threads;
  for (double& cost : found) {
    threads.emplace_back([&] { cost = gcs.SolvePath(start, goal, options).second.objective; });
  }
  for (std::thread& thread : threads) thread.join();
  for (const double cost : found) EXPECT_EQ(cost, alone);
  EXPECT_NEAR(alone, kCorridorLength + 6, 1e-5);
}

TEST(GcsTrajectory, ARestrictionIsOfTheVerticesThatAreGiven) {
  Through problem(kCorridorStart, Corridor(), kCorridorGoal, 3);
  problem.gcs.AddPathLengthCost();
  const auto rooms = std::as_const(problem.rooms).Vertices();
  const auto [q, result] = problem.gcs.SolveConvexRestriction(
      {problem.start.Vertices()[0], rooms[0], rooms[1], rooms[2], problem.goal.Vertices()[0]});
  ASSERT_TRUE(result.is_success()) << result.message;
  EXPECT_NEAR(result.objective, kCorridorLength, 1e-5);
  EXPECT_EQ(q.get_number_of_segments(), 3);
  const auto alone = problem.gcs.SolveConvexRestriction({rooms[1]});
  EXPECT_NEAR(alone.second.objective, 0, 1e-5);
}

TEST(GcsTrajectory, ATimeLimitIsKept) {
  Through problem(kCorridorStart, Corridor(), kCorridorGoal, 3);
  problem.gcs.AddPathLengthCost();
  GraphOfConvexSetsOptions options;
  options.solver_options.time_limit = 0;
  const GcsTrajectory found = problem.Find(options);
  EXPECT_EQ(found.result().termination, Termination::kTimeLimit) << found.result().message;
  EXPECT_EQ(found.trajectory.get_number_of_segments(), 0);
}

}  // namespace
}  // namespace switchyard
