// core/bridges/rotate_cones.hpp - the map between the second-order cone and the rotated one.
//
// (s_0, s_1) -> ((s_0 + s_1) / sqrt2, (s_0 - s_1) / sqrt2) takes 2 s_0 s_1 >= |s_2|^2 to
// s_0 >= |(s_1, s_2)| and back: it is orthogonal and its own inverse, so duals go the same way.
#pragma once

#include "core/bridges/bridge.hpp"

namespace switchyard {

/// Every cone of kind `from` becomes one of kind `to`; a second-order cone of one row, s_0 >= 0,
/// becomes nonnegative.
Bridged RotateCones(ProblemData d, sy_cone_kind from, sy_cone_kind to);

}  // namespace switchyard
