// core/bridges/bridges.hpp - one function for each bridge: its row in the table.
#pragma once

#include "core/bridges/bridge.hpp"

namespace switchyard {

BridgeKind BoundsToRows();
BridgeKind RowsToCones();
BridgeKind LinearConesToRows();
BridgeKind RotatedToSecondOrder();
BridgeKind SecondOrderToRotated();
BridgeKind QuadraticObjectiveToCone();
BridgeKind ConesToFunctions();

/// The problem without the cones that are off: see switched_off_cones.cpp.
Bridged LeaveOutSwitchedOff(ProblemData d);

}  // namespace switchyard
