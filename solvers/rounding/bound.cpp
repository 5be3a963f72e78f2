#include "solvers/rounding/bound.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "solvers/rounding/exact_duals.hpp"
#include "switchyard/boxes.hpp"
#include "switchyard/problem.hpp"
#include "switchyard/safe_bound.hpp"

namespace switchyard::rounding {
namespace {

double BoundOver(const sy_problem& problem, const Answer& relaxed, const double* lower,
                 const double* upper) {
  Duals duals{relaxed.row_dual, relaxed.cone_dual};
  MakeExact(problem, lower, upper, duals);
  const std::vector<double> curvature = Curvature(problem);
  return SafeDualBound(problem, relaxed.x.data(), duals.row.data(), duals.cone.data(), lower, upper,
                       curvature.empty() ? nullptr : curvature.data())
      .value;
}

}  // namespace

double ProvenBound(const sy_problem& problem, const Answer& relaxed, double cutoff) {
  if (!(cutoff < kInfinity)) {
    const double own = BoundOver(problem, relaxed, problem.x_lower, problem.x_upper);
    if (own > -kInfinity) return own;  // else rows may close what bounds leave open
  }
  const Boxes boxes = ProvenBoxes(problem, cutoff);
  if (boxes.infeasible) return cutoff < kInfinity ? cutoff : -kInfinity;
  return std::min(cutoff, BoundOver(problem, relaxed, boxes.lower.data(), boxes.upper.data()));
}

bool ProvesInfeasible(const sy_problem& problem, const Answer& certificate) {
  const std::vector<double> zero(static_cast<std::size_t>(problem.num_vars), 0.0);
  sy_problem feasibility = problem;
  feasibility.P = nullptr;
  feasibility.q = zero.data();
  feasibility.offset = 0;
  Answer duals = certificate;
  duals.x = zero;
  if (BoundOver(feasibility, duals, problem.x_lower, problem.x_upper) > 0) return true;
  const Boxes boxes = ProvenBoxes(problem);
  return boxes.infeasible ||
         BoundOver(feasibility, duals, boxes.lower.data(), boxes.upper.data()) > 0;
}

}  // namespace switchyard::rounding
