// A quadrotor through a building, by segments of order 7 that join with four continuous
// derivatives, as its motors need: positions are a flat output, so that a curve in space is enough.
//
//   quadrotor [PICTURE.svg]
#include <iostream>

#include "examples/trajectories/svg.hpp"
#include "switchyard/sets/hyperrectangle.hpp"
#include "switchyard/sets/point.hpp"
#include "switchyard/trajectory/gcs_trajectory_optimization.hpp"

using namespace switchyard;

namespace {

struct Room {
  Eigen::Vector3d low, high;
};

// Rooms of 4 m x 4 m x 3 m on two floors, and the doors, windows and stairwell between them, each
// reaching a little into what it joins.
const std::vector<Room> kRooms = {{{0, 0, 0}, {4, 4, 3}},
                                  {{4.2, 0, 0}, {8, 4, 3}},
                                  {{8.2, 0, 0}, {12, 4, 3}},
                                  {{0, 4.2, 0}, {4, 8, 3}},
                                  {{4.2, 4.2, 0}, {8, 8, 3}},
                                  {{8.2, 4.2, 0}, {12, 8, 3}},
                                  {{0, 0, 3.2}, {4, 4, 6}},
                                  {{4.2, 0, 3.2}, {8, 4, 6}},
                                  {{8.2, 0, 3.2}, {12, 8, 6}},
                                  {{3.8, 1.5, 0}, {4.4, 2.5, 2}},
                                  {{1.5, 3.8, 0}, {2.5, 4.4, 2}},
                                  {{3.8, 5.5, 0}, {4.4, 6.5, 2}},
                                  {{7.8, 6.5, 1}, {8.4, 7.5, 2}},
                                  {{0.5, 0.5, 2.8}, {1.5, 1.5, 3.4}},
                                  {{3.8, 1.5, 3.2}, {4.4, 2.5, 5}},
                                  {{7.8, 2.0, 4}, {8.4, 3.5, 5}},
                                  {{10.5, 6.5, 2.8}, {11.5, 7.5, 3.4}},
                                  {{10, 3.8, 0.5}, {11, 4.4, 2}}};

void View(Panel& panel, int across, int up, const GcsTrajectory& found) {
  const auto on = [&](const Eigen::Vector3d& p) { return Eigen::Vector2d(p[across], p[up]); };
  for (const Room& room : kRooms) panel.Box(on(room.low), on(room.high), "#2980b922", "#9bb7d0");
  const auto& trajectory = found.trajectory;
  const Eigen::MatrixXd points = trajectory.vector_values(Eigen::VectorXd(
      Eigen::VectorXd::LinSpaced(600, trajectory.start_time(), trajectory.end_time())));
  Eigen::Matrix2Xd flat(2, points.cols());
  flat << points.row(across), points.row(up);
  panel.Line(flat, "#c0392b", 2.5);
  panel.Dot(flat.leftCols(1), "#27ae60");
  panel.Dot(flat.rightCols(1), "#c0392b");
}

}  // namespace

int main(int argc, char** argv) {
  GcsTrajectoryOptimization problem(3);
  ConvexSets rooms;
  for (const Room& room : kRooms) rooms.emplace_back(Hyperrectangle(room.low, room.high));
  auto& building = problem.AddRegions(rooms, 7, 0.05, 20, "building");
  const Eigen::Vector3d from(6, 1, 1), to(11, 2, 1.5);
  auto& start = problem.AddRegions(MakeConvexSets(Point(from)), 0, 0, 0, "start");
  auto& goal = problem.AddRegions(MakeConvexSets(Point(to)), 0, 0, 0, "goal");
  auto& takeoff = problem.AddEdges(start, building);
  auto& landing = problem.AddEdges(building, goal);
  for (int k = 1; k <= 2; ++k) {  // at rest, and without thrust to the side
    takeoff.AddZeroDerivativeConstraints(k);
    landing.AddZeroDerivativeConstraints(k);
  }
  problem.AddTimeCost();
  problem.AddPathLengthCost();
  problem.AddVelocityBounds(Eigen::Vector3d::Constant(-3), Eigen::Vector3d::Constant(3));
  for (int k = 1; k <= 4; ++k) problem.AddPathContinuityConstraints(k);

  const GcsTrajectory found = problem.FindPath(start, goal);
  if (!found.result().is_success()) {
    std::cerr << found.result().message << "\n";
    return 1;
  }
  const auto in_path = GcsTrajectoryOptimization::NormalizeSegmentTimes(found.trajectory);
  std::cout << "through " << found.segment_vertices.size() << " rooms and openings in "
            << found.trajectory.end_time() << " s, " << in_path.get_number_of_segments()
            << " segments: cost " << found.result().objective << ", bound " << found.result().bound
            << ", furthest from a constraint by " << found.violation.max() << "\n";
  if (argc < 2) return 0;
  Panel above("from above (x, y), metres", {0, 0}, {12, 8}, true);
  Panel side("from the side (x, z), metres", {0, 0}, {12, 6}, true);
  View(above, 0, 1, found);
  View(side, 0, 2, found);
  WritePicture(argv[1], {&above, &side});
}
