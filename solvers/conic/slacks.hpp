// solvers/conic/slacks.hpp - G of the slacks s = G x - h tau: A's conic rows, bounds, and the same
// from above.
#pragma once

#include "solvers/conic/form.hpp"

namespace switchyard::conic {

/// take(slack, its row of G x), given A x.
template <class Take>
void EachSlack(const Shape& s, const Vector& x, const Vector& a_x, Take&& take) {
  for (Index i = 0; i < s.conic_rows(); ++i) take(i, a_x[i]);
  for (Index j = 0; j < s.bounded; ++j) take(s.lower_bounds() + j, x[j]);
  for (Index i = 0; i < s.ranges; ++i) take(s.range_tops() + i, -a_x[s.cone_rows + i]);
  for (Index j = 0; j < s.boxed; ++j) take(s.upper_bounds() + j, -x[j]);
}

/// x += E'y + G'z; `rows` becomes what multiplies A's rows.
void AddSlackColumns(const Form& form, const Vector& y, const Vector& z, Vector& rows, Vector& x);

}  // namespace switchyard::conic
