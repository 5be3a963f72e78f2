#include "solvers/rounding/verify.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <sstream>
#include <vector>

#include "switchyard/cones.hpp"
#include "switchyard/problem.hpp"

namespace switchyard::rounding {
namespace {

/// The largest relative violation met so far, and of what.
class Worst {
 public:
  void See(const char* what, std::int32_t index, double violation, double size) {
    const double relative = violation / size;
    if (relative <= relative_ || std::isnan(relative_)) return;  // a NaN is the worst
    relative_ = relative;
    what_ = what;
    index_ = index;
  }
  /// Of a value between two sides, the sum of terms of at most this size.
  void SeeSides(const char* what, std::int32_t index, double value, double term, double lower,
                double upper) {
    const double below = lower - value, above = value - upper;
    if (!(below <= 0)) See(what, index, below, 1 + std::max(term, std::abs(lower)));
    if (!(above <= 0)) See(what, index, above, 1 + std::max(term, std::abs(upper)));
  }
  [[nodiscard]] std::string Text(double tolerance) const {
    if (relative_ <= tolerance) return "";
    std::ostringstream text;
    text << what_ << "[" << index_ << "] is violated by " << relative_;
    return text.str();
  }

 private:
  double relative_ = 0;
  const char* what_ = "";
  std::int32_t index_ = -1;
};

void SeeVariables(const sy_problem& p, const double* x, Worst& worst) {
  for (std::int32_t j = 0; j < p.num_vars; ++j) {
    worst.SeeSides("x", j, x[j], std::abs(x[j]), p.x_lower != nullptr ? p.x_lower[j] : -kInfinity,
                   p.x_upper != nullptr ? p.x_upper[j] : kInfinity);
    if (p.integer != nullptr && p.integer[j] != 0) {
      worst.See("x", j, std::abs(x[j] - std::round(x[j])), 1);
    }
  }
}

/// M x + constant, and the largest term of each row.
struct RowValues {
  RowValues(const sy_csc* M, const double* constant, std::int32_t rows, const double* x)
      : value(static_cast<std::size_t>(rows), 0.0), term(value) {
    for (std::size_t i = 0; constant != nullptr && i < value.size(); ++i) {
      value[i] = constant[i];
      term[i] = std::abs(constant[i]);
    }
    for (std::int32_t j = 0; M != nullptr && j < M->cols; ++j) {
      if (x[j] == 0) continue;
      for (std::int32_t k = M->start[j]; k < M->start[j + 1]; ++k) {
        const auto i = static_cast<std::size_t>(M->row[k]);
        value[i] += M->value[k] * x[j];
        term[i] = std::max(term[i], std::abs(M->value[k] * x[j]));
      }
    }
  }
  std::vector<double> value, term;
};

void SeeRows(const sy_problem& p, const double* x, Worst& worst) {
  const RowValues rows(p.A, nullptr, p.num_rows, x);
  for (std::int32_t i = 0; i < p.num_rows; ++i) {
    const auto at = static_cast<std::size_t>(i);
    worst.SeeSides("row", i, rows.value[at], rows.term[at],
                   p.row_lower != nullptr ? p.row_lower[i] : -kInfinity,
                   p.row_upper != nullptr ? p.row_upper[i] : kInfinity);
  }
}

void SeeCones(const sy_problem& p, const double* x, Worst& worst) {
  const RowValues rows(p.F, p.g, p.num_cone_rows, x);
  const double* at = rows.value.data();
  const double* term = rows.term.data();
  for (std::int32_t c = 0; c < p.num_cones; ++c) {
    const sy_cone& cone = p.cones[c];
    const double size = cone.dim > 0 ? 1 + *std::max_element(term, term + cone.dim) : 1;
    const double violation = FactsOf(cone.kind).violation(at, cone.dim, cone.parameter);
    if (!(violation <= 0)) worst.See("cone", c, violation, size);
    at += cone.dim;
    term += cone.dim;
  }
}

}  // namespace

std::string WhatIsViolated(const sy_problem& problem, const double* x, double tolerance) {
  Worst worst;
  SeeVariables(problem, x, worst);
  SeeRows(problem, x, worst);
  SeeCones(problem, x, worst);
  return worst.Text(tolerance);
}

}  // namespace switchyard::rounding
