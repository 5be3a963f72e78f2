// Which control points a trajectory has, or comes nearest to.
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/trajectory/kinematic_checks.hpp"
#include "core/trajectory/kinematic_rows.hpp"
#include "switchyard/trajectory/kinematic_trajectory_optimization.hpp"

namespace switchyard {
namespace {

// Of knots that are one after they were shifted and scaled.
constexpr double kSameKnot = 1e-12;

bool SameKnots(const BsplineBasis<double>& a, const BsplineBasis<double>& b) {
  if (a.order() != b.order() || a.knots().size() != b.knots().size()) return false;
  for (std::size_t i = 0; i < a.knots().size(); ++i) {
    if (!(std::abs(a.knots()[i] - b.knots()[i]) <= kSameKnot)) return false;
  }
  return true;
}

/// Of each basis function the mean of the knots within its support; of order 1 the middle of it.
Eigen::VectorXd GrevilleAbscissae(const BsplineBasis<double>& basis) {
  const int n = basis.num_basis_functions(), degree = basis.degree();
  Eigen::VectorXd s(n);
  for (int j = 0; j < n; ++j) {
    const double* knot = basis.knots().data() + j;
    double sum = 0;
    for (int i = 1; i <= degree; ++i) sum += knot[i];
    s[j] = degree > 0 ? sum / degree : (knot[0] + knot[1]) / 2;
    s[j] = std::clamp(s[j], 0.0, 1.0);
  }
  return s;
}

}  // namespace

Eigen::MatrixXd KinematicTrajectoryOptimization::PointsThrough(
    const Trajectory<double>& trajectory) const {
  const int N = num_control_points();
  Eigen::MatrixXd points(num_positions(), N);
  const auto* spline = dynamic_cast<const BsplineTrajectory<double>*>(&trajectory);
  if (spline != nullptr && SameKnots(NormalizedBasis(spline->basis()), basis_)) {
    for (int j = 0; j < N; ++j) {
      points.col(j) = spline->control_points()[static_cast<std::size_t>(j)];
    }
    return points;
  }
  const Eigen::VectorXd s = GrevilleAbscissae(basis_);
  const double start = trajectory.start_time(), length = trajectory.end_time() - start;
  Eigen::MatrixXd values(N, N), at(num_positions(), N);
  for (int j = 0; j < N; ++j) {
    values.col(j) = basis_.EvaluateLinearInControlPoints(s[j]);
    at.col(j) = trajectory.value(start + s[j] * length);
  }
  return values.transpose().partialPivLu().solve(at.transpose()).transpose();
}

void KinematicTrajectoryOptimization::SetInitialGuess(const Trajectory<double>& trajectory) {
  constexpr const char* kCall = "SetInitialGuess";
  Require(trajectory.rows() == num_positions() && trajectory.cols() == 1, kCall,
          " needs a trajectory of ", num_positions(), " x 1, got ", trajectory.rows(), " x ",
          trajectory.cols());
  const double duration = trajectory.end_time() - trajectory.start_time();
  Require(duration > 0 && std::isfinite(duration), kCall,
          " needs a trajectory whose duration is above 0 and finite, got ", duration);
  const Eigen::MatrixXd points = PointsThrough(trajectory);
  program_.SetInitialGuess(control_points_, points.reshaped());
  program_.SetInitialGuess(duration_, duration);
  guessed_duration_ = duration;
  for (const auto& rows : scaled_) rows->Rescale(duration);
}

}  // namespace switchyard
