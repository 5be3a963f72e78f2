// core/linalg/implicit_equalities.hpp - the inequalities of a polyhedron that are equalities.
#pragma once

#include <vector>

#include "core/linalg/dense_lp.hpp"

namespace switchyard {

/// Row `row` of [A; I] is `value` at every point.
struct ImplicitEquality {
  int row;  // num_rows + j: variable j
  double value;
};

struct ImplicitEqualities {
  /// kOptimal: found. kInfeasible: there is no point. kUndecided: could not be told.
  DenseLpStatus status = DenseLpStatus::kUndecided;
  std::vector<ImplicitEquality> equalities;  // by row; those whose two sides agree among them
  std::vector<double> x;  // a relative interior point: strict in every other inequality
};

/// Of the rows and bounds of `lp`; its c is not looked at.
///
/// One homogenized program: max 1'w : A x + s w <= b tau, 0 <= w <= 1, 1 <= tau, for all finite
/// sides. Where side i is strict at some point, w_i = 1 at an optimum, since the mean of such
/// points times a large enough tau has room for all of them; x / tau is the point. With s the
/// largest distance |b_i| / |a_i|, a slack is told from 0 where it is more than about 1e-6 of that.
ImplicitEqualities FindImplicitEqualities(const DenseLp& lp);

}  // namespace switchyard
