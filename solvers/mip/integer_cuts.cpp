#include "solvers/mip/integer_cuts.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace switchyard::mip {
namespace {

using rounding::Entry;

std::size_t At(std::int32_t i) { return static_cast<std::size_t>(i); }

/// At an integer k.
Interval ValueAt(const Affine& a, double k) {
  return Plus(a.constant, a.variable < 0 ? Interval{0, 0} : Times(a.factor, {k, k}));
}

double SumOf(const std::vector<Entry>& entries, const std::vector<double>& x) {
  double sum = 0;
  for (const Entry& e : entries) sum += e.value * x[At(e.variable)];
  return sum;
}

bool IsBinary(const NodeBoxes& boxes, std::int32_t j) {
  return boxes.IsInteger(j) && boxes.lower(j) >= 0 && boxes.upper(j) <= 1;
}

bool IsViolated(const Row& row, const std::vector<double>& x, double tolerance) {
  double scale = 1;
  for (const Entry& e : row.entries) {
    scale = std::max(scale, std::abs(e.value * x[At(e.variable)]));
  }
  return SumOf(row.entries, x) < row.lower - tolerance * scale;
}

}  // namespace

IntegerCuts::IntegerCuts(const sy_problem& problem, const NodeBoxes& boxes) {
  if (problem.F == nullptr) return;
  const Csc by_rows = Transpose(*problem.F);
  const std::vector<Affine> columns = AffineColumns(problem, boxes);
  const auto constant = [&](std::int32_t row) {
    return problem.g != nullptr ? problem.g[row] : 0.0;
  };
  const auto head = [&](std::int32_t row) {
    Head h{{}, constant(row)};
    for (std::int32_t k = by_rows.start[At(row)]; k < by_rows.start[At(row) + 1]; ++k) {
      h.entries.push_back({by_rows.row[At(k)], by_rows.value[At(k)]});
    }
    return h;
  };
  std::int32_t first = 0;
  for (std::int32_t c = 0; c < problem.num_cones; first += problem.cones[c++].dim) {
    const sy_cone& cone = problem.cones[c];
    const bool rotated = cone.kind == SY_CONE_ROTATED;
    if (!rotated && cone.kind != SY_CONE_SECOND_ORDER) continue;
    std::vector<std::optional<Affine>> values;
    for (std::int32_t row = first; row < first + cone.dim; ++row) {
      values.push_back(AffineRow(by_rows, row, constant(row), columns));
    }
    if (!rotated) {
      AddRoot(values, 1, head(first), boxes);
      continue;
    }
    AddChord(values, head(first), 1, boxes);
    AddChord(values, head(first + 1), 0, boxes);
    const auto &r = values[0], &s = values[1];
    const bool same = r && s && r->variable >= 0 && r->variable == s->variable &&
                      IsExactly(r->constant, 0) && IsExactly(s->constant, 0) &&
                      r->factor.lower > 0 && s->factor.lower > 0;
    if (!same) continue;
    const double both = Root(Times({2, 2}, Times(r->factor, s->factor))).upper;
    AddRoot(values, 2, {{{r->variable, both}}, 0}, boxes);
  }
}

void IntegerCuts::AddChord(const std::vector<std::optional<Affine>>& values, const Head& t,
                           std::size_t r, const NodeBoxes& boxes) {
  Chord chord{t, -1, {}, {}, 0, 0, false};
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i == 1 - r) continue;  // t
    if (!values[i]) return;
    const std::int32_t j = values[i]->variable;
    if (j >= 0 && (!boxes.IsInteger(j) || (chord.k >= 0 && j != chord.k))) return;
    if (j >= 0) chord.k = j;
    if (i == r) {
      chord.r = *values[i];
    } else {
      chord.u.push_back(*values[i]);
    }
  }
  const bool in_t = std::any_of(t.entries.begin(), t.entries.end(),
                                [&](const Entry& e) { return e.variable == chord.k; });
  if (chord.k < 0 || in_t || t.entries.empty()) return;
  chord.least = boxes.lower(chord.k);
  chord.most = boxes.upper(chord.k);
  if (!std::isfinite(chord.least) || std::abs(chord.least) > 1e9) return;
  double size = 0;
  for (const Affine& u : chord.u) size += Square(ValueAt(u, chord.least)).lower;
  if (size > 0 && ValueAt(chord.r, chord.least).upper <= 0) {
    ++chord.least;  // a head of 0, and members that are not
    chord.raised = true;
  }
  if (!(chord.most - chord.least >= 1) || !(ValueAt(chord.r, chord.least).lower > 0)) return;
  const double far = std::isfinite(chord.most) ? chord.most : chord.least + 1;
  if (!(ValueAt(chord.r, far).lower > 0) || !(chord.r.factor.lower >= 0 || far == chord.most)) {
    return;
  }
  chords_.push_back(std::move(chord));
}

