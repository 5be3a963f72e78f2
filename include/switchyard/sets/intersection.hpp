// switchyard/sets/intersection.hpp - the points that several sets have in common.
#pragma once

#include "switchyard/sets/convex_set.hpp"

namespace switchyard {

class SWITCHYARD_EXPORT Intersection final : public ConvexSet {
 public:
  Intersection() : ConvexSet(0) {}
  /// Throws InvalidArgument where their dimensions differ.
  explicit Intersection(ConvexSets sets);
  Intersection(const ConvexSet& a, const ConvexSet& b) : Intersection(MakeConvexSets(a, b)) {}
  [[nodiscard]] int num_elements() const { return static_cast<int>(sets_.size()); }
  [[nodiscard]] const ConvexSet& element(int i) const {
    return *sets_.at(static_cast<std::size_t>(i));
  }
  [[nodiscard]] std::string Kind() const override { return "intersection"; }

 private:
  [[nodiscard]] std::unique_ptr<ConvexSet> DoClone() const override;
  [[nodiscard]] ScaledSet DoScaled() const override;
  ConvexSets sets_;
};

}  // namespace switchyard
