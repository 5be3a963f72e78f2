// core/host/problem_check.hpp - what the ABI promises a solver about a problem as it arrives.
#pragma once

#include "switchyard/abi.h"

namespace switchyard {

/// Throws InvalidArgument with a sentence about x[3], row[3] or cone[3] where the problem has a
/// NaN, an infinite coefficient, crossed or meaningless bounds, rows that do not ascend, an index
/// out of range, or cones whose dimensions do not fit. Linear in entries.
void CheckProblem(const sy_problem& problem);

/// Of its vectors and bounds alone.
void CheckVectors(const sy_problem& problem);

/// The same of the single bounds that an update brings.
void CheckSingleBounds(const sy_update& update);

}  // namespace switchyard
