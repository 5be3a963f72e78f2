// switchyard/sets/hyperrectangle.hpp - {x : lb <= x <= ub}.
#pragma once

#include <optional>

#include "switchyard/sets/convex_set.hpp"
#include "switchyard/sets/hpolyhedron.hpp"

namespace switchyard {

/// An axis-aligned box; sides may be infinite.
class SWITCHYARD_EXPORT Hyperrectangle final : public ConvexSet {
 public:
  Hyperrectangle() : Hyperrectangle(Eigen::VectorXd(), Eigen::VectorXd()) {}
  /// Throws InvalidArgument where sizes differ, a number is NaN, or lb[i] > ub[i].
  Hyperrectangle(const VectorRef& lb, const VectorRef& ub);
  [[nodiscard]] const Eigen::VectorXd& lb() const { return lb_; }
  [[nodiscard]] const Eigen::VectorXd& ub() const { return ub_; }
  /// Throws where a side is infinite.
  [[nodiscard]] Eigen::VectorXd Center() const;
  /// Each coordinate evenly and by itself. Throws InvalidArgument where a side is infinite.
  [[nodiscard]] Eigen::VectorXd UniformSample(RandomGenerator* generator) const;
  [[nodiscard]] HPolyhedron MakeHPolyhedron() const;
  [[nodiscard]] std::optional<Hyperrectangle> MaybeGetIntersection(
      const Hyperrectangle& other) const;
  /// nullopt where the set is empty or an end of its box is not known to be finite.
  [[nodiscard]] static std::optional<Hyperrectangle> MaybeCalcAxisAlignedBoundingBox(
      const ConvexSet& set);
  [[nodiscard]] std::string Kind() const override { return "hyperrectangle"; }

 private:
  [[nodiscard]] std::unique_ptr<ConvexSet> DoClone() const override;
  [[nodiscard]] ScaledSet DoScaled() const override;
  [[nodiscard]] std::optional<SetBox> DoBoundingBox() const override;
  [[nodiscard]] std::optional<Eigen::VectorXd> DoMaybeGetPoint() const override;
  [[nodiscard]] std::optional<Eigen::VectorXd> DoMaybeGetFeasiblePoint() const override;
  [[nodiscard]] bool DoIsBounded(Parallelism /*parallelism*/) const override {
    return lb_.allFinite() && ub_.allFinite();
  }
  [[nodiscard]] double DoSupport(const Eigen::VectorXd& direction) const override;
  [[nodiscard]] Eigen::VectorXd DoNearestPoint(const Eigen::VectorXd& x) const override {
    return x.cwiseMax(lb_).cwiseMin(ub_);
  }
  [[nodiscard]] bool DoHasExactVolume() const override { return true; }
  [[nodiscard]] std::optional<double> DoCalcVolume() const override;
  Eigen::VectorXd lb_;
  Eigen::VectorXd ub_;
};

}  // namespace switchyard
