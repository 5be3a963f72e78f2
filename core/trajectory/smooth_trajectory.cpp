#include "switchyard/trajectory/smooth_trajectory.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/trajectory/segment_knots.hpp"
#include "switchyard/sets/minkowski_sum.hpp"
#include "switchyard/sets/point.hpp"
#include "switchyard/trajectory/efforts.hpp"

namespace switchyard {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr const char* kCall = "SmoothTrajectory";
// Of segments that join.
constexpr double kJoint = 1e-5;
// Of the first duration that keeps all bounds, one that a motion surely needs.
constexpr double kLeastDuration = 1e-3;
// Times in each interval between knots at which efforts are bounded at first, and are verified.
constexpr int kFirstTimes = 3;
constexpr int kVerifiedTimes = 20;
// Of a joint's effort limit: what may remain between two times.
constexpr double kEffortTolerance = 1e-4;

std::size_t At(int i) { return static_cast<std::size_t>(i); }

void CheckLimit(const char* what, const std::optional<VectorXd>& limit, int n) {
  if (!limit) return;
  Require(limit->size() == n, kCall, ": the limit of ", what, " needs ", n,
          n == 1 ? " entry" : " entries", ", one for each position, got ", limit->size());
  for (int i = 0; i < n; ++i) {
    Require((*limit)[i] > 0, kCall, ": the limit of ", what, " needs entries above 0, got ",
            (*limit)[i], " at ", i);
  }
}

bool IsFiniteSomewhere(const std::optional<VectorXd>& limit) {
  return limit && limit->array().isFinite().any();
}

/// Limits of the k-th derivative, k = 1, 2, 3: those given, and the model's velocities.
std::vector<std::optional<VectorXd>> LimitsOf(const SmoothingOptions& options) {
  std::vector<std::optional<VectorXd>> limits = {options.velocity, options.acceleration,
                                                 options.jerk};
  if (options.model) {
    const VectorXd own = options.model->velocity_limits();
    limits[0] = limits[0] ? limits[0]->cwiseMin(own) : own;
  }
  return limits;
}

/// The shortest duration in which the control points keep the limits.
double DurationOf(const MatrixXd& points, const BsplineBasis<double>& basis,
                  const SmoothingOptions& options) {
  double duration = 0;
  const auto limits = LimitsOf(options);
  for (int k = 1; k <= 3 && k < basis.order(); ++k) {
    const auto& limit = limits[At(k - 1)];
    if (!limit) continue;
    const MatrixXd slopes = points * basis.DerivativeMap(k);
    for (Eigen::Index i = 0; i < slopes.rows(); ++i) {
      if (!((*limit)[i] > 0)) continue;  // it must not move, in any time
      const double least = slopes.row(i).cwiseAbs().maxCoeff() / (*limit)[i];
      duration = std::max(duration, std::pow(least, 1.0 / k));
    }
  }
  return duration;
}

BsplineTrajectory<double> GuessOf(const SegmentKnots& knots,
                                  const CompositeTrajectory<double>& found,
                                  const SmoothingOptions& options) {
  const MatrixXd points = knots.Guess(found);
  double duration = DurationOf(points, {options.spline_order, knots.knots()}, options);
  if (!(duration > 0)) duration = found.end_time() - found.start_time();  // it stays where it is
  std::vector<double> times = knots.knots();
  for (double& time : times) time *= duration;
  std::vector<MatrixXd> columns;
  for (Eigen::Index j = 0; j < points.cols(); ++j) columns.emplace_back(points.col(j));
  return {BsplineBasis<double>(options.spline_order, std::move(times)), std::move(columns)};
}

void AddEnds(KinematicTrajectoryOptimization& problem, const CompositeTrajectory<double>& found,
             const SmoothingOptions& options) {
  const VectorXd ends[] = {found.value(found.start_time()), found.value(found.end_time())};
  const VectorXd zero = VectorXd::Zero(problem.num_positions());
  for (const int s : {0, 1}) {
    problem.AddPathPositionConstraint(ends[s], ends[s], s);
    if (!options.rest_to_rest) continue;
    problem.AddPathVelocityConstraint(zero, zero, s);
    if (IsFiniteSomewhere(options.jerk)) problem.AddPathAccelerationConstraint(zero, zero, s);
  }
}

void AddLimits(KinematicTrajectoryOptimization& problem, const SmoothingOptions& options) {
  const auto limits = LimitsOf(options);
  if (options.model) {
    problem.AddPositionBounds(options.model->position_lower_limits(),
                              options.model->position_upper_limits());
  }
  if (IsFiniteSomewhere(limits[0])) problem.AddVelocityBounds(-*limits[0], *limits[0]);
  if (IsFiniteSomewhere(limits[1])) problem.AddAccelerationBounds(-*limits[1], *limits[1]);
  if (IsFiniteSomewhere(limits[2])) problem.AddJerkBounds(-*limits[2], *limits[2]);
}

void AddCosts(KinematicTrajectoryOptimization& problem, const SmoothingOptions& options) {
  problem.AddDurationCost(options.time_weight);
  if (options.length_weight > 0) problem.AddPathLengthCost(options.length_weight);
  if (options.energy_weight > 0) problem.AddPathEnergyCost(options.energy_weight);
}

/// The ends stay what they are given as: they belong to their regions as well as the found path
/// does.
void AddRegions(KinematicTrajectoryOptimization& problem, const SegmentKnots& knots,
                const ConvexSets& regions) {
  for (int j = 1; j + 1 < problem.num_control_points(); ++j) {
    for (const int i : knots.SegmentsOf(j)) {
      regions[At(i)]->AddPointInSetConstraints(&problem.get_mutable_prog(),
                                               problem.control_points().col(j));
    }
  }
}

VectorXd FirstTimes(const SegmentKnots& knots) {
  std::vector<double> times = {0};
  for (int l = 0; l < knots.num_intervals(); ++l) {
    for (int k = 0; k < kFirstTimes; ++k) times.push_back(knots.Inside(l, (k + 0.5) / kFirstTimes));
  }
  times.push_back(1);
  return Eigen::Map<const VectorXd>(times.data(), std::ssize(times));
}

/// Of each interval where an effort is above its limit, the parameter where it is so by the largest
/// share of it.
VectorXd ExceededTimes(const SegmentKnots& knots, const RigidBodyModel& model,
                       const VectorXd& limits, const BsplineTrajectory<double>& curve) {
  const VectorXd inverse = limits.cwiseInverse();
  std::vector<double> exceeded;
  for (int l = 0; l < knots.num_intervals(); ++l) {
    VectorXd s(kVerifiedTimes + 1);
    for (int k = 0; k <= kVerifiedTimes; ++k) s[k] = knots.Inside(l, 1.0 * k / kVerifiedTimes);
    const MatrixXd efforts = EffortsAlong(model, curve, curve.end_time() * s);
    const VectorXd shares =
        (inverse.asDiagonal() * efforts.cwiseAbs()).colwise().maxCoeff().transpose();
    Eigen::Index worst = 0;
    if (shares.maxCoeff(&worst) > 1 + kEffortTolerance) exceeded.push_back(s[worst]);
  }
  return Eigen::Map<const VectorXd>(exceeded.data(), std::ssize(exceeded));
}

/// Bounds efforts, and bounds them at more times as long as it finds some where they are exceeded.
KinematicTrajectory FindUnderEfforts(KinematicTrajectoryOptimization& problem,
                                     const SegmentKnots& knots, const SmoothingOptions& options) {
  const auto find = [&] { return problem.FindTrajectory(options.solver_options, options.solver); };
  if (!options.model) return find();
  const RigidBodyModel& model = *options.model;
  const VectorXd limits = options.effort.value_or(model.effort_limits());
  if (!IsFiniteSomewhere(limits)) return find();
  problem.AddEffortBoundsAtNormalizedTimes(model, FirstTimes(knots), -limits, limits);
  KinematicTrajectory found = find();
  for (int round = 0; round < options.effort_rounds && found.result.is_success(); ++round) {
    const VectorXd exceeded = ExceededTimes(knots, model, limits, *found.trajectory);
    if (exceeded.size() == 0) break;
    problem.AddEffortBoundsAtNormalizedTimes(model, exceeded, -limits, limits);
    problem.SetInitialGuess(*found.trajectory);
    found = find();
  }
  return found;
}

double RegionViolation(const BsplineTrajectory<double>& curve, const SegmentKnots& knots,
                       const ConvexSets& regions) {
  double worst = 0;
  for (int j = 0; j < curve.num_control_points(); ++j) {
    for (const int i : knots.SegmentsOf(j)) {
      const VectorXd point = curve.control_points()[At(j)];
      worst = std::max(worst, regions[At(i)]->Violation(point));
    }
  }
  return worst;
}

void CheckFound(const CompositeTrajectory<double>& found, const ConvexSets& regions) {
  const int n = found.get_number_of_segments();
  Require(n >= 1, kCall, " needs a trajectory with a segment or more, got none");
  Require(found.cols() == 1, kCall, " needs a trajectory of one column, got ", found.cols());
  for (int i = 1; i < n; ++i) {
    const double end = found.segment(i - 1).end_time();
    const double gap = (found.segment(i - 1).value(end) - found.segment(i).value(end)).norm();
    Require(gap <= kJoint, kCall, " needs segments that join: segment ", i, " starts ", gap,
            " from where the one before ends");
  }
  Require(regions.empty() || std::ssize(regions) == n, kCall, " needs ", n,
          n == 1 ? " region" : " regions", ", one for each segment, got ", regions.size());
  for (std::size_t i = 0; i < regions.size(); ++i) {
    Require(regions[i]->ambient_dimension() == found.rows(), kCall, ": region ", i, " needs ",
            found.rows(), " dimensions, got ", regions[i]->ambient_dimension());
  }
}

/// The region in which a vertex of the problem has its segment.
const ConvexSetPointer& RegionOf(const GcsTrajectoryOptimization& problem,
                                 const GraphOfConvexSets::Vertex* vertex) {
  for (const auto* subgraph : problem.GetSubgraphs()) {
    const auto vertices = subgraph->Vertices();
    const auto at = std::find(vertices.begin(), vertices.end(), vertex);
    if (at != vertices.end())
      return subgraph->regions()[At(static_cast<int>(at - vertices.begin()))];
  }
  Refuse(kCall, " needs a path of this problem, got one with another vertex");
}

}  // namespace

