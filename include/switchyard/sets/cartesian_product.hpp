// switchyard/sets/cartesian_product.hpp - tuples of points of several sets.
#pragma once

#include "switchyard/sets/convex_set.hpp"

namespace switchyard {

/// {(x_1, ..., x_k) : x_i in S_i}, or {x : Ax + b in that}.
class SWITCHYARD_EXPORT CartesianProduct final : public ConvexSet {
 public:
  CartesianProduct() : CartesianProduct(ConvexSets()) {}
  explicit CartesianProduct(ConvexSets sets);
  CartesianProduct(const ConvexSet& a, const ConvexSet& b)
      : CartesianProduct(MakeConvexSets(a, b)) {}
  /// A has as many rows as the factors have dimensions together, and b entries. A of any rank:
  /// where it has a kernel the set is not bounded. Throws InvalidArgument where sizes differ or an
  /// entry is not finite.
  CartesianProduct(ConvexSets sets, const Eigen::Ref<const Eigen::MatrixXd>& A, const VectorRef& b);
  [[nodiscard]] int num_factors() const { return static_cast<int>(sets_.size()); }
  [[nodiscard]] const ConvexSet& factor(int i) const {
    return *sets_.at(static_cast<std::size_t>(i));
  }
  /// None where the product was made without.
  [[nodiscard]] const std::optional<Eigen::MatrixXd>& A() const { return A_; }
  [[nodiscard]] const std::optional<Eigen::VectorXd>& b() const { return b_; }
  [[nodiscard]] std::string Kind() const override { return "cartesian product"; }

 private:
  [[nodiscard]] std::unique_ptr<ConvexSet> DoClone() const override;
  [[nodiscard]] ScaledSet DoScaled() const override;
  [[nodiscard]] std::optional<SetBox> DoBoundingBox() const override;
  [[nodiscard]] std::optional<Eigen::VectorXd> DoMaybeGetPoint() const override;
  [[nodiscard]] std::optional<Eigen::VectorXd> DoMaybeGetFeasiblePoint() const override;
  [[nodiscard]] bool DoIsBounded(Parallelism parallelism) const override;
  [[nodiscard]] double DoViolation(const Eigen::VectorXd& x) const override;
  [[nodiscard]] double DoSupport(const Eigen::VectorXd& direction) const override;
  [[nodiscard]] Eigen::VectorXd DoNearestPoint(const Eigen::VectorXd& x) const override;
  [[nodiscard]] bool DoHasExactVolume() const override;
  [[nodiscard]] std::optional<double> DoCalcVolume() const override;
  ConvexSets sets_;
  std::optional<Eigen::MatrixXd> A_;
  std::optional<Eigen::VectorXd> b_;
};

}  // namespace switchyard
