// switchyard/trajectory/smooth_trajectory.hpp - from a trajectory through regions to a motion: one
// B-spline in the same regions, under bounds of its derivatives and of a robot's efforts.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>

#include "switchyard/dynamics/rigid_body_model.hpp"
#include "switchyard/sets/convex_set.hpp"
#include "switchyard/solve/solve.hpp"
#include "switchyard/trajectory/composite_trajectory.hpp"
#include "switchyard/trajectory/gcs_trajectory_optimization.hpp"
#include "switchyard/trajectory/kinematic_trajectory_optimization.hpp"

namespace switchyard {

struct SmoothingOptions {
  /// 4 for bounds of jerk; 5 for a jerk without jumps.
  int spline_order = 5;
  /// At least; more where regions need them.
  int num_control_points = 40;
  /// |derivative| <= limit of each position, units of q / s^k; infinite: none.
  std::optional<Eigen::VectorXd> velocity = {};
  std::optional<Eigen::VectorXd> acceleration = {};
  std::optional<Eigen::VectorXd> jerk = {};
  /// Its limits of positions, velocities and efforts hold as well.
  std::optional<RigidBodyModel> model = {};
  /// |tau| <= effort of the model's joints; unset: the model's own.
  std::optional<Eigen::VectorXd> effort = {};
  /// Minimized: time T + length (path length) + energy (path energy), see
  /// KinematicTrajectoryOptimization.
  double time_weight = 1;
  double length_weight = 0;
  double energy_weight = 0;
  /// At rest at both ends; with limits of jerk without acceleration there, too. Else free.
  bool rest_to_rest = true;
  /// How often efforts are bounded at more times where they were exceeded between those before, and
  /// the motion found anew from the last one.
  int effort_rounds = 3;
  /// What else is asked, of the problem before it is solved.
  std::function<void(KinematicTrajectoryOptimization&)> more = {};
  SolverOptions solver_options = {};
  const SolverInterface* solver = nullptr;

  /// Throws InvalidArgument for what does not fit `num_positions`, and where no limit of velocity,
  /// acceleration or jerk keeps the duration from vanishing.
  SWITCHYARD_EXPORT void Check(int num_positions) const;
};

/// As KinematicTrajectoryOptimization::FindTrajectory has it, and how far it is from its regions.
struct SmoothedTrajectory : KinematicTrajectory {
  /// The largest ConvexSet::Violation of a control point in a region that it must be in. For
  /// regions that are polyhedra or boxes no point of the trajectory violates them by more.
  double region_violation = 0;
};

/// From the first point of `found` to its last one, in the shortest time; `found` is the guess.
///
/// With regions, one for each segment of `found`, the motion stays in them at all times, not at
/// samples alone. Knots are at the joints of segments, spline_order - 1 intervals or more between
/// two of them; the curve in an interval is in the hull of the spline_order control points whose
/// functions are not zero there, and these are constrained to the region of its segment. By the
/// number of intervals no control point belongs to more than two segments; one that belongs to two
/// is in both regions. Segments have the share of time that they have in `found`, a tenth of the
/// mean or more. The more control points, the nearer they are to the curve, and the less it is held
/// back by narrow regions.
///
/// Throws InvalidArgument where `found` has no segment, its segments do not join to 1e-5, regions
/// are not one for each, and for options that do not fit. What is found is a value, also that there
/// is nothing.
[[nodiscard]] SWITCHYARD_EXPORT SmoothedTrajectory
SmoothTrajectory(const CompositeTrajectory<double>& found, const ConvexSets& regions,
                 const SmoothingOptions& options = {});
/// Through the regions that the path came through. Segments along continuous revolute joints are
/// unwrapped (UnwrapToContinuousTrajectory), and their regions moved with them. Throws where there
/// is no path, or it is one of another problem.
[[nodiscard]] SWITCHYARD_EXPORT SmoothedTrajectory
SmoothTrajectory(const GcsTrajectoryOptimization& problem, const GcsTrajectory& found,
                 const SmoothingOptions& options = {});

}  // namespace switchyard
