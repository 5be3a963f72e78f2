#include "switchyard/sets/hyperellipsoid.hpp"

#include <Eigen/QR>
#include <cmath>

#include "core/sets/scaled_rows.hpp"
#include "switchyard/error.hpp"

namespace switchyard {

Hyperellipsoid::Hyperellipsoid(const Eigen::Ref<const Eigen::MatrixXd>& A, const VectorRef& center)
    : ConvexSet(static_cast<int>(center.size())), A_(A), center_(center) {
  Require(A.cols() == center.size(), "hyperellipsoid: A has ", A.cols(), " columns, the center ",
          center.size(), " entries");
  Require(A.allFinite(), "hyperellipsoid: an entry of A is not a finite number");
  Require(center.allFinite(), "hyperellipsoid: an entry of the center is not a finite number");
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

}  // namespace switchyard