void SmoothingOptions::Check(int num_positions) const {
  CheckLimit("velocity", velocity, num_positions);
  CheckLimit("acceleration", acceleration, num_positions);
  CheckLimit("jerk", jerk, num_positions);
  Require(!model || model->num_positions() == num_positions, kCall, " needs a model of ",
          num_positions, num_positions == 1 ? " joint" : " joints", ", got \"",
          model ? model->name() : "", "\" of ", model ? model->num_positions() : 0);
  Require(!effort || model, kCall, " needs a model for a limit of efforts");
  CheckLimit("efforts", effort, num_positions);
  const auto limits = LimitsOf(*this);
  Require(std::any_of(limits.begin(), limits.end(), IsFiniteSomewhere), kCall,
          " needs a limit of velocity, acceleration or jerk: without, the duration vanishes");
  const int least = IsFiniteSomewhere(jerk) ? 4 : IsFiniteSomewhere(acceleration) ? 3 : 2;
  Require(spline_order >= least, kCall, " needs a spline_order of ", least,
          " or more for these limits, got ", spline_order);
  Require(num_control_points >= spline_order, kCall, " needs ", spline_order,
          " control points or more for order ", spline_order, ", got ", num_control_points);
  Require(effort_rounds >= 0, kCall, " needs effort_rounds of 0 or more, got ", effort_rounds);
}

