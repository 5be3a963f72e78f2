// linear/duals.hpp - duals and certificates of a linear or quadratic program in the signs of
// switchyard/abi.h, made from what a solver returns. The problem has all its bounds and q.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "switchyard/abi.h"
#include "switchyard/problem.hpp"

namespace switchyard::linear {

/// Entries of a ray, of largest entry 1, that are rounding errors where they meet an infinite side.
inline constexpr double kRayNoise = 1e-9;

struct Duals {
  std::vector<double> x;
  std::vector<double> row;
};

/// d l for d > 0, d u for d < 0, 0 for d = 0.
inline double Side(double d, double lower, double upper) {
  return d > 0 ? d * lower : d < 0 ? d * upper : 0;
}

/// sum side(x_dual) + sum side(row_dual)
inline double Sides(const sy_problem& p, const Duals& duals) {
  double sum = 0;
  for (std::int32_t j = 0; j < p.num_vars; ++j) {
    sum += Side(duals.x[static_cast<std::size_t>(j)], p.x_lower[j], p.x_upper[j]);
  }
  for (std::int32_t i = 0; i < p.num_rows; ++i) {
    sum += Side(duals.row[static_cast<std::size_t>(i)], p.row_lower[i], p.row_upper[i]);
  }
  return sum;
}

/// The duals whose x part is what stationarity leaves at x: Px + q - A'row_dual.
inline Duals Complete(const sy_problem& p, const double* x, std::vector<double> row_dual) {
  std::vector<double> rest(p.q, p.q + p.num_vars);
  if (p.P != nullptr) SymmetricMultiplyAdd(*p.P, 1, x, rest.data());
  if (p.A != nullptr) TransposedMultiplyAdd(*p.A, -1, row_dual.data(), rest.data());
  return {std::move(rest), std::move(row_dual)};
}

/// The dual objective, a bound where the problem is convex. Duals of a solver carry rounding
/// errors: one below `noise` against an infinite side counts as 0, a larger one leaves no bound.
inline double DualObjective(const sy_problem& p, const double* x, Duals duals, double noise) {
  const auto quiet = [&](std::vector<double>& d, const double* lower, const double* upper) {
    for (std::size_t k = 0; k < d.size(); ++k) {
      if (std::abs(d[k]) <= noise && std::isinf(Side(d[k], lower[k], upper[k]))) d[k] = 0;
    }
  };
  quiet(duals.x, p.x_lower, p.x_upper);
  quiet(duals.row, p.row_lower, p.row_upper);
  const double half = p.P != nullptr ? 0.5 * QuadraticForm(*p.P, x) : 0;
  const double value = p.offset - half + Sides(p, duals);
  return std::isnan(value) ? -kInfinity : value;
}

/// The Farkas certificate along `ray` or against it: -A'ray stands against the bounds of x, and the
/// sides sum to something positive. Nothing where neither direction certifies.
inline std::optional<Duals> Farkas(const sy_problem& p, const std::vector<double>& ray) {
  double size = 0;
  for (const double r : ray) size = std::max(size, std::abs(r));
  if (size == 0 && p.num_rows > 0) return std::nullopt;
  const auto drop_noise = [](std::vector<double>& d, const double* lower, const double* upper) {
    for (std::size_t k = 0; k < d.size(); ++k) {
      if (std::abs(d[k]) <= kRayNoise && std::isinf(Side(d[k], lower[k], upper[k]))) d[k] = 0;
    }
  };
  for (const double sign : {1.0, -1.0}) {
    Duals duals = {std::vector<double>(static_cast<std::size_t>(p.num_vars)), ray};
    for (double& r : duals.row) r *= sign / size;
    drop_noise(duals.row, p.row_lower, p.row_upper);
    if (p.A != nullptr) TransposedMultiplyAdd(*p.A, -1, duals.row.data(), duals.x.data());
    drop_noise(duals.x, p.x_lower, p.x_upper);
    const double value = Sides(p, duals);
    if (std::isfinite(value) && value > 0) return duals;
  }
  return std::nullopt;
}

/// Does d recede into a box: no entry towards a side that is finite?
inline bool Recedes(const std::vector<double>& d, const double* lower, const double* upper) {
  constexpr double kSlack = 1e-8;
  for (std::size_t k = 0; k < d.size(); ++k) {
    if (d[k] < -kSlack && !std::isinf(lower[k])) return false;
    if (d[k] > kSlack && !std::isinf(upper[k])) return false;
  }
  return true;
}

/// The direction along `ray` or against it, of largest entry 1, in which the objective falls and
/// the problem recedes; nothing where neither does.
inline std::optional<std::vector<double>> FallingRay(const sy_problem& p, std::vector<double> ray) {
  double size = 0;
  double slope = 0;
  for (std::size_t j = 0; j < ray.size(); ++j) {
    size = std::max(size, std::abs(ray[j]));
    slope += p.q[j] * ray[j];
  }
  if (size == 0 || slope == 0) return std::nullopt;
  for (double& r : ray) r *= slope < 0 ? 1 / size : -1 / size;
  std::vector<double> rows(static_cast<std::size_t>(p.num_rows), 0.0);
  if (p.A != nullptr) MultiplyAdd(*p.A, 1, ray.data(), rows.data());
  const bool recedes =
      Recedes(ray, p.x_lower, p.x_upper) && Recedes(rows, p.row_lower, p.row_upper);
  return recedes ? std::optional(std::move(ray)) : std::nullopt;
}

}  // namespace switchyard::linear
