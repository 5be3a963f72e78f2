#include "switchyard/sets/hyperrectangle.hpp"

#include "core/sets/scaled_rows.hpp"
#include "switchyard/error.hpp"

namespace switchyard {

Hyperrectangle::Hyperrectangle(const VectorRef& lb, const VectorRef& ub)
    : ConvexSet(static_cast<int>(lb.size())), lb_(lb), ub_(ub) {
  Require(lb.size() == ub.size(), "hyperrectangle: lb has ", lb.size(), " entries, ub ", ub.size());
  for (Eigen::Index i = 0; i < lb.size(); ++i) {
    Require(lb[i] <= ub[i], "hyperrectangle: lb[", i, "] = ", lb[i], " must be at most ub[", i,
            "] = ", ub[i]);
    Require(lb[i] < kInfinity && ub[i] > -kInfinity, "hyperrectangle: no number is between lb[", i,
            "] = ", lb[i], " and ub[", i, "] = ", ub[i]);
  }
}

Eigen::VectorXd Hyperrectangle::Center() const {
  Require(lb_.allFinite() && ub_.allFinite(),
          "a hyperrectangle with an infinite side has no center");
  return 0.5 * (lb_ + ub_);
}

HPolyhedron Hyperrectangle::MakeHPolyhedron() const { return HPolyhedron::MakeBox(lb_, ub_); }

std::optional<Hyperrectangle> Hyperrectangle::MaybeGetIntersection(
    const Hyperrectangle& other) const {
  Require(other.ambient_dimension() == ambient_dimension(), "hyperrectangles in R^",
          ambient_dimension(), " and R^", other.ambient_dimension(), " have no intersection");
  const Eigen::VectorXd lower = lb_.cwiseMax(other.lb_);
  const Eigen::VectorXd upper = ub_.cwiseMin(other.ub_);
  if ((lower.array() > upper.array()).any()) return std::nullopt;
  return Hyperrectangle(lower, upper);
}

std::optional<Hyperrectangle> Hyperrectangle::MaybeCalcAxisAlignedBoundingBox(
    const ConvexSet& set) {
  const SetBox& box = set.bounding_box();
  if (box.empty || !box.is_finite()) return std::nullopt;
  return Hyperrectangle(box.lower, box.upper);
}

std::unique_ptr<ConvexSet> Hyperrectangle::DoClone() const {
  return std::make_unique<Hyperrectangle>(*this);
}

ScaledSet Hyperrectangle::DoScaled() const {
  ScaledRows rows(ambient_dimension());
  for (int i = 0; i < ambient_dimension(); ++i) {
    rows.AddTwoSided(lb_[i], ub_[i], [&](int row) { rows.Set(row, 1 + i, 1); });
  }
  return rows.Finish();
}

std::optional<SetBox> Hyperrectangle::DoBoundingBox() const { return SetBox{lb_, ub_, false}; }

std::optional<Eigen::VectorXd> Hyperrectangle::DoMaybeGetPoint() const {
  if (lb_ == ub_) return lb_;
  return std::nullopt;
}

}  // namespace switchyard
