// A 7-joint arm moves from one pose to another in the shortest time under limits of position,
// velocity, acceleration, jerk and torque; then through two places for its hand on the way.
//
//   fastest ROBOTS [PICTURE.svg [PICTURE_THROUGH.svg]]
#include "examples/motions/robot.hpp"
#include "switchyard/trajectory/kinematic_trajectory_optimization.hpp"

using namespace switchyard;

namespace {

// Stretched out low to the right; high to the left.
const Eigen::Vector<double, 7> kStart(-0.7, 1.2, 0.1, -0.6, 0.2, 2.2, 0.8);
const Eigen::Vector<double, 7> kGoal(0.8, -0.2, -0.2, -1.1, -0.4, 2.4, -0.6);

void AskForMinimumTime(KinematicTrajectoryOptimization& problem, const RigidBodyModel& arm) {
  const Eigen::VectorXd a = PandaAccelerations(), j = PandaJerks(), zero = 0 * a;
  problem.AddDurationCost();
  problem.AddDurationConstraint(0.1, std::nullopt);
  problem.AddJointLimits(arm);
  problem.AddAccelerationBounds(-a, a);
  problem.AddJerkBounds(-j, j);
  const Eigen::VectorXd tau = PandaEfforts(arm);
  problem.AddEffortBoundsAtNormalizedTimes(arm, Eigen::VectorXd::LinSpaced(81, 0, 1), -tau, tau);
  problem.AddPathPositionConstraint(kStart, kStart, 0);
  problem.AddPathPositionConstraint(kGoal, kGoal, 1);
  for (const double end : {0.0, 1.0}) {
    problem.AddPathVelocityConstraint(zero, zero, end);
    problem.AddPathAccelerationConstraint(zero, zero, end);
  }
}

/// The hand passes two places, within 5 mm, and at the second looks down, within a tenth.
void AskForPlaces(KinematicTrajectoryOptimization& problem, const RigidBodyModel& arm) {
  const Eigen::Vector3d near = Eigen::Vector3d::Constant(0.005);
  const Eigen::Vector3d first(0.45, -0.2, 0.65), second(0.55, 0.25, 0.5);
  problem.AddFramePositionConstraint(arm, "panda_hand_tcp", first - near, first + near, 0.35);
  problem.AddFramePositionConstraint(arm, "panda_hand_tcp", second - near, second + near, 0.7);
  const Eigen::Matrix3d down = Eigen::Vector3d(1, -1, -1).asDiagonal();
  problem.AddFrameOrientationConstraint(arm, "panda_hand_tcp", down, 0.1, 0.7);
}

/// From the straight line, slowly.
KinematicTrajectory Find(KinematicTrajectoryOptimization& problem, const std::string& what) {
  std::vector<Eigen::MatrixXd> points;
  const int n = problem.num_control_points();
  for (int i = 0; i < n; ++i) points.emplace_back(kStart + (kGoal - kStart) * i / (n - 1));
  problem.SetInitialGuess(BsplineTrajectory<double>(
      BsplineBasis<double>(problem.basis().order(), n, KnotVectorType::kClampedUniform, 0, 3),
      points));
  KinematicTrajectory found = problem.FindTrajectory();
  if (!found.result.is_success() || !found.trajectory) {
    std::cerr << what << ": " << found.result.message << "\n";
    std::exit(1);
  }
  std::cout << what << ": " << found.trajectory->end_time() << " s, found in "
            << found.result.iterations << " iterations and " << found.result.seconds.total
            << " s; bounds exceeded by at most "
            << *std::max_element(found.bound_violation.begin(), found.bound_violation.end())
            << ", torques between the times where they are bounded by " << found.effort_violation
            << " N m\n";
  return found;
}

}  // namespace

int main(int argc, char** argv) {
  const std::optional<RigidBodyModel> arm = Panda(argc, argv);
  if (!arm) return kSkipped;
  KinematicTrajectoryOptimization problem(7, 22, 5);
  AskForMinimumTime(problem, *arm);
  const KinematicTrajectory fastest = Find(problem, "from pose to pose");
  if (argc > 2) {
    DrawMotion(argv[2], "from pose to pose in minimum time; limits dashed", *arm,
               *fastest.trajectory);
  }
  AskForPlaces(problem, *arm);
  const KinematicTrajectory through = Find(problem, "through two places");
  if (argc > 3) {
    const double end = through.trajectory->end_time();
    DrawMotion(argv[3], "through two places in minimum time; limits dashed", *arm,
               *through.trajectory, {0.35 * end, 0.7 * end});
  }
}
