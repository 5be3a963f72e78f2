// switchyard/box_narrowing.hpp - what a row, a cone and a separable objective say about boxes: the
// steps of propagation, on any boxes that take what is proven.
//
// Boxes have lower(j) and upper(j), Cut(j, v) and Raise(j, v) for x_j <= v and x_j >= v that are
// proven, Demand(lhs, side) for lhs <= side, which is proven, and infeasible().
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

namespace switchyard::boxes_detail {

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

/// min sign r'x over the boxes.
template <class Box>
Activity Least(const Row& row, double sign, const Box& box) {
  Activity least;
  for (std::int32_t k = 0; k < row.count; ++k) {
    const double a = sign * row.value[k];
    if (a != 0) least.Add(a * (a > 0 ? box.lower(row.column[k]) : box.upper(row.column[k])));
  }
  return least;
}

/// Are all of x fixed, and is sign r'x + shift, summed as Least does, not rounded anywhere?
template <class Box>
bool IsExact(const Row& row, double sign, double shift, const Box& box) {
  double sum = 0;
  bool exact = true;
  const auto add = [&](double v) {
    const double old = sum;
    sum += v;
    exact = exact && sum - old == v && sum - v == old;
  };
  for (std::int32_t k = 0; k < row.count && exact; ++k) {
    const double a = sign * row.value[k], x = box.lower(row.column[k]);
    if (a == 0) continue;
    exact = x == box.upper(row.column[k]) && std::fma(a, x, -(a * x)) == 0;
    add(a * x);
  }
  add(shift);
  return exact;
}

/// No more than min sign r'x + shift over the boxes; that itself where nothing rounds, so that an
/// entry which fixed variables make 0 is 0.
template <class Box>
double LeastValue(const Row& row, double sign, double shift, const Box& box) {
  const Activity least = Least(row, sign, box);
  if (least.infinite > 0) return -kInfinity;
  const double slack = least.Slack(row.count, shift);
  const bool exact = slack > 0 && IsExact(row, sign, shift, box);
  return least.sum + shift - (exact ? 0 : slack);
}

/// Narrows the boxes to where sign r'x <= side may hold: a_j x_j <= side - min of the others.
template <class Box>
void NarrowByRow(const Row& row, double sign, double side, Box& box) {
  if (!std::isfinite(side)) return;
  const Activity least = Least(row, sign, box);
  if (least.infinite > 1) return;
  const double slack = least.Slack(row.count, side);
  if (least.infinite == 0) box.Demand(least.sum - slack, side);
  if (box.infeasible()) return;
  const double widening = row.count == 1 ? Activity().Slack(1, side) : slack;  // no others to sum
  for (std::int32_t k = 0; k < row.count; ++k) {
    const std::int32_t j = row.column[k];
    const double a = sign * row.value[k];
    if (a == 0) continue;
    const double own = a * (a > 0 ? box.lower(j) : box.upper(j));
    if (least.infinite == 1 && std::isfinite(own)) continue;
    const double rest = std::isfinite(own) ? least.sum - own : least.sum;
    const double room = (side - rest + widening) / a;
    if (a > 0) {
      box.Cut(j, room);
    } else {
      box.Raise(j, room);
    }
  }
}

/// Narrows the boxes to where f x + g may be in the cone, whose first row is `first` of f by rows;
/// `ranges` is memory. The ranges of f x + g, narrowed by the cone, are sides of the rows of f.
template <class Box>
void NarrowByCone(const sy_cone& cone, const Csc& f, const double* g, std::int32_t first,
                  std::vector<Interval>& ranges, Box& box) {
  const auto shift = [g](std::int32_t i) { return g != nullptr ? g[i] : 0.0; };
  ranges.clear();
  for (std::int32_t i = first; i < first + cone.dim; ++i) {
    const double upper = -LeastValue(RowOf(f, i), -1, -shift(i), box);
    ranges.push_back({LeastValue(RowOf(f, i), 1, shift(i), box), upper});
  }
  FactsOf(cone.kind).narrow(ranges.data(), cone.dim, cone.parameter);
  for (std::int32_t k = 0; k < cone.dim; ++k) {
    const Interval& s = ranges[static_cast<std::size_t>(k)];
    NarrowByRow(RowOf(f, first + k), 1, s.upper - shift(first + k), box);
    NarrowByRow(RowOf(f, first + k), -1, shift(first + k) - s.lower, box);
  }
}

/// One term d/2 x^2 + c x of a separable function that is nowhere above the objective.
struct Parabola {
  double d = 0;
  double c = 0;
};

struct Term {
  std::int32_t variable;
  Parabola of;
};

/// The terms that are not 0, of one for each variable.
inline std::vector<Term> NonzeroTerms(const std::vector<Parabola>& below) {
  std::vector<Term> terms;
  for (std::size_t j = 0; j < below.size(); ++j) {
    if (below[j].d != 0 || below[j].c != 0) {
      terms.push_back({static_cast<std::int32_t>(j), below[j]});
    }
  }
  return terms;
}

/// The minimum of one term over its box, and the size of what it was computed from.
template <class Box>
Activity LeastOf(const Term& term, const Box& box) {
  const Parabola& p = term.of;
  const double lower = box.lower(term.variable);
  const double upper = box.upper(term.variable);
  Activity least;
  if (p.d == 0 && p.c == 0) return least;
  double x = p.d > 0 ? std::clamp(-p.c / p.d, lower, upper) : lower;
  const auto value = [&p](double at) {
    if (at == 0) return 0.0;
    return (p.d == 0 ? p.c : 0.5 * p.d * at + p.c) * at;
  };
  if (p.d <= 0 && !(value(lower) <= value(upper))) x = upper;
  least.Add(value(x));
  if (least.infinite == 0) least.size = std::abs(0.5 * p.d * x * x) + std::abs(p.c * x);
  return least;
}

/// Narrows the box to where d/2 x^2 + c x <= room, d >= 0: between the roots
/// (-c -+ sqrt(c^2 + 2 d room)) / d, or below room / c.
template <class Box>
void NarrowByTerm(const Term& term, double room, Box& box) {
  const Parabola& p = term.of;
  if (p.d > 0) {
    const double inside = p.c * p.c + 2 * p.d * std::abs(room);
    const double root =
        std::sqrt(std::max(0.0, p.c * p.c + 2 * p.d * room + 4 * DBL_EPSILON * inside));
    const double margin = 4 * DBL_EPSILON * (std::abs(p.c) + root);
    box.Cut(term.variable, std::nextafter((root - p.c + margin) / p.d, kInfinity));
    box.Raise(term.variable, std::nextafter((-root - p.c - margin) / p.d, -kInfinity));
  } else if (p.d == 0 && p.c != 0) {
    const double end = room / p.c;
    if (p.c > 0 && end < box.upper(term.variable)) {
      box.Cut(term.variable, std::nextafter(end, kInfinity));
    } else if (p.c < 0 && end > box.lower(term.variable)) {
      box.Raise(term.variable, std::nextafter(end, -kInfinity));
    }
  }
}

/// Narrows the boxes to where offset + the sum of the terms may be at most `cutoff`: each term is
/// at most cutoff - offset - the least of the others. `least` is memory.
template <class Box>
void NarrowByTerms(const std::vector<Term>& terms, double offset, double cutoff,
                   std::vector<Activity>& least, Box& box) {
  Activity all;
  least.clear();
  for (const Term& term : terms) {
    least.push_back(LeastOf(term, box));
    all.sum += least.back().sum;
    all.size += least.back().size;
    all.infinite += least.back().infinite;
  }
  const auto count = static_cast<std::int32_t>(terms.size());
  const double slack = all.Slack(count, std::abs(cutoff) + std::abs(offset));
  const double room = cutoff - offset - all.sum + slack;
  if (all.infinite > 1) return;
  if (all.infinite == 0) box.Demand(cutoff - room, cutoff);
  if (box.infeasible()) return;
  for (std::size_t k = 0; k < terms.size(); ++k) {
    if (all.infinite == 0 || least[k].infinite == 1) {
      NarrowByTerm(terms[k], room + least[k].sum, box);
    }
  }
}

}  // namespace switchyard::boxes_detail
