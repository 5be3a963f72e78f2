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

/// Likewise; `workers`, if any, share them, so take must not add up.
template <class Take>
void EachSlack(const Shape& s, const Vector& x, const Vector& a_x, linalg::Workers* workers,
               Take&& take) {
  constexpr std::size_t kGrain = 8192;
  const auto each = [&](Index count, auto&& one) {
    linalg::EachPart(workers, static_cast<std::size_t>(count), kGrain,
                     [&](std::size_t begin, std::size_t end) {
                       for (std::size_t i = begin; i < end; ++i) one(static_cast<Index>(i));
                     });
  };
  each(s.conic_rows(), [&](Index i) { take(i, a_x[i]); });
  each(s.bounded, [&](Index j) { take(s.lower_bounds() + j, x[j]); });
  each(s.ranges, [&](Index i) { take(s.range_tops() + i, -a_x[s.cone_rows + i]); });
  each(s.boxed, [&](Index j) { take(s.upper_bounds() + j, -x[j]); });
}

/// x += E'y + G'z; `rows` becomes what multiplies A's rows.
void AddSlackColumns(const Form& form, const Vector& y, const Vector& z, linalg::Workers* workers,
                     Vector& rows, Vector& x);

}  // namespace switchyard::conic
