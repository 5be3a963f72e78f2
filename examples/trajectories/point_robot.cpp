// A point robot among boxes: the fastest way from a corner to the other, at 1 m/s along each axis,
// in free space that is cut into rectangles; the shorter way counts a little, too.
//
//   point_robot [PICTURE.svg]
#include <iostream>

#include "examples/trajectories/svg.hpp"
#include "switchyard/sets/hyperrectangle.hpp"
#include "switchyard/sets/point.hpp"
#include "switchyard/trajectory/gcs_trajectory_optimization.hpp"

using namespace switchyard;

namespace {

Hyperrectangle Rectangle(double left, double low, double right, double high) {
  return {Eigen::Vector2d(left, low), Eigen::Vector2d(right, high)};
}

// What is left of [0, 10] x [0, 6] beside three obstacles.
const std::vector<Hyperrectangle> kFree = {
    Rectangle(0, 0, 2, 6),   Rectangle(2, 0, 4, 1), Rectangle(2, 4.5, 4, 6),
    Rectangle(4, 0, 5, 6),   Rectangle(5, 0, 7, 2), Rectangle(5, 3, 7, 3.6),
    Rectangle(5, 5.4, 7, 6), Rectangle(7, 0, 8, 6), Rectangle(8, 0, 9, 0.8),
    Rectangle(8, 5, 9, 6),   Rectangle(9, 0, 10, 6)};

void Draw(const std::string& path, const CompositeTrajectory<double>& trajectory) {
  Panel plan("free space, and the way through it", {0, 0}, {10, 6}, true);
  plan.Box({0, 0}, {10, 6}, "#555", "#555");
  for (const Hyperrectangle& box : kFree) plan.Box(box.lb(), box.ub(), "#eef3fb", "#c5d3e8");
  const Eigen::VectorXd times =
      Eigen::VectorXd::LinSpaced(400, trajectory.start_time(), trajectory.end_time());
  plan.Line(trajectory.vector_values(times), "#c0392b", 2.5);
  for (const double t : trajectory.get_segment_times()) plan.Dot(trajectory.value(t), "#c0392b", 3);
  WritePicture(path, {&plan});
}

}  // namespace

int main(int argc, char** argv) {
  GcsTrajectoryOptimization problem(2);
  ConvexSets free;
  for (const Hyperrectangle& box : kFree) free.emplace_back(box);
  auto& regions = problem.AddRegions(free, 5, 1e-3, 20, "free");
  auto& start =
      problem.AddRegions(MakeConvexSets(Point(Eigen::Vector2d(0.5, 0.5))), 0, 0, 0, "start");
  auto& goal =
      problem.AddRegions(MakeConvexSets(Point(Eigen::Vector2d(9.5, 5.5))), 0, 0, 0, "goal");
  problem.AddEdges(start, regions);
  problem.AddEdges(regions, goal);
  problem.AddTimeCost();
  problem.AddPathLengthCost(0.1);
  problem.AddVelocityBounds(Eigen::Vector2d(-1, -1), Eigen::Vector2d(1, 1));
  problem.AddPathContinuityConstraints(1);

  const GcsTrajectory found = problem.FindPath(start, goal);
  if (!found.result().is_success()) {
    std::cerr << found.result().message << "\n";
    return 1;
  }
  std::cout << "through " << found.segment_vertices.size() << " regions in "
            << found.trajectory.end_time() - found.trajectory.start_time() << " s: cost "
            << found.result().objective << ", and no trajectory costs less than "
            << found.result().bound << "\n";
  if (argc > 1) Draw(argv[1], found.trajectory);
}
