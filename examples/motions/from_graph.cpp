// From a graph to a motion: the fastest path through regions that are known to be free, found
// globally under limits of velocity alone, becomes a motion in the same regions under limits of
// acceleration, jerk and torque.
//
//   from_graph ROBOTS [PICTURE.svg]
#include "examples/motions/robot.hpp"
#include "examples/trajectories/around.hpp"
#include "switchyard/sets/point.hpp"
#include "switchyard/trajectory/smooth_trajectory.hpp"

using namespace switchyard;

namespace {

using Pose = Eigen::Vector<double, 7>;

const Pose kHome(0, 0.3, 0, -1.8, 0, 1.9, 0);
const Pose kLeftBin(-1.2, 0.8, 0, -1.4, 0.2, 2.0, 0);
const Pose kRightBin(1.2, 0.8, 0, -1.4, -0.2, 2.0, 0);
const Pose kAboveShelf(0, 0.2, 0, -2.1, 0, 2.2, 1.5);
const Pose kTopShelf(0.1, 0.6, 0.1, -1.0, 0.1, 1.5, 1.6);

}  // namespace

int main(int argc, char** argv) {
  const std::optional<RigidBodyModel> arm = Panda(argc, argv);
  if (!arm) return kSkipped;
  GcsTrajectoryOptimization graph(7);
  const ConvexSets free =
      MakeConvexSets(Around(kLeftBin, kHome, 0.15), Around(kHome, kRightBin, 0.15),
                     Around(kHome, kAboveShelf, 0.15), Around(kLeftBin, kAboveShelf, 0.1),
                     Around(kAboveShelf, kTopShelf, 0.1), Around(kRightBin, kTopShelf, 0.05));
  auto& regions = graph.AddRegions(free, 3, 0.02, 20, "free");
  auto& start = graph.AddRegions(MakeConvexSets(Point(kLeftBin)), 0, 0, 0, "left bin");
  auto& goal = graph.AddRegions(MakeConvexSets(Point(kTopShelf)), 0, 0, 0, "top shelf");
  graph.AddEdges(start, regions);
  graph.AddEdges(regions, goal);
  graph.AddTimeCost();
  graph.AddVelocityBounds(-arm->velocity_limits(), arm->velocity_limits());

  const GcsTrajectory found = graph.FindPath(start, goal);
  if (!found.result().is_success()) {
    std::cerr << found.result().message << "\n";
    return 1;
  }
  SmoothingOptions options;
  options.model = arm;
  options.acceleration = PandaAccelerations();
  options.jerk = PandaJerks();
  options.effort = PandaEfforts(*arm);
  const SmoothedTrajectory motion = SmoothTrajectory(graph, found, options);
  if (!motion.result.is_success()) {
    std::cerr << motion.result.message << "\n";
    return 1;
  }
  std::cout << "a path through " << found.segment_vertices.size() << " regions in "
            << found.trajectory.end_time() << " s became a motion of "
            << motion.trajectory->end_time() << " s with "
            << motion.trajectory->num_control_points()
            << " control points: outside of its regions by " << motion.region_violation
            << " rad, above torques by " << motion.effort_violation << " N m\n";
  if (argc > 2) {
    DrawMotion(argv[2], "from a graph to a motion; limits dashed", *arm, *motion.trajectory);
  }
}
