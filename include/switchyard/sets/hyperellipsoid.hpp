// switchyard/sets/hyperellipsoid.hpp - {x : |A (x - center)|_2 <= 1}.
#pragma once

#include "switchyard/sets/convex_set.hpp"

namespace switchyard {

/// An ellipsoid, a cylinder where A has a kernel.
class SWITCHYARD_EXPORT Hyperellipsoid final : public ConvexSet {
 public:
  Hyperellipsoid() : Hyperellipsoid(Eigen::MatrixXd(0, 0), Eigen::VectorXd()) {}
  /// A is rows x dimension. Throws InvalidArgument where sizes differ or an entry is not finite.
  Hyperellipsoid(const Eigen::Ref<const Eigen::MatrixXd>& A, const VectorRef& center);
  [[nodiscard]] const Eigen::MatrixXd& A() const { return A_; }
  [[nodiscard]] const Eigen::VectorXd& center() const { return center_; }
  /// Throws InvalidArgument where a radius is not positive and finite.
  [[nodiscard]] static Hyperellipsoid MakeAxisAligned(const VectorRef& radius,
                                                      const VectorRef& center);
  [[nodiscard]] static Hyperellipsoid MakeHypersphere(double radius, const VectorRef& center);
  [[nodiscard]] static Hyperellipsoid MakeUnitBall(int dim);
  [[nodiscard]] std::string Kind() const override { return "hyperellipsoid"; }

 private:
  [[nodiscard]] std::unique_ptr<ConvexSet> DoClone() const override;
  [[nodiscard]] ScaledSet DoScaled() const override;
  [[nodiscard]] std::optional<SetBox> DoBoundingBox() const override;
  Eigen::MatrixXd A_;
  Eigen::VectorXd center_;
};

}  // namespace switchyard
