// tests/presolve/solved.hpp - reduced problems solved by the interior-point method.
#pragma once

#include <gtest/gtest.h>

#include "solvers/conic/blocks.hpp"
#include "solvers/conic/interior_point.hpp"
#include "tests/presolve/programs.hpp"

namespace switchyard::presolve {

/// What the method found, in the terms of its problem.
struct Solved {
  conic::Ending ending = conic::Ending::kTrouble;
  Answer answer;
};

inline Answer OfProblem(const conic::Form& form, const conic::Iterate& at, double unit,
                        const ProblemData& d) {
  const conic::Shape& s = form.shape;
  const auto count = [](Index n) { return static_cast<std::size_t>(n); };
  linalg::Vector x = at.x, y(count(s.rows())), bounds(count(s.vars), 0.0);
  for (double& v : x) v /= unit;
  for (Index i = 0; i < s.conic_rows(); ++i) y[i] = at.z[i] / unit;
  for (Index i = 0; i < s.ranges; ++i) y[s.cone_rows + i] -= at.z[s.range_tops() + i] / unit;
  for (Index i = 0; i < s.equations; ++i) y[s.conic_rows() + i] = at.y[i] / unit;
  for (Index j = 0; j < s.bounded; ++j) bounds[j] = at.z[s.lower_bounds() + j] / unit;
  for (Index j = 0; j < s.boxed; ++j) bounds[j] -= at.z[s.upper_bounds() + j] / unit;
  Answer a{Vector(count(d.num_vars)), Vector(count(d.num_vars)), Vector(count(d.num_rows())),
           Vector(count(d.num_cone_rows())), Meaning::kOptimum};
  form.PointBack(x, a.x.data());
  form.DualsBack(y, bounds, a.x_dual.data(), a.row_dual.data(), a.cone_dual.data(), d.num_vars,
                 d.num_rows(), d.num_cone_rows());
  return a;
}

inline Solved Solve(const ProblemData& d, double tolerance = 1e-9) {
  if (d.num_vars == 0) return {conic::Ending::kOptimal, {}};
  const conic::Form form(d);
  conic::Kkt kkt(form, conic::FindBlocks(form));
  conic::InteriorPointOptions options;
  options.tolerance = tolerance;
  conic::InteriorPoint method(form, kkt, options, {});
  const conic::Solution found = method.Solve();
  const bool is_ray = found.ending == conic::Ending::kUnbounded;
  const bool is_contradiction = found.ending == conic::Ending::kInfeasible;
  Solved solved{found.ending,
                OfProblem(form, found.at, is_ray || is_contradiction ? 1 : found.at.tau, d)};
  solved.answer.meaning = is_ray             ? Meaning::kRay
                          : is_contradiction ? Meaning::kContradiction
                                             : Meaning::kOptimum;
  return solved;
}

}  // namespace switchyard::presolve
