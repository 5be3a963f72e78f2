#include "solvers/mip/affine_columns.hpp"

#include <cmath>
#include <cstddef>

namespace switchyard::mip {
namespace {

std::size_t At(std::int32_t i) { return static_cast<std::size_t>(i); }

constexpr double kFixed = 1e-9;  // a box that is no wider, relative, is a constant

/// sum += value x, where both depend on one variable at most.
bool Add(double value, const Affine& x, Affine& sum) {
  const Interval by = {value, value};
  sum.constant = Plus(sum.constant, Times(by, x.constant));
  if (x.variable < 0) return true;
  if (sum.variable >= 0 && sum.variable != x.variable) return false;
  sum.variable = x.variable;
  sum.factor = Plus(sum.factor, Times(by, x.factor));
  return true;
}

class Chase {
 public:
  Chase(const sy_problem& problem, const NodeBoxes& boxes)
      : p_(problem), known_(At(problem.num_vars), 0), columns_(At(problem.num_vars)) {
    if (p_.A != nullptr) rows_ = Transpose(*p_.A);
    unknown_.assign(At(p_.num_rows), 0);
    for (std::int32_t i = 0; i < p_.num_rows; ++i) unknown_[At(i)] = Size(i);
    for (std::int32_t j = 0; j < p_.num_vars; ++j) {
      const double l = boxes.lower(j), u = boxes.upper(j);
      if (u - l <= kFixed * std::max(1.0, std::abs(l))) Know(j, {-1, {0, 0}, {l, u}});
    }
    for (const bool integer : {true, false}) {
      for (std::int32_t j = 0; j < p_.num_vars; ++j) {
        if (boxes.IsInteger(j) != integer) continue;
        if (known_[At(j)] == 0) Know(j, {j, {1, 1}, {0, 0}});
        if (!integer) Follow();
      }
      Follow();
    }
  }

  std::vector<Affine> Take() { return std::move(columns_); }

 private:
  [[nodiscard]] std::int32_t Size(std::int32_t i) const {
    return rows_.start[At(i) + 1] - rows_.start[At(i)];
  }

  void Know(std::int32_t j, const Affine& as) {
    known_[At(j)] = 1;
    columns_[At(j)] = as;
    if (p_.A == nullptr) return;
    for (std::int32_t k = p_.A->start[j]; k < p_.A->start[j + 1]; ++k) {
      const std::int32_t i = p_.A->row[k];
      if (--unknown_[At(i)] == 1) waiting_.push_back(i);
    }
  }

  void Follow() {
    while (!waiting_.empty()) {
      const std::int32_t i = waiting_.back();
      waiting_.pop_back();
      Solve(i);
    }
  }

  // a x_j + rest = side, for the one x_j that is not known.
  void Solve(std::int32_t i) {
    if (unknown_[At(i)] != 1 || p_.row_lower == nullptr || p_.row_upper == nullptr) return;
    if (p_.row_lower[i] != p_.row_upper[i]) return;
    Affine rest;
    std::int32_t j = -1;
    double a = 0;
    for (std::int32_t k = rows_.start[At(i)]; k < rows_.start[At(i) + 1]; ++k) {
      const std::int32_t other = rows_.row[At(k)];
      if (known_[At(other)] == 0) {
        j = other;
        a = rows_.value[At(k)];
      } else if (!Add(rows_.value[At(k)], columns_[At(other)], rest)) {
        return;
      }
    }
    if (j < 0 || a == 0 || rest.variable < 0) return;
    const Interval side = {p_.row_lower[i], p_.row_lower[i]}, by = {a, a};
    Know(j,
         {rest.variable, Over(Minus(rest.factor), by), Over(Plus(side, Minus(rest.constant)), by)});
  }

  const sy_problem& p_;
  Csc rows_;  // by rows
  std::vector<std::uint8_t> known_;
  std::vector<std::int32_t> unknown_;  // entries of each row whose variable is not known
  std::vector<std::int32_t> waiting_;  // rows with one
  std::vector<Affine> columns_;
};

}  // namespace

std::vector<Affine> AffineColumns(const sy_problem& problem, const NodeBoxes& boxes) {
  return Chase(problem, boxes).Take();
}

std::optional<Affine> AffineRow(const Csc& by_rows, std::int32_t row, double constant,
                                const std::vector<Affine>& columns) {
  Affine sum;
  sum.constant = {constant, constant};
  for (std::int32_t k = by_rows.start[At(row)]; k < by_rows.start[At(row) + 1]; ++k) {
    if (!Add(by_rows.value[At(k)], columns[At(by_rows.row[At(k)])], sum)) return std::nullopt;
  }
  if (sum.variable >= 0 && IsExactly(sum.factor, 0)) sum.variable = -1;
  return sum;
}

}  // namespace switchyard::mip
