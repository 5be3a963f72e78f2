#include "solvers/rounding/tightened.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "switchyard/cones.hpp"

namespace switchyard::rounding {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

std::size_t At(std::int32_t i) { return static_cast<std::size_t>(i); }

double ValueAt(const std::vector<Entry>& entries, std::span<const double> x) {
  double value = 0;
  for (const auto& e : entries) value += e.value * x[At(e.variable)];
  return value;
}

/// Entries of one variable as one; those that cancel go.
void Merge(std::vector<Entry>& entries) {
  std::sort(entries.begin(), entries.end(),
            [](const auto& a, const auto& b) { return a.variable < b.variable; });
  std::size_t kept = 0;
  for (std::size_t k = 0; k < entries.size(); ++k) {
    if (kept > 0 && entries[kept - 1].variable == entries[k].variable) {
      entries[kept - 1].value += entries[k].value;
    } else {
      entries[kept++] = entries[k];
    }
  }
  entries.resize(kept);
  std::erase_if(entries, [](const auto& e) { return e.value == 0; });
}

/// The factor with sum = factor times scale; NaN: there is none.
double FactorOf(const std::vector<Entry>& sum, const std::vector<Entry>& scale) {
  if (sum.empty()) return 0;
  if (sum.size() != scale.size()) return kNaN;
  const double factor = sum[0].value / scale[0].value;
  for (std::size_t k = 0; k < sum.size(); ++k) {
    if (sum[k].variable != scale[k].variable || sum[k].value != factor * scale[k].value) {
      return kNaN;
    }
  }
  return factor;
}

/// A row of a set's, of which `by_rows` has a column for each, at (t, x); and its largest number.
double RowAt(const sy_csc& by_rows, std::int32_t row, std::span<const double> at, double& size) {
  double value = 0;
  for (std::int32_t k = by_rows.start[row]; k < by_rows.start[row + 1]; ++k) {
    value += by_rows.value[k] * at[At(by_rows.row[k])];
    size = std::max(size, std::abs(by_rows.value[k]));
  }
  return value;
}

/// A matrix with more columns, and rows below.
Csc Extended(const sy_csc* matrix, std::int32_t rows, const Csc& below) {
  Csc top = matrix != nullptr ? Csc(*matrix) : Csc(rows, 0);
  top.cols = below.cols;
  top.start.resize(At(below.cols) + 1, top.start.back());
  return StackRows(top, below);
}

}  // namespace

bool Tightened::Serves(const PathProblem& whole) {
  const sy_paths& paths = whole.paths();
  return paths.dim != nullptr && paths.set != nullptr && paths.tail_point.start != nullptr &&
         paths.head_point.start != nullptr;
}

Tightened::Tightened(const PathProblem& whole)
    : whole_(whole),
      p_(whole.problem()),
      in_(Reversed(whole.arcs())),
      tail_first_(FirstPoints(whole.paths(), whole.paths().tail)),
      head_first_(FirstPoints(whole.paths(), whole.paths().head)),
      num_blocks_(whole.blocks().num_blocks) {
  ListPairs();
}

// Ordered pairs (u, w), u neither source nor target, with open arcs both ways.
void Tightened::ListPairs() {
  const Arcs& arcs = whole_.arcs();
  std::set<std::pair<std::int32_t, std::int32_t>> ways;
  for (std::int32_t u = 0; u < arcs.num_vertices; ++u) {
    for (const std::int32_t a : whole_.out().Of(u)) ways.emplace(u, arcs.head[At(a)]);
  }
  for (const auto& [u, w] : ways) {
    if (u == whole_.paths().source || u == whole_.paths().target || u == w) continue;
    if (ways.count({w, u}) > 0) pairs_.emplace_back(u, w);
  }
}

void Tightened::AddFlow(std::int32_t arc, double sign, Sum& sum) const {
  const std::int32_t j = whole_.paths().flow[arc];
  sum.entries.push_back({j, sign});
  (sign > 0 ? sum.upper : sum.lower) += sign;
}

void Tightened::Add(const sy_csc& points, std::int32_t column, double sign, Sum& sum) const {
  for (std::int32_t k = points.start[column]; k < points.start[column + 1]; ++k) {
    const std::int32_t j = points.row[k];
    const double value = sign * points.value[k];
    sum.entries.push_back({j, value});
    const double one = value * (p_.x_lower != nullptr ? p_.x_lower[j] : -kInfinity);
    const double other = value * (p_.x_upper != nullptr ? p_.x_upper[j] : kInfinity);
    sum.lower += std::min(one, other);
    sum.upper += std::max(one, other);
  }
}

