#include "solvers/mip/node_bound.hpp"

#include <algorithm>
#include <cfloat>
#include <cmath>

#include "solvers/mip/close_columns.hpp"
#include "solvers/mip/project_columns.hpp"
#include "switchyard/safe_bound.hpp"

namespace switchyard::mip {
namespace {

using rounding::Duals;

std::size_t At(std::int32_t j) { return static_cast<std::size_t>(j); }

double SlopeOf(const Interval& rho) {
  if (rho.lower > 0) return rho.lower;
  return rho.upper < 0 ? rho.upper : 0;
}

/// No slopes where nothing is proven.
NodeBound BoundAt(const sy_problem& problem, const Duals& duals, const std::vector<double>& lower,
                  const std::vector<double>& upper) {
  using namespace safe_bound_detail;
  const std::vector<double> zero(lower.size(), 0.0);
  NodeBound bound;
  bound.slope.resize(lower.size());
  Terms terms;
  bool open = false;
  EachColumn(problem, zero, duals.row.data(), duals.cone.data(), terms,
             [&](std::int32_t j, const Interval& rho, double) {
               bound.slope[At(j)] = SlopeOf(rho);
               open = open || OpenSize(rho, lower[At(j)], upper[At(j)]) != 0;
               if (!open) terms.Add(LeastProduct(rho, lower[At(j)], upper[At(j)]));
             });
  if (open) return {};
  bound.value = terms.LowerEnd();
  return bound;
}

}  // namespace

NodeBound BoundFrom(const sy_problem& problem, Duals duals, const std::vector<double>& lower,
                    const std::vector<double>& upper) {
  rounding::MakeExact(problem, lower.data(), upper.data(), duals);
  NodeBound bound = BoundAt(problem, duals, lower, upper);
  if (!bound.slope.empty()) return bound;
  Duals closed = duals;
  CloseColumns(problem, lower, upper, closed);
  bound = BoundAt(problem, closed, lower, upper);
  if (!bound.slope.empty()) return bound;
  ProjectColumns(problem, lower, upper, duals);
  CloseColumns(problem, lower, upper, duals);
  return BoundAt(problem, duals, lower, upper);
}

bool ProvesEmpty(const sy_problem& problem, Duals duals, const std::vector<double>& lower,
                 const std::vector<double>& upper) {
  sy_problem feasibility = problem;
  feasibility.q = nullptr;
  feasibility.offset = 0;
  return BoundFrom(feasibility, std::move(duals), lower, upper).value > 0;
}

std::vector<VariableBox> ByReducedCosts(const sy_problem& problem, const NodeBound& bound,
                                        double cutoff, const std::vector<double>& lower,
                                        const std::vector<double>& upper) {
  std::vector<VariableBox> narrower;
  if (!(cutoff < kInfinity) || bound.slope.empty() || !std::isfinite(bound.value)) return narrower;
  constexpr double kOutward = 8 * DBL_EPSILON;  // three roundings
  constexpr double kShare = 0.1;
  const double room = (cutoff - bound.value) * (1 + kOutward) +
                      kOutward * (std::abs(cutoff) + std::abs(bound.value));
  if (!(room >= 0)) return narrower;
  for (std::int32_t j = 0; j < problem.num_vars; ++j) {
    const double slope = bound.slope[At(j)], l = lower[At(j)], u = upper[At(j)];
    if (slope == 0 || l == u) continue;
    const bool integer = problem.integer != nullptr && problem.integer[j] != 0;
    double step = room / std::abs(slope) * (1 + kOutward);
    const double from = slope > 0 ? l : u;
    if (!std::isfinite(from)) continue;
    step += kOutward * std::abs(from);
    if (integer) step = std::floor(step + 1e-9);
    const double end = slope > 0 ? l + step : u - step;
    const double gain = slope > 0 ? u - end : end - l;
    if (!(gain > (integer ? 0.5 : kShare * (std::isfinite(u - l) ? u - l : 0)))) continue;
    if (slope > 0) narrower.push_back({j, l, std::max(l, end)});
    if (slope < 0) narrower.push_back({j, std::min(u, end), u});
  }
  return narrower;
}

}  // namespace switchyard::mip
