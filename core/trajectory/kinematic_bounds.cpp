// Bounds of the trajectory and its derivatives at all times, by control points.
#include <cmath>
#include <limits>
#include <utility>

#include "core/trajectory/kinematic_rows.hpp"
#include "switchyard/trajectory/kinematic_trajectory_optimization.hpp"

namespace switchyard {
namespace {

using Sides = SideRows::Sides;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Sides kEachSide[] = {Sides::kEqual, Sides::kLower, Sides::kUpper};

const char* NameOf(Sides sides) {
  return sides == Sides::kEqual ? "" : sides == Sides::kLower ? ", lower" : ", upper";
}

}  // namespace

Binding<BoundingBoxConstraint> KinematicTrajectoryOptimization::AddDurationConstraint(
    std::optional<double> lb, std::optional<double> ub) {
  const double lower = lb.value_or(0), upper = ub.value_or(kInfinity);
  constexpr const char* kCall = "AddDurationConstraint";
  Require(lower >= 0 && lower < kInfinity, kCall, " needs lb of 0 or more and finite, got ", lower);
  Require(upper >= 0, kCall, " needs ub of 0 or more, got ", upper);
  Require(lower <= upper, kCall, ": lb = ", lower, " is above ub = ", upper);
  return program_.AddBoundingBoxConstraint(lower, upper, duration_);
}

std::vector<Binding<BoundingBoxConstraint>> KinematicTrajectoryOptimization::AddPositionBounds(
    const VectorRef& lb, const VectorRef& ub) {
  CheckBounds("AddPositionBounds", lb, ub);
  const auto box = std::make_shared<BoundingBoxConstraint>(lb, ub);
  box->set_description("position bounds");
  std::vector<Binding<BoundingBoxConstraint>> added;
  for (int j = 0; j < num_control_points(); ++j) {
    added.push_back(program_.AddConstraint(box, control_points_.col(j)));
  }
  bounds_.push_back({0, lb, ub});
  return added;
}

template <class C, class Make>
std::vector<Binding<C>> KinematicTrajectoryOptimization::AddDerivativeBounds(
    const std::string& call, const Bound& bound, const Make& make) {
  const int k = bound.derivative_order;
  CheckBounds(call, bound.lower, bound.upper);
  Require(basis_.order() > k, call, " needs a spline of order ", k + 1, " or more, got ",
          basis_.order());
  const SparseMatrix W = basis_.DerivativeMap(k).transpose();
  SparseMatrix I(W.rows(), W.rows());
  I.setIdentity();
  std::vector<Binding<C>> added;
  for (int i = 0; i < num_positions(); ++i) {
    const Eigen::VectorXd lower = Eigen::VectorXd::Constant(W.rows(), bound.lower[i]);
    const Eigen::VectorXd upper = Eigen::VectorXd::Constant(W.rows(), bound.upper[i]);
    for (const Sides sides : kEachSide) {
      const SideRows rows(I, lower, upper, W, sides);
      if (rows.empty()) continue;
      const std::shared_ptr<C> constraint = make(rows);
      constraint->set_description(Text(call.substr(3), " of position ", i, NameOf(sides)));
      added.push_back(program_.AddConstraint(Binding<C>(
          constraint,
          {control_points_.row(i).transpose(), VectorXDecisionVariable::Constant(1, duration_)})));
    }
  }
  bounds_.push_back(bound);
  return added;
}

std::shared_ptr<Constraint> KinematicTrajectoryOptimization::MakePowerRows(const SideRows& rows,
                                                                           int k) {
  if (k == 1 || rows.b.isZero(0)) return rows.OfDuration();
  scaled_.push_back(std::make_shared<PowerRows>(rows, k, guessed_duration_));
  return scaled_.back();
}

std::vector<Binding<LinearConstraint>> KinematicTrajectoryOptimization::AddVelocityBounds(
    const VectorRef& lb, const VectorRef& ub) {
  return AddDerivativeBounds<LinearConstraint>(
      "AddVelocityBounds", {1, lb, ub}, [](const SideRows& rows) { return rows.OfDuration(); });
}

std::vector<Binding<Constraint>> KinematicTrajectoryOptimization::AddAccelerationBounds(
    const VectorRef& lb, const VectorRef& ub) {
  return AddDerivativeBounds<Constraint>(
      "AddAccelerationBounds", {2, lb, ub},
      [this](const SideRows& rows) { return MakePowerRows(rows, 2); });
}

std::vector<Binding<Constraint>> KinematicTrajectoryOptimization::AddJerkBounds(
    const VectorRef& lb, const VectorRef& ub) {
  return AddDerivativeBounds<Constraint>(
      "AddJerkBounds", {3, lb, ub},
      [this](const SideRows& rows) { return MakePowerRows(rows, 3); });
}

}  // namespace switchyard
