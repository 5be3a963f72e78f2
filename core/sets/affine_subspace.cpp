#include "switchyard/sets/affine_subspace.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "core/sets/affine_hull.hpp"
#include "switchyard/error.hpp"
#include "switchyard/sets/scaled_rows.hpp"

namespace switchyard {
namespace {

constexpr double kOrthogonal = 1e-12;  // of a direction: what may be along the subspace

}  // namespace

AffineSubspace::AffineSubspace(const Eigen::Ref<const Eigen::MatrixXd>& basis,
                               const VectorRef& translation)
    : ConvexSet(static_cast<int>(translation.size())), basis_(basis), translation_(translation) {
  Require(basis.rows() == translation.size(), "affine subspace: the basis has ", basis.rows(),
          " rows, the translation ", translation.size(), " entries");
  Require(basis.allFinite(), "affine subspace: an entry of the basis is not a finite number");
  Require(translation.allFinite(),
          "affine subspace: an entry of the translation is not a finite number");
  SplitSpace();
}

AffineSubspace::AffineSubspace(const ConvexSet& set, std::optional<double> tol)
    : ConvexSet(set.ambient_dimension()) {
  AffineHull hull = AffineHullOf(set, tol.value_or(kAffineHullTolerance));
  basis_ = std::move(hull.basis);
  translation_ = std::move(hull.point);
  SplitSpace();
}

void AffineSubspace::SplitSpace() {
  const Eigen::Index n = basis_.rows();
  const Eigen::Index k = basis_.cols();
  if (k == 0 || n == 0) {
    Require(k == 0, "affine subspace: the basis of one in R^0 has no columns, got ", k);
    complement_ = Eigen::MatrixXd::Identity(n, n);
    return;
  }
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(basis_);
  Require(qr.rank() == k, "affine subspace: the columns of a basis must be linearly independent, ",
          "got ", k, " of rank ", qr.rank());
  const Eigen::MatrixXd Q = qr.householderQ();
  complement_ = Q.rightCols(n - k);
}

Eigen::MatrixXd AffineSubspace::ToLocalCoordinates(
    const Eigen::Ref<const Eigen::MatrixXd>& x) const {
  Require(x.rows() == ambient_dimension(), "points of an affine subspace in R^",
          ambient_dimension(), " need ", ambient_dimension(), " rows, got ", x.rows());
  if (basis_.cols() == 0) return Eigen::MatrixXd(0, x.cols());
  return basis_.householderQr().solve(x.colwise() - translation_);
}

Eigen::MatrixXd AffineSubspace::ToGlobalCoordinates(
    const Eigen::Ref<const Eigen::MatrixXd>& y) const {
  Require(y.rows() == AffineDimension(), "local coordinates of an affine subspace need ",
          AffineDimension(), " rows, got ", y.rows());
  return (basis_ * y).colwise() + translation_;
}

bool AffineSubspace::ContainedIn(const AffineSubspace& other, double tol) const {
  Require(other.ambient_dimension() == ambient_dimension(), "an affine subspace in R^",
          ambient_dimension(), " is compared with one in R^", ambient_dimension(),
          ", got one in R^", other.ambient_dimension());
  Eigen::MatrixXd corners(translation_.size(), 1 + basis_.cols());
  corners << translation_, basis_.colwise() + translation_;
  const Eigen::MatrixXd off =
      other.complement_.transpose() * (corners.colwise() - other.translation_);
  return off.size() == 0 || off.colwise().norm().maxCoeff() <= tol;
}

bool AffineSubspace::IsNearlyEqualTo(const AffineSubspace& other, double tol) const {
  return ContainedIn(other, tol) && other.ContainedIn(*this, tol);
}

std::unique_ptr<ConvexSet> AffineSubspace::DoClone() const {
  return std::make_unique<AffineSubspace>(*this);
}

// N'x = t N'translation, N the orthogonal complement: no coordinates are needed.
ScaledSet AffineSubspace::DoScaled() const {
  ScaledRows rows(ambient_dimension());
  const Eigen::VectorXd side = complement_.transpose() * translation_;
  for (Eigen::Index i = 0; i < side.size(); ++i) {
    rows.AddTwoSided(side[i], side[i], [&](int row) {
      for (int j = 0; j < ambient_dimension(); ++j) rows.Set(row, 1 + j, complement_(j, i));
    });
  }
  return rows.Finish();
}

std::optional<SetBox> AffineSubspace::DoBoundingBox() const {
  SetBox box{translation_, translation_, false};
  for (Eigen::Index i = 0; i < translation_.size(); ++i) {
    if (basis_.row(i).isZero(0)) continue;
    box.lower[i] = -kInfinity;
    box.upper[i] = kInfinity;
  }
  return box;
}

std::optional<Eigen::VectorXd> AffineSubspace::DoMaybeGetPoint() const {
  if (AffineDimension() > 0) return std::nullopt;
  return translation_;
}

double AffineSubspace::DoSupport(const Eigen::VectorXd& direction) const {
  const Eigen::VectorXd across = complement_ * (complement_.transpose() * direction);
  const bool orthogonal = (direction - across).norm() <= kOrthogonal * direction.norm();
  return orthogonal || AffineDimension() == 0 ? direction.dot(translation_) : kInfinity;
}

Eigen::VectorXd AffineSubspace::DoNearestPoint(const Eigen::VectorXd& x) const {
  return x - complement_ * (complement_.transpose() * (x - translation_));
}

std::optional<double> AffineSubspace::DoCalcVolume() const {
  if (ambient_dimension() == 0) return 1.0;
  return AffineDimension() < ambient_dimension() ? 0.0 : kInfinity;
}

}  // namespace switchyard
