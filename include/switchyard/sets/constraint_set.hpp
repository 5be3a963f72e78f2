// switchyard/sets/constraint_set.hpp - the points that satisfy constraints that have a perspective.
#pragma once

#include <memory>
#include <vector>

#include "switchyard/sets/convex_set.hpp"

namespace switchyard {

/// {x in R^dimension : every constraint holds}; each takes all of x.
class SWITCHYARD_EXPORT ConstraintSet final : public ConvexSet {
 public:
  using Constraints = std::vector<std::shared_ptr<const Constraint>>;
  /// Throws InvalidArgument where a constraint takes another number of variables, or is neither
  /// linear nor conic.
  ConstraintSet(int dimension, Constraints constraints);
  [[nodiscard]] const Constraints& constraints() const { return constraints_; }
  [[nodiscard]] std::string Kind() const override { return "intersection of constraints"; }

 private:
  [[nodiscard]] std::unique_ptr<ConvexSet> DoClone() const override;
  [[nodiscard]] ScaledSet DoScaled() const override;
  Constraints constraints_;
};

}  // namespace switchyard