void IntegerCuts::AddRoot(const std::vector<std::optional<Affine>>& values, std::size_t heads,
                          Head t, const NodeBoxes& boxes) {
  Rooted root;
  root.t = std::move(t);
  for (std::size_t i = heads; i < values.size(); ++i) {
    if (!values[i]) continue;  // without it t is still as large as the rest asks for
    const Affine& u = *values[i];
    const double square = Square(u.variable < 0 ? u.constant : u.factor).lower;
    if (!(square > 0) || !std::isfinite(square)) continue;
    if (u.variable < 0) {
      root.constant = std::max(0.0, Below(root.constant + square));
    } else if (IsBinary(boxes, u.variable) && IsExactly(u.constant, 0)) {
      root.members.push_back({u.variable, square});
    }
  }
  std::stable_sort(root.members.begin(), root.members.end(),
                   [](const Member& a, const Member& b) { return a.z < b.z; });
  const auto twice =
      std::adjacent_find(root.members.begin(), root.members.end(),
                         [](const Member& a, const Member& b) { return a.z == b.z; });
  const bool own = std::any_of(root.t.entries.begin(), root.t.entries.end(), [&](const Entry& e) {
    return std::any_of(root.members.begin(), root.members.end(),
                       [&](const Member& m) { return m.z == e.variable; });
  });
  if (root.members.size() > 1 && twice == root.members.end() && !own && !root.t.entries.empty()) {
    roots_.push_back(std::move(root));
  }
}

void IntegerCuts::Separate(const std::vector<double>& x, double tolerance,
                           std::vector<Row>& rows) const {
  for (const Chord& chord : chords_) SeparateChord(chord, x, tolerance, rows);
  for (const Rooted& root : roots_) SeparateRoot(root, x, tolerance, rows);
}

// f(k).
Interval IntegerCuts::Least(const Chord& chord, double k) {
  Interval sum = {0, 0};
  for (const Affine& u : chord.u) sum = Plus(sum, Square(ValueAt(u, k)));
  return Over(sum, Times({2, 2}, ValueAt(chord.r, k)));
}

// The row is t - slope k >= side. Convex, f(k) - slope k is nowhere on the integers below what it
// is at K or K + 1, where it does not fall towards K - 1, nor towards K + 2.
void IntegerCuts::SeparateChord(const Chord& chord, const std::vector<double>& x, double tolerance,
                                std::vector<Row>& rows) {
  const double at = x[At(chord.k)];
  if (chord.raised && at < chord.least - tolerance) {
    rows.push_back({{{chord.k, 1}}, chord.least});
    return;
  }
  double K = std::max(std::floor(at), chord.least);
  if (K >= chord.most) K = chord.most - 1;
  if (!(std::abs(K) < 1e9)) return;
  const Interval f = Least(chord, K), next = Least(chord, K + 1);
  const double slope = Middle(next) - Middle(f);
  const auto above = [&](const Interval& value, double k) {  // f(k) - slope k
    return Plus(value, Minus(Times({slope, slope}, {k, k})));
  };
  const double side = std::min(above(f, K).lower, above(next, K + 1).lower);
  if (!std::isfinite(side)) return;
  if (K - 1 >= chord.least && !(above(Least(chord, K - 1), K - 1).lower >= above(f, K).upper)) {
    return;
  }
  if (K + 2 <= chord.most &&
      !(above(Least(chord, K + 2), K + 2).lower >= above(next, K + 1).upper)) {
    return;
  }
  Row row{chord.t.entries, Below(side - chord.t.constant)};
  if (slope != 0) row.entries.push_back({chord.k, -slope});
  if (IsViolated(row, x, tolerance)) rows.push_back(std::move(row));
}

// Squares and c are taken as the numbers they are, which are at most the true ones; steps of the
// root are rounded down, which z >= 0 bears.
void IntegerCuts::SeparateRoot(const Rooted& root, const std::vector<double>& x, double tolerance,
                               std::vector<Row>& rows) {
  std::vector<Member> order = root.members;
  std::stable_sort(order.begin(), order.end(),
                   [&](const Member& a, const Member& b) { return x[At(a.z)] > x[At(b.z)]; });
  Interval sum = {root.constant, root.constant}, before = Root(sum);
  Row row{root.t.entries, Below(before.lower - root.t.constant)};
  for (const Member& m : order) {
    sum = Plus(sum, {m.square, m.square});
    const Interval now = Root(sum);
    const double step = Over({m.square, m.square}, Plus(now, before)).lower;
    row.entries.push_back({m.z, -std::max(0.0, step)});
    before = now;
  }
  if (IsViolated(row, x, tolerance)) rows.push_back(std::move(row));
}

}  // namespace switchyard::mip
