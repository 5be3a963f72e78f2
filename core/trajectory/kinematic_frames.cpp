// Where a robot's frames are at normalized times, and how far its bodies are apart.
#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "switchyard/dynamics/model_functions.hpp"
#include "switchyard/trajectory/kinematic_trajectory_optimization.hpp"

namespace switchyard {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kRotation = 1e-6;

/// Rows of a pose, and their bounds.
struct PoseRows {
  std::vector<PoseRow> rows;
  VectorXd lower, upper;
};

/// The coordinates of o + R point.
std::vector<PoseRow> CoordinatesOf(const Vector3d& point) {
  std::vector<PoseRow> rows;
  for (int i = 0; i < 3; ++i) {
    const Vector3d axis = Vector3d::Unit(i);
    rows.push_back({axis, axis * point.transpose(), 0});
  }
  return rows;
}

/// tr(D'R) = 1 + 2 cos f, and D'R - R'D = 2 sin(f) [axis], so entry (j, i) of D'R less entry (i, j)
/// is 2 sin(f) axis_k for (i, j, k) in cyclic order; entry (j, i) of D'R is tr((D e_j e_i')' R).
PoseRows AngleFrom(const Matrix3d& D, double tolerance) {
  if (tolerance > 0) {
    const double half = std::sin(tolerance / 2);
    return {{{Vector3d::Zero(), -D / (4 * half), 3 / (4 * half)}},
            VectorXd::Constant(1, -kInfinity),
            VectorXd::Constant(1, half)};
  }
  PoseRows rows{{}, VectorXd::Zero(4), VectorXd::Zero(4)};
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    Matrix3d A = Matrix3d::Zero();
    A.col(i) = D.col(j) / 2;
    A.col(j) = -D.col(i) / 2;
    rows.rows.push_back({Vector3d::Zero(), A, 0});
  }
  rows.rows.push_back({Vector3d::Zero(), D / 2, -0.5});
  rows.upper[3] = kInfinity;
  return rows;
}

}  // namespace

Binding<Constraint> KinematicTrajectoryOptimization::AddFramePositionConstraint(
    const RigidBodyModel& model, const std::string& frame, const Vector3d& lower,
    const Vector3d& upper, double s, const Vector3d& point) {
  constexpr const char* kCall = "AddFramePositionConstraint";
  CheckModel(kCall, model);
  for (int i = 0; i < 3; ++i) {
    Require(lower[i] <= upper[i], kCall, ": lower[", i, "] = ", lower[i], " is above upper[", i,
            "] = ", upper[i]);
  }
  for (int i = 0; i < 3; ++i) {
    Require(std::isfinite(point[i]), kCall, ": point[", i, "] needs to be finite, got ", point[i]);
  }
  return AddFunction(kCall, Text("position of \"", frame, "\""),
                     FrameFunction(model, model.FrameIndex(frame), CoordinatesOf(point)), lower,
                     upper, q(), VectorXd::Constant(1, s))[0];
}

Binding<Constraint> KinematicTrajectoryOptimization::AddFrameOrientationConstraint(
    const RigidBodyModel& model, const std::string& frame, const Matrix3d& axes, double tolerance,
    double s) {
  constexpr const char* kCall = "AddFrameOrientationConstraint";
  CheckModel(kCall, model);
  Require((axes.transpose() * axes - Matrix3d::Identity()).cwiseAbs().maxCoeff() <= kRotation &&
              axes.determinant() > 0,
          kCall, " needs axes that are a rotation: orthonormal columns, of determinant 1");
  Require(tolerance >= 0 && tolerance < std::numbers::pi, kCall,
          " needs a tolerance from 0 to below pi, got ", tolerance);
  PoseRows angle = AngleFrom(axes, tolerance);
  return AddFunction(kCall, Text("orientation of \"", frame, "\""),
                     FrameFunction(model, model.FrameIndex(frame), std::move(angle.rows)),
                     angle.lower, angle.upper, q(), VectorXd::Constant(1, s))[0];
}

std::vector<Binding<Constraint>> KinematicTrajectoryOptimization::AddMinimumDistanceConstraint(
    const RigidBodyModel& model, double distance, const VectorRef& s,
    const std::optional<std::vector<int>>& pairs) {
  constexpr const char* kCall = "AddMinimumDistanceConstraint";
  CheckModel(kCall, model);
  Require(std::isfinite(distance), kCall, " needs a finite distance, got ", distance);
  std::vector<int> all(model.pairs().size());
  std::iota(all.begin(), all.end(), 0);
  if (pairs) all = *pairs;
  Require(!all.empty(), kCall, " needs a pair of shapes or more",
          model.pairs().empty()
              ? Text(", and \"", model.name(), "\" has none: load it with geometry")
              : "");
  const auto num = static_cast<Eigen::Index>(all.size());
  return AddFunction(kCall, "distances in \"" + model.name() + "\"",
                     DistanceFunction(model, std::move(all)), VectorXd::Constant(num, distance),
                     VectorXd::Constant(num, kInfinity), q(), s);
}

}  // namespace switchyard
