// core/sets/scaled_constraint.hpp - a constraint g(x) by its perspective: the cone of all (t, x)
// with t >= 0 and x in t {g holds}.
#pragma once

#include "switchyard/model/constraint.hpp"
#include "switchyard/sets/scaled_rows.hpp"

namespace switchyard {

/// Is it linear, conic, or a quadratic form that is convex, whatever its maker says?
bool HasPerspective(const Constraint& constraint);
/// Throws InvalidArgument, naming it, where it has none.
void RequirePerspective(const Constraint& constraint);

/// lb t <= Ax <= ub t as rows; Ax + bt in the cone, in the ABI's coordinates. Of
/// 1/2 x'Qx + b'x <= ub with Q = S'S
///   t (ub t - b'x) >= 1/2 |Sx|^2
/// as a rotated cone, or as a row where Q is 0. Throws likewise.
void WriteScaled(const Constraint& constraint, ScaledRows& rows);

}  // namespace switchyard
