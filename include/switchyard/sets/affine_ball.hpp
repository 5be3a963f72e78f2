// switchyard/sets/affine_ball.hpp - {B y + center : |y|_2 <= 1}.
#pragma once

#include "switchyard/sets/convex_set.hpp"

namespace switchyard {

class Hyperellipsoid;

/// The affine image of a unit ball: an ellipsoid, flat where B has not full row rank.
class SWITCHYARD_EXPORT AffineBall final : public ConvexSet {
 public:
  AffineBall() : AffineBall(Eigen::MatrixXd(0, 0), Eigen::VectorXd()) {}
  /// B is dimension x any number of columns. Throws InvalidArgument where sizes differ or an entry
  /// is not finite.
  AffineBall(const Eigen::Ref<const Eigen::MatrixXd>& B, const VectorRef& center);
  /// The same points, B the pseudo-inverse of the ellipsoid's A. Throws InvalidArgument for one
  /// that is not bounded.
  explicit AffineBall(const Hyperellipsoid& ellipsoid);
  [[nodiscard]] const Eigen::MatrixXd& B() const { return B_; }
  [[nodiscard]] const Eigen::VectorXd& center() const { return center_; }

  /// Throws InvalidArgument where a radius is negative or not finite.
  [[nodiscard]] static AffineBall MakeAxisAligned(const VectorRef& radius, const VectorRef& center);
  [[nodiscard]] static AffineBall MakeHypersphere(double radius, const VectorRef& center);
  [[nodiscard]] static AffineBall MakeUnitBall(int dim);
  /// The segment from x_1 to x_2 is its longest axis, all others have the radius epsilon. Throws
  /// InvalidArgument where the points are less than 1e-9 apart, or epsilon is negative.
  [[nodiscard]] static AffineBall MakeAffineBallFromLineSegment(const VectorRef& x_1,
                                                                const VectorRef& x_2,
                                                                double epsilon = 1e-3);
  /// The ball of least volume, in the affine hull of the points (columns), that holds them, its
  /// volume to a part in 1e6. Singular values of the points below `rank_tol` of the largest are
  /// taken for 0. Throws InvalidArgument where there is no point, or an entry is not finite.
  [[nodiscard]] static AffineBall MinimumVolumeCircumscribedEllipsoid(
      const Eigen::Ref<const Eigen::MatrixXd>& points, double rank_tol = 1e-6);
  [[nodiscard]] std::string Kind() const override { return "affine ball"; }

 private:
  [[nodiscard]] std::unique_ptr<ConvexSet> DoClone() const override;
  [[nodiscard]] ScaledSet DoScaled() const override;
  [[nodiscard]] std::optional<SetBox> DoBoundingBox() const override;
  [[nodiscard]] std::optional<Eigen::VectorXd> DoMaybeGetPoint() const override;
  [[nodiscard]] std::optional<Eigen::VectorXd> DoMaybeGetFeasiblePoint() const override {
    return center_;
  }
  [[nodiscard]] bool DoIsBounded(Parallelism /*parallelism*/) const override { return true; }
  [[nodiscard]] double DoViolation(const Eigen::VectorXd& x) const override;
  [[nodiscard]] double DoSupport(const Eigen::VectorXd& direction) const override;
  [[nodiscard]] Eigen::VectorXd DoNearestPoint(const Eigen::VectorXd& x) const override;
  [[nodiscard]] bool DoHasExactVolume() const override { return true; }
  [[nodiscard]] std::optional<double> DoCalcVolume() const override;
  Eigen::MatrixXd B_;
  Eigen::VectorXd center_;
};

}  // namespace switchyard
