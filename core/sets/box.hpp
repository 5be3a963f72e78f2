// core/sets/box.hpp - the box of a set from its scaled form.
#pragma once

#include "switchyard/sets/convex_set.hpp"

namespace switchyard {

/// By propagation, then by linear or conic programs for the ends that it leaves open.
SetBox BoxOf(const ScaledSet& set);

/// Does propagation alone prove that the set has no point? No backend is asked.
bool IsProvenEmpty(const ScaledSet& set);

}  // namespace switchyard
