// core/bridges/smooth_cones.hpp - cones as concave functions >= 0 of their own rows s.
//
//   second order   s_0 - |s_w|^2 / s_0                        s_0 >= 0
//   exponential    s_1 log(s_2 / s_1) - s_0                   s_1, s_2 >= 0
//   power          s_0^a s_1^(1-a) - s_2,  ... + s_2          s_0, s_1 >= 0
//
// Each is the perspective of a smooth function: its gradient on the boundary neither vanishes nor
// grows towards the apex, as that of s_0^2 - |s_w|^2 does, so multipliers exist there too. (Benson,
// Vanderbei, "Solving problems with semidefinite and related constraints using interior-point
// methods for nonlinear programming", 2003.)
//
// Far outside of the second-order cone, s_0 < |s_w| / 2, its function goes on along its tangents,
// as 5 s_0 - 4 |s_w|: |w|^2 / d = max_p 2 p |w| - p^2 d, and with p <= 2 that is convex and finite
// everywhere. There its Hessian is taken as that at s_0 = |s_w| / 2, which has the pattern. The
// others are not defined where a variable with a bound is 0, which methods of interior points
// avoid. Rotated cones become second-order ones first.
#pragma once

#include <cstdint>

#include "switchyard/abi.h"

namespace switchyard {

/// The functions of one cone of dimension `dim` with parameter a.
struct SmoothCone {
  sy_cone_kind kind;
  std::int32_t (*rows)(std::int32_t dim);
  /// Is s_i >= 0?
  bool (*nonnegative)(std::int32_t i);
  /// Is (i, j), i <= j, in the pattern of the Hessian?
  bool (*curved)(std::int32_t i, std::int32_t j);
  void (*values)(const double* s, std::int32_t dim, double a, double* c);
  /// rows x dim, column by column.
  void (*jacobian)(const double* s, std::int32_t dim, double a, double* J);
  /// Of w'c, in the order of the pattern, column by column.
  void (*hessian)(const double* s, std::int32_t dim, double a, const double* w, double* H);
};

/// NULL for the cones that are none of these.
const SmoothCone* SmoothConeOf(sy_cone_kind kind);

}  // namespace switchyard
