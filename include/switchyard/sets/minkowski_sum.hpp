// switchyard/sets/minkowski_sum.hpp - sums of points of several sets.
#pragma once

#include "switchyard/sets/convex_set.hpp"

namespace switchyard {

/// {x_1 + ... + x_k : x_j in S_j}; empty where a term is, and {0} in R^0 without terms. The sum of
/// closed sets that are not bounded need not be closed; what is asked of it is then answered of its
/// closure.
class SWITCHYARD_EXPORT MinkowskiSum final : public ConvexSet {
 public:
  MinkowskiSum() : ConvexSet(0) {}
  /// Throws InvalidArgument where their dimensions differ.
  explicit MinkowskiSum(ConvexSets sets);
  MinkowskiSum(const ConvexSet& a, const ConvexSet& b) : MinkowskiSum(MakeConvexSets(a, b)) {}
  [[nodiscard]] int num_terms() const { return static_cast<int>(sets_.size()); }
  [[nodiscard]] const ConvexSet& term(int index) const {
    return *sets_.at(static_cast<std::size_t>(index));
  }
  [[nodiscard]] std::string Kind() const override { return "minkowski sum"; }

 private:
  [[nodiscard]] std::unique_ptr<ConvexSet> DoClone() const override;
  [[nodiscard]] ScaledSet DoScaled() const override;
  [[nodiscard]] std::optional<SetBox> DoBoundingBox() const override;
  [[nodiscard]] std::optional<Eigen::VectorXd> DoMaybeGetPoint() const override;
  [[nodiscard]] std::optional<Eigen::VectorXd> DoMaybeGetFeasiblePoint() const override;
  [[nodiscard]] bool DoIsBounded(Parallelism parallelism) const override;
  [[nodiscard]] double DoSupport(const Eigen::VectorXd& direction) const override;
  ConvexSets sets_;
};

}  // namespace switchyard
