// programs.hpp - programs whose answers are known, and the checks of abi.h's formulas.
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "bare_solver.hpp"

namespace switchyard::test {

/// The matrix of the given rows.
inline Csc Dense(const std::vector<std::vector<double>>& rows, std::int32_t cols) {
  Csc a(static_cast<std::int32_t>(rows.size()), cols);
  for (std::int32_t j = 0; j < cols; ++j) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const double value = rows[i][static_cast<std::size_t>(j)];
      if (value == 0) continue;
      a.row.push_back(static_cast<std::int32_t>(i));
      a.value.push_back(value);
    }
    a.start[static_cast<std::size_t>(j) + 1] = static_cast<std::int32_t>(a.row.size());
  }
  return a;
}

/// min q'x + offset, l <= x <= u, rl <= Ax <= ru
inline ProblemData Linear(std::vector<double> q, std::vector<double> l, std::vector<double> u,
                          const std::vector<std::vector<double>>& rows, std::vector<double> rl,
                          std::vector<double> ru, double offset = 0) {
  ProblemData d;
  d.num_vars = static_cast<std::int32_t>(q.size());
  d.P = Csc(d.num_vars, d.num_vars);
  d.F = Csc(0, d.num_vars);
  d.A = Dense(rows, d.num_vars);
  d.q = std::move(q);
  d.offset = offset;
  d.x_lower = std::move(l);
  d.x_upper = std::move(u);
  d.row_lower = std::move(rl);
  d.row_upper = std::move(ru);
  return d;
}

/// min -x - 2y + 10, x + y <= 4, 1 <= x + 3y <= 6, 0 <= x <= 3, y >= 0: 5 at (3, 1).
inline ProblemData Corner() {
  return Linear({-1, -2}, {0, 0}, {3, kInfinity}, {{1, 1}, {1, 3}}, {-kInfinity, 1}, {4, 6}, 10);
}

