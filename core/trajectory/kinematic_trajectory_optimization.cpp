#include "switchyard/trajectory/kinematic_trajectory_optimization.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/trajectory/kinematic_checks.hpp"
#include "core/trajectory/kinematic_point.hpp"
#include "core/trajectory/kinematic_rows.hpp"
#include "switchyard/model/new_ids.hpp"
#include "switchyard/symbolic/variable_names.hpp"

namespace switchyard {
namespace {

constexpr const char* kClass = "KinematicTrajectoryOptimization";
constexpr double kInfinity = std::numeric_limits<double>::infinity();

BsplineBasis<double> ClampedBasis(int num_control_points, int order) {
  Require(order >= 1, kClass, " needs a spline order of 1 or more, got ", order);
  Require(num_control_points >= order, kClass, " needs ", order,
          " control points or more for order ", order, ", got ", num_control_points);
  return {order, num_control_points, KnotVectorType::kClampedUniform, 0, 1};
}

}  // namespace

BsplineBasis<double> NormalizedBasis(const BsplineBasis<double>& basis) {
  const double start = basis.initial_parameter_value();
  const double length = basis.final_parameter_value() - start;
  std::vector<double> knots = basis.knots();
  for (double& knot : knots) knot = (knot - start) / length;
  return {basis.order(), std::move(knots)};
}

KinematicTrajectoryOptimization::KinematicTrajectoryOptimization(int num_positions,
                                                                 BsplineBasis<double> basis,
                                                                 double duration)
    : basis_(std::move(basis)), guessed_duration_(duration) {
  Require(num_positions >= 1, kClass, " needs a position or more, got ", num_positions);
  Require(duration > 0 && std::isfinite(duration), kClass,
          " needs a duration above 0 and finite, got ", duration);
  control_points_ =
      program_.NewContinuousVariables(num_positions, basis_.num_basis_functions(), "point");
  duration_ = program_.NewContinuousVariables(1, "duration")[0];
  program_.AddBoundingBoxConstraint(0, kInfinity, duration_);
  program_.SetInitialGuess(duration_, duration);
  program_.SetInitialGuess(control_points_, Eigen::VectorXd::Zero(control_points_.size()));
  Variable::Id next = NewVariableIds(std::int64_t{3} * num_positions);
  for (const char* name : {"q", "qdot", "qddot"}) {
    names_.push_back(std::make_shared<const NameBlock>(NameBlock::Shaped(name, num_positions, 0)));
    RegisterNames(next, names_.back());
    VectorXDecisionVariable& all = placeholders_.emplace_back(num_positions);
    for (Variable& one : all) one = Variable(next++);
  }
}

KinematicTrajectoryOptimization::KinematicTrajectoryOptimization(int num_positions,
                                                                 int num_control_points,
                                                                 int spline_order, double duration)
    : KinematicTrajectoryOptimization(num_positions, ClampedBasis(num_control_points, spline_order),
                                      duration) {}

KinematicTrajectoryOptimization::KinematicTrajectoryOptimization(
    const BsplineTrajectory<double>& trajectory)
    : KinematicTrajectoryOptimization(static_cast<int>(trajectory.rows()),
                                      NormalizedBasis(trajectory.basis()),
                                      trajectory.end_time() - trajectory.start_time()) {
  SetInitialGuess(trajectory);
}

KinematicTrajectoryOptimization::~KinematicTrajectoryOptimization() = default;

void KinematicTrajectoryOptimization::CheckBounds(const std::string& call, const VectorRef& lb,
                                                  const VectorRef& ub) const {
  CheckVectorOfBounds(call, "lb", lb, num_positions());
  CheckVectorOfBounds(call, "ub", ub, num_positions());
  for (int i = 0; i < num_positions(); ++i) {
    Require(lb[i] <= ub[i], call, ": lb[", i, "] = ", lb[i], " is above ub[", i, "] = ", ub[i]);
    Require(lb[i] < kInfinity, call, ": lb[", i, "] needs to be below infinity");
    Require(ub[i] > -kInfinity, call, ": ub[", i, "] needs to be above -infinity");
  }
}

// Of the bounds that the program has on it, whoever added them.
double KinematicTrajectoryOptimization::LeastDuration() const {
  double least = 0;
  for (const auto& box : program_.bounding_box_constraints()) {
    for (Eigen::Index k = 0; k < box.variables().size(); ++k) {
      if (!box.variables()[k].equal_to(duration_)) continue;
      least = std::max(least, box.evaluator()->lower_bound()[k]);
    }
  }
  return least;
}

void KinematicTrajectoryOptimization::RequireDuration(const std::string& call) const {
  Require(LeastDuration() > 0, call,
          " divides by the duration, which needs a bound above 0: call "
          "AddDurationConstraint first");
}

CurvePoint KinematicTrajectoryOptimization::PointOf(const std::string& call,
                                                    const VectorXDecisionVariable& placeholders,
                                                    double s) const {
  Require(s >= 0 && s <= 1, call, ": s needs to be from 0 to 1, got ", s);
  const int n = num_positions();
  const Variable::Id first = q()[0].get_id();
  std::vector<CurvePoint::Value> values;
  for (const Variable v : placeholders) {
    const Variable::Id place = v.get_id() - first;
    Require(place >= 0 && place < 3 * n, call,
            " needs its variables among q(), qdot() and qddot(), got ", NameOf(v));
    values.push_back({static_cast<int>(place) / n, static_cast<int>(place) % n});
  }
  return {basis_, s, std::move(values)};
}

VectorXDecisionVariable KinematicTrajectoryOptimization::VariablesOf(const CurvePoint& at,
                                                                     bool with_duration) const {
  VectorXDecisionVariable all(at.num_point_vars() + (with_duration ? 1 : 0));
  Eigen::Index next = 0;
  for (const int joint : at.joints()) {
    for (int c = 0; c < at.columns(); ++c) all[next++] = control_points_(joint, at.first() + c);
  }
  if (with_duration) all[next] = duration_;
  return all;
}

}  // namespace switchyard
