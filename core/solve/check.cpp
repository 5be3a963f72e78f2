#include "core/solve/check.hpp"

#include <algorithm>
#include <cmath>

#include "switchyard/boxes.hpp"
#include "switchyard/cones.hpp"
#include "switchyard/safe_bound.hpp"

namespace switchyard {
namespace {

// Most boxes close in a few passes of propagation; chains of rows take more.
constexpr int kFewPasses = 4;
constexpr int kManyPasses = 20;

/// values = M x (+ g), and for each row the largest |term|.
struct RowValues {
  std::vector<double> value;
  std::vector<double> largest;
};

RowValues Evaluate(const sy_csc* m, const double* g, std::int32_t rows,
                   const std::vector<double>& x) {
  RowValues r;
  r.value.assign(static_cast<std::size_t>(rows), 0.0);
  if (g != nullptr) r.value.assign(g, g + rows);
  r.largest.resize(r.value.size());
  std::transform(r.value.begin(), r.value.end(), r.largest.begin(),
                 [](double v) { return std::abs(v); });
  for (std::int32_t j = 0; m != nullptr && j < m->cols; ++j) {
    for (std::int32_t k = m->start[j]; k < m->start[j + 1]; ++k) {
      const auto i = static_cast<std::size_t>(m->row[k]);
      const double term = m->value[k] * x[static_cast<std::size_t>(j)];
      r.value[i] += term;
      r.largest[i] = std::max(r.largest[i], std::abs(term));
    }
  }
  return r;
}

/// NaN where the value is: no comparison would see it.
double Outside(double value, double lower, double upper) {
  return std::isnan(value) ? value : std::max({0.0, lower - value, value - upper});
}

/// Side of a recession: 0 where the bound is finite.
double Recession(double bound) { return std::isfinite(bound) ? 0 : bound; }

/// The worst violations so far: each relative to its own terms, and absolute. One that overflowed
/// has no ratio, and is infinite.
struct Worst {
  double relative = 0;
  double absolute = 0;
  double largest_term = 0;