/// A random program, feasible and bounded by construction: costs from row duals and reduced costs
/// that fit a random point.
inline ProblemData Random(std::int32_t vars, std::int32_t rows, unsigned seed,
                          double density = 0.3) {
  std::mt19937 draw(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  ProblemData d;
  d.num_vars = vars;
  d.P = Csc(vars, vars);
  d.F = Csc(0, vars);
  d.A = Csc(rows, vars);
  std::vector<double> activity(static_cast<std::size_t>(rows), 0.0);
  std::vector<double> price(static_cast<std::size_t>(rows));
  for (double& y : price) y = unit(draw);
  for (std::int32_t j = 0; j < vars; ++j) {
    const double x = unit(draw) < 0.5 ? 0 : 5 * unit(draw);
    double cost = x == 0 ? unit(draw) : 0;
    for (std::int32_t i = 0; i < rows; ++i) {
      if (unit(draw) > density) continue;
      const double value = 2 * unit(draw) - 0.5;
      d.A.row.push_back(i);
      d.A.value.push_back(value);
      activity[static_cast<std::size_t>(i)] += value * x;
      cost += value * price[static_cast<std::size_t>(i)];
    }
    d.A.start[static_cast<std::size_t>(j) + 1] = static_cast<std::int32_t>(d.A.row.size());
    d.q.push_back(cost);
  }
  d.x_lower.assign(static_cast<std::size_t>(vars), 0);
  d.x_upper.assign(static_cast<std::size_t>(vars), kInfinity);
  d.row_lower = activity;
  d.row_upper.assign(static_cast<std::size_t>(rows), kInfinity);
  return d;
}

inline double Side(double d, double lower, double upper, double tolerance) {
  const double bound = d > 0 ? lower : upper;
  if (std::isinf(bound)) return std::abs(d) <= tolerance ? 0 : -kInfinity;
  return d * bound;
}

/// sum side(x_dual) + sum side(row_dual); -infinity where a dual stands against an infinite side.
inline double Sides(const ProblemData& d, const Answer& a, double tolerance) {
  double sum = 0;
  for (std::size_t j = 0; j < a.x.size(); ++j) {
    sum += Side(a.x_dual[j], d.x_lower[j], d.x_upper[j], tolerance);
  }
  for (std::size_t i = 0; i < a.row_dual.size(); ++i) {
    sum += Side(a.row_dual[i], d.row_lower[i], d.row_upper[i], tolerance);
  }
  return sum;
}

inline double Violation(const ProblemData& d, const std::vector<double>& x) {
  std::vector<double> rows(d.row_lower.size(), 0.0);
  MultiplyAdd(d.A.View(), 1, x.data(), rows.data());
  double worst = 0;
  for (std::size_t j = 0; j < x.size(); ++j) {
    worst = std::max({worst, d.x_lower[j] - x[j], x[j] - d.x_upper[j]});
    if (!d.integer.empty() && d.integer[j] != 0) {
      worst = std::max(worst, std::abs(x[j] - std::round(x[j])));
    }
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    worst = std::max({worst, d.row_lower[i] - rows[i], rows[i] - d.row_upper[i]});
  }
  return worst;
}

/// |Px + q - x_dual - A'row_dual|, or without Px + q for a certificate.
inline double Stationarity(const ProblemData& d, const Answer& a, bool certificate) {
  std::vector<double> rest(a.x.size(), 0.0);
  if (!certificate) {
    rest = d.q;
    SymmetricMultiplyAdd(d.P.View(), 1, a.x.data(), rest.data());
  }
  TransposedMultiplyAdd(d.A.View(), -1, a.row_dual.data(), rest.data());
  double worst = 0;
  for (std::size_t j = 0; j < rest.size(); ++j) {
    worst = std::max(worst, std::abs(rest[j] - a.x_dual[j]));
  }
  return worst;
}

/// Optimal, feasible, and where there are duals as good as they say.
inline void ExpectOptimal(const ProblemData& d, const BareSolver& solver, const Answer& a,
                          double tolerance) {
  ASSERT_EQ(a.result.termination, SY_OPTIMAL) << a.text;
  ASSERT_EQ(a.result.primal, SY_FEASIBLE);
  const Problem problem(d);
  const double scale = 1 + std::abs(a.result.objective);
  EXPECT_LE(Violation(d, a.x), tolerance * scale);
  EXPECT_NEAR(a.result.objective, Objective(problem.view(), a.x.data()), tolerance * scale);
  EXPECT_NEAR(a.result.bound, a.result.objective, 10 * tolerance * scale);
  EXPECT_GE(a.result.seconds, 0);
  if (!solver.Has(SY_GIVES_DUALS) || d.has_integers()) return;
  ASSERT_EQ(a.result.dual, SY_FEASIBLE);
  EXPECT_LE(Stationarity(d, a, false), tolerance * scale);
  const double dual =
      d.offset - 0.5 * QuadraticForm(d.P.View(), a.x.data()) + Sides(d, a, tolerance * scale);
  EXPECT_NEAR(dual, a.result.objective, 10 * tolerance * scale);
}

inline void ExpectFarkas(const ProblemData& d, const Answer& a) {
  ASSERT_EQ(a.result.termination, SY_INFEASIBLE) << a.text;
  ASSERT_EQ(a.result.dual, SY_CERTIFICATE);
  EXPECT_LE(Stationarity(d, a, true), 1e-7);
  EXPECT_GT(Sides(d, a, 1e-8), 1e-7);
}

inline void ExpectRay(const ProblemData& d, const Answer& a) {
  ASSERT_EQ(a.result.termination, SY_UNBOUNDED) << a.text;
  ASSERT_EQ(a.result.primal, SY_CERTIFICATE);
  ProblemData directions = d;
  const auto recede = [](std::vector<double>& lower, std::vector<double>& upper) {
    for (double& l : lower) l = std::isinf(l) ? l : 0;
    for (double& u : upper) u = std::isinf(u) ? u : 0;
  };
  recede(directions.x_lower, directions.x_upper);
  recede(directions.row_lower, directions.row_upper);
  EXPECT_LE(Violation(directions, a.x), 1e-7);
  double slope = 0;
  for (std::size_t j = 0; j < a.x.size(); ++j) slope += d.q[j] * a.x[j];
  EXPECT_LT(slope, -1e-7);
  EXPECT_LE(std::abs(QuadraticForm(d.P.View(), a.x.data())), 1e-7);
}

inline constexpr std::uint64_t kLinear = SY_ACCEPTS_BOUNDS | SY_ACCEPTS_ROWS;

}  // namespace switchyard::test
