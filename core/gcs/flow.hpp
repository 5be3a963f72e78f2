// core/gcs/flow.hpp - how much of a path an edge carries in a result.
#pragma once

#include "switchyard/gcs/edge.hpp"

namespace switchyard {

constexpr double kNoFlow = 1e-7;  // what an interior point leaves of 0

/// 0 where the result knows no flow of the edge.
inline double FlowOf(const GraphOfConvexSets::Edge& edge, const MathematicalProgramResult& result) {
  return result.Knows(edge.phi()) ? result.GetSolution(edge.phi()) : 0;
}

}  // namespace switchyard
