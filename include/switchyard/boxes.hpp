// switchyard/boxes.hpp - ranges that every feasible point is proven to lie in, found by propagation
// over rows, cones and a cutoff: what a safe bound needs where the problem gives no finite bounds.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "switchyard/abi.h"
#include "switchyard/box_narrowing.hpp"
#include "switchyard/box_ranges.hpp"
#include "switchyard/problem.hpp"

namespace switchyard {

namespace boxes_detail {

/// sum d_j/2 x_j^2 + q_j x_j nowhere above 1/2 x'Px + q'x: what P has beyond diag(d) is
/// diagonally dominant for d_j = P_jj - sum_i |P_ij|; where P >= 0 is known and some d_j < 0,
/// d = 0 is better.
inline std::vector<Parabola> Underestimate(const sy_problem& problem) {
  const auto n = static_cast<std::size_t>(problem.num_vars);
  std::vector<Parabola> below(n);
  std::vector<Activity> off(n);
  for (std::int32_t j = 0; problem.P != nullptr && j < problem.num_vars; ++j) {
    for (std::int32_t k = problem.P->start[j]; k < problem.P->start[j + 1]; ++k) {
      const auto row = static_cast<std::size_t>(problem.P->row[k]);
      const auto column = static_cast<std::size_t>(j);
      if (row == column) below[column].d = problem.P->value[k];
      if (row != column) off[row].Add(std::abs(problem.P->value[k]));
      if (row != column) off[column].Add(std::abs(problem.P->value[k]));
    }
  }
  bool concave = false;
  for (std::size_t j = 0; j < below.size(); ++j) {
    if (problem.q != nullptr) below[j].c = problem.q[j];
    if (off[j].size > 0) {
      below[j].d -= off[j].size + off[j].Slack(problem.num_vars, below[j].d);
    }
    concave = concave || below[j].d < 0;
  }
  if (concave && (problem.flags & SY_PROBLEM_CONVEX) != 0) {
    for (Parabola& p : below) p.d = 0;
  }
  return below;
}

class Propagation {
 public:
  explicit Propagation(const sy_problem& problem) : problem_(problem), box_(problem) {}

  Boxes Run(double cutoff, int passes) {
    const std::vector<Term> below =
        cutoff < kInfinity ? NonzeroTerms(Underestimate(problem_)) : std::vector<Term>();
    PropagateCutoff(below, cutoff);
    if (passes > 0 && problem_.A != nullptr) a_ = Transpose(*problem_.A);
    if (passes > 0 && problem_.F != nullptr) f_ = Transpose(*problem_.F);
    for (int pass = 0; pass < passes && !box_.infeasible(); ++pass) {
      PropagateRows();
      PropagateCones();
      PropagateCutoff(below, cutoff);
      if (!box_.TakeChanged()) break;
    }
    return box_.Take();
  }

 private:
  void PropagateRows() {
    for (std::int32_t i = 0; i < a_.cols && !box_.infeasible(); ++i) {
      box_.At(BoxSource::kRow, i);
      const Row row = RowOf(a_, i);
      if (problem_.row_upper != nullptr) NarrowByRow(row, 1, problem_.row_upper[i], box_);
      if (problem_.row_lower != nullptr) NarrowByRow(row, -1, -problem_.row_lower[i], box_);
    }
  }

  void PropagateCones() {
    std::int32_t first = 0;
    for (std::int32_t c = 0; c < problem_.num_cones && !box_.infeasible(); ++c) {
      box_.At(BoxSource::kCone, c);
      NarrowByCone(problem_.cones[c], f_, problem_.g, first, ranges_, box_);
      first += problem_.cones[c].dim;
    }
  }

  void PropagateCutoff(const std::vector<Term>& below, double cutoff) {
    if (!(cutoff < kInfinity) || box_.infeasible()) return;
    box_.At(BoxSource::kCutoff, -1);
    NarrowByTerms(below, problem_.offset, cutoff, least_, box_);
  }

  const sy_problem& problem_;
  Csc a_;  // by rows: column i is row i
  Csc f_;
  Ranges box_;
  std::vector<Interval> ranges_;  // of the cone at hand
  std::vector<Activity> least_;   // of the objective's terms
};

}  // namespace boxes_detail

/// d with P - diag(d) >= 0, d >= 0, as far as diagonal dominance shows it: what SafeDualBound takes
/// as curvature of a convex problem; no entries where there is none.
inline std::vector<double> Curvature(const sy_problem& problem) {
  std::vector<double> curvature;
  if (problem.P == nullptr) return curvature;
  bool any = false;
  for (const boxes_detail::Parabola& p : boxes_detail::Underestimate(problem)) {
    curvature.push_back(std::max(0.0, p.d));
    any = any || p.d > 0;
  }
  if (!any) curvature.clear();
  return curvature;
}

/// Boxes that hold every feasible point with an objective of at most `cutoff`, in time linear in
/// the nonzeros for each pass: first by the cutoff alone, then at most `passes` over rows, cones
/// and cutoff, fewer where one narrows nothing by a thousandth. Infinite where no finite end is
/// proven. All rounding is outward (underflow aside); an integer's ends are integers.
///
/// A bound found with boxes that used a cutoff holds where the optimum is below it: the bound on
/// the optimum is min(cutoff, bound). Infeasible then means: no point is at or below the cutoff.
/// Functions of an nlp are not looked at, and with one the cutoff is not used.
inline Boxes ProvenBoxes(const sy_problem& problem, double cutoff = kInfinity, int passes = 20) {
  return boxes_detail::Propagation(problem).Run(problem.nlp == nullptr ? cutoff : kInfinity,
                                                passes);
}

}  // namespace switchyard