SmoothedTrajectory SmoothTrajectory(const CompositeTrajectory<double>& found,
                                    const ConvexSets& regions, const SmoothingOptions& options) {
  CheckFound(found, regions);
  options.Check(static_cast<int>(found.rows()));
  const SegmentKnots knots(regions.empty() ? std::vector<double>{1} : SharesOfTime(found),
                           options.spline_order, options.num_control_points);
  const BsplineTrajectory<double> guess = GuessOf(knots, found, options);
  KinematicTrajectoryOptimization problem(guess);
  problem.AddDurationConstraint(kLeastDuration * guess.end_time(), std::nullopt);
  AddEnds(problem, found, options);
  AddLimits(problem, options);
  AddCosts(problem, options);
  if (!regions.empty()) AddRegions(problem, knots, regions);
  if (options.more) options.more(problem);
  SmoothedTrajectory smoothed{FindUnderEfforts(problem, knots, options)};
  if (smoothed.trajectory && !regions.empty()) {
    smoothed.region_violation = RegionViolation(*smoothed.trajectory, knots, regions);
  }
  return smoothed;
}

SmoothedTrajectory SmoothTrajectory(const GcsTrajectoryOptimization& problem,
                                    const GcsTrajectory& found, const SmoothingOptions& options) {
  Require(found.trajectory.get_number_of_segments() > 0, kCall,
          " needs a path with a segment or more, got none: ", found.result().message);
  ConvexSets regions;
  for (const auto* vertex : found.segment_vertices) regions.push_back(RegionOf(problem, vertex));
  if (problem.continuous_revolute_joints().empty()) {
    return SmoothTrajectory(found.trajectory, regions, options);
  }
  const auto unwrapped = GcsTrajectoryOptimization::UnwrapToContinuousTrajectory(
      found.trajectory, problem.continuous_revolute_joints(), std::nullopt, kJoint);
  for (int i = 0; i < unwrapped.get_number_of_segments(); ++i) {
    const double start = unwrapped.segment(i).start_time();
    const VectorXd moved =
        unwrapped.segment(i).value(start) - found.trajectory.segment(i).value(start);
    if (moved.isZero(0)) continue;
    regions[At(i)] = ConvexSetPointer(MinkowskiSum(*regions[At(i)], Point(moved)));
  }
  return SmoothTrajectory(unwrapped, regions, options);
}

}  // namespace switchyard
