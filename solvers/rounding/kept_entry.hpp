// solvers/rounding/kept_entry.hpp - the dual of a cone with one entry as a column wants it.
#pragma once

#include "switchyard/abi.h"

namespace switchyard::rounding {

/// Is entry `place` of every member of the cone at least 0, for it to be a head of the cone?
bool IsHead(const sy_cone& cone, int place);

/// Makes entry `place` of y `kept`, and moves other entries of y by what membership in the dual
/// cone then needs, so that into_dual of cones.hpp no longer changes the entry: of the heads of
/// second-order, rotated and power cones, of a semidefinite diagonal, of the last entry of an
/// exponential one; of all else into_dual itself does it. False, and y is as it was, where no
/// member has this entry, or none was found.
bool KeepEntry(const sy_cone& cone, int place, double kept, double* y);

}  // namespace switchyard::rounding
