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
  Eigen::VectorXd lb_;
  Eigen::VectorXd ub_;
};

}  // namespace switchyard
