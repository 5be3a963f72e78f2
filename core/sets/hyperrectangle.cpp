#include "switchyard/sets/hyperrectangle.hpp"

#include <algorithm>
#include <cmath>

#include "switchyard/error.hpp"
#include "switchyard/sets/scaled_rows.hpp"

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

Eigen::VectorXd Hyperrectangle::UniformSample(RandomGenerator* generator) const {
  Require(generator != nullptr, "UniformSample needs a generator, got a null pointer");
  Require(lb_.allFinite() && ub_.allFinite(),
          "a hyperrectangle with an infinite side has no even distribution");
  Eigen::VectorXd x(lb_.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    x[i] = std::uniform_real_distribution<double>(lb_[i], ub_[i])(*generator);
  }
  return x.cwiseMin(ub_);
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

std::optional<Eigen::VectorXd> Hyperrectangle::DoMaybeGetFeasiblePoint() const {
  Eigen::VectorXd x(lb_.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const bool both = std::isfinite(lb_[i]) && std::isfinite(ub_[i]);
    x[i] = both ? 0.5 * lb_[i] + 0.5 * ub_[i] : std::clamp(0.0, lb_[i], ub_[i]);
  }
  return x;
}

double Hyperrectangle::DoSupport(const Eigen::VectorXd& direction) const {
  double sum = 0;
  for (Eigen::Index i = 0; i < direction.size(); ++i) {
    if (direction[i] != 0) sum += direction[i] * (direction[i] > 0 ? ub_[i] : lb_[i]);
  }
  return sum;
}

// A flat box has none, whatever its other sides.
std::optional<double> Hyperrectangle::DoCalcVolume() const {
  const Eigen::VectorXd sides = ub_ - lb_;
  return (sides.array() == 0).any() ? 0.0 : sides.prod();
}

}  // namespace switchyard
