// Other times and other rounds for the segments of a trajectory.
#include <cmath>
#include <numbers>

#include "switchyard/sets/geodesic_convexity.hpp"
#include "switchyard/trajectory/bezier_curve.hpp"
#include "switchyard/trajectory/gcs_trajectory_optimization.hpp"

namespace switchyard {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

const BezierCurve<double>& CurveOf(const char* call, const CompositeTrajectory<double>& trajectory,
                                   int k) {
  const auto* curve = dynamic_cast<const BezierCurve<double>*>(&trajectory.segment(k));
  Require(curve != nullptr, call, ": segment ", k, " needs to be a Bezier curve, got a ",
          trajectory.segment(k).Kind());
  return *curve;
}

/// What is added to a segment's points so that it starts where the one before ends.
Eigen::VectorXd Shift(const Eigen::VectorXd& end, const Eigen::VectorXd& start,
                      const std::vector<int>& joints, double tol, int segment) {
  Eigen::VectorXd shift = Eigen::VectorXd::Zero(end.size());
  for (const int joint : joints) {
    shift[joint] = kTurn * std::round((end[joint] - start[joint]) / kTurn);
  }
  Eigen::Index worst = 0;
  const double gap = (start + shift - end).cwiseAbs().maxCoeff(&worst);
  Require(gap <= tol, "UnwrapToContinuousTrajectory: segment ", segment, " starts ", gap,
          " from where segment ", segment - 1, " ends, at joint ", worst,
          shift[worst] != 0 ? ", up to whole rounds" : "", "; allowed are ", tol);
  return shift;
}

}  // namespace

CompositeTrajectory<double> GcsTrajectoryOptimization::NormalizeSegmentTimes(
    const CompositeTrajectory<double>& trajectory) {
  std::vector<TrajectoryPointer<double>> segments;
  const int count = trajectory.get_number_of_segments();
  double time = count > 0 ? trajectory.start_time() : 0;
  for (int k = 0; k < count; ++k) {
    const auto& curve = CurveOf("NormalizeSegmentTimes", trajectory, k);
    segments.push_back(BezierCurve<double>(time, time + 1, curve.control_points()));
    time += 1;
  }
  return CompositeTrajectory<double>(std::move(segments));
}

CompositeTrajectory<double> GcsTrajectoryOptimization::UnwrapToContinuousTrajectory(
    const CompositeTrajectory<double>& gcs_trajectory, std::vector<int> continuous_revolute_joints,
    std::optional<std::vector<int>> starting_rounds, double tol) {
  constexpr const char* kCall = "UnwrapToContinuousTrajectory";
  const std::size_t num_joints = continuous_revolute_joints.size();
  Require(!starting_rounds || starting_rounds->size() == num_joints, kCall,
          " needs a starting round for each of ", num_joints, " joints, got ",
          starting_rounds ? starting_rounds->size() : 0);
  Require(tol >= 0, kCall, " needs a tolerance of 0 or more, got ", tol);
  if (gcs_trajectory.get_number_of_segments() == 0) return gcs_trajectory;
  ThrowsForInvalidContinuousJointsList(static_cast<int>(gcs_trajectory.rows()),
                                       continuous_revolute_joints);
  std::vector<TrajectoryPointer<double>> segments;
  Eigen::VectorXd shift = Eigen::VectorXd::Zero(gcs_trajectory.rows());
  Eigen::VectorXd end;
  for (int k = 0; k < gcs_trajectory.get_number_of_segments(); ++k) {
    const auto& curve = CurveOf(kCall, gcs_trajectory, k);
    Eigen::MatrixXd points = curve.control_points();
    if (k > 0) {
      shift = Shift(end, points.col(0), continuous_revolute_joints, tol, k);
    } else if (starting_rounds) {
      for (std::size_t j = 0; j < num_joints; ++j) {
        const int joint = continuous_revolute_joints[j];
        const double rounds = std::floor(points(joint, 0) / kTurn);
        shift[joint] = kTurn * ((*starting_rounds)[j] - rounds);
      }
    }
    points.colwise() += shift;
    end = points.rightCols<1>();
    segments.push_back(BezierCurve<double>(curve.start_time(), curve.end_time(), points));
  }
  return CompositeTrajectory<double>(std::move(segments));
}

}  // namespace switchyard
