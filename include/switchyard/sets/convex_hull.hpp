// switchyard/sets/convex_hull.hpp - the convex hull of several sets.
#pragma once

#include "switchyard/sets/convex_set.hpp"

namespace switchyard {

/// {sum_j x_j : x_j in a_j S_j, a_j >= 0, sum a_j = 1}, of sets that are not bounded the closure.
///
/// A set without points adds none to the hull, so it takes no part: in a_j S_j at a_j = 0 it would
/// add the directions in which its rows are open.
class SWITCHYARD_EXPORT ConvexHull final : public ConvexSet {
 public:
  ConvexHull() : ConvexHull(ConvexSets()) {}
  /// `remove_empty_sets`: ask each set now whether it has points, and have those that have none
  /// out of participating_sets(); else they are asked when something is asked of the hull. Throws
  /// InvalidArgument where their dimensions differ.
  explicit ConvexHull(ConvexSets sets, bool remove_empty_sets = true);
  [[nodiscard]] const ConvexSets& sets() const { return sets_; }
  [[nodiscard]] const ConvexSets& participating_sets() const { return participating_; }
  [[nodiscard]] bool empty_sets_removed() const { return empty_sets_removed_; }
  /// Of all sets().
  [[nodiscard]] const ConvexSet& element(int index) const {
    return *sets_.at(static_cast<std::size_t>(index));
  }
  [[nodiscard]] int num_elements() const { return static_cast<int>(sets_.size()); }
  [[nodiscard]] std::string Kind() const override { return "convex hull"; }

 private:
  /// Those that have points.
  [[nodiscard]] ConvexSets Members() const;
  [[nodiscard]] std::unique_ptr<ConvexSet> DoClone() const override;
  [[nodiscard]] ScaledSet DoScaled() const override;
  [[nodiscard]] std::optional<SetBox> DoBoundingBox() const override;
  [[nodiscard]] std::optional<Eigen::VectorXd> DoMaybeGetPoint() const override;
  [[nodiscard]] std::optional<Eigen::VectorXd> DoMaybeGetFeasiblePoint() const override;
  [[nodiscard]] bool DoIsBounded(Parallelism parallelism) const override;
  [[nodiscard]] double DoSupport(const Eigen::VectorXd& direction) const override;
  ConvexSets sets_;
  ConvexSets participating_;
  bool empty_sets_removed_;
};

}  // namespace switchyard