Tightened::Cone Tightened::ConeOf(std::int32_t u, std::int32_t w) const {
  const sy_paths& paths = whole_.paths();
  Cone cone{u,
            {},
            std::vector<Sum>(At(paths.dim[u])),
            {},
            std::vector<std::uint8_t>(At(paths.dim[u]), 1)};
  for (const std::int32_t a : whole_.out().Of(u)) {
    if (paths.head[a] == w) continue;
    AddFlow(a, 1, cone.scale);
    for (std::int32_t i = 0; i < paths.dim[u]; ++i) {
      Add(paths.tail_point, tail_first_[At(a)] + i, 1, cone.point[At(i)]);
    }
  }
  for (const std::int32_t a : in_.Of(u)) {
    if (paths.tail[a] != w) continue;
    AddFlow(a, -1, cone.scale);
    for (std::int32_t i = 0; i < paths.dim[u]; ++i) {
      const std::int32_t column = head_first_[At(a)] + i;
      Add(paths.head_point, column, -1, cone.point[At(i)]);
      if (paths.head_point.start[column] == paths.head_point.start[column + 1]) {
        cone.known[At(i)] = 0;
      }
    }
  }
  Merge(cone.scale.entries);
  for (Sum& sum : cone.point) {
    Merge(sum.entries);
    cone.factor.push_back(FactorOf(sum.entries, cone.scale.entries));
  }
  return cone;
}

bool Tightened::Cone::Knows(const sy_csc& by_rows, std::int32_t row) const {
  for (std::int32_t k = by_rows.start[row]; k < by_rows.start[row + 1]; ++k) {
    if (by_rows.row[k] > 0 && known[At(by_rows.row[k] - 1)] == 0) return false;
  }
  return true;
}

bool Tightened::Cone::KnowsAll() const {
  return std::find(known.begin(), known.end(), 0) == known.end();
}

double Tightened::ConeViolation(const sy_set& set, std::span<const double> at) {
  double worst = 0;
  std::vector<double> s;
  for (std::int32_t c = 0, row = 0; c < set.num_cones; ++c) {
    const sy_cone& one = set.cones[c];
    double size = 1;
    s.clear();
    for (std::int32_t i = 0; i < one.dim; ++i) s.push_back(RowAt(*set.Ft, row++, at, size));
    worst = std::max(worst, FactsOf(one.kind).violation(s.data(), one.dim, one.parameter) / size);
  }
  return worst;
}

// A row of the set's, as one that is at least 0, over the arcs' variables.
void Tightened::AddCombination(const Cone& cone, const sy_set& set, std::int32_t row) {
  std::vector<Entry> entries;
  const double sign = set.row_lower[row] == 0 ? 1 : -1;
  const bool equation = set.row_lower[row] == 0 && set.row_upper[row] == 0;
  for (std::int32_t k = set.At->start[row]; k < set.At->start[row + 1]; ++k) {
    const std::size_t c = At(set.At->row[k]);
    for (const Entry& e : c == 0 ? cone.scale.entries : cone.point[c - 1].entries) {
      entries.push_back({e.variable, sign * set.At->value[k] * e.value});
    }
  }
  AddRow(entries);
  if (equation) row_upper_.back() = 0;
}

void Tightened::Find(std::int32_t u, std::int32_t w, std::span<const double> x,
                     std::vector<Violated>& violated) const {
  const auto see = [&](std::int32_t row, double by) {
    const Violated one{u, w, row, by};
    if (by > 0 && added_.count(one.Key()) == 0) violated.push_back(one);
  };
  const Cone cone = ConeOf(u, w);
  const sy_set* set = whole_.paths().set[u];
  std::vector<double> at = {ValueAt(cone.scale.entries, x)};
  for (const Sum& sum : cone.point) at.push_back(ValueAt(sum.entries, x));
  see(kScale, -at[0]);
  if (set == nullptr || added_.count({u, w, kWhole}) > 0) return;
  // What a set with variables of its own makes of the point is not told by looking.
  if (set->num_aux > 0) return see(kWhole, cone.KnowsAll() ? kInfinity : 0);
  if (cone.KnowsAll()) see(kWhole, ConeViolation(*set, at));
  for (std::int32_t i = 0; i < set->num_rows; ++i) {
    if (!cone.Knows(*set->At, i)) continue;
    double size = 1;
    const double value = RowAt(*set->At, i, at, size);
    see(i, std::max(set->row_lower[i] - value, value - set->row_upper[i]) / size);
  }
}

