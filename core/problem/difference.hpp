// core/problem/difference.hpp - what an update from one problem to another must carry.
#pragma once

#include <cstdint>

#include "switchyard/problem.hpp"

namespace switchyard {

/// Rows, cones, patterns, integrality or sections differ: no update, a new load.
inline constexpr std::uint64_t kStructureChanged = std::uint64_t{1} << 63;

/// SY_UPDATES_BOUNDS, _VECTORS and _VALUES as they differ, or kStructureChanged.
std::uint64_t ProblemDifference(const ProblemData& before, const ProblemData& after);

}  // namespace switchyard
