// switchyard/sets/scaled_set.hpp - a convex set by the cone over it: what every transcription
// writes, and what membership, boxes and emptiness are found from.
#pragma once

#include <vector>

#include "switchyard/problem.hpp"

namespace switchyard {

/// The closed cone of all (t, x, w) with t >= 0 and x in tX; w are variables of its own.
///
/// Rows lower <= A (t; x; w) <= upper have sides that are 0 or infinite; F (t; x; w) lies in the
/// product of the cones. At t = 1 the x are the points of X. t >= 0 is not a row: whoever writes
/// the cone has it as a bound.
struct ScaledSet {
  int dim = 0;      // of x
  int num_aux = 0;  // of w
  Csc A;            // columns t, x, w
  std::vector<double> lower;
  std::vector<double> upper;
  Csc F;
  std::vector<sy_cone> cones;

  [[nodiscard]] int num_columns() const { return 1 + dim + num_aux; }
};

/// The section t = 1 as a problem over (x, w) without objective.
inline ProblemData AtScaleOne(const ScaledSet& set) {
  ProblemData d;
  d.num_vars = set.num_columns() - 1;
  d.flags = SY_PROBLEM_CONVEX;
  d.q.assign(static_cast<std::size_t>(d.num_vars), 0.0);
  d.P = Csc(d.num_vars, d.num_vars);
  d.row_lower = set.lower;
  d.row_upper = set.upper;
  d.cones = set.cones;
  d.g.assign(static_cast<std::size_t>(set.F.rows), 0.0);
  for (std::int32_t k = 0; k < set.A.start[1]; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const auto row = static_cast<std::size_t>(set.A.row[at]);
    d.row_lower[row] -= set.A.value[at];
    d.row_upper[row] -= set.A.value[at];
  }
  for (std::int32_t k = 0; k < set.F.start[1]; ++k) {
    const auto at = static_cast<std::size_t>(k);
    d.g[static_cast<std::size_t>(set.F.row[at])] = set.F.value[at];
  }
  const auto without_first = [](const Csc& m) {
    Csc rest(m.rows, m.cols - 1);
    const std::int32_t first = m.start[1];
    for (std::size_t j = 0; j < rest.start.size(); ++j) rest.start[j] = m.start[j + 1] - first;
    rest.row.assign(m.row.begin() + first, m.row.end());
    rest.value.assign(m.value.begin() + first, m.value.end());
    return rest;
  };
  d.A = without_first(set.A);
  d.F = without_first(set.F);
  return d;
}

}  // namespace switchyard
