// switchyard/sets/hyperellipsoid.hpp - {x : |A (x - center)|_2 <= 1}.
#pragma once

#include "switchyard/sets/convex_set.hpp"

namespace switchyard {

class AffineBall;

/// An ellipsoid, a cylinder where A has a kernel.
class SWITCHYARD_EXPORT Hyperellipsoid final : public ConvexSet {
 public:
  Hyperellipsoid() : Hyperellipsoid(Eigen::MatrixXd(0, 0), Eigen::VectorXd()) {}
  /// A is rows x dimension. Throws InvalidArgument where sizes differ or an entry is not finite.
  Hyperellipsoid(const Eigen::Ref<const Eigen::MatrixXd>& A, const VectorRef& center);
  /// The same points, A the inverse of the ball's B. Throws InvalidArgument where B has none.
  explicit Hyperellipsoid(const AffineBall& ellipsoid);
  [[nodiscard]] const Eigen::MatrixXd& A() const { return A_; }
  [[nodiscard]] const Eigen::VectorXd& center() const { return center_; }
  /// The least s with |A (x - center)| <= s for some x of `other`, and such an x. Throws
  /// InvalidArgument where `other` has no point.
  [[nodiscard]] std::pair<double, Eigen::VectorXd> MinimumUniformScalingToTouch(
      const ConvexSet& other) const;
  /// About the center, to `scale` times the volume. Throws InvalidArgument where it is not above 0.
  [[nodiscard]] Hyperellipsoid Scale(double scale) const;
  /// In R^dimension; infinite where A has a kernel.
  [[nodiscard]] double Volume() const;
  /// Throws InvalidArgument where a radius is not positive and finite.
  [[nodiscard]] static Hyperellipsoid MakeAxisAligned(const VectorRef& radius,
                                                      const VectorRef& center);
  [[nodiscard]] static Hyperellipsoid MakeHypersphere(double radius, const VectorRef& center);
  [[nodiscard]] static Hyperellipsoid MakeUnitBall(int dim);
  /// AffineBall's, for points that span R^dimension; else throws InvalidArgument.
  [[nodiscard]] static Hyperellipsoid MinimumVolumeCircumscribedEllipsoid(
      const Eigen::Ref<const Eigen::MatrixXd>& points, double rank_tol = 1e-6);
  [[nodiscard]] std::string Kind() const override { return "hyperellipsoid"; }

 private:
  [[nodiscard]] std::unique_ptr<ConvexSet> DoClone() const override;
  [[nodiscard]] ScaledSet DoScaled() const override;
  [[nodiscard]] std::optional<SetBox> DoBoundingBox() const override;
  [[nodiscard]] std::optional<Eigen::VectorXd> DoMaybeGetFeasiblePoint() const override {
    return center_;
  }
  [[nodiscard]] bool DoIsBounded(Parallelism parallelism) const override;
  [[nodiscard]] double DoSupport(const Eigen::VectorXd& direction) const override;
  [[nodiscard]] Eigen::VectorXd DoNearestPoint(const Eigen::VectorXd& x) const override;
  [[nodiscard]] bool DoHasExactVolume() const override { return true; }
  [[nodiscard]] std::optional<double> DoCalcVolume() const override { return Volume(); }
  Eigen::MatrixXd A_;
  Eigen::VectorXd center_;
};

}  // namespace switchyard
