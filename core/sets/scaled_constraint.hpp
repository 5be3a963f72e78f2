// core/sets/scaled_constraint.hpp - a constraint g(x) by its perspective: the cone of all (t, x)
// with t >= 0 and x in t {g holds}.
#pragma once

#include "core/sets/scaled_rows.hpp"
#include "switchyard/model/constraint.hpp"

namespace switchyard {

/// Throws InvalidArgument, naming it, where it is neither linear nor conic.
void RequireConvex(const Constraint& constraint);

/// lb t <= Ax <= ub t as rows; Ax + bt in the cone, in the ABI's coordinates.
void WriteScaled(const Constraint& constraint, ScaledRows& rows);

}  // namespace switchyard
