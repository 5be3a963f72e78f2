// switchyard/sets/point.hpp - {x}.
#pragma once

#include "switchyard/sets/convex_set.hpp"

namespace switchyard {

/// The set of one point.
class SWITCHYARD_EXPORT Point final : public ConvexSet {
 public:
  Point() : Point(Eigen::VectorXd()) {}
  /// Throws InvalidArgument where an entry is not finite.
  explicit Point(const VectorRef& x);
  [[nodiscard]] const Eigen::VectorXd& x() const { return x_; }
  /// Of any dimension; not once the set is shared.
  void set_x(const VectorRef& x);
  [[nodiscard]] std::string Kind() const override { return "point"; }

 private:
  [[nodiscard]] std::unique_ptr<ConvexSet> DoClone() const override;
  [[nodiscard]] ScaledSet DoScaled() const override;
  [[nodiscard]] std::optional<SetBox> DoBoundingBox() const override;
  [[nodiscard]] std::optional<Eigen::VectorXd> DoMaybeGetPoint() const override { return x_; }
  [[nodiscard]] bool DoIsBounded(Parallelism /*parallelism*/) const override { return true; }
  [[nodiscard]] double DoSupport(const Eigen::VectorXd& direction) const override {
    return direction.dot(x_);
  }
  [[nodiscard]] Eigen::VectorXd DoNearestPoint(const Eigen::VectorXd& /*x*/) const override {
    return x_;
  }
  [[nodiscard]] bool DoHasExactVolume() const override { return true; }
  [[nodiscard]] std::optional<double> DoCalcVolume() const override {
    return x_.size() > 0 ? 0.0 : 1.0;
  }
  Eigen::VectorXd x_;
};

}  // namespace switchyard