void Tightened::Append(const Violated& violated) {
  added_.insert(violated.Key());
  const Cone cone = ConeOf(violated.u, violated.w);
  const sy_set* set = whole_.paths().set[violated.u];
  if (violated.row == kScale) return AddRow(cone.scale.entries);
  if (violated.row == kWhole) return AppendBlock(cone, *set);
  AddCombination(cone, *set, violated.row);
}

int Tightened::AddTwoCycles(std::span<const double> x, double tolerance, std::int32_t most_dim) {
  constexpr double kShare = 0.1;
  const sy_paths& paths = whole_.paths();
  const auto flow = [&](std::int32_t from, std::int32_t to) {
    double sum = 0;
    for (const std::int32_t a : whole_.out().Of(from)) {
      if (paths.head[a] == to) sum += x[At(paths.flow[a])];
    }
    return sum;
  };
  std::vector<Violated> violated;
  for (const auto& [u, w] : pairs_) {  // of a bounded set, only flow both ways can violate a row
    if (paths.dim[u] > most_dim) continue;
    if (flow(u, w) > tolerance && flow(w, u) > tolerance) Find(u, w, x, violated);
  }
  double worst = 0;
  for (const Violated& v : violated) {
    if (v.by < kInfinity) worst = std::max(worst, v.by);
  }
  std::erase_if(violated,
                [&](const Violated& v) { return v.by < std::max(tolerance, kShare * worst); });
  for (const Violated& v : violated) Append(v);
  num_cuts_ += static_cast<int>(violated.size());
  return static_cast<int>(violated.size());
}

std::int32_t Tightened::AddVariable(double lower, double upper, bool scale) {
  x_lower_.push_back(lower);
  x_upper_.push_back(upper);
  is_scale_.push_back(scale ? 1 : 0);
  block_of_x_.push_back(num_blocks_);
  return p_.num_vars + static_cast<std::int32_t>(x_lower_.size()) - 1;
}

int Tightened::AddDetached(std::span<const double> x, double tolerance) {
  const sy_paths& paths = whole_.paths();
  std::vector<std::uint8_t> carries(whole_.arcs().size());
  for (std::size_t a = 0; a < carries.size(); ++a) {
    carries[a] = x[At(paths.flow[a])] > 0.1 * tolerance ? 1 : 0;
  }
  const auto reached = Reached(whole_.arcs(), Leaving(whole_.arcs(), carries), paths.source);
  int added = 0;
  for (std::int32_t v = 0; v < paths.num_vertices; ++v) {
    double out = 0;
    for (const std::int32_t a : whole_.out().Of(v)) out += x[At(paths.flow[a])];
    if (reached[At(v)] != 0 || !(out > tolerance)) continue;
    std::vector<Entry> row;
    for (const std::int32_t a : whole_.out().Of(v)) row.push_back({paths.flow[a], -1});
    for (std::int32_t a = 0; a < paths.num_arcs; ++a) {
      const bool enters = reached[At(paths.head[a])] == 0 && reached[At(paths.tail[a])] != 0;
      if (enters) row.push_back({paths.flow[a], 1});
    }
    AddRow(row);
    ++added;
  }
  num_cuts_ += added;
  return added;
}

void Tightened::BeginRow(double lower, double upper, std::int32_t block) {
  rows_.emplace_back();
  row_lower_.push_back(lower);
  row_upper_.push_back(upper);
  block_of_row_.push_back(block);
}

void Tightened::AddRow(const std::vector<Entry>& entries) {
  BeginRow(0, kInfinity, -1);
  rows_.back() = entries;
  Merge(rows_.back());
}

