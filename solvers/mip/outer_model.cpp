#include "solvers/mip/outer_model.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "switchyard/cones.hpp"

namespace switchyard::mip {
namespace {

std::size_t Index(std::int32_t i) { return static_cast<std::size_t>(i); }

constexpr double kRoot = 0.70710678118654752;  // 1 / sqrt 2

std::vector<double> Whole(const double* given, std::int32_t count, double none) {
  return given != nullptr ? std::vector<double>(given, given + count)
                          : std::vector<double>(Index(count), none);
}

/// rho of the plane that touches u^2 <= w t next to (w, t, u), and how far that is outside,
/// relative to the point's size: with p = (w + t) / 2 and q = ((w - t) / 2, u), |q| <= p.
std::pair<double, double> Nearest(double w, double t, double u) {
  const double p = 0.5 * (w + t), q0 = 0.5 * (w - t);
  const double size = std::hypot(q0, u);
  if (size == 0) return {0, -p};
  const double a = q0 / size, b = u / size;
  constexpr double kSteepest = 1e4;
  const double rho = std::clamp(b / std::max(1 - a, 1e-12), -kSteepest, kSteepest);
  return {rho, (size - p) / std::max(1.0, std::abs(p))};
}

}  // namespace

std::string OuterModel::WhyNot(const sy_problem& problem) {
  if (problem.P != nullptr) return "the objective is quadratic";
  for (std::int32_t c = 0; c < problem.num_cones; ++c) {
    const sy_cone_kind kind = problem.cones[c].kind;
    const bool known = kind == SY_CONE_ZERO || kind == SY_CONE_NONNEGATIVE ||
                       kind == SY_CONE_SECOND_ORDER || kind == SY_CONE_ROTATED;
    if (!known) return "cone[" + std::to_string(c) + "] is " + FactsOf(kind).name;
  }
  return "";
}

bool OuterModel::IsCurved(const sy_problem& problem) {
  return std::any_of(problem.cones, problem.cones + problem.num_cones, [](const sy_cone& cone) {
    return cone.kind != SY_CONE_ZERO && cone.kind != SY_CONE_NONNEGATIVE;
  });
}

OuterModel::OuterModel(const sy_problem& problem) : problem_(problem) {
  if (problem.F != nullptr) f_ = Transpose(*problem.F);
  value_.resize(Index(problem.num_cone_rows));
  AddValues(f_);
  std::int32_t first = 0;
  for (std::int32_t c = 0; c < problem.num_cones; ++c) {
    AddCone(problem.cones[c], first);
    first += problem.cones[c].dim;
  }
  Finish();
}

std::int32_t OuterModel::AddColumn(double lower) {
  x_lower_.push_back(lower);
  return problem_.num_vars + static_cast<std::int32_t>(x_lower_.size()) - 1;
}

void OuterModel::AddStatic(Cut row, double upper) {
  rows_.push_back(std::move(row));
  upper_of_rows_.push_back(upper);
}

// A row of several entries in a second-order cone gets a column, so that cuts are sparse.
void OuterModel::AddValues(const Csc& by_rows) {
  std::int32_t row = 0;
  for (std::int32_t c = 0; c < problem_.num_cones; ++c) {
    const sy_cone& cone = problem_.cones[c];
    const bool curved = cone.kind == SY_CONE_SECOND_ORDER || cone.kind == SY_CONE_ROTATED;
    for (std::int32_t k = 0; k < cone.dim; ++k, ++row) {
      if (!curved) continue;
      Value& value = value_[Index(row)];
      const double constant = problem_.g != nullptr ? problem_.g[row] : 0;
      const std::int32_t begin = by_rows.start[Index(row)], end = by_rows.start[Index(row) + 1];
      if (end - begin <= 1) {
        value.constant = constant;
        if (end == begin) continue;
        value.column = by_rows.row[Index(begin)];
        value.coefficient = by_rows.value[Index(begin)];
        continue;
      }
      value = {AddColumn(-kInfinity), 1, 0};
      Cut definition;
      for (std::int32_t e = begin; e < end; ++e) {
        definition.entries.push_back({by_rows.row[Index(e)], by_rows.value[Index(e)]});
      }
      definition.entries.push_back({value.column, -1});
      definition.lower = -constant;
      AddStatic(std::move(definition), -constant);
    }
  }
}

void OuterModel::Put(std::int32_t cone_row, double coefficient, Cut& cut) const {
  if (coefficient == 0) return;
  cut.dual.push_back({cone_row, coefficient});
  const Value& value = value_[Index(cone_row)];
  cut.lower -= coefficient * value.constant;
  if (value.column < 0) return;
  const auto same = std::find_if(cut.entries.begin(), cut.entries.end(),
                                 [&](const Entry& e) { return e.variable == value.column; });
  if (same == cut.entries.end()) {
    cut.entries.push_back({value.column, coefficient * value.coefficient});
  } else {
    same->value += coefficient * value.coefficient;
  }
}

void OuterModel::AddCone(const sy_cone& cone, std::int32_t first) {
  const bool rotated = cone.kind == SY_CONE_ROTATED;
  if (!rotated && cone.kind != SY_CONE_SECOND_ORDER) {
    for (std::int32_t row = first; row < first + cone.dim; ++row) {
      Cut linear;
      for (std::int32_t e = f_.start[Index(row)]; e < f_.start[Index(row) + 1]; ++e) {
        linear.entries.push_back({f_.row[Index(e)], f_.value[Index(e)]});
      }
      linear.lower = problem_.g != nullptr ? -problem_.g[row] : 0;
      linear.dual = {{row, 1}};
      AddStatic(linear, cone.kind == SY_CONE_ZERO ? linear.lower : kInfinity);
    }
    return;
  }
  const std::int32_t heads = rotated ? 2 : 1;
  Curved curved{rotated ? first + 1 : first, rotated ? first : -1, first + heads, cone.dim - heads};
  if (curved.count > 2) {
    AddSum(curved);
  } else {
    AddDirect(curved);
  }
  curved_.push_back(curved);
}

// Heads are not negative; a plane along each axis.
void OuterModel::AddDirect(const Curved& cone) {
  for (const std::int32_t head : {cone.head, cone.head2}) {
    if (head < 0) continue;
    Cut sign;
    Put(head, 1, sign);
    AddStatic(std::move(sign));
  }
  for (std::int32_t i = 0; i < cone.count; ++i) {
    for (const double side : {-1.0, 1.0}) {
      std::vector<double> direction(Index(cone.count) + 1, 0.0);
      direction[Index(i) + 1] = side;
      AddStatic(DirectCut(cone, direction));
    }
  }
}

void OuterModel::AddSum(Curved& cone) {
  cone.w = AddColumn(0);
  for (std::int32_t i = 1; i < cone.count; ++i) AddColumn(0);
  Cut sum;
  if (cone.head2 < 0) Put(cone.head, 1, sum);
  if (cone.head2 >= 0) Put(cone.head2, 2, sum);
  for (std::int32_t i = 0; i < cone.count; ++i) sum.entries.push_back({cone.w + i, -1});
  AddStatic(std::move(sum));
  Cut sign;
  Put(cone.head, 1, sign);
  AddStatic(std::move(sign));
  for (std::int32_t i = 0; i < cone.count; ++i) {
    for (const double rho : {-1.0, 1.0}) AddStatic(MemberCut(cone, i, rho));
  }
}

Cut OuterModel::MemberCut(const Curved& cone, std::int32_t member, double rho) const {
  Cut cut;
  cut.entries.push_back({cone.w + member, 1});
  Put(cone.first + member, -2 * rho, cut);
  Put(cone.head, rho * rho, cut);
  return cut;
}

// p >= direction'q, a unit vector: of a rotated cone p = (r + t) / sqrt 2, q = ((r - t) / sqrt 2,
// u); of another one p = t, q = (0, u).
Cut OuterModel::DirectCut(const Curved& cone, const std::vector<double>& direction) const {
  Cut cut;
  if (cone.head2 < 0) {
    Put(cone.head, 1, cut);
  } else {
    Put(cone.head2, kRoot * (1 - direction[0]), cut);
    Put(cone.head, kRoot * (1 + direction[0]), cut);
  }
  for (std::int32_t i = 0; i < cone.count; ++i) {
    Put(cone.first + i, -direction[Index(i) + 1], cut);
  }
  return cut;
}

double OuterModel::At(std::int32_t cone_row, const std::vector<double>& point) const {
  const Value& value = value_[Index(cone_row)];
  if (value.column < 0) return value.constant;
  return value.coefficient * point[Index(value.column)] + value.constant;
}

void OuterModel::SeparateMembers(const Curved& cone, const std::vector<double>& point,
                                 double tolerance, std::vector<Cut>& cuts) const {
  const double t = At(cone.head, point);
  for (std::int32_t i = 0; i < cone.count; ++i) {
    const auto [rho, outside] = Nearest(point[Index(cone.w + i)], t, At(cone.first + i, point));
    if (outside > tolerance) cuts.push_back(MemberCut(cone, i, rho));
  }
}

void OuterModel::SeparateDirectly(const Curved& cone, const std::vector<double>& point,
                                  double tolerance, std::vector<Cut>& cuts) const {
  const double t = At(cone.head, point);
  const double r = cone.head2 >= 0 ? At(cone.head2, point) : 0;
  const double p = cone.head2 >= 0 ? kRoot * (r + t) : t;
  std::vector<double> direction = {cone.head2 >= 0 ? kRoot * (r - t) : 0};
  for (std::int32_t i = 0; i < cone.count; ++i) direction.push_back(At(cone.first + i, point));
  double size = 0;
  for (const double d : direction) size = std::hypot(size, d);
  if (!(size > 0) || size - p <= tolerance * std::max(1.0, std::abs(p))) return;
  for (double& d : direction) d /= size;
  cuts.push_back(DirectCut(cone, direction));
}

void OuterModel::Separate(const std::vector<double>& point, double tolerance,
                          std::vector<Cut>& cuts) const {
  for (const Curved& cone : curved_) {
    if (cone.w >= 0) {
      SeparateMembers(cone, point, tolerance, cuts);
    } else {
      SeparateDirectly(cone, point, tolerance, cuts);
    }
  }
}

void OuterModel::TangentsAt(const std::vector<double>& x, std::vector<Cut>& cuts) const {
  std::vector<double> s(value_.size(), 0.0);
  if (problem_.g != nullptr) s.assign(problem_.g, problem_.g + problem_.num_cone_rows);
  if (problem_.F != nullptr) MultiplyAdd(*problem_.F, 1, x.data(), s.data());
  for (const Curved& cone : curved_) {
    const double t = s[Index(cone.head)];
    std::vector<double> direction = {0};
    if (cone.head2 >= 0) direction[0] = kRoot * (s[Index(cone.head2)] - t);
    for (std::int32_t i = 0; i < cone.count; ++i) direction.push_back(s[Index(cone.first + i)]);
    double size = 0;
    for (const double d : direction) size = std::hypot(size, d);
    if (!(size > 1e-12)) continue;
    if (cone.w < 0) {
      for (double& d : direction) d /= size;
      cuts.push_back(DirectCut(cone, direction));
      continue;
    }
    // Where the cone's boundary is next to (t, u): a ratio of members to the head.
    const double head = cone.head2 >= 0 ? t : size;
    if (!(head > 1e-9)) continue;
    for (std::int32_t i = 0; i < cone.count; ++i) {
      cuts.push_back(MemberCut(cone, i, std::clamp(direction[Index(i) + 1] / head, -1e4, 1e4)));
    }
  }
}

rounding::Duals OuterModel::DualsOf(const std::vector<double>& row_dual,
                                    const std::vector<Cut>& cuts) const {
  rounding::Duals duals;
  const auto own = row_dual.begin() + problem_.num_rows;
  duals.row.assign(row_dual.begin(), own);
  duals.cone.assign(value_.size(), 0.0);
  const auto add = [&](const Cut& row, double y) {
    for (const Entry& e : row.dual) duals.cone[Index(e.variable)] += y * e.value;
  };
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const bool equation = upper_of_rows_[i] < kInfinity;
    const double y = *(own + static_cast<std::ptrdiff_t>(i));
    if (y != 0) add(rows_[i], equation ? y : std::max(0.0, y));
  }
  const auto behind = own + static_cast<std::ptrdiff_t>(rows_.size());
  for (std::size_t k = 0; k < cuts.size(); ++k) {
    add(cuts[k], std::max(0.0, *(behind + static_cast<std::ptrdiff_t>(k))));
  }
  return duals;
}

