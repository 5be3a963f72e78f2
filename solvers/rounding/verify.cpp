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
  /// Of a value between two sides.
  void SeeSides(const char* what, std::int32_t index, double value, double lower, double upper) {
    const double below = lower - value, above = value - upper;
    if (!(below <= 0)) See(what, index, below, 1 + std::abs(lower));
    if (!(above <= 0)) See(what, index, above, 1 + std::abs(upper));
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
    worst.SeeSides("x", j, x[j], p.x_lower != nullptr ? p.x_lower[j] : -kInfinity,
                   p.x_upper != nullptr ? p.x_upper[j] : kInfinity);
    if (p.integer != nullptr && p.integer[j] != 0) {
      worst.See("x", j, std::abs(x[j] - std::round(x[j])), 1);
    }
  }
}

void SeeRows(const sy_problem& p, const double* x, Worst& worst) {
  std::vector<double> value(static_cast<std::size_t>(p.num_rows), 0.0);
  if (p.A != nullptr) MultiplyAdd(*p.A, 1, x, value.data());
  for (std::int32_t i = 0; i < p.num_rows; ++i) {
    worst.SeeSides("row", i, value[static_cast<std::size_t>(i)],
                   p.row_lower != nullptr ? p.row_lower[i] : -kInfinity,
                   p.row_upper != nullptr ? p.row_upper[i] : kInfinity);
  }
}

void SeeCones(const sy_problem& p, const double* x, Worst& worst) {
  std::vector<double> s(static_cast<std::size_t>(p.num_cone_rows), 0.0);
  if (p.g != nullptr) std::copy(p.g, p.g + p.num_cone_rows, s.begin());
  if (p.F != nullptr) MultiplyAdd(*p.F, 1, x, s.data());
  const double* at = s.data();
  for (std::int32_t c = 0; c < p.num_cones; ++c) {
    const sy_cone& cone = p.cones[c];
    double size = 1;
    for (std::int32_t i = 0; i < cone.dim; ++i) size = std::max(size, std::abs(at[i]));
    const double violation = FactsOf(cone.kind).violation(at, cone.dim, cone.parameter);
    if (!(violation <= 0)) worst.See("cone", c, violation, size);
    at += cone.dim;
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