void Tightened::AppendBlock(const Cone& cone, const sy_set& set) {
  const std::int32_t scale = AddVariable(0, 1, true);
  const auto define = [&](std::int32_t j, const Sum& sum) {
    BeginRow(0, 0, -1);
    rows_.back() = sum.entries;
    rows_.back().push_back({j, -1});
  };
  define(scale, cone.scale);
  std::vector<std::int32_t> column = {scale};
  std::vector<double> factor = {1};
  for (std::size_t i = 0; i < cone.point.size(); ++i) {
    const bool fixed = !std::isnan(cone.factor[i]);
    column.push_back(fixed ? scale : AddVariable(cone.point[i].lower, cone.point[i].upper, false));
    factor.push_back(fixed ? cone.factor[i] : 1);
    if (!fixed) define(column.back(), cone.point[i]);
  }
  for (std::int32_t k = 0; k < set.num_aux; ++k) {
    column.push_back(AddVariable(-kInfinity, kInfinity, false));
    factor.push_back(1);
  }
  AppendSet(set, column, factor, num_blocks_++);
}

// Rows of the scale alone hold, or the set is empty.
void Tightened::AppendSet(const sy_set& set, std::span<const std::int32_t> column,
                          std::span<const double> factor, std::int32_t block) {
  const auto entries = [&](const sy_csc& by_rows, std::int32_t i) {
    std::vector<Entry> row;
    for (std::int32_t k = by_rows.start[i]; k < by_rows.start[i + 1]; ++k) {
      const std::size_t c = At(by_rows.row[k]);
      row.push_back({column[c], by_rows.value[k] * factor[c]});
    }
    Merge(row);
    return row;
  };
  for (std::int32_t i = 0; i < set.num_rows; ++i) {
    std::vector<Entry> row = entries(*set.At, i);
    if (row.empty() || (row.size() == 1 && row[0].variable == column[0])) continue;
    BeginRow(set.row_lower[i], set.row_upper[i], block);
    rows_.back() = std::move(row);
  }
  for (std::int32_t i = 0; i < set.num_cone_rows; ++i) {
    cone_rows_.push_back(entries(*set.Ft, i));
  }
  cones_.insert(cones_.end(), set.cones, set.cones + set.num_cones);
  block_of_cone_.insert(block_of_cone_.end(), At(set.num_cones), block);
}

void Tightened::Rebuild() {
  const sy_blocks& given = whole_.blocks();
  const auto joined = [](const std::int32_t* first, std::int32_t count,
                         const std::vector<std::int32_t>& more) {
    std::vector<std::int32_t> all(first, first + count);
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  all_x_ = joined(given.x, p_.num_vars, block_of_x_);
  all_rows_ = joined(given.row, p_.num_rows, block_of_row_);
  all_cones_ = joined(given.cone, p_.num_cones, block_of_cone_);
  blocks_ = {sizeof blocks_,   num_blocks_,       all_x_.data(),
             all_rows_.data(), all_cones_.data(), nullptr};
  hints_ = {{"sy.blocks/1", &blocks_}, {nullptr, nullptr}};
  ProblemData d(p_);
  const auto append = [](auto& to, const auto& more) {
    to.insert(to.end(), more.begin(), more.end());
  };
  d.num_vars += static_cast<std::int32_t>(x_lower_.size());
  d.q.resize(At(d.num_vars), 0.0);
  d.integer.clear();
  d.x_lower.resize(At(p_.num_vars), -kInfinity);
  d.x_upper.resize(At(p_.num_vars), kInfinity);
  append(d.x_lower, x_lower_);
  append(d.x_upper, x_upper_);
  append(d.row_lower, row_lower_);
  append(d.row_upper, row_upper_);
  append(d.cones, cones_);
  d.g.resize(d.g.size() + cone_rows_.size(), 0.0);
  d.P.rows = d.P.cols = d.num_vars;
  d.P.start.resize(At(d.num_vars) + 1, d.P.start.back());
  d.A = Extended(p_.A, p_.num_rows, ByColumns(rows_, d.num_vars));
  d.F = Extended(p_.F, p_.num_cone_rows, ByColumns(cone_rows_, d.num_vars));
  d.hints = hints_.data();
  ProblemData r = d;
  const sy_problem& relaxed = whole_.relaxation();
  std::copy_n(relaxed.x_lower, p_.num_vars, r.x_lower.begin());
  std::copy_n(relaxed.x_upper, p_.num_vars, r.x_upper.begin());
  for (std::size_t k = 0; k < is_scale_.size(); ++k) {  // all others are implied
    if (is_scale_[k] == 0) r.x_lower[At(p_.num_vars) + k] = -kInfinity;
    r.x_upper[At(p_.num_vars) + k] = kInfinity;
  }
  exact_ = Problem(std::move(d));
  relaxed_ = Problem(std::move(r));
}

}  // namespace switchyard::rounding
