// Subspaces, offsets, continuous joints, rounds, removal.
#include <cmath>
#include <numbers>

#include "switchyard/sets/hyperellipsoid.hpp"
#include "switchyard/sets/vpolytope.hpp"
#include "tests/trajectory/gcs_problems.hpp"

namespace switchyard {
namespace {

using namespace switchyard::testing;
constexpr double kPi = std::numbers::pi;

/// From one room to another that overlap, through a subspace of what they share.
double LengthThrough(const ConvexSet* subspace) {
  GcsTrajectoryOptimization gcs(2);
  auto& a = gcs.AddRegions(Box(Vector2d(0, 0), Vector2d(3, 4)), 2, 1e-3, 20, "a");
  auto& b = gcs.AddRegions(Box(Vector2d(2, 0), Vector2d(5, 4)), 3, 1e-3, 20, "b");
  auto& start = gcs.AddRegions(At(Vector2d(0, 0)), 0, 0, 0, "start");
  auto& goal = gcs.AddRegions(At(Vector2d(5, 0)), 0, 0, 0, "goal");
  gcs.AddEdges(start, a);
  gcs.AddEdges(a, b, subspace);
  gcs.AddEdges(b, goal);
  gcs.AddPathLengthCost();
  const GcsTrajectory found = gcs.FindPath(start, goal);
  EXPECT_TRUE(found.result().is_success()) << found.result().message;
  if (subspace != nullptr && found.is_continuous) {
    const auto& q = found.trajectory;
    EXPECT_TRUE(subspace->PointInSet(q.segment(0).value(q.end_time(0)), 1e-4));
  }
  return found.result().objective;
}

TEST(GcsJoints, ASubspaceIsWhereOneSegmentEnds) {
  EXPECT_NEAR(LengthThrough(nullptr), 5, 1e-5);
  const Point point(Vector2d(2.5, 2));
  EXPECT_NEAR(LengthThrough(&point), 2 * std::hypot(2.5, 2), 1e-5);
  const HPolyhedron above = HPolyhedron::MakeBox(Vector2d(-9, 3), Vector2d(9, 9));
  EXPECT_NEAR(LengthThrough(&above), 2 * std::hypot(2.5, 3), 1e-5);
  const Hyperrectangle box(Vector2d(2, 1), Vector2d(3, 9));
  EXPECT_NEAR(LengthThrough(&box), 2 * std::hypot(2.5, 1), 1e-5);
  const Hyperellipsoid ball = Hyperellipsoid::MakeHypersphere(1, Vector2d(2.5, 3));
  EXPECT_NEAR(LengthThrough(&ball), 2 * std::hypot(2.5, 2), 1e-4);
  const VPolytope triangle((MatrixXd(2, 3) << 2.5, 2, 3, 2, 4, 4).finished());
  EXPECT_NEAR(LengthThrough(&triangle), 2 * std::hypot(2.5, 2), 1e-4);
}

TEST(GcsJoints, AnEdgeIsWhereBothRegionsAndTheSubspaceMeet) {
  // a meets b, and each meets the subspace, but not in one point.
  GcsTrajectoryOptimization gcs(2);
  auto& a = gcs.AddRegions(Box(Vector2d(0, 0), Vector2d(2, 2)), 1, 1e-3, 20, "a");
  auto& b = gcs.AddRegions(Box(Vector2d(1, 1), Vector2d(3, 3)), 1, 1e-3, 20, "b");
  const HPolyhedron diagonal((MatrixXd(2, 2) << 1, -1, -1, 1).finished(), Vector2d(2, -1.5));
  EXPECT_EQ(Thrown([&] { gcs.AddEdges(a, b, &diagonal); }),
            "AddEdges from a to b: no region of the one meets a region of the other in the "
            "subspace");
  EXPECT_EQ(gcs.GetEdgesBetweenSubgraphs().size(), 0u);
  EXPECT_EQ(gcs.graph_of_convex_sets().num_edges(), 0);
  const HPolyhedron nearer((MatrixXd(2, 2) << 1, -1, -1, 1).finished(), Vector2d(2, -1));
  EXPECT_EQ(gcs.AddEdges(a, b, &nearer).Edges().size(), 1u);
  const std::vector<std::pair<int, int>> pairs = {{0, 0}};
  EXPECT_EQ(gcs.AddEdges(a, b, &nearer, &pairs).Edges().size(), 1u);
}

/// From 0.2 rad the short way round, over 0 to -0.2 = 2 pi - 0.2, with y along.
struct Round {
  explicit Round(const ConvexSet* subspace = nullptr)
      : gcs(2, {0}),
        a(gcs.AddRegions(Box(Vector2d(-1, 0), Vector2d(1, 1)), 3, 0.1, 20, "a")),
        b(gcs.AddRegions(Box(Vector2d(2 * kPi - 1.5, 0), Vector2d(2 * kPi - 0.1, 1)), 3, 0.1, 20,
                         "b")),
        start(gcs.AddRegions(At(Vector2d(0.5 - 2 * kPi, 0)), 0, 0, 0, "start")),
        goal(gcs.AddRegions(At(Vector2d(4 * kPi - 1.2, 0)), 0, 0, 0, "goal")) {
    gcs.AddEdges(start, a);
    gcs.AddEdges(a, b, subspace);
    gcs.AddEdges(b, goal);
    gcs.AddPathLengthCost();
  }
  GcsTrajectoryOptimization gcs;
  Subgraph &a, &b, &start, &goal;
};

TEST(GcsJoints, AContinuousJointGoesTheShortWayRound) {
  const Round problem;
  const GcsTrajectory found = problem.gcs.FindPath(problem.start, problem.goal);
  ASSERT_TRUE(found.result().is_success()) << found.result().message;
  EXPECT_NEAR(found.result().objective, 1.7, 1e-5);
  EXPECT_TRUE(found.is_continuous);
  EXPECT_LT(found.violation.max(), 1e-5);
  ASSERT_EQ(found.trajectory.get_number_of_segments(), 2);
  const auto q = GcsTrajectoryOptimization::UnwrapToContinuousTrajectory(found.trajectory, {0},
                                                                         std::nullopt, 1e-5);
  EXPECT_NEAR(q.value(q.start_time())(0), 0.5, 1e-5);
  EXPECT_NEAR(q.value(q.end_time())(0), -1.2, 1e-5);
  const auto rounds = GcsTrajectoryOptimization::UnwrapToContinuousTrajectory(
      found.trajectory, {0}, std::vector<int>{-2}, 1e-5);
  EXPECT_NEAR(rounds.value(rounds.start_time())(0), 0.5 - 4 * kPi, 1e-5);
  EXPECT_NEAR(rounds.value(rounds.end_time())(0), -1.2 - 4 * kPi, 1e-5);
}

TEST(GcsJoints, ASubspaceMayBeRoundsAway) {
  // Given on the other side of 2 pi than the first region is.
  const Point point(Vector2d(2 * kPi - 0.5, 0.75));
  const double by_point = std::hypot(1, 0.75) + std::hypot(0.7, 0.75);
  const Round at(&point);
  const GcsTrajectory found = at.gcs.FindPath(at.start, at.goal);
  ASSERT_TRUE(found.result().is_success()) << found.result().message;
  EXPECT_NEAR(found.result().objective, by_point, 1e-5);
  const HPolyhedron box = HPolyhedron::MakeBox(Vector2d(6 * kPi - 0.5, 0.75), Vector2d(6 * kPi, 1));
  const Round in(&box);
  const GcsTrajectory other = in.gcs.FindPath(in.start, in.goal);
  ASSERT_TRUE(other.result().is_success()) << other.result().message;
  // Through the box at y = 0.75: a mirror at x = -0.35.
  EXPECT_NEAR(other.result().objective, std::hypot(1.7, 1.5), 1e-5);
  const VectorXd end = other.trajectory.segment(0).value(other.trajectory.end_time(0));
  EXPECT_NEAR(end[1], 0.75, 1e-4);
  EXPECT_NEAR(end[0], -0.35, 1e-3);
  // Not where both regions are.
  const Point away(Vector2d(2 * kPi + 0.5, 0.75));
  EXPECT_EQ(Thrown([&] { Round none(&away); }),
            "AddEdges from a to b: no region of the one meets a region of the other in the "
            "subspace");
}

TEST(GcsJoints, EdgesMayBeGivenWithTheirOffsets) {
  GcsTrajectoryOptimization gcs(1, {0});
  const ConvexSets regions =
      MakeConvexSets(Hyperrectangle(One(-1), One(1)), Hyperrectangle(One(5), One(6)));
  const std::vector<std::pair<int, int>> edges = {{0, 1}, {1, 0}};
  auto& by_ranges = gcs.AddRegions(regions, edges, 2, 0.1);
  auto& computed = gcs.AddRegions(regions, 2, 0.1);
  const std::vector<VectorXd> offsets = {One(2 * kPi), One(-2 * kPi)};
  auto& given = gcs.AddRegions(regions, edges, 2, 0.1, 20, "given", &offsets);
  for (Subgraph* subgraph : {&by_ranges, &computed, &given}) {
    ASSERT_EQ(subgraph->Edges().size(), 2u);
    for (std::size_t k = 0; k < 2; ++k) {
      const auto row = subgraph->Edges()[k]->GetConstraints()[0];
      EXPECT_NEAR(row.evaluator()->upper_bound()[0], k == 0 ? -2 * kPi : 2 * kPi, 1e-12);
    }
  }
}

TEST(GcsJoints, ManyEdgesShareOneEvaluator) {
  GcsTrajectoryOptimization gcs(2);
  auto& rooms = gcs.AddRegions(Corridor(), 3);
  rooms.AddPathContinuityConstraints(1);
  rooms.AddPathLengthCost();
  for (const auto* edge : rooms.Edges()) {
    ASSERT_EQ(edge->constraints().size(), 2u);
    for (const std::size_t k : {0u, 1u}) {
      EXPECT_EQ(edge->constraints()[k].binding.evaluator(),
                rooms.Edges()[0]->constraints()[k].binding.evaluator());
    }
  }
  for (const auto* vertex : rooms.Vertices()) {
    for (const auto& cost : vertex->costs()) {
      EXPECT_EQ(cost.binding.evaluator(), rooms.Vertices()[0]->costs()[0].binding.evaluator());
    }
  }
}

TEST(GcsJoints, ARemovedSubgraphTakesItsEdgesAlong) {
  Through problem(kCorridorStart, Corridor(), kCorridorGoal, 3);
  GcsTrajectoryOptimization& gcs = problem.gcs;
  gcs.AddPathLengthCost();
  auto& other = gcs.AddRegions(At(Vector2d(0.5, 2.5)), 0, 0, 0, "other");
  gcs.AddEdges(other, problem.rooms);
  EXPECT_EQ(gcs.GetSubgraphs().size(), 4u);
  EXPECT_EQ(gcs.GetEdgesBetweenSubgraphs().size(), 3u);
  gcs.RemoveSubgraph(problem.start);
  EXPECT_EQ(gcs.GetSubgraphs().size(), 3u);
  EXPECT_EQ(gcs.GetEdgesBetweenSubgraphs().size(), 2u);
  EXPECT_EQ(gcs.graph_of_convex_sets().num_vertices(), 5);
  EXPECT_EQ(gcs.graph_of_convex_sets().num_edges(), 4 + 2 + 1);
  const GcsTrajectory found = gcs.FindPath(other, problem.goal);
  ASSERT_TRUE(found.result().is_success()) << found.result().message;
  EXPECT_NEAR(found.result().objective, 3.5 + std::hypot(0.5, 1.5), 0.1);
  gcs.AddTimeCost();  // of those that are left
  gcs.RemoveSubgraph(problem.rooms);
  EXPECT_EQ(gcs.GetEdgesBetweenSubgraphs().size(), 0u);
  EXPECT_EQ(gcs.graph_of_convex_sets().num_edges(), 0);
}

CompositeTrajectory<double> Curves(const std::vector<std::pair<double, double>>& ends) {
  std::vector<TrajectoryPointer<double>> segments;
  double t = 0;
  for (const auto& [from, to] : ends) {
    segments.push_back(BezierCurve<double>(t, t + 2, Eigen::RowVector2d(from, to)));
    t += 2;
  }
  return CompositeTrajectory<double>(segments);
}

TEST(GcsJoints, UnwrappedSegmentsJoin) {
  const auto wrapped = Curves({{0, 3}, {3 - 2 * kPi, 0}, {2 * kPi, 8}});
  const auto q = GcsTrajectoryOptimization::UnwrapToContinuousTrajectory(wrapped, {0});
  EXPECT_NEAR(q.value(6)(0), 8, 1e-12);
  EXPECT_NEAR(q.segment(1).value(2)(0), 3, 1e-12);
  EXPECT_NEAR(q.segment(1).value(4)(0), 2 * kPi, 1e-12);
  EXPECT_EQ(q.start_time(2), 4);
  const auto from = GcsTrajectoryOptimization::UnwrapToContinuousTrajectory(Curves({{-1, 1}}), {0},
                                                                            std::vector<int>{0});
  EXPECT_NEAR(from.value(0)(0), 2 * kPi - 1, 1e-12);
}

TEST(GcsJoints, WhatDoesNotJoinIsSaid) {
  using Gcs = GcsTrajectoryOptimization;
  const auto apart = Curves({{0, 1}, {1.5, 2}});
  EXPECT_EQ(
      Thrown([&] { (void)Gcs::UnwrapToContinuousTrajectory(apart, {0}); }),
      "UnwrapToContinuousTrajectory: segment 1 starts 0.5 from where segment 0 ends, at joint "
      "0; allowed are 1e-08");
  const auto wrapped = Curves({{0, 1}, {1 + 2 * kPi, 2}});
  EXPECT_NE(Thrown([&] { (void)Gcs::UnwrapToContinuousTrajectory(wrapped, {}); }),
            "nothing was thrown");
  EXPECT_EQ(Thrown([&] {
              (void)Gcs::UnwrapToContinuousTrajectory(apart, {0}, std::vector<int>{1, 2});
            }),
            "UnwrapToContinuousTrajectory needs a starting round for each of 1 joints, got 2");
  EXPECT_EQ(Thrown([&] { (void)Gcs::UnwrapToContinuousTrajectory(apart, {1}); }),
            "continuous revolute joints: index 1 is not one of 1 positions");
  const CompositeTrajectory<double> nested(std::vector<TrajectoryPointer<double>>{apart});
  EXPECT_EQ(Thrown([&] { (void)Gcs::NormalizeSegmentTimes(nested); }),
            "NormalizeSegmentTimes: segment 0 needs to be a Bezier curve, got a composite "
            "trajectory");
}

}  // namespace
}  // namespace switchyard
