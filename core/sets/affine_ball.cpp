#include "switchyard/sets/affine_ball.hpp"

#include <Eigen/QR>
#include <Eigen/SVD>
#include <cfloat>
#include <cmath>

#include "core/sets/ball_volume.hpp"
#include "switchyard/error.hpp"
#include "switchyard/sets/hyperellipsoid.hpp"
#include "switchyard/sets/scaled_rows.hpp"

namespace switchyard {
namespace {

constexpr double kSamePoint = 1e-9;
// Of what rounding may leave of a point in the range of B, per unit of the sizes.
constexpr double kRounding = 64 * DBL_EPSILON;

Eigen::MatrixXd BallOf(const Hyperellipsoid& ellipsoid) {
  const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> A(ellipsoid.A());
  Require(A.rank() == ellipsoid.ambient_dimension(), "an affine ball needs a bounded ",
          "hyperellipsoid, got one in R^", ellipsoid.ambient_dimension(), " with A of rank ",
          A.rank());
  return A.pseudoInverse();
}

}  // namespace

AffineBall::AffineBall(const Eigen::Ref<const Eigen::MatrixXd>& B, const VectorRef& center)
    : ConvexSet(static_cast<int>(center.size())), B_(B), center_(center) {
  Require(B.rows() == center.size(), "affine ball: B has ", B.rows(), " rows, the center ",
          center.size(), " entries");
  Require(B.allFinite(), "affine ball: an entry of B is not a finite number");
  Require(center.allFinite(), "affine ball: an entry of the center is not a finite number");
}

AffineBall::AffineBall(const Hyperellipsoid& ellipsoid)
    : AffineBall(BallOf(ellipsoid), ellipsoid.center()) {}

AffineBall AffineBall::MakeAxisAligned(const VectorRef& radius, const VectorRef& center) {
  for (Eigen::Index i = 0; i < radius.size(); ++i) {
    Require(radius[i] >= 0 && std::isfinite(radius[i]), "affine ball: radius[", i,
            "] must be a finite number of at least 0, got ", radius[i]);
  }
  return {Eigen::MatrixXd(radius.asDiagonal()), center};
}

AffineBall AffineBall::MakeHypersphere(double radius, const VectorRef& center) {
  return MakeAxisAligned(Eigen::VectorXd::Constant(center.size(), radius), center);
}

AffineBall AffineBall::MakeUnitBall(int dim) {
  return MakeHypersphere(1, Eigen::VectorXd::Zero(dim));
}

// With u the unit vector along the segment, half of it along u u', epsilon along I - u u'.
AffineBall AffineBall::MakeAffineBallFromLineSegment(const VectorRef& x_1, const VectorRef& x_2,
                                                     double epsilon) {
  const Eigen::Index n = x_1.size();
  Require(x_2.size() == n, "a segment needs ends of one dimension, got ", n, " and ", x_2.size());
  Require(epsilon >= 0, "a ball about a segment needs a radius of at least 0, got ", epsilon);
  const double length = (x_2 - x_1).norm();
  Require(length >= kSamePoint, "a segment needs ends that are ", kSamePoint,
          " apart or more, got ", length);
  const Eigen::VectorXd u = (x_2 - x_1) / length;
  const Eigen::MatrixXd along = u * u.transpose();
  return {0.5 * length * along + epsilon * (Eigen::MatrixXd::Identity(n, n) - along),
          0.5 * (x_1 + x_2)};
}

std::unique_ptr<ConvexSet> AffineBall::DoClone() const {
  return std::make_unique<AffineBall>(*this);
}

// x = B y + center t, |y| <= t.
ScaledSet AffineBall::DoScaled() const {
  const int n = ambient_dimension();
  const auto m = static_cast<int>(B_.cols());
  ScaledRows rows(n, m);
  for (int i = 0; i < n; ++i) {
    const int row = rows.AddRow(0, 0);
    rows.Set(row, 0, center_[i]);
    rows.Set(row, 1 + i, -1);
    for (int j = 0; j < m; ++j) rows.Set(row, 1 + n + j, B_(i, j));
  }
  const int first = rows.AddCone({SY_CONE_SECOND_ORDER, m + 1, 0});
  rows.SetCone(first, 0, 1);
  for (int j = 0; j < m; ++j) rows.SetCone(first + 1 + j, 1 + n + j, 1);
  return rows.Finish();
}

std::optional<SetBox> AffineBall::DoBoundingBox() const {
  const Eigen::VectorXd half = B_.rowwise().norm();
  const Eigen::VectorXd margin =
      (static_cast<double>(B_.cols()) + 4) * DBL_EPSILON * (half + center_.cwiseAbs());
  return SetBox{center_ - half - margin, center_ + half + margin, false};
}

std::optional<Eigen::VectorXd> AffineBall::DoMaybeGetPoint() const {
  if (B_.isZero(0)) return center_;
  return std::nullopt;
}

// A point of the ball is told by the shortest y with B y = x - center.
double AffineBall::DoViolation(const Eigen::VectorXd& x) const {
  if (!x.allFinite() || B_.size() == 0) return ConvexSet::DoViolation(x);
  const Eigen::VectorXd from_center = x - center_;
  const Eigen::VectorXd y = B_.completeOrthogonalDecomposition().solve(from_center);
  const double left = (B_ * y - from_center).lpNorm<Eigen::Infinity>();
  const double size = x.lpNorm<Eigen::Infinity>() + center_.lpNorm<Eigen::Infinity>();
  if (left <= kRounding * size && y.norm() <= 1 + kRounding) return 0;
  return ConvexSet::DoViolation(x);
}

double AffineBall::DoSupport(const Eigen::VectorXd& direction) const {
  return direction.dot(center_) + (B_.transpose() * direction).norm();
}

// With B = U diag(s) V' and z = U'(x - center), the nearest point is U diag(s) u for the u in the
// unit ball that minimizes |s u - z|: u_i = s_i z_i / (s_i^2 + m), m >= 0 the multiplier of the
// ball, 0 or the root of |u| = 1, between 0 and |s z|, where |u(m)| <= |s z| / m = 1.
Eigen::VectorXd AffineBall::DoNearestPoint(const Eigen::VectorXd& x) const {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(B_, Eigen::ComputeThinU);
  const Eigen::ArrayXd s = svd.singularValues().array();
  const Eigen::ArrayXd z = (svd.matrixU().transpose() * (x - center_)).array();
  const auto u = [&](double m) -> Eigen::ArrayXd {
    return (s > 0).select(s * z / (s * s + m).max(DBL_MIN), 0.0);
  };
  const auto point = [&](const Eigen::ArrayXd& at) -> Eigen::VectorXd {
    return center_ + svd.matrixU() * (s * at).matrix();
  };
  if (u(0).matrix().norm() <= 1) return point(u(0));
  double low = 0;
  double high = (s * z).matrix().norm();
  for (double m = 0.5 * high; low < m && m < high; m = 0.5 * (low + high)) {
    (u(m).matrix().norm() > 1 ? low : high) = m;
  }
  return point(u(high));
}

std::optional<double> AffineBall::DoCalcVolume() const {
  const int n = ambient_dimension();
  if (n == 0) return 1.0;
  if (B_.cols() < n) return 0.0;
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(B_);
  return svd.singularValues().prod() * UnitBallVolume(n);
}

}  // namespace switchyard
