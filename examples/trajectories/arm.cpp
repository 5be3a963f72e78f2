// A 7-joint arm between shelves: regions of its configurations that are known to be free, polytopes
// along moves between poses, and the fastest motion through them under limits of joint speed, at
// rest at both ends.
//
//   arm [PICTURE.svg]
#include <iostream>

#include "examples/trajectories/around.hpp"
#include "examples/trajectories/svg.hpp"
#include "switchyard/sets/point.hpp"
#include "switchyard/trajectory/gcs_trajectory_optimization.hpp"

using namespace switchyard;

namespace {

constexpr int kJoints = 7;
using Pose = Eigen::Vector<double, kJoints>;

Pose PoseOf(std::initializer_list<double> radians) {
  Pose pose;
  std::copy(radians.begin(), radians.end(), pose.data());
  return pose;
}

const Pose kHome = PoseOf({0, 0.3, 0, -1.8, 0, 1, 0});
const Pose kLeftBin = PoseOf({-1.2, 0.8, 0, -1.4, 0.2, 1.1, 0});
const Pose kRightBin = PoseOf({1.2, 0.8, 0, -1.4, -0.2, 1.1, 0});
const Pose kAboveShelf = PoseOf({0, 0.2, 0, -2.1, 0, 1.2, 1.5});
const Pose kTopShelf = PoseOf({0.1, 0.6, 0.1, -1.0, 0.1, 1.0, 1.6});

void Draw(const std::string& path, const CompositeTrajectory<double>& motion, double limit) {
  const double end = motion.end_time();
  const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(500, 0, end);
  Panel joints("joints over time, rad and s", {0, -2.5}, {end, 2.5}, false);
  Panel speeds("their velocities and the limit, rad/s", {0, -1.2 * limit}, {end, 1.2 * limit},
               false);
  const Eigen::MatrixXd q = motion.vector_values(times);
  const Eigen::MatrixXd v = motion.MakeDerivative()->vector_values(times);
  for (int i = 0; i < kJoints; ++i) {
    Eigen::Matrix2Xd line(2, times.size());
    line << times.transpose(), q.row(i);
    joints.Line(line, ColorOf(i), 1.8);
    line.row(1) = v.row(i);
    speeds.Line(line, ColorOf(i), 1.8);
  }
  for (const double side : {-limit, limit}) {
    Eigen::Matrix2Xd line(2, 2);
    line << 0, end, side, side;
    speeds.Line(line, "#555", 1, "stroke-dasharray='5 4'");
  }
  WritePicture(path, {&joints, &speeds});
}

}  // namespace

int main(int argc, char** argv) {
  constexpr double kSpeed = 1.4;         // rad/s
  constexpr double kAcceleration = 6.0;  // rad/s^2
  GcsTrajectoryOptimization problem(kJoints);
  const ConvexSets free =
      MakeConvexSets(Around(kLeftBin, kHome, 0.15), Around(kHome, kRightBin, 0.15),
                     Around(kHome, kAboveShelf, 0.15), Around(kLeftBin, kAboveShelf, 0.1),
                     Around(kAboveShelf, kTopShelf, 0.1), Around(kRightBin, kTopShelf, 0.05));
  auto& regions = problem.AddRegions(free, 5, 0.02, 20, "free");
  auto& start = problem.AddRegions(MakeConvexSets(Point(kLeftBin)), 0, 0, 0, "left bin");
  auto& goal = problem.AddRegions(MakeConvexSets(Point(kTopShelf)), 0, 0, 0, "top shelf");
  auto& leave = problem.AddEdges(start, regions);
  auto& arrive = problem.AddEdges(regions, goal);
  leave.AddZeroDerivativeConstraints(1);
  arrive.AddZeroDerivativeConstraints(1);
  problem.AddTimeCost();
  problem.AddPathLengthCost(0.2);
  problem.AddVelocityBounds(Pose::Constant(-kSpeed), Pose::Constant(kSpeed));
  problem.AddNonlinearDerivativeBounds(Pose::Constant(-kAcceleration),
                                       Pose::Constant(kAcceleration), 2);
  problem.AddContinuityConstraints(1);

  const GcsTrajectory found = problem.FindPath(start, goal);
  if (!found.result().is_success()) {
    std::cerr << found.result().message << "\n";
    return 1;
  }
  std::cout << "in " << found.trajectory.end_time() << " s through "
            << found.segment_vertices.size() << " regions: cost " << found.result().objective
            << ", bound " << found.result().bound << "; " << found.search.rounded.size()
            << " paths were solved\n";
  if (argc > 1) Draw(argv[1], found.trajectory, kSpeed);
}
