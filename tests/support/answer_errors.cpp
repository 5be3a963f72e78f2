#include "tests/support/answer_errors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "switchyard/cones.hpp"

namespace switchyard::testing {

Vector Product(const Csc& M, const Vector& x) {
  Vector y(static_cast<std::size_t>(M.rows), 0.0);
  MultiplyAdd(M.View(), 1, x.data(), y.data());
  return y;
}

Vector Combined(const ProblemData& d, const Vectors& v) {
  Vector sum = v.x_dual;
  sum.resize(static_cast<std::size_t>(d.num_vars), 0.0);
  if (!v.row_dual.empty()) TransposedMultiplyAdd(d.A.View(), 1, v.row_dual.data(), sum.data());
  if (!v.cone_dual.empty()) TransposedMultiplyAdd(d.F.View(), 1, v.cone_dual.data(), sum.data());
  return sum;
}

double Outside(double value, double lower, double upper) {
  return std::max({0.0, lower - value, value - upper});
}

double PrimalError(const ProblemData& d, const Vector& x) {
  double worst = 0;
  for (std::size_t j = 0; j < d.x_lower.size(); ++j) {
    worst = std::max(worst, Outside(x[j], d.x_lower[j], d.x_upper[j]));
  }
  const Vector Ax = Product(d.A, x);
  for (std::size_t i = 0; i < Ax.size(); ++i) {
    worst = std::max(worst, Outside(Ax[i], d.row_lower[i], d.row_upper[i]));
  }
  const Vector Fx = Product(d.F, x);
  std::size_t at = 0;
  for (const sy_cone& cone : d.cones) {
    Vector s(static_cast<std::size_t>(cone.dim));
    for (std::size_t i = 0; i < s.size(); ++i) s[i] = Fx[at + i] + d.g[at + i];
    worst = std::max(worst, FactsOf(cone.kind).violation(s.data(), cone.dim, cone.parameter));
    at += s.size();
  }
  return worst;
}

double SideSum(const ProblemData& d, const Vectors& v) {
  double sum = 0;
  const auto add = [&](double dual, double lower, double upper) {
    if (dual != 0) sum += dual * (dual > 0 ? lower : upper);
  };
  for (std::size_t j = 0; j < v.x_dual.size(); ++j) {
    add(v.x_dual[j], d.x_lower.empty() ? -kInfinity : d.x_lower[j],
        d.x_upper.empty() ? kInfinity : d.x_upper[j]);
  }
  for (std::size_t i = 0; i < v.row_dual.size(); ++i) {
    add(v.row_dual[i], d.row_lower[i], d.row_upper[i]);
  }
  for (std::size_t i = 0; i < v.cone_dual.size(); ++i) sum -= d.g[i] * v.cone_dual[i];
  return sum;
}

double ConeDualError(const ProblemData& d, const Vector& cone_dual) {
  double worst = 0;
  const double* at = cone_dual.data();
  for (const sy_cone& cone : d.cones) {
    if (cone_dual.empty()) break;
    worst = std::max(worst, DualViolation(cone, at));
    at += cone.dim;
  }
  return worst;
}

double OptimumError(const ProblemData& d, const Vectors& v) {
  double worst = std::max(PrimalError(d, v.x), ConeDualError(d, v.cone_dual));
  Vector left = Combined(d, v);
  for (std::size_t j = 0; j < left.size(); ++j) left[j] -= d.q[j];
  SymmetricMultiplyAdd(d.P.View(), -1, v.x.data(), left.data());
  double total = 0;
  for (const double l : left) total += std::abs(l);
  double linear = 0;
  for (std::size_t j = 0; j < v.x.size(); ++j) linear += d.q[j] * v.x[j];
  const double curved = QuadraticForm(d.P.View(), v.x.data());
  const double gap = std::abs(linear + curved - SideSum(d, v));  // 1/2 x'Px on either side
  if (std::isnan(total) || std::isnan(gap)) return std::numeric_limits<double>::quiet_NaN();
  return std::max({worst, total, gap});
}

double ContradictionError(const ProblemData& d, const Vectors& v) {
  const double sum = SideSum(d, v);
  if (!(sum > 0)) return kInfinity;
  double worst = ConeDualError(d, v.cone_dual);
  for (const double c : Combined(d, v)) worst = std::max(worst, std::abs(c));
  return worst / sum;
}

double RayError(const ProblemData& given, const Vector& x) {
  ProblemData d = given;
  const auto recede = [](Vector& sides) {
    for (double& side : sides) side = std::isfinite(side) ? 0 : side;
  };
  for (Vector* sides : {&d.x_lower, &d.x_upper, &d.row_lower, &d.row_upper}) recede(*sides);
  std::fill(d.g.begin(), d.g.end(), 0.0);
  double slope = 0;
  for (std::size_t j = 0; j < x.size(); ++j) slope += d.q[j] * x[j];
  if (!(slope < 0)) return kInfinity;
  double worst = PrimalError(d, x);
  Vector curved(x.size(), 0.0);
  SymmetricMultiplyAdd(d.P.View(), 1, x.data(), curved.data());
  for (const double c : curved) worst = std::max(worst, std::abs(c));
  return worst / -slope;
}

}  // namespace switchyard::testing
