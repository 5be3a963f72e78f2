#include "switchyard/sets/hyperellipsoid.hpp"

#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <cmath>

#include "core/sets/ball_volume.hpp"
#include "core/sets/set_program.hpp"

#include "switchyard/error.hpp"
#include "switchyard/sets/affine_ball.hpp"
#include "switchyard/sets/scaled_rows.hpp"
#include "switchyard/solve/solve.hpp"

namespace switchyard {
namespace {

constexpr double kInRange = 1e-12;  // of a direction: what may be outside the range of A'

Eigen::MatrixXd InverseOf(const AffineBall& ball) {
  const Eigen::FullPivLU<Eigen::MatrixXd> B(ball.B());
  Require(ball.B().rows() == ball.B().cols() && B.isInvertible(), "a hyperellipsoid needs an ",
          "affine ball with a B that has an inverse, got one with ", ball.B().rows(), " x ",
          ball.B().cols(), " entries of rank ", B.rank());
  return B.inverse();
}

}  // namespace

Hyperellipsoid::Hyperellipsoid(const Eigen::Ref<const Eigen::MatrixXd>& A, const VectorRef& center)
    : ConvexSet(static_cast<int>(center.size())), A_(A), center_(center) {
  Require(A.cols() == center.size(), "hyperellipsoid: A has ", A.cols(), " columns, the center ",
          center.size(), " entries");
  Require(A.allFinite(), "hyperellipsoid: an entry of A is not a finite number");
  Require(center.allFinite(), "hyperellipsoid: an entry of the center is not a finite number");
}

Hyperellipsoid::Hyperellipsoid(const AffineBall& ellipsoid)
    : Hyperellipsoid(InverseOf(ellipsoid), ellipsoid.center()) {}

std::pair<double, Eigen::VectorXd> Hyperellipsoid::MinimumUniformScalingToTouch(
    const ConvexSet& other) const {
  const int n = ambient_dimension();
  Require(other.ambient_dimension() == n, "an ellipsoid in R^", n,
          " is scaled to touch a set in R^", n, ", got one in R^", other.ambient_dimension());
  Require(!other.IsEmpty(), "an ellipsoid is scaled to touch a set with a point, got an empty ",
          other.Kind());
  SetProgram nearest(other);
  const VectorXDecisionVariable s = nearest.program.NewContinuousVariables(1, "s");
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(1 + A_.rows(), 1 + n);
  rows(0, 0) = 1;
  rows.bottomRightCorner(A_.rows(), n) = A_;
  Eigen::VectorXd shift(1 + A_.rows());
  shift << 0, -A_ * center_;
  nearest.program.AddLorentzConeConstraint(rows, shift, VariableList({s, nearest.x}));
  nearest.program.AddLinearCost(Eigen::VectorXd::Ones(1), s);
  const MathematicalProgramResult result = Solve(nearest.program);
  if (!result.is_success()) CouldNotTell(other.Kind(), "where an ellipsoid touches it", result);
  const Eigen::VectorXd x = result.GetSolution(nearest.x);
  return {(A_ * (x - center_)).norm(), x};
}

Hyperellipsoid Hyperellipsoid::Scale(double scale) const {
  Require(scale > 0 && std::isfinite(scale),
          "hyperellipsoid: a scale must be positive and finite, got ", scale);
  return {A_ / std::pow(scale, 1.0 / ambient_dimension()), center_};
}

double Hyperellipsoid::Volume() const {
  const int n = ambient_dimension();
  if (n == 0) return 1;
  if (A_.rows() < n) return kInfinity;
  return UnitBallVolume(n) / Eigen::JacobiSVD<Eigen::MatrixXd>(A_).singularValues().prod();
}

Hyperellipsoid Hyperellipsoid::MinimumVolumeCircumscribedEllipsoid(
    const Eigen::Ref<const Eigen::MatrixXd>& points, double rank_tol) {
  return Hyperellipsoid(AffineBall::MinimumVolumeCircumscribedEllipsoid(points, rank_tol));
}

Hyperellipsoid Hyperellipsoid::MakeAxisAligned(const VectorRef& radius, const VectorRef& center) {
  for (Eigen::Index i = 0; i < radius.size(); ++i) {
    Require(radius[i] > 0 && std::isfinite(radius[i]), "hyperellipsoid: radius[", i,
            "] must be positive and finite, got ", radius[i]);
  }
  return {Eigen::MatrixXd(radius.cwiseInverse().asDiagonal()), center};
}

Hyperellipsoid Hyperellipsoid::MakeHypersphere(double radius, const VectorRef& center) {
  return MakeAxisAligned(Eigen::VectorXd::Constant(center.size(), radius), center);
}

Hyperellipsoid Hyperellipsoid::MakeUnitBall(int dim) {
  return MakeHypersphere(1, Eigen::VectorXd::Zero(dim));
}

std::unique_ptr<ConvexSet> Hyperellipsoid::DoClone() const {
  return std::make_unique<Hyperellipsoid>(*this);
}

// |Ax - Act| <= t.
ScaledSet Hyperellipsoid::DoScaled() const {
  ScaledRows rows(ambient_dimension());
  const auto m = static_cast<int>(A_.rows());
  const int first = rows.AddCone({SY_CONE_SECOND_ORDER, m + 1, 0});
  rows.SetCone(first, 0, 1);
  const Eigen::VectorXd shift = A_ * center_;
  for (int i = 0; i < m; ++i) {
    rows.SetCone(first + 1 + i, 0, -shift[i]);
    for (int j = 0; j < ambient_dimension(); ++j) rows.SetCone(first + 1 + i, 1 + j, A_(i, j));
  }
  return rows.Finish();
}

// With L a left inverse of A, x - c = L A (x - c), so |x_i - c_i| <= |row i of L|. Rounding is
// covered by a part in 1e9, far above what a well-conditioned A can lose.
std::optional<SetBox> Hyperellipsoid::DoBoundingBox() const {
  const int n = ambient_dimension();
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(A_);
  if (n == 0 || qr.rank() < n) return std::nullopt;
  const Eigen::MatrixXd L = qr.solve(Eigen::MatrixXd::Identity(A_.rows(), A_.rows()));
  if ((L * A_ - Eigen::MatrixXd::Identity(n, n)).cwiseAbs().maxCoeff() > 1e-10) return std::nullopt;
  const Eigen::VectorXd half =
      (L.rowwise().norm().array() * (1 + 1e-9) + 1e-9 * center_.array().abs() * 1e-3).matrix();
  return SetBox{center_ - half, center_ + half, false};
}

bool Hyperellipsoid::DoIsBounded(Parallelism /*parallelism*/) const {
  return ambient_dimension() == 0 || A_.colPivHouseholderQr().rank() == ambient_dimension();
}

// direction = A'u for the shortest u, where it is in the range of A': then it is u'A (x - c) that
// is largest, at |u|.
double Hyperellipsoid::DoSupport(const Eigen::VectorXd& direction) const {
  const Eigen::MatrixXd transposed = A_.transpose();
  if (A_.rows() == 0) return direction.isZero(0) ? 0 : kInfinity;
  const Eigen::VectorXd u = transposed.completeOrthogonalDecomposition().solve(direction);
  if ((transposed * u - direction).norm() > kInRange * direction.norm()) return kInfinity;
  return direction.dot(center_) + u.norm();
}

Eigen::VectorXd Hyperellipsoid::DoNearestPoint(const Eigen::VectorXd& x) const {
  if (!IsBounded()) return ConvexSet::DoNearestPoint(x);
  return AffineBall(*this).Projection(x)->second;
}

}  // namespace switchyard
