#include "solvers/mip/reduced_problem.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "switchyard/cones.hpp"
#include "switchyard/plugin.hpp"

namespace switchyard::mip {
namespace {

constexpr double kRounding = 1e-9;  // of what is left of a side, or of a cone's members

std::size_t At(std::int32_t i) { return static_cast<std::size_t>(i); }

/// Columns of m over rows that are left, `place` each one's place among them.
Csc Left(const sy_csc* m, const std::vector<std::int32_t>& columns,
         const std::vector<std::int32_t>& rows, std::int32_t num_rows) {
  std::vector<std::int32_t> place(At(num_rows), -1);
  for (std::size_t k = 0; k < rows.size(); ++k) place[At(rows[k])] = static_cast<std::int32_t>(k);
  Csc left(static_cast<std::int32_t>(rows.size()), static_cast<std::int32_t>(columns.size()));
  for (std::size_t c = 0; m != nullptr && c < columns.size(); ++c) {
    for (std::int32_t k = m->start[columns[c]]; k < m->start[columns[c] + 1]; ++k) {
      if (place[At(m->row[k])] < 0) continue;
      left.row.push_back(place[At(m->row[k])]);
      left.value.push_back(m->value[k]);
    }
    left.start[c + 1] = static_cast<std::int32_t>(left.row.size());
  }
  return left;
}

template <class T>
std::vector<T> Those(const T* all, const std::vector<std::int32_t>& places, T none) {
  std::vector<T> those;
  those.reserve(places.size());
  for (const std::int32_t i : places) those.push_back(all != nullptr ? all[i] : none);
  return those;
}

const sy_blocks* BlocksOf(const sy_problem& problem) {
  for (const sy_hint* hint = problem.hints; hint != nullptr && hint->id != nullptr; ++hint) {
    if (std::strcmp(hint->id, "sy.blocks/1") == 0) return static_cast<const sy_blocks*>(hint->data);
  }
  return nullptr;
}

}  // namespace

ReducedProblem::ReducedProblem(const sy_problem& whole, const std::vector<double>& lower,
                               const std::vector<double>& upper)
    : whole_(whole),
      value_(At(whole.num_vars), std::numeric_limits<double>::quiet_NaN()),
      row_fixed_(At(whole.num_rows), 0.0),
      cone_row_fixed_(At(whole.num_cone_rows), 0.0) {
  FixVariables(lower, upper);
  std::vector<std::uint8_t> in_row(At(whole.num_rows), 0), in_cone_row(At(whole.num_cone_rows), 0);
  for (const std::int32_t j : variable_) {
    const auto mark = [&](const sy_csc* m, std::vector<std::uint8_t>& used) {
      if (m == nullptr) return;
      for (std::int32_t k = m->start[j]; k < m->start[j + 1]; ++k) used[At(m->row[k])] = 1;
    };
    mark(whole.A, in_row);
    mark(whole.F, in_cone_row);
  }
  KeepRows(in_row);
  KeepCones(in_cone_row);
  KeepBlocks();
}

void ReducedProblem::FixVariables(const std::vector<double>& lower,
                                  const std::vector<double>& upper) {
  data_.offset = whole_.offset;
  for (std::int32_t j = 0; j < whole_.num_vars; ++j) {
    const double value = lower[At(j)];
    if (value != upper[At(j)]) {
      variable_.push_back(j);
      continue;
    }
    value_[At(j)] = value;
    if (value == 0) continue;
    if (whole_.q != nullptr) data_.offset += whole_.q[j] * value;
    const auto add = [&](const sy_csc* m, std::vector<double>& fixed) {
      if (m == nullptr) return;
      for (std::int32_t k = m->start[j]; k < m->start[j + 1]; ++k) {
        fixed[At(m->row[k])] += m->value[k] * value;
      }
    };
    add(whole_.A, row_fixed_);
    add(whole_.F, cone_row_fixed_);
  }
  data_.num_vars = static_cast<std::int32_t>(variable_.size());
  data_.q = Those(whole_.q, variable_, 0.0);
  data_.x_lower = Those(whole_.x_lower, variable_, -kInfinity);
  data_.x_upper = Those(whole_.x_upper, variable_, kInfinity);
}

// One that does not hold stays, for the proof.
void ReducedProblem::KeepRows(const std::vector<std::uint8_t>& used) {
  for (std::int32_t i = 0; i < whole_.num_rows; ++i) {
    const double fixed = row_fixed_[At(i)];
    const double lower = whole_.row_lower != nullptr ? whole_.row_lower[i] : -kInfinity;
    const double upper = whole_.row_upper != nullptr ? whole_.row_upper[i] : kInfinity;
    const double slack = kRounding * (1 + std::abs(fixed));
    if (used[At(i)] == 0 && lower - slack <= fixed && fixed <= upper + slack) continue;
    row_.push_back(i);
    data_.row_lower.push_back(lower - fixed);
    data_.row_upper.push_back(upper - fixed);
  }
  data_.A = Left(whole_.A, variable_, row_, whole_.num_rows);
}

void ReducedProblem::KeepCones(const std::vector<std::uint8_t>& used) {
  std::int32_t first = 0;
  std::vector<double> s;
  for (std::int32_t c = 0; c < whole_.num_cones; ++c) {
    const sy_cone& cone = whole_.cones[c];
    s.clear();
    double size = 1;
    for (std::int32_t i = first; i < first + cone.dim; ++i) {
      s.push_back((whole_.g != nullptr ? whole_.g[i] : 0) + cone_row_fixed_[At(i)]);
      size = std::max(size, std::abs(s.back()));
    }
    const auto begin = used.begin() + first;
    const bool constant = std::none_of(begin, begin + cone.dim, [](std::uint8_t u) { return u; });
    const bool holds = constant && FactsOf(cone.kind).violation(s.data(), cone.dim,
                                                                cone.parameter) <= kRounding * size;
    if (!holds) {
      cone_.push_back(c);
      data_.cones.push_back(cone);
      data_.g.insert(data_.g.end(), s.begin(), s.end());
      for (std::int32_t i = 0; i < cone.dim; ++i) cone_row_.push_back(first + i);
    }
    first += cone.dim;
  }
  data_.F = Left(whole_.F, variable_, cone_row_, whole_.num_cone_rows);
}

void ReducedProblem::KeepBlocks() {
  A_ = data_.A.View();
  F_ = data_.F.View();
  view_ = whole_;
  view_.num_vars = data_.num_vars;
  view_.num_rows = static_cast<std::int32_t>(row_.size());
  view_.num_cones = static_cast<std::int32_t>(cone_.size());
  view_.num_cone_rows = static_cast<std::int32_t>(cone_row_.size());
  view_.P = nullptr;
  view_.q = data_.q.data();
  view_.offset = data_.offset;
  view_.x_lower = data_.x_lower.data();
  view_.x_upper = data_.x_upper.data();
  view_.integer = nullptr;
  view_.A = &A_;
  view_.row_lower = data_.row_lower.data();
  view_.row_upper = data_.row_upper.data();
  view_.F = &F_;
  view_.g = data_.g.data();
  view_.cones = data_.cones.data();
  view_.hints = nullptr;
  const sy_blocks* given = BlocksOf(whole_);
  if (given == nullptr) return;
  const sy_blocks blocks = plugin::Whole(*given);
  block_of_variable_ = Those(blocks.x, variable_, -1);
  block_of_row_ = Those(blocks.row, row_, -1);
  block_of_cone_ = Those(blocks.cone, cone_, -1);
  blocks_.size = sizeof blocks_;
  blocks_.num_blocks = blocks.num_blocks;
  blocks_.x = block_of_variable_.data();
  blocks_.row = block_of_row_.data();
  blocks_.cone = block_of_cone_.data();
  hints_ = {{"sy.blocks/1", &blocks_}, {nullptr, nullptr}};
  view_.hints = hints_.data();
}

bool ReducedProblem::Covers(const std::vector<double>& lower,
                            const std::vector<double>& upper) const {
  for (std::size_t j = 0; j < value_.size(); ++j) {
    if (std::isnan(value_[j])) continue;
    if (lower[j] != value_[j] || upper[j] != value_[j]) return false;
  }
  return true;
}

std::vector<double> ReducedProblem::Kept(const std::vector<double>& v) const {
  return Those(v.data(), variable_, 0.0);
}

rounding::Answer ReducedProblem::Back(const rounding::Answer& reduced) const {
  rounding::Answer whole;
  whole.termination = reduced.termination;
  whole.primal = reduced.primal;
  whole.dual = reduced.dual;
  whole.iterations = reduced.iterations;
  whole.text = reduced.text;
  const auto scatter = [](const std::vector<double>& from, const std::vector<std::int32_t>& places,
                          std::vector<double>& to) {
    for (std::size_t k = 0; k < places.size(); ++k) to[At(places[k])] = from[k];
  };
  whole.x = value_;
  whole.x_dual.assign(value_.size(), 0.0);
  whole.row_dual.assign(row_fixed_.size(), 0.0);
  whole.cone_dual.assign(cone_row_fixed_.size(), 0.0);
  scatter(reduced.x, variable_, whole.x);
  scatter(reduced.x_dual, variable_, whole.x_dual);
  scatter(reduced.row_dual, row_, whole.row_dual);
  scatter(reduced.cone_dual, cone_row_, whole.cone_dual);
  return whole;
}

}  // namespace switchyard::mip
