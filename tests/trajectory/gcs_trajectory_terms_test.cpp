// Costs and constraints by placeholders, searching again, and what is said of mistakes.
#include <cmath>

#include "switchyard/functions/make_function.hpp"
#include "switchyard/model/function_terms.hpp"
#include "tests/trajectory/gcs_problems.hpp"

namespace switchyard {
namespace {

using namespace switchyard::testing;
using Transcription = GraphOfConvexSets::Transcription;
constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// ---- Placeholders ----

TEST(GcsPlaceholders, StandForEverySegment) {
  Through problem(kCorridorStart, Corridor(), kCorridorGoal, 2, 0.5, 9);
  Subgraph& rooms = problem.rooms;
  EXPECT_EQ(rooms.vertex_control_points().rows(), 2);
  EXPECT_EQ(rooms.vertex_control_points().cols(), 3);
  const auto& r = rooms.vertex_control_points();
  // Twice the length of the legs, and the duration.
  for (int j = 0; j < 2; ++j) rooms.AddVertexCost(2 * (r.col(j + 1) - r.col(j)).norm());
  rooms.AddVertexCost(3 * rooms.vertex_duration());
  rooms.AddVertexConstraint(rooms.vertex_duration() >= 1.0);
  const GcsTrajectory found = problem.Find();
  ASSERT_TRUE(found.result().is_success()) << found.result().message;
  EXPECT_NEAR(found.result().objective, 2 * kCorridorLength + 9, 1e-5);
  for (const auto* vertex : rooms.Vertices()) {
    EXPECT_EQ(vertex->costs()[0].binding.evaluator(),
              rooms.Vertices()[0]->costs()[0].binding.evaluator());
  }
}

TEST(GcsPlaceholders, StandForTheSegmentsOfEveryEdge) {
  Through problem(kCorridorStart, Corridor(), kCorridorGoal, 2, 0.5, 9);
  Subgraph& rooms = problem.rooms;
  const auto& [hu, hv] = rooms.edge_constituent_vertex_durations();
  const auto& [u, v] = rooms.edge_constituent_vertex_control_points();
  rooms.AddEdgeConstraint(hv >= hu + Expression(1));
  rooms.AddEdgeConstraint(u(1, 2) >= 2.5);  // joints are high
  rooms.AddEdgeCost(v(0, 0) - u(0, 2));     // 0
  rooms.AddTimeCost();
  rooms.AddPathLengthCost();
  const GcsTrajectory found = problem.Find();
  ASSERT_TRUE(found.result().is_success()) << found.result().message;
  EXPECT_NEAR(found.result().objective, 0.5 + 1.5 + 2.5 + 3 + 2 * std::hypot(0.5, 2), 1e-5);
  // Of two subgraphs with different orders.
  auto& [start_points, room_points] = problem.out.edge_constituent_vertex_control_points();
  EXPECT_EQ(start_points.cols(), 1);
  EXPECT_EQ(room_points.cols(), 3);
  problem.out.AddEdgeCost(7 * problem.out.edge_constituent_vertex_durations().second);
  problem.out.AddEdgeConstraint(room_points.col(1) == start_points.col(0));
  EXPECT_NEAR(problem.Find().result().objective - found.result().objective, 3.5, 1e-5);
}

TEST(GcsPlaceholders, BindingsAreTakenAsTheyAre) {
  Through problem(One(0), Range(0, 9), One(4), 2, 0.5, 20);
  Subgraph& rooms = problem.rooms;
  const VectorXDecisionVariable h = VectorXDecisionVariable::Constant(1, rooms.vertex_duration());
  rooms.AddVertexCost(Binding<Cost>(std::make_shared<LinearCost>(One(1)), h));
  rooms.AddVertexConstraint(
      Binding<Constraint>(std::make_shared<BoundingBoxConstraint>(One(2), One(3)), h));
  EXPECT_NEAR(problem.Find().result().objective, 2, 1e-6);
  // Nonlinear, for the restriction alone: h^2 >= 6.25.
  const auto square = MakeFunction(1, [](const auto& x) { return x[0] * x[0]; });
  rooms.AddVertexConstraint(
      Binding<Constraint>(std::make_shared<FunctionConstraint>(square, One(6.25), One(kInf)), h),
      {Transcription::kRestriction});
  const GcsTrajectory found = problem.Find();
  ASSERT_TRUE(found.result().is_success()) << found.result().message;
  EXPECT_NEAR(found.result().objective, 2.5, 1e-5);
  EXPECT_NEAR(found.result().bound, 2, 1e-5);
}

TEST(GcsPlaceholders, OthersAreRefused) {
  Through problem(One(0), Range(0, 9), One(4), 2);
  Subgraph &rooms = problem.rooms, &goal = problem.goal;
  EXPECT_EQ(Thrown([&] { rooms.AddVertexCost(goal.vertex_duration() * 2.0); }),
            "AddVertexCost of subgraph rooms needs its placeholders of durations and control "
            "points as variables, got vertex_duration");
  EXPECT_EQ(Thrown([&] { rooms.AddVertexConstraint(rooms.Vertices()[0]->x()[0] >= 1.0); }),
            "AddVertexConstraint of subgraph rooms needs its placeholders of durations and control "
            "points as variables, got rooms: 0.x(0)");
  EXPECT_EQ(Thrown([&] { rooms.AddEdgeCost(1.0 * rooms.vertex_control_points()(0, 1)); }),
            "AddEdgeCost of subgraph rooms needs its placeholders of durations and control points "
            "as variables, got vertex_points(0,1)");
  EXPECT_EQ(Thrown([&] {
              problem.out.AddEdgeCost(1.0 * rooms.edge_constituent_vertex_durations().first);
            }),
            "AddEdgeCost of edges from start to rooms needs its placeholders of durations and "
            "control points as variables, got u_duration");
  EXPECT_TRUE(rooms.Vertices()[0]->costs().empty());
  EXPECT_NE(Thrown([&] {
              rooms.AddVertexConstraint(rooms.vertex_duration() != Expression(1));
            }).find("AddVertexConstraint of subgraph rooms: "),
            std::string::npos);
}

TEST(GcsPlaceholders, BindingsOfEdgesToo) {
  Through problem(One(0), Range(0, 9), One(4), 2, 0.5, 20);
  problem.gcs.AddTimeCost();
  const VectorXDecisionVariable h =
      VectorXDecisionVariable::Constant(1, problem.in.edge_constituent_vertex_durations().first);
  problem.in.AddEdgeCost(Binding<Cost>(std::make_shared<LinearCost>(One(2)), h));
  problem.in.AddEdgeConstraint(
      Binding<Constraint>(std::make_shared<BoundingBoxConstraint>(One(1), One(3)), h));
  EXPECT_NEAR(problem.Find().result().objective, 3, 1e-5);
}

TEST(GcsTrajectoryOptimization, SaysWhatItHolds) {
  Through problem(kCorridorStart, Corridor(), kCorridorGoal, 3, 0.1, 2);
  const GcsTrajectoryOptimization& gcs = problem.gcs;
  EXPECT_EQ(gcs.num_positions(), 2);
  EXPECT_TRUE(gcs.continuous_revolute_joints().empty());
  const Subgraph& rooms = *gcs.GetSubgraphs()[0];
  EXPECT_EQ(rooms.name(), "rooms");
  EXPECT_EQ(rooms.order(), 3);
  EXPECT_EQ(rooms.size(), 3);
  EXPECT_EQ(rooms.h_min(), 0.1);
  EXPECT_EQ(rooms.h_max(), 2);
  EXPECT_EQ(rooms.regions().size(), 3u);
  EXPECT_EQ(rooms.Vertices().size(), 3u);
  EXPECT_EQ(rooms.Vertices()[1]->name(), "rooms: 1");
  EXPECT_EQ(rooms.Edges().size(), 4u);
  const EdgesBetween& out = *gcs.GetEdgesBetweenSubgraphs()[0];
  EXPECT_EQ(&out.from_subgraph(), &problem.start);
  EXPECT_EQ(&out.to_subgraph(), &rooms);
  EXPECT_EQ(out.Edges().size(), 1u);
  problem.gcs.AddPathLengthCost();
  const auto found = gcs.SolvePath(problem.start, problem.goal);
  EXPECT_NE(gcs.GetGraphvizString().find("rooms: 1"), std::string::npos);
  EXPECT_NE(gcs.GetGraphvizString(&found.second).find("rooms: 1"), std::string::npos);
}

// ---- Again ----

TEST(GcsTrajectorySearch, AnswersAsASearchOfItsOwn) {
  Through problem(kCorridorStart, Corridor(), kCorridorGoal, 3);
  GcsTrajectoryOptimization& gcs = problem.gcs;
  gcs.AddPathLengthCost();
  auto& several =
      gcs.AddRegions(MakeConvexSets(Point(Vector2d(4.5, 2.5)), Point(Vector2d(4.5, 1))), 0, 0, 0);
  gcs.AddEdges(problem.rooms, several);
  const int vertices = gcs.graph_of_convex_sets().num_vertices();
  {
    GcsTrajectorySearch search(gcs);
    for (int k = 0; k < 2; ++k) {
      EXPECT_NEAR(search.FindPath(problem.start, problem.goal).result().objective, kCorridorLength,
                  1e-5);
      const GcsTrajectory found = search.FindPath(problem.start, several);
      EXPECT_NEAR(found.result().objective, gcs.FindPath(problem.start, several).result().objective,
                  1e-6);
      EXPECT_EQ(found.vertices.back(), several.Vertices()[0]);
      EXPECT_EQ(found.search.edges.size() + 1, found.vertices.size());
      EXPECT_EQ(gcs.graph_of_convex_sets().num_vertices(), vertices + 1);
    }
  }
  EXPECT_EQ(gcs.graph_of_convex_sets().num_vertices(), vertices);
}

TEST(GcsTrajectorySearch, TakesNewStartsAndGoals) {
  GcsTrajectoryOptimization gcs(2);
  auto& rooms = gcs.AddRegions(Corridor(), 3, 1e-6, 20, "rooms");
  gcs.AddPathLengthCost();
  GcsTrajectorySearch search(gcs);
  for (const double y : {0.5, 1.0, 1.5}) {
    auto& start = gcs.AddRegions(At(Vector2d(0.5, y)), 0, 0, 0, "start");
    auto& goal = gcs.AddRegions(At(Vector2d(4.5, y)), 0, 0, 0, "goal");
    gcs.AddEdges(start, rooms);
    gcs.AddEdges(rooms, goal);
    const GcsTrajectory found = search.FindPath(start, goal);
    ASSERT_TRUE(found.result().is_success()) << found.result().message;
    EXPECT_NEAR(found.result().objective, 3 + 2 * std::hypot(0.5, 2 - y), 1e-5);
    EXPECT_LT(found.violation.max(), 1e-5);
    gcs.RemoveSubgraph(start);
    gcs.RemoveSubgraph(goal);
  }
}

TEST(GcsTrajectorySearch, OutlivesTheSubgraphsItHasSearched) {
  GcsTrajectoryOptimization gcs(2);
  auto& rooms = gcs.AddRegions(Corridor(), 3, 1e-6, 20, "rooms");
  auto& goals =
      gcs.AddRegions(MakeConvexSets(Point(Vector2d(4.5, 2.5)), Point(Vector2d(4.5, 1))), 0, 0, 0);
  gcs.AddEdges(rooms, goals);
  gcs.AddPathLengthCost();
  {
    GcsTrajectorySearch search(gcs);
    EXPECT_NEAR(search.FindPath(rooms, goals).result().objective, 0, 1e-5);
    gcs.RemoveSubgraph(goals);
  }
  EXPECT_EQ(gcs.graph_of_convex_sets().num_vertices(), 3);
}

// ---- Mistakes ----

TEST(GcsMistakes, OfRegions) {
  EXPECT_EQ(Thrown([] { GcsTrajectoryOptimization none(0); }),
            "GcsTrajectoryOptimization needs a position or more, got 0");
  EXPECT_EQ(Thrown([] { GcsTrajectoryOptimization none(2, {2}); }),
            "continuous revolute joints: index 2 is not one of 2 positions");
  GcsTrajectoryOptimization gcs(1);
  const ConvexSets room = Range(0, 1);
  const auto said = [&](auto add) {
    const std::string text = Thrown(add);
    EXPECT_TRUE(gcs.GetSubgraphs().empty());
    EXPECT_EQ(gcs.graph_of_convex_sets().num_vertices(), 0);
    return text;
  };
  EXPECT_EQ(said([&] { gcs.AddRegions({}, 1); }),
            "AddRegions for subgraph Subgraph0 needs a region or more, got none");
  EXPECT_EQ(said([&] { gcs.AddRegions(At(Vector2d(0, 0)), 1, 0, 1, "a"); }),
            "AddRegions for subgraph a: region 0, a point, needs to be in R^1, got one in R^2");
  EXPECT_EQ(said([&] {
              gcs.AddRegions(MakeConvexSets(HPolyhedron(Vector2d(1, -1), Vector2d(0, -1))), 1, 0, 1,
                             "a");
            }),
            "AddRegions for subgraph a: region 0, a hpolyhedron, has no point");
  EXPECT_EQ(said([&] { gcs.AddRegions(room, -1, 0, 1, "a"); }),
            "AddRegions for subgraph a needs an order of 0 or more, got -1");
  EXPECT_EQ(said([&] { gcs.AddRegions(room, 1, 3, 2, "a"); }),
            "AddRegions for subgraph a: h_min = 3 is above h_max = 2");
  EXPECT_EQ(said([&] { gcs.AddRegions(room, 1, -1, 2, "a"); }),
            "AddRegions for subgraph a needs h_min of 0 or more, got -1");
  EXPECT_EQ(said([&] { gcs.AddRegions(room, 1, 0, kInf, "a"); }),
            "AddRegions for subgraph a needs a finite h_max, got inf");
  const std::vector<std::pair<int, int>> wrong = {{0, 0}, {0, 4}};
  EXPECT_EQ(said([&] { gcs.AddRegions(room, wrong, 1, 0, 1, "a"); }),
            "AddRegions for subgraph a: edge 1 is from region 0 of 1 to region 4 of 1; regions "
            "count from 0");
  const std::vector<std::pair<int, int>> loop = {{0, 0}};
  std::vector<VectorXd> offsets;
  const auto add = [&] { gcs.AddRegions(room, loop, 1, 0, 1, "a", &offsets); };
  EXPECT_EQ(said(add), "AddRegions for subgraph a needs an offset for each of 1 edges, got 0");
  offsets = {Vector2d(0, 0)};
  EXPECT_EQ(said(add), "AddRegions for subgraph a: the offset of edge 0 needs 1 entries, got 2");
  offsets = {One(1)};
  EXPECT_EQ(said(add),
            "AddRegions for subgraph a: the offset of edge 0 needs a 0 at joint 0, got 1");
  GcsTrajectoryOptimization turning(1, {0});
  EXPECT_EQ(Thrown([&] { turning.AddRegions(room, loop, 1, 0, 1, "a", &offsets); }),
            "AddRegions for subgraph a: the offset of edge 0 needs a multiple of 2 pi at the "
            "continuous revolute joint 0, got 1");
  EXPECT_EQ(Thrown([&] { turning.AddRegions(Range(0, 4), 1, 0, 1, "a"); }),
            "AddRegions for subgraph a: region 0, a hyperrectangle, is 4 wide along the continuous "
            "revolute joint 0: it must be narrower than pi, see PartitionConvexSet");
}

TEST(GcsMistakes, OfEdges) {
  GcsTrajectoryOptimization gcs(1);
  auto& rooms = gcs.AddRegions(Range(0, 1), 1, 0, 1, "rooms");
  auto& outside = gcs.AddRegions(At(One(2)), 0, 0, 0, "outside");
  EXPECT_EQ(Thrown([&] { gcs.AddEdges(outside, rooms); }),
            "AddEdges from outside to rooms: no region of the one meets a region of the other");
  const Point flat(Vector2d(0, 0));
  EXPECT_EQ(Thrown([&] { gcs.AddEdges(rooms, rooms, &flat); }),
            "AddEdges from rooms to rooms: the subspace, a point, needs to be in R^1, got one in "
            "R^2");
  const std::vector<VectorXd> offsets;
  EXPECT_EQ(Thrown([&] { gcs.AddEdges(rooms, outside, nullptr, nullptr, &offsets); }),
            "AddEdges from rooms to outside needs the edges to which its offsets belong");
  GcsTrajectoryOptimization other(1);
  auto& theirs = other.AddRegions(Range(0, 1), 1, 0, 1, "theirs");
  EXPECT_EQ(Thrown([&] { gcs.AddEdges(rooms, theirs); }),
            "AddEdges needs subgraphs of this problem, got one of another");
  EXPECT_EQ(Thrown([&] { gcs.RemoveSubgraph(theirs); }),
            "RemoveSubgraph needs a subgraph of this problem, got one that is not");
  EXPECT_EQ(Thrown([&] { (void)gcs.FindPath(rooms, theirs); }),
            "FindPath: the target is no subgraph of this problem");
}

TEST(GcsMistakes, OfCosts) {
  GcsTrajectoryOptimization gcs(2);
  auto& rooms = gcs.AddRegions(Corridor(), 1, 0, 1, "rooms");
  EXPECT_EQ(Thrown([&] { gcs.AddTimeCost(kNan); }), "AddTimeCost needs a finite weight, got nan");
  EXPECT_EQ(Thrown([&] { gcs.AddPathLengthCost(-1); }),
            "AddPathLengthCost needs a finite weight of 0 or more, got -1");
  EXPECT_EQ(
      Thrown([&] { rooms.AddPathEnergyCost(MatrixXd::Identity(3, 3)); }),
      "AddPathEnergyCost of subgraph rooms needs a finite weight matrix of 2 columns, got 3 x "
      "3");
  EXPECT_TRUE(rooms.Vertices()[0]->costs().empty());
}

TEST(GcsMistakes, OfBounds) {
  Through problem(One(0), Range(0, 9), One(4), 1, 0, 1);
  GcsTrajectoryOptimization& gcs = problem.gcs;
  EXPECT_EQ(Thrown([&] { gcs.AddVelocityBounds(Vector2d(0, 0), One(1)); }),
            "AddVelocityBounds needs lb and ub of 1 entries, got 2 and 1");
  EXPECT_EQ(Thrown([&] { problem.rooms.AddVelocityBounds(One(2), One(1)); }),
            "AddVelocityBounds of subgraph rooms needs lb <= ub, got lb[0] = 2 and ub[0] = 1");
  EXPECT_EQ(Thrown([&] { problem.start.AddVelocityBounds(One(0), One(1)); }),
            "AddVelocityBounds of subgraph start needs order 1 or more, got 0: a point has no "
            "velocity");
  EXPECT_EQ(Thrown([&] { problem.rooms.AddNonlinearDerivativeBounds(One(0), One(1), 1); }),
            "AddNonlinearDerivativeBounds of subgraph rooms needs a derivative order of 2 or more, "
            "got 1: for velocities there is AddVelocityBounds");
  EXPECT_EQ(Thrown([&] { problem.rooms.AddNonlinearDerivativeBounds(One(0), One(1), 2); }),
            "AddNonlinearDerivativeBounds of subgraph rooms needs order 2 or more, got 1");
  EXPECT_EQ(Thrown([&] { problem.out.AddNonlinearDerivativeBounds(One(0), One(1), 2); }),
            "AddNonlinearDerivativeBounds of edges from start to rooms needs a subgraph of order 2 "
            "or more on one side, got 0 and 1");
  EXPECT_EQ(Thrown([&] { problem.out.AddZeroDerivativeConstraints(0); }),
            "AddZeroDerivativeConstraints of edges from start to rooms needs a derivative order of "
            "1 or more, got 0");
  auto& higher = gcs.AddRegions(Range(0, 9), 2, 0, 1, "higher");
  EXPECT_EQ(Thrown([&] { gcs.AddNonlinearDerivativeBounds(One(0), One(1), 2); }),
            "AddNonlinearDerivativeBounds: derivative bounds need h_min > 0 at every segment they "
            "touch, and at subgraph higher it is 0");
  EXPECT_EQ(Thrown([&] { higher.AddNonlinearDerivativeBounds(One(0), One(1), 2); }),
            "AddNonlinearDerivativeBounds of subgraph higher: derivative bounds need h_min > 0 at "
            "every segment they touch, and at subgraph higher it is 0");
  auto& edges = gcs.AddEdges(problem.rooms, higher);
  EXPECT_EQ(Thrown([&] { edges.AddNonlinearDerivativeBounds(One(0), One(1), 2); }),
            "AddNonlinearDerivativeBounds of edges from rooms to higher: derivative bounds need "
            "h_min > 0 at every segment they touch, and at subgraph higher it is 0");
  gcs.RemoveSubgraph(higher);
  gcs.AddNonlinearDerivativeBounds(One(0), One(1), 2);
  EXPECT_EQ(
      Thrown([&] { gcs.AddRegions(Range(0, 9), 2, 0, 1, "later"); }),
      "AddRegions for subgraph later needs h_min > 0 for the bounds of derivative 2 that were "
      "asked of all subgraphs, got 0");
  EXPECT_EQ(gcs.GetSubgraphs().size(), 3u);
  EXPECT_EQ(Thrown([&] { gcs.UseSurrogates(0); }),
            "UseSurrogates needs a characteristic time above 0, got 0");
  gcs.UseSurrogates(2);
  EXPECT_EQ(Thrown([&] { gcs.UseSurrogates(3); }),
            "UseSurrogates: surrogates are in use already, with a characteristic time of 2");
}

TEST(GcsMistakes, OfContinuity) {
  GcsTrajectoryOptimization gcs(2);
  auto& rooms = gcs.AddRegions(Corridor(), 2, 0, 1, "rooms");
  auto& low = gcs.AddRegions(Corridor(), 1, 0.1, 1, "low");
  auto& edges = gcs.AddEdges(rooms, low);
  EXPECT_EQ(Thrown([&] { rooms.AddPathContinuityConstraints(3); }),
            "AddPathContinuityConstraints of subgraph rooms needs segments of order 3 or more on "
            "both sides, got 2 and 2");
  EXPECT_EQ(Thrown([&] { edges.AddContinuityConstraints(2); }),
            "AddContinuityConstraints of edges from rooms to low needs segments of order 2 or more "
            "on both sides, got 2 and 1");
  EXPECT_EQ(
      Thrown([&] { gcs.AddPathContinuityConstraints(0); }),
      "AddPathContinuityConstraints needs an order of 1 or more, got 0: segments join anyway");
  EXPECT_EQ(Thrown([&] { rooms.AddContinuityConstraints(1); }),
            "AddContinuityConstraints of subgraph rooms: continuity constraints need h_min > 0 at "
            "every segment they touch, and at subgraph rooms it is 0");
  EXPECT_EQ(Thrown([&] { gcs.AddContinuityConstraints(1); }),
            "AddContinuityConstraints of subgraph rooms: continuity constraints need h_min > 0 at "
            "every segment they touch, and at subgraph rooms it is 0");
  for (const auto* edge : low.Edges()) EXPECT_EQ(edge->constraints().size(), 1u);
  gcs.RemoveSubgraph(rooms);
  gcs.AddContinuityConstraints(1);
  EXPECT_EQ(Thrown([&] { gcs.AddRegions(Corridor(), 2, 0, 1, "later"); }),
            "AddRegions for subgraph later needs h_min > 0 for the continuity of derivative 1 that "
            "was asked of all subgraphs, got 0");
  // One region has no joints of its own; those to others have.
  auto& one = gcs.AddRegions(Box(Vector2d(0, 0), Vector2d(1, 1)), 2, 0, 1, "one");
  EXPECT_EQ(Thrown([&] { gcs.AddEdges(one, low); }),
            "AddEdges from one to low needs h_min > 0 for the continuity of derivative 1 that was "
            "asked of all subgraphs, got 0 and 0.1");
}

}  // namespace
}  // namespace switchyard
