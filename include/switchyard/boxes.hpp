// switchyard/boxes.hpp - ranges that every feasible point is proven to lie in, found by propagation
// over rows, cones and a cutoff: what a safe bound needs where the problem gives no finite bounds.
#pragma once

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "switchyard/abi.h"
#include "switchyard/box_ranges.hpp"
#include "switchyard/cones.hpp"
#include "switchyard/problem.hpp"

namespace switchyard {

namespace boxes_detail {

struct Row {
  const std::int32_t* column;
  const double* value;
  std::int32_t count;
};

inline Row RowOf(const Csc& transposed, std::int32_t i) {
  const auto begin = static_cast<std::size_t>(transposed.start[static_cast<std::size_t>(i)]);
  const auto end = static_cast<std::size_t>(transposed.start[static_cast<std::size_t>(i) + 1]);
  return {transposed.row.data() + begin, transposed.value.data() + begin,
          static_cast<std::int32_t>(end - begin)};
}

/// One term d/2 x^2 + c x of a separable function that is nowhere above the objective.
struct Parabola {
  double d = 0;
  double c = 0;
};

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
    const std::vector<Parabola> below =
        cutoff < kInfinity ? Underestimate(problem_) : std::vector<Parabola>();
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
      if (problem_.row_upper != nullptr) Impose(row, 1, problem_.row_upper[i]);
      if (problem_.row_lower != nullptr) Impose(row, -1, -problem_.row_lower[i]);
    }
  }

  /// The ranges of s = Fx + g, narrowed by the cone, are sides of the rows of F.
  void PropagateCones() {
    std::int32_t first = 0;
    for (std::int32_t c = 0; c < problem_.num_cones && !box_.infeasible(); ++c) {
      box_.At(BoxSource::kCone, c);
      const sy_cone& cone = problem_.cones[c];
      ranges_.clear();
      for (std::int32_t i = first; i < first + cone.dim; ++i) {
        const double upper = -LeastValue(RowOf(f_, i), -1, -Shift(i));
        ranges_.push_back({LeastValue(RowOf(f_, i), 1, Shift(i)), upper});
      }
      FactsOf(cone.kind).narrow(ranges_.data(), cone.dim, cone.parameter);
      for (std::int32_t k = 0; k < cone.dim; ++k) {
        const Interval& s = ranges_[static_cast<std::size_t>(k)];
        Impose(RowOf(f_, first + k), 1, s.upper - Shift(first + k));
        Impose(RowOf(f_, first + k), -1, Shift(first + k) - s.lower);
      }
      first += cone.dim;
    }
  }

  [[nodiscard]] double Shift(std::int32_t i) const {
    return problem_.g != nullptr ? problem_.g[i] : 0.0;
  }

  /// min sign r'x over the boxes.
  [[nodiscard]] Activity Least(const Row& row, double sign) const {
    Activity least;
    for (std::int32_t k = 0; k < row.count; ++k) {
      const double a = sign * row.value[k];
      if (a != 0) least.Add(a * (a > 0 ? box_.lower(row.column[k]) : box_.upper(row.column[k])));
    }
    return least;
  }

  [[nodiscard]] double LeastValue(const Row& row, double sign, double shift) const {
    const Activity least = Least(row, sign);
    if (least.infinite > 0) return -kInfinity;
    return least.sum + shift - least.Slack(row.count, shift);
  }

  /// Narrows the boxes to where sign r'x <= side may hold: a_j x_j <= side - min of the others.
  void Impose(const Row& row, double sign, double side) {
    if (!std::isfinite(side)) return;
    const Activity least = Least(row, sign);
    if (least.infinite > 1) return;
    const double slack = least.Slack(row.count, side);
    if (least.infinite == 0) box_.Demand(least.sum - slack, side);
    if (box_.infeasible()) return;
    for (std::int32_t k = 0; k < row.count; ++k) {
      const std::int32_t j = row.column[k];
      const double a = sign * row.value[k];
      if (a == 0) continue;
      const double own = a * (a > 0 ? box_.lower(j) : box_.upper(j));
      if (least.infinite == 1 && std::isfinite(own)) continue;
      const double rest = std::isfinite(own) ? least.sum - own : least.sum;
      const double room = (side - rest + slack) / a;
      if (a > 0) {
        box_.Cut(j, room);
      } else {
        box_.Raise(j, room);
      }
    }
  }

  /// The minimum of one term over its box, and the size of what it was computed from.
  [[nodiscard]] Activity LeastOf(const Parabola& p, std::int32_t j) const {
    Activity least;
    if (p.d == 0 && p.c == 0) return least;
    double x = p.d > 0 ? std::clamp(-p.c / p.d, box_.lower(j), box_.upper(j)) : box_.lower(j);
    const auto value = [&p](double at) {
      if (at == 0) return 0.0;
      return (p.d == 0 ? p.c : 0.5 * p.d * at + p.c) * at;
    };
    if (p.d <= 0 && !(value(box_.lower(j)) <= value(box_.upper(j)))) x = box_.upper(j);
    least.Add(value(x));
    if (least.infinite == 0) least.size = std::abs(0.5 * p.d * x * x) + std::abs(p.c * x);
    return least;
  }

  /// Each term is at most cutoff - offset - the least of the others.
  void PropagateCutoff(const std::vector<Parabola>& below, double cutoff) {
    if (below.empty() || box_.infeasible()) return;
    box_.At(BoxSource::kCutoff, -1);
    Activity all;
    std::vector<Activity> least(below.size());
    for (std::int32_t j = 0; j < problem_.num_vars; ++j) {
      const auto k = static_cast<std::size_t>(j);
      least[k] = LeastOf(below[k], j);
      all.sum += least[k].sum;
      all.size += least[k].size;
      all.infinite += least[k].infinite;
    }
    const double slack = all.Slack(problem_.num_vars, std::abs(cutoff) + std::abs(problem_.offset));
    const double room = cutoff - problem_.offset - all.sum + slack;
    if (all.infinite > 1) return;
    if (all.infinite == 0) box_.Demand(cutoff - room, cutoff);
    if (box_.infeasible()) return;
    for (std::int32_t j = 0; j < problem_.num_vars; ++j) {
      const auto k = static_cast<std::size_t>(j);
      if (all.infinite == 0 || least[k].infinite == 1) BoundTerm(below[k], j, room + least[k].sum);
    }
  }

  /// Narrows the box to where d/2 x^2 + c x <= room, d >= 0: between the roots
  /// (-c -+ sqrt(c^2 + 2 d room)) / d, or below room / c.
  void BoundTerm(const Parabola& p, std::int32_t j, double room) {
    if (p.d > 0) {
      const double inside = p.c * p.c + 2 * p.d * std::abs(room);
      const double root =
          std::sqrt(std::max(0.0, p.c * p.c + 2 * p.d * room + 4 * DBL_EPSILON * inside));
      const double margin = 4 * DBL_EPSILON * (std::abs(p.c) + root);
      box_.Cut(j, std::nextafter((root - p.c + margin) / p.d, kInfinity));
      box_.Raise(j, std::nextafter((-root - p.c - margin) / p.d, -kInfinity));
    } else if (p.d == 0 && p.c > 0) {
      box_.Cut(j, std::nextafter(room / p.c, kInfinity));
    } else if (p.d == 0 && p.c < 0) {
      box_.Raise(j, std::nextafter(room / p.c, -kInfinity));
    }
  }

  const sy_problem& problem_;
  Csc a_;  // by rows: column i is row i
  Csc f_;
  Ranges box_;
  std::vector<Interval> ranges_;  // of the cone at hand
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