  void See(double violation, double own_term) {
    if (!std::isfinite(violation) || !std::isfinite(own_term)) {
      relative = absolute = kInfinity;
      return;
    }
    relative = std::max(relative, violation / (1 + own_term));
    absolute = std::max(absolute, violation);
    largest_term = std::max(largest_term, own_term);
  }
  /// In units in which kSupported is the most: by each one's own terms, or by the largest of all.
  [[nodiscard]] double InUnits() const {
    const double by_norm = absolute / (1 + largest_term) * (kSupported / kSupportedByNorm);
    return std::min(relative, by_norm);
  }
};

void SeeCones(const sy_problem& problem, const RowValues& rows, Worst& worst) {
  std::size_t at = 0;
  for (std::int32_t c = 0; c < problem.num_cones; ++c) {
    const sy_cone& cone = problem.cones[c];
    const auto dim = static_cast<std::size_t>(cone.dim);
    if (cone.kind == SY_CONE_ZERO || cone.kind == SY_CONE_NONNEGATIVE) {  // a row each
      for (std::size_t i = at; i < at + dim; ++i) {
        worst.See(FactsOf(cone.kind).violation(&rows.value[i], 1, 0), rows.largest[i]);
      }
    } else {
      const auto first = rows.largest.begin() + static_cast<std::ptrdiff_t>(at);
      worst.See(FactsOf(cone.kind).violation(&rows.value[at], cone.dim, cone.parameter),
                *std::max_element(first, first + cone.dim));
    }
    at += dim;
  }
}

void SeeFunctions(const sy_problem& problem, const std::vector<double>& x, Worst& worst) {
  if (problem.nlp == nullptr) return;
  const sy_nlp& nlp = *problem.nlp;
  std::vector<double> c(static_cast<std::size_t>(nlp.num_constraints));
  sy_evaluation e{};
  e.size = sizeof e;
  e.want = SY_CONSTRAINTS;
  e.x = x.data();
  e.constraints = c.data();
  if (nlp.evaluate(nlp.context, &e) != SY_EVALUATED) return worst.See(kInfinity, 0);
  for (std::size_t i = 0; i < c.size(); ++i) {
    const double below = nlp.lower[i] - c[i];
    const double above = c[i] - nlp.upper[i];
    worst.See(std::max({0.0, below, above}), std::abs(below > 0   ? nlp.lower[i]
                                                      : above > 0 ? nlp.upper[i]
                                                                  : 0));
  }
}

/// What duals are worth on the problem's own bounds, in plain arithmetic.
struct PlainDual {
  double objective = 0;   // open columns left out: r_j of the wrong sign against an infinite side
  double open_worth = 0;  // their sum |r_j|, times the largest |x_j|
  bool open = false;
};

/// r = Px + q - A'y - F'z. Row duals against infinite sides count as 0, cone duals are moved into
/// their dual cones.
PlainDual EvaluateDuals(const sy_problem& problem, const Vectors& v) {
  const auto n = static_cast<std::size_t>(problem.num_vars);
  PlainDual dual{problem.offset, 0, false};
  std::vector<double> r(n, 0.0);
  if (problem.P != nullptr && !v.x.empty()) {
    SymmetricMultiplyAdd(*problem.P, 1, v.x.data(), r.data());
    for (std::size_t j = 0; j < n; ++j) dual.objective -= 0.5 * r[j] * v.x[j];
  }
  for (std::size_t j = 0; j < n; ++j) r[j] += problem.q[j];
  std::vector<double> y = v.row_dual;
  for (std::size_t i = 0; i < y.size(); ++i) {
    const double side = y[i] > 0 ? problem.row_lower[i] : problem.row_upper[i];
    if (std::isinf(side)) y[i] = 0;
    if (y[i] != 0) dual.objective += y[i] * side;
  }
  if (problem.A != nullptr && !y.empty()) TransposedMultiplyAdd(*problem.A, -1, y.data(), r.data());
  std::vector<double> z = v.cone_dual;
  for (std::size_t c = 0, at = 0; !z.empty() && c < static_cast<std::size_t>(problem.num_cones);
       ++c) {
    const sy_cone& cone = problem.cones[c];
    FactsOf(cone.kind).into_dual(&z[at], cone.dim, cone.parameter);
    at += static_cast<std::size_t>(cone.dim);
  }
  for (std::size_t i = 0; i < z.size(); ++i) dual.objective -= problem.g[i] * z[i];
  if (problem.F != nullptr && !z.empty()) TransposedMultiplyAdd(*problem.F, -1, z.data(), r.data());
  double radius = 1;
  for (std::size_t j = 0; j < n; ++j) {
    if (!v.x.empty()) radius = std::max(radius, std::abs(v.x[j]));
    if (r[j] == 0) continue;
    double side = r[j] > 0 ? -kInfinity : kInfinity;
    if (problem.x_lower != nullptr) side = r[j] > 0 ? problem.x_lower[j] : problem.x_upper[j];
    if (std::isfinite(side)) {
      dual.objective += r[j] * side;
    } else {
      dual.open = true;
      dual.open_worth += std::abs(r[j]);
    }
  }
  dual.open_worth *= radius;
  return dual;
}

}  // namespace

double RelativeViolation(const sy_problem& problem, const std::vector<double>& x) {
  Worst worst;
  double integrality = 0;
  for (std::size_t j = 0; j < x.size(); ++j) {
    if (problem.x_lower != nullptr) {
      worst.See(Outside(x[j], problem.x_lower[j], problem.x_upper[j]), std::abs(x[j]));
    }
    if (problem.integer != nullptr && problem.integer[j] != 0) {
      integrality = std::max(integrality, std::abs(x[j] - std::round(x[j])));
    }
  }
  const RowValues rows = Evaluate(problem.A, nullptr, problem.num_rows, x);
  for (std::size_t i = 0; i < rows.value.size(); ++i) {
    worst.See(Outside(rows.value[i], problem.row_lower[i], problem.row_upper[i]), rows.largest[i]);
  }
  SeeCones(problem, Evaluate(problem.F, problem.g, problem.num_cone_rows, x), worst);
  SeeFunctions(problem, x, worst);
  return std::max(worst.InUnits(), integrality * kSupported / kIntegral);
}

DualCheck EstimateDuals(const sy_problem& problem, const Vectors& v) {
  const PlainDual plain = EvaluateDuals(problem, v);
  return {-kInfinity, plain.objective, plain.open_worth, -1};
}

DualCheck CheckDuals(const sy_problem& problem, const Vectors& v, double cutoff) {
  const auto data = [](const std::vector<double>& values) {
    return values.empty() ? nullptr : values.data();
  };
  const std::vector<double> curvature = Curvature(problem);
  const auto bound_on = [&](const double* lower, const double* upper) {
    return SafeDualBound(problem, data(v.x), data(v.row_dual), data(v.cone_dual), lower, upper,
                         data(curvature));
  };
  SafeBound proven = bound_on(nullptr, nullptr);
  if (std::isfinite(cutoff) && cutoff - proven.value <= 0.1 * kSupported * (1 + std::abs(cutoff))) {
    return {std::min(proven.value, cutoff), proven.value, 0, -1};
  }
  const PlainDual plain = EvaluateDuals(problem, v);
  DualCheck check{-kInfinity, plain.objective, plain.open_worth, -1};
  for (const int passes : {kFewPasses, kManyPasses}) {
    // Closed by a faint curvature, a bound may be a poor one: then boxes are tried too.
    const bool by_curvature = plain.open && passes == kFewPasses;
    if (std::isfinite(proven.value) && !by_curvature) break;
    // A cutoff just above the objective: the boxes then hold an optimal point.
    const Boxes boxes = ProvenBoxes(problem, cutoff + 1e-6 * (1 + std::abs(cutoff)), passes);
    if (boxes.infeasible) break;  // by less than the point's own violation
    const SafeBound boxed = bound_on(boxes.lower.data(), boxes.upper.data());
    if (!(boxed.value <= proven.value) || !std::isfinite(proven.value)) proven = boxed;
  }
  check.bound = std::min(proven.value, cutoff);
  check.open_column = proven.open_column;
  return check;
}

bool ProvesInfeasible(const sy_problem& problem, const Vectors& v) {
  double scale = 0;
  for (const auto* duals : {&v.row_dual, &v.cone_dual}) {
    for (const double y : *duals) scale = std::max(scale, std::abs(y));
  }
  for (const double y : v.x_dual) scale = std::max(scale, std::abs(y));
  if (scale == 0 || !std::isfinite(scale)) return false;
  std::vector<double> rows = v.row_dual;
  std::vector<double> cones = v.cone_dual;
  for (auto* duals : {&rows, &cones}) {
    for (double& y : *duals) y /= scale;
  }
  // Without an objective any positive bound is a contradiction.
  sy_problem no_objective = problem;
  const std::vector<double> zero(static_cast<std::size_t>(problem.num_vars), 0.0);
  no_objective.P = nullptr;
  no_objective.nlp = nullptr;  // rows and cones that contradict each other do so without it
  no_objective.q = zero.data();
  no_objective.offset = 0;
  const Boxes boxes = ProvenBoxes(no_objective);
  if (boxes.infeasible) return true;
  const SafeBound safe =
      SafeDualBound(no_objective, nullptr, rows.empty() ? nullptr : rows.data(),
                    cones.empty() ? nullptr : cones.data(), boxes.lower.data(), boxes.upper.data());
  if (safe.value > 0) return true;
  // Short of a proof: a contradiction for every x up to about 1e9 in size.
  return safe.estimate > 1e-7 && safe.open_residual <= 1e-9 * std::min(1.0, safe.estimate);
}

bool IsUnboundedRay(const sy_problem& problem, const Vectors& v) {
  if (problem.nlp != nullptr) return false;  // what functions do far out is not known
  double scale = 0;
  for (const double x : v.x) scale = std::max(scale, std::abs(x));
  if (scale == 0 || !std::isfinite(scale)) return false;
  std::vector<double> ray = v.x;
  for (double& x : ray) x /= scale;
  // A gain has to stand out from what the violations below, up to 1e-9, could feign.
  double slope = 0;
  double largest_gain = 0;
  for (std::size_t j = 0; j < ray.size(); ++j) {
    slope += problem.q[j] * ray[j];
    largest_gain = std::max(largest_gain, std::abs(problem.q[j] * ray[j]));
  }
  if (!(-slope > 1e-8 * largest_gain)) return false;
  Worst worst;
  for (std::size_t j = 0; problem.x_lower != nullptr && j < ray.size(); ++j) {
    worst.See(Outside(ray[j], Recession(problem.x_lower[j]), Recession(problem.x_upper[j])), 0);
  }
  const RowValues rows = Evaluate(problem.A, nullptr, problem.num_rows, ray);
  for (std::size_t i = 0; i < rows.value.size(); ++i) {
    worst.See(
        Outside(rows.value[i], Recession(problem.row_lower[i]), Recession(problem.row_upper[i])),
        rows.largest[i]);
  }
  SeeCones(problem, Evaluate(problem.F, nullptr, problem.num_cone_rows, ray), worst);
  if (problem.P != nullptr) {
    std::vector<double> curved(ray.size(), 0.0);
    SymmetricMultiplyAdd(*problem.P, 1, ray.data(), curved.data());
    for (const double c : curved) worst.See(std::abs(c), 0);
  }
  // The ray's largest entry is 1, its slope what it gains.
  return worst.relative <= kSupported * std::min(1.0, -slope) || worst.relative <= 1e-9;
}

}  // namespace switchyard
