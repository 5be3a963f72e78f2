// core/sets/recession_cone.hpp - what a scaled form is at scale 0.
#pragma once

#include "switchyard/sets/scaled_set.hpp"

namespace switchyard {

/// The (0, x, w) of a scaled form, with cones that scale 0 has pressed flat as the rows that are
/// left of them: |s| <= t is s = 0 there, which no interior-point method should be asked to find.
ScaledSet RecessionCone(const ScaledSet& set);

}  // namespace switchyard
