#include "switchyard/sets/intersection.hpp"

#include "switchyard/error.hpp"
#include "switchyard/sets/scaled_rows.hpp"

namespace switchyard {

Intersection::Intersection(ConvexSets sets)
    : ConvexSet(sets.empty() ? 0 : sets.front()->ambient_dimension()), sets_(std::move(sets)) {
  for (const ConvexSetPointer& set : sets_) {
    Require(set->ambient_dimension() == ambient_dimension(), "intersection: sets in R^",
            ambient_dimension(), " and in R^", set->ambient_dimension(), " do not meet");
  }
}

std::unique_ptr<ConvexSet> Intersection::DoClone() const {
  return std::make_unique<Intersection>(*this);
}

// The elements' rows and cones, one below the other; their own variables side by side.
ScaledSet Intersection::DoScaled() const {
  ScaledRows rows(ambient_dimension());
  for (const ConvexSetPointer& set : sets_) rows.AddSet(set->scaled());
  return rows.Finish();
}

}  // namespace switchyard
