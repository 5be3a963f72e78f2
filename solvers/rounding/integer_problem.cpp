#include "solvers/rounding/integer_problem.hpp"

#include <algorithm>
#include <cmath>

#include "solvers/rounding/verify.hpp"
#include "switchyard/cones.hpp"

namespace switchyard::rounding {
namespace {

std::size_t At(std::int32_t i) { return static_cast<std::size_t>(i); }

/// visit(row, value) for each entry of column j; none where there is no matrix.
template <class Visit>
void EachEntry(const sy_csc* m, std::int32_t j, Visit&& visit) {
  if (m == nullptr) return;
  for (std::int32_t k = m->start[j]; k < m->start[j + 1]; ++k) visit(At(m->row[k]), m->value[k]);
}

/// Of rows of F: does the cone stay satisfied where the row grows, where it falls? The cone is
/// convex, so it does where the unit vector, or its negative, is in it.
struct Indifference {
  bool to_growth = false, to_fall = false;
};

Indifference IndifferenceOf(const sy_cone& cone, std::int32_t row) {
  std::vector<double> unit(At(cone.dim), 0.0);
  const auto holds = [&](double v) {
    unit[At(row)] = v;
    return FactsOf(cone.kind).violation(unit.data(), cone.dim, cone.parameter) <= 0;
  };
  return {holds(1), holds(-1)};
}

/// Of each row of F that integer variables stand in.
std::vector<Indifference> IndifferenceOfRows(const sy_problem& p,
                                             const std::vector<std::int32_t>& integers) {
  std::vector<std::uint8_t> needed(At(p.num_cone_rows), 0);
  for (const std::int32_t j : integers) {
    EachEntry(p.F, j, [&](std::size_t row, double) { needed[row] = 1; });
  }
  std::vector<Indifference> rows(At(p.num_cone_rows));
  std::int32_t first = 0;
  for (std::int32_t c = 0; c < p.num_cones; first += p.cones[c++].dim) {
    for (std::int32_t i = 0; i < p.cones[c].dim; ++i) {
      if (needed[At(first + i)] != 0) rows[At(first + i)] = IndifferenceOf(p.cones[c], i);
    }
  }
  return rows;
}

}  // namespace

IntegerProblem::IntegerProblem(const sy_problem& problem) : problem_(problem), groups_(problem) {
  for (std::int32_t j = 0; problem.integer != nullptr && j < problem.num_vars; ++j) {
    if (problem.integer[j] != 0) integers_.push_back(j);
  }
  has_continuous_.assign(At(problem.num_rows), 0);
  for (std::int32_t j = 0; problem.A != nullptr && j < problem.num_vars; ++j) {
    if (problem.integer != nullptr && problem.integer[j] != 0) continue;
    EachEntry(problem.A, j, [&](std::size_t row, double) { has_continuous_[row] = 1; });
  }
  CountLocks();
}

void IntegerProblem::CountLocks() {
  const sy_problem& p = problem_;
  locks_.resize(integers_.size());
  const auto lock = [](Locks& of, double entry, bool against_growth, bool against_fall) {
    if (against_growth) ++(entry > 0 ? of.up : of.down);
    if (against_fall) ++(entry > 0 ? of.down : of.up);
  };
  const std::vector<Indifference> cone_rows = IndifferenceOfRows(p, integers_);
  for (std::size_t i = 0; i < integers_.size(); ++i) {
    const std::int32_t j = integers_[i];
    EachEntry(p.A, j, [&](std::size_t row, double value) {
      lock(locks_[i], value, p.row_upper != nullptr && p.row_upper[row] < kInfinity,
           p.row_lower != nullptr && p.row_lower[row] > -kInfinity);
    });
    EachEntry(p.F, j, [&](std::size_t row, double value) {
      lock(locks_[i], value, !cone_rows[row].to_growth, !cone_rows[row].to_fall);
    });
  }
}

std::string IntegerProblem::WhatIsViolatedBy(const std::vector<double>& x, double tolerance) const {
  std::string violated = WhatIsViolated(problem_, x.data(), tolerance);
  if (violated.empty()) violated = WhatIntegerRowIsViolatedBy(x, tolerance);
  if (violated.empty()) violated = WhatProductIsViolatedBy(x, tolerance);
  for (std::int32_t g = 0; violated.empty() && g < num_groups(); ++g) {
    double largest = 0, next = 0;
    for (const std::int32_t j : Group(g)) {
      const double size = std::abs(x[At(j)]);
      next = std::max(next, std::min(size, largest));
      largest = std::max(largest, size);
    }
    if (next > tolerance * (1 + largest)) {
      violated = "group " + std::to_string(g) + " of sy.sos1/1 has two that are not 0";
    }
  }
  return violated;
}

std::string IntegerProblem::WhatIntegerRowIsViolatedBy(const std::vector<double>& x,
                                                       double tolerance) const {
  constexpr double kRounding = 1e-12;  // of a sum, relative to its terms
  const sy_problem& p = problem_;
  std::vector<double> value(has_continuous_.size(), 0.0), term(value);
  for (const std::int32_t j : integers_) {
    EachEntry(p.A, j, [&](std::size_t row, double entry) {
      value[row] += entry * x[At(j)];
      term[row] += std::abs(entry * x[At(j)]);
    });
  }
  for (std::size_t i = 0; i < value.size(); ++i) {
    const auto is_beyond = [&](double side, double by) {
      return by > tolerance * (1 + std::abs(side)) + kRounding * term[i];
    };
    if (has_continuous_[i] != 0) continue;
    const bool below =
        p.row_lower != nullptr && is_beyond(p.row_lower[i], p.row_lower[i] - value[i]);
    const bool above =
        p.row_upper != nullptr && is_beyond(p.row_upper[i], value[i] - p.row_upper[i]);
    if (below || above) return "row[" + std::to_string(i) + "] over integers alone is violated";
  }
  return "";
}

std::string IntegerProblem::WhatProductIsViolatedBy(const std::vector<double>& x,
                                                    double tolerance) const {
  const sy_problem& p = problem_;
  std::vector<double> s(At(p.num_cone_rows), 0.0);
  if (p.g != nullptr) s.assign(p.g, p.g + p.num_cone_rows);
  if (p.F != nullptr) MultiplyAdd(*p.F, 1, x.data(), s.data());
  std::size_t first = 0;
  for (std::int32_t c = 0; c < p.num_cones; first += At(p.cones[c++].dim)) {
    if (p.cones[c].kind != SY_CONE_ROTATED) continue;
    double squares = 0;
    for (std::size_t i = first + 2; i < first + At(p.cones[c].dim); ++i) squares += s[i] * s[i];
    const double product = 2 * std::max(0.0, s[first]) * std::max(0.0, s[first + 1]);
    if (squares - product <= tolerance * std::max({1.0, squares, product})) continue;
    return "cone[" + std::to_string(c) + "]: its product is exceeded by " +
           std::to_string(squares - product);
  }
  return "";
}

Domain::Domain(const IntegerProblem& whole) : whole_(&whole) {
  const sy_problem& p = whole.problem();
  boxes_.lower.assign(At(p.num_vars), -kInfinity);
  boxes_.upper.assign(At(p.num_vars), kInfinity);
  if (p.x_lower != nullptr) boxes_.lower.assign(p.x_lower, p.x_lower + p.num_vars);
  if (p.x_upper != nullptr) boxes_.upper.assign(p.x_upper, p.x_upper + p.num_vars);
}

double Domain::Nearest(std::int32_t j, double v) const {
  return std::clamp(std::round(v), std::ceil(lower(j)), std::floor(upper(j)));
}

void Domain::Impose(std::int32_t j, double lower, double upper) {
  double& own_lower = boxes_.lower[At(j)];
  double& own_upper = boxes_.upper[At(j)];
  own_lower = std::max(own_lower, lower);
  own_upper = std::min(own_upper, upper);
  if (own_lower <= own_upper) return;
  boxes_.infeasible = true;
  boxes_.source = BoxSource::kVariable;
  boxes_.index = j;
}

bool Domain::Propagate(double cutoff) {
  constexpr int kPasses = 5;
  for (bool changed = true; changed;) {
    if (boxes_.infeasible) return false;
    sy_problem p = whole_->problem();
    p.x_lower = boxes_.lower.data();
    p.x_upper = boxes_.upper.data();
    Boxes narrower = ProvenBoxes(p, cutoff, kPasses);
    boxes_ = std::move(narrower);
    if (boxes_.infeasible || !PropagateGroups(changed)) return false;
  }
  return true;
}

bool Domain::PropagateGroups(bool& changed) {
  changed = false;
  for (std::int32_t g = 0; g < whole_->num_groups(); ++g) {
    std::int32_t chosen = -1;
    for (const std::int32_t j : whole_->Group(g)) {
      if (j == chosen || (lower(j) <= 0 && upper(j) >= 0)) continue;
      if (chosen >= 0) contradictory_group_ = g;
      chosen = j;
    }
    if (contradictory_group_ >= 0) boxes_.infeasible = true;
    if (boxes_.infeasible) return false;
    for (const std::int32_t j : whole_->Group(g)) {
      if (chosen < 0 || j == chosen || (lower(j) == 0 && upper(j) == 0)) continue;
      boxes_.lower[At(j)] = boxes_.upper[At(j)] = 0;
      changed = true;
    }
  }
  return true;
}

std::string Domain::Contradiction() const {
  if (contradictory_group_ >= 0) {
    return "group " + std::to_string(contradictory_group_) + " of sy.sos1/1";
  }
  const auto named = [this](const char* what) {
    return what + ("[" + std::to_string(boxes_.index) + "]");
  };
  switch (boxes_.source) {
    case BoxSource::kRow:
      return named("row");
    case BoxSource::kCone:
      return named("cone");
    case BoxSource::kCutoff:
      return "the objective of the best point";
    default:
      return named("x");
  }
}

}  // namespace switchyard::rounding
