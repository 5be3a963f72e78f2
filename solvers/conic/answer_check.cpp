#include "solvers/conic/answer_check.hpp"

#include <algorithm>
#include <cmath>

#include "switchyard/cones.hpp"
#include "switchyard/safe_bound.hpp"

namespace switchyard::conic {
namespace {

using presolve::Answer;
using Values = std::vector<double>;

double Outside(double v, double lower, double upper) {
  return std::max({0.0, lower - v, v - upper});
}
double LowerOf(const ProblemData& p, std::size_t j) {
  return p.x_lower.empty() ? -kInfinity : p.x_lower[j];
}
double UpperOf(const ProblemData& p, std::size_t j) {
  return p.x_upper.empty() ? kInfinity : p.x_upper[j];
}
bool IsOn(const ProblemData& p, std::size_t cone) {
  return p.cone_on.empty() || p.cone_on[cone] != 0;
}

/// Sums, and the largest term of each.
struct Sums {
  Values value, largest;
  explicit Sums(std::size_t count) : value(count, 0.0), largest(count, 0.0) {}
  void Add(std::size_t i, double term) {
    value[i] += term;
    largest[i] = std::max(largest[i], std::abs(term));
  }
  /// M v.
  void Add(const Csc& m, const Values& v) {
    for (std::size_t j = 0; j < static_cast<std::size_t>(m.cols); ++j) {
      for (auto k = m.start[j]; k < m.start[j + 1]; ++k) Add(m.row[k], m.value[k] * v[j]);
    }
  }
  /// -M'v.
  void Subtract(const Csc& m, const Values& v) {
    for (std::size_t j = 0; j < static_cast<std::size_t>(m.cols); ++j) {
      for (auto k = m.start[j]; k < m.start[j + 1]; ++k) Add(j, -m.value[k] * v[m.row[k]]);
    }
  }
  [[nodiscard]] double Largest() const {
    return largest.empty() ? 0 : *std::max_element(largest.begin(), largest.end());
  }
};

/// Calls back with each cone that is on, its number and its first row.
template <class Take>
void EachCone(const ProblemData& p, Take&& take) {
  std::size_t row = 0;
  for (std::size_t c = 0; c < p.cones.size(); ++c) {
    if (IsOn(p, c)) take(p.cones[c], row);
    row += static_cast<std::size_t>(p.cones[c].dim);
  }
}

double PrimalError(const ProblemData& p, const Answer& a) {
  Sums rows(p.row_lower.size()), cones(p.g.size());
  rows.Add(p.A, a.x);
  cones.Add(p.F, a.x);
  for (std::size_t i = 0; i < p.g.size(); ++i) cones.Add(i, p.g[i]);
  double violation = 0, size = std::max(rows.Largest(), cones.Largest());
  for (std::size_t i = 0; i < p.row_lower.size(); ++i) {
    violation = std::max(violation, Outside(rows.value[i], p.row_lower[i], p.row_upper[i]));
  }
  for (std::size_t j = 0; j < a.x.size(); ++j) {
    violation = std::max(violation, Outside(a.x[j], LowerOf(p, j), UpperOf(p, j)));
    size = std::max(size, std::abs(a.x[j]));
  }
  EachCone(p, [&](const sy_cone& cone, std::size_t row) {
    violation = std::max(violation,
                         FactsOf(cone.kind).violation(&cones.value[row], cone.dim, cone.parameter));
  });
  return violation / (1 + size);
}

/// side(d) of abi.h; a dual against an infinite side is an error of its size.
double Side(double d, double lower, double upper, double& wrong) {
  if (d == 0) return 0;
  const double side = d > 0 ? lower : upper;
  if (std::isfinite(side)) return d * side;
  wrong = std::max(wrong, std::abs(d));
  return 0;
}

/// Px + q - A'y - F'z.
Sums Stationarity(const ProblemData& p, const Answer& a, const Values& curved) {
  Sums left(p.q.size());
  for (std::size_t j = 0; j < p.q.size() && a.meaning != presolve::Meaning::kContradiction; ++j) {
    left.Add(j, curved[j]);
    left.Add(j, p.q[j]);
  }
  left.Subtract(p.A, a.row_dual);
  left.Subtract(p.F, a.cone_dual);
  return left;
}

Values Curved(const ProblemData& p, const Values& x) {
  Values curved(x.size(), 0.0);
  SymmetricMultiplyAdd(p.P.View(), 1, x.data(), curved.data());
  return curved;
}

bool AreFinite(const Values& v) {
  return std::all_of(v.begin(), v.end(), [](double e) { return std::isfinite(e); });
}

}  // namespace

double AnswerErrors::Worst() const { return std::max({primal, dual, gap}); }

AnswerErrors ErrorsOf(const ProblemData& p, const Answer& a) {
  AnswerErrors errors;
  errors.primal = PrimalError(p, a);
  const Values curved = Curved(p, a.x);
  Sums left = Stationarity(p, a, curved);
  errors.objective = errors.dual_objective = p.offset;
  double worst = 0;
  for (std::size_t j = 0; j < a.x.size(); ++j) {
    left.Add(j, -a.x_dual[j]);
    errors.objective += (0.5 * curved[j] + p.q[j]) * a.x[j];
    errors.dual_objective -= 0.5 * curved[j] * a.x[j];
    errors.dual_objective += Side(a.x_dual[j], LowerOf(p, j), UpperOf(p, j), worst);
  }
  for (std::size_t i = 0; i < p.row_lower.size(); ++i) {
    errors.dual_objective += Side(a.row_dual[i], p.row_lower[i], p.row_upper[i], worst);
  }
  for (std::size_t i = 0; i < p.g.size(); ++i) errors.dual_objective -= p.g[i] * a.cone_dual[i];
  EachCone(p, [&](const sy_cone& cone, std::size_t row) {
    worst = std::max(worst, DualViolation(cone, &a.cone_dual[row]));
  });
  for (const double v : left.value) worst = std::max(worst, std::abs(v));
  errors.dual = worst / (1 + left.Largest());
  const bool finite = AreFinite(a.x) && AreFinite(a.x_dual) && AreFinite(a.row_dual) &&
                      AreFinite(a.cone_dual) && std::isfinite(errors.primal + errors.dual);
  if (!finite) errors.primal = errors.dual = errors.gap = kInfinity;
  if (!finite) return errors;
  errors.gap = std::abs(errors.objective - errors.dual_objective) /
               (1 + std::min(std::abs(errors.objective), std::abs(errors.dual_objective)));
  return errors;
}

void CloseStationarity(const ProblemData& p, Answer& a) {
  a.x_dual = Stationarity(p, a, Curved(p, a.x)).value;
}

bool IsContradiction(const ProblemData& p, const Answer& a) {
  double scale = 0;
  for (const Values* duals : {&a.x_dual, &a.row_dual, &a.cone_dual}) {
    for (const double d : *duals) scale = std::max(scale, std::abs(d));
  }
  if (!(scale > 0) || !std::isfinite(scale)) return false;
  Values rows = a.row_dual, cones = a.cone_dual;
  for (double& d : rows) d /= scale;
  for (double& d : cones) d /= scale;
  // Without an objective a positive bound is a contradiction.
  ProblemData costless = p;
  costless.P = Csc(p.num_vars, p.num_vars);
  costless.q.assign(p.q.size(), 0.0);
  costless.offset = 0;
  const Problem problem(std::move(costless));
  const SafeBound safe =
      SafeDualBound(problem.view(), nullptr, rows.empty() ? nullptr : rows.data(),
                    cones.empty() ? nullptr : cones.data(), nullptr, nullptr);
  if (safe.value > 0) return true;
  return safe.estimate > 1e-7 && safe.open_residual <= 1e-9 * std::min(1.0, safe.estimate);
}

bool IsRay(const ProblemData& p, const Answer& a) {
  double scale = 0;
  for (const double v : a.x) scale = std::max(scale, std::abs(v));
  if (!(scale > 0) || !std::isfinite(scale)) return false;
  Values ray = a.x;
  for (double& v : ray) v /= scale;
  double slope = 0, gain = 0, worst = 0;
  for (std::size_t j = 0; j < ray.size(); ++j) {
    slope += p.q[j] * ray[j];
    gain = std::max(gain, std::abs(p.q[j] * ray[j]));
  }
  if (!(-slope > 1e-8 * gain)) return false;
  const auto side = [](double bound) { return std::isfinite(bound) ? 0 : bound; };
  for (std::size_t j = 0; j < ray.size(); ++j) {
    worst = std::max(worst, Outside(ray[j], side(LowerOf(p, j)), side(UpperOf(p, j))));
  }
  Sums rows(p.row_lower.size()), cones(p.g.size());
  rows.Add(p.A, ray);
  cones.Add(p.F, ray);
  for (std::size_t i = 0; i < p.row_lower.size(); ++i) {
    const double out = Outside(rows.value[i], side(p.row_lower[i]), side(p.row_upper[i]));
    worst = std::max(worst, out / (1 + rows.largest[i]));
  }
  EachCone(p, [&](const sy_cone& cone, std::size_t row) {
    double size = 0;
    for (std::int32_t i = 0; i < cone.dim; ++i) size = std::max(size, cones.largest[row + i]);
    const double out = FactsOf(cone.kind).violation(&cones.value[row], cone.dim, cone.parameter);
    worst = std::max(worst, out / (1 + size));
  });
  for (const double c : Curved(p, ray)) worst = std::max(worst, std::abs(c));
  return worst <= 1e-6 * std::min(1.0, -slope) || worst <= 1e-9;
}

}  // namespace switchyard::conic
