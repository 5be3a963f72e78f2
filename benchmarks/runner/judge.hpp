// benchmarks/runner/judge.hpp - how good an answer is, recomputed in the problem as it was given.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/problem/vectors.hpp"
#include "switchyard/cones.hpp"
#include "switchyard/problem.hpp"

namespace switchyard::benchmark {

/// Norms of a vector sum and of what meets in it.
struct Sum {
  explicit Sum(std::size_t count) : value(count, 0.0), largest(count, 0.0) {}
  void Add(const sy_csc* m, bool transposed, const double* v, double sign) {
    for (std::int32_t j = 0; m != nullptr && j < m->cols; ++j) {
      for (std::int32_t k = m->start[j]; k < m->start[j + 1]; ++k) {
        const std::int32_t from = transposed ? m->row[k] : j;
        Add(static_cast<std::size_t>(transposed ? j : m->row[k]), sign * m->value[k] * v[from]);
      }
    }
  }
  void Add(std::size_t i, double term) {
    value[i] += term;
    largest[i] = std::max(largest[i], std::abs(term));
  }
  [[nodiscard]] double Size() const {
    return largest.empty() ? 0 : *std::max_element(largest.begin(), largest.end());
  }
  std::vector<double> value, largest;
};

/// Each relative to 1 + the largest term that meets in it.
struct Residuals {
  double primal = 0, dual = 0, gap = 0;
  double objective = 0;
  [[nodiscard]] double Worst() const { return std::max({primal, dual, gap}); }
};

/// What is left of rows, cones and bounds.
inline double PrimalResidual(const sy_problem& p, const std::vector<double>& x) {
  Sum rows(static_cast<std::size_t>(p.num_rows)), cones(static_cast<std::size_t>(p.num_cone_rows));
  rows.Add(p.A, false, x.data(), 1);
  cones.Add(p.F, false, x.data(), 1);
  double violation = 0, largest_x = 0;
  for (std::size_t i = 0; i < rows.value.size(); ++i) {
    violation =
        std::max({violation, p.row_lower[i] - rows.value[i], rows.value[i] - p.row_upper[i]});
  }
  for (std::size_t i = 0; i < cones.value.size(); ++i) cones.Add(i, p.g[i]);
  for (std::int32_t c = 0, at = 0; c < p.num_cones; at += p.cones[c++].dim) {
    const sy_cone& cone = p.cones[c];
    violation = std::max(violation, FactsOf(cone.kind).violation(&cones.value[std::size_t(at)],
                                                                 cone.dim, cone.parameter));
  }
  for (std::size_t j = 0; j < x.size(); ++j) {
    largest_x = std::max(largest_x, std::abs(x[j]));
    if (p.x_lower == nullptr) continue;
    violation = std::max({violation, p.x_lower[j] - x[j], x[j] - p.x_upper[j]});
  }
  return violation / (1 + std::max({rows.Size(), cones.Size(), largest_x}));
}

/// side(d) of abi.h; a dual against an infinite side is wrong by its size.
inline double Side(double d, double lower, double upper, double& wrong) {
  if (d == 0) return 0;
  const double side = d > 0 ? lower : upper;
  if (std::isfinite(side)) return d * side;
  wrong = std::max(wrong, std::abs(d));
  return 0;
}

inline Residuals Judge(const sy_problem& p, const Vectors& v) {
  const auto n = static_cast<std::size_t>(p.num_vars);
  Residuals r;
  r.objective = Objective(p, v.x.data());
  r.primal = PrimalResidual(p, v.x);
  // Px + q = x_dual + A'y + F'z.
  Sum stationary(n);
  std::vector<double> curved(n, 0.0);
  if (p.P != nullptr) SymmetricMultiplyAdd(*p.P, 1, v.x.data(), curved.data());
  double dual_objective = p.offset, worst = 0;
  for (std::size_t j = 0; j < n; ++j) {
    stationary.Add(j, curved[j]);
    stationary.Add(j, p.q[j]);
    stationary.Add(j, -v.x_dual[j]);
    dual_objective -= 0.5 * curved[j] * v.x[j];
    dual_objective += Side(v.x_dual[j], p.x_lower != nullptr ? p.x_lower[j] : -kInfinity,
                           p.x_upper != nullptr ? p.x_upper[j] : kInfinity, worst);
  }
  stationary.Add(p.A, true, v.row_dual.data(), -1);
  stationary.Add(p.F, true, v.cone_dual.data(), -1);
  for (std::size_t i = 0; i < v.row_dual.size(); ++i) {
    dual_objective += Side(v.row_dual[i], p.row_lower[i], p.row_upper[i], worst);
  }
  for (std::size_t i = 0; i < v.cone_dual.size(); ++i) dual_objective -= p.g[i] * v.cone_dual[i];
  for (std::int32_t c = 0, at = 0; c < p.num_cones; at += p.cones[c++].dim) {
    worst = std::max(worst, DualViolation(p.cones[c], &v.cone_dual[std::size_t(at)]));
  }
  for (const double s : stationary.value) worst = std::max(worst, std::abs(s));
  r.dual = worst / (1 + stationary.Size());
  r.gap = std::abs(r.objective - dual_objective) /
          (1 + std::min(std::abs(r.objective), std::abs(dual_objective)));
  if (!std::isfinite(r.Worst())) r.primal = r.dual = r.gap = kInfinity;
  return r;
}

}  // namespace switchyard::benchmark
