// switchyard/sets/affine_subspace.hpp - {basis y + translation : y in R^k}.
#pragma once

#include "switchyard/sets/convex_set.hpp"

namespace switchyard {

/// A point, line, plane, ... of any dimension.
class SWITCHYARD_EXPORT AffineSubspace final : public ConvexSet {
 public:
  AffineSubspace() : AffineSubspace(Eigen::MatrixXd(0, 0), Eigen::VectorXd()) {}
  /// `basis`: linearly independent columns, at most as many as rows. Throws InvalidArgument where
  /// they are not, sizes differ, or an entry is not finite.
  explicit AffineSubspace(const Eigen::Ref<const Eigen::MatrixXd>& basis,
                          const VectorRef& translation);
  /// The affine hull of a set. Directions in which it is not thicker than `tol` (1e-6 unless
  /// given; absolute), or than that within 1 of one of its points, are none of it. Throws
  /// InvalidArgument for a set without points.
  explicit AffineSubspace(const ConvexSet& set, std::optional<double> tol = std::nullopt);
  [[nodiscard]] const Eigen::MatrixXd& basis() const { return basis_; }
  [[nodiscard]] const Eigen::VectorXd& translation() const { return translation_; }
  /// k, the number of columns of the basis.
  [[nodiscard]] int AffineDimension() const { return static_cast<int>(basis_.cols()); }
  /// y with basis y + translation nearest to each column of x; k rows.
  [[nodiscard]] Eigen::MatrixXd ToLocalCoordinates(
      const Eigen::Ref<const Eigen::MatrixXd>& x) const;
  /// basis y + translation for each column of y, which has k rows.
  [[nodiscard]] Eigen::MatrixXd ToGlobalCoordinates(
      const Eigen::Ref<const Eigen::MatrixXd>& y) const;
  /// Are the translation, and the translation plus each column of the basis, within `tol` of
  /// `other`, absolute?
  [[nodiscard]] bool ContainedIn(const AffineSubspace& other, double tol = 1e-15) const;
  [[nodiscard]] bool IsNearlyEqualTo(const AffineSubspace& other, double tol = 1e-15) const;
  /// dimension x (dimension - k), orthonormal columns.
  [[nodiscard]] const Eigen::MatrixXd& OrthogonalComplementBasis() const { return complement_; }
  [[nodiscard]] std::string Kind() const override { return "affine subspace"; }

 private:
  void SplitSpace();
  [[nodiscard]] std::unique_ptr<ConvexSet> DoClone() const override;
  [[nodiscard]] ScaledSet DoScaled() const override;
  [[nodiscard]] std::optional<SetBox> DoBoundingBox() const override;
  [[nodiscard]] std::optional<Eigen::VectorXd> DoMaybeGetPoint() const override;
  [[nodiscard]] std::optional<Eigen::VectorXd> DoMaybeGetFeasiblePoint() const override {
    return translation_;
  }
  [[nodiscard]] bool DoIsBounded(Parallelism /*parallelism*/) const override {
    return AffineDimension() == 0;
  }
  [[nodiscard]] double DoSupport(const Eigen::VectorXd& direction) const override;
  [[nodiscard]] Eigen::VectorXd DoNearestPoint(const Eigen::VectorXd& x) const override;
  [[nodiscard]] bool DoHasExactVolume() const override { return true; }
  [[nodiscard]] std::optional<double> DoCalcVolume() const override;
  Eigen::MatrixXd basis_;
  Eigen::VectorXd translation_;
  Eigen::MatrixXd complement_;
};

}  // namespace switchyard