void OuterModel::Finish() {
  const std::int32_t n = problem_.num_vars, m = problem_.num_rows;
  const auto all = n + static_cast<std::int32_t>(x_lower_.size());
  rounding::Rows rows(Index(m));
  for (std::int32_t j = 0; problem_.A != nullptr && j < n; ++j) {
    for (std::int32_t k = problem_.A->start[j]; k < problem_.A->start[j + 1]; ++k) {
      rows[Index(problem_.A->row[k])].push_back({j, problem_.A->value[k]});
    }
  }
  linear_.Change([&](ProblemData& d) {
    d.num_vars = all;
    d.flags = SY_PROBLEM_CONVEX;
    d.offset = problem_.offset;
    d.P = Csc(all, all);
    d.q = Whole(problem_.q, n, 0);
    d.q.resize(Index(all), 0.0);
    d.x_lower = Whole(problem_.x_lower, n, -kInfinity);
    d.x_lower.insert(d.x_lower.end(), x_lower_.begin(), x_lower_.end());
    d.x_upper = Whole(problem_.x_upper, n, kInfinity);
    d.x_upper.resize(Index(all), kInfinity);
    d.row_lower = Whole(problem_.row_lower, m, -kInfinity);
    d.row_upper = Whole(problem_.row_upper, m, kInfinity);
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      rows.push_back(rows_[i].entries);
      d.row_lower.push_back(rows_[i].lower);
      d.row_upper.push_back(upper_of_rows_[i]);
    }
    d.A = rounding::ByColumns(rows, all);
    d.F = Csc(0, all);
  });
}

}  // namespace switchyard::mip
