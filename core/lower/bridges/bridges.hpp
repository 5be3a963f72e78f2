// core/lower/bridges/bridges.hpp - one function for each bridge: its row in the table.
#pragma once

#include "core/lower/bridge.hpp"

namespace switchyard {

BridgeKind BoundsToRows();
BridgeKind RowsToCones();
BridgeKind LinearConesToRows();
BridgeKind RotatedToSecondOrder();
BridgeKind SecondOrderToRotated();
BridgeKind QuadraticObjectiveToCone();

}  // namespace switchyard
