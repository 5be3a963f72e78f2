#include "solvers/conic/slacks.hpp"

#include <algorithm>

namespace switchyard::conic {

void AddSlackColumns(const Form& form, const Vector& y, const Vector& z, linalg::Workers* workers,
                     Vector& rows, Vector& x) {
  const Shape& s = form.shape;
  std::copy_n(z.begin(), s.conic_rows(), rows.begin());
  for (Index i = 0; i < s.ranges; ++i) rows[s.cone_rows + i] -= z[s.range_tops() + i];
  std::copy_n(y.begin(), s.equations, rows.begin() + s.conic_rows());
  AddTransposed(form.A, 1, rows.data(), x.data(), workers);
  for (Index j = 0; j < s.bounded; ++j) x[j] += z[s.lower_bounds() + j];
  for (Index j = 0; j < s.boxed; ++j) x[j] -= z[s.upper_bounds() + j];
}

}  // namespace switchyard::conic
