// switchyard/smallest_eigenvalue.hpp - the smallest eigenvalue of a symmetric matrix: all that
// membership in a semidefinite cone asks, without a library for the rest.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace switchyard {

struct SmallestEigenvalue {
  double value = 0;
  double rounding = 0;  // how far from the true one it may be
};

namespace eigenvalue_detail {

/// Symmetric and tridiagonal.
struct Tridiagonal {
  std::vector<double> diagonal, beside;
};

/// A similar one, by reflections (Householder, J. ACM 5, 1958). `a`: n x n, the lower triangle
/// counts; it is used up.
inline Tridiagonal Reduced(std::vector<double>& a, std::size_t n) {
  Tridiagonal t{std::vector<double>(n), std::vector<double>(n - 1)};
  std::vector<double> v(n), p(n);
  for (std::size_t k = 0; k < n; ++k) {
    t.diagonal[k] = a[k * n + k];
    if (k + 1 == n) break;
    double below = 0;  // what is to vanish
    for (std::size_t i = k + 2; i < n; ++i) below += a[i * n + k] * a[i * n + k];
    const double head = a[(k + 1) * n + k];
    t.beside[k] = head;
    if (below == 0) continue;
    t.beside[k] = -std::copysign(std::sqrt(head * head + below), head);
    for (std::size_t i = k + 1; i < n; ++i) v[i] = a[i * n + k];
    v[k + 1] -= t.beside[k];
    const double scale = 2 / (v[k + 1] * v[k + 1] + below);
    // A - v w' - w v' with w = p - (scale / 2) (p'v) v, p = scale A v.
    std::fill(p.begin(), p.end(), 0.0);
    for (std::size_t i = k + 1; i < n; ++i) {
      const double* row = &a[i * n];
      for (std::size_t j = k + 1; j < i; ++j) {
        p[i] += row[j] * v[j];
        p[j] += row[j] * v[i];
      }
      p[i] += row[i] * v[i];
    }
    double along = 0;
    for (std::size_t i = k + 1; i < n; ++i) along += (p[i] *= scale) * v[i];
    for (std::size_t i = k + 1; i < n; ++i) p[i] -= scale / 2 * along * v[i];
    for (std::size_t i = k + 1; i < n; ++i) {
      double* row = &a[i * n];
      for (std::size_t j = k + 1; j <= i; ++j) row[j] -= v[i] * p[j] + p[i] * v[j];
    }
  }
  return t;
}

/// Is an eigenvalue at or below x? By the signs of the pivots of T - x (Sturm).
inline bool AnyUpTo(const Tridiagonal& t, double x) {
  double pivot = t.diagonal[0] - x;
  for (std::size_t k = 1; pivot > 0 && k < t.diagonal.size(); ++k) {
    pivot = t.diagonal[k] - x - t.beside[k - 1] / pivot * t.beside[k - 1];
  }
  return !(pivot > 0);
}

}  // namespace eigenvalue_detail

/// Of the n x n matrix whose lower triangle `a` holds, by rows; NaN where it is not finite.
inline SmallestEigenvalue SmallestEigenvalueOf(std::vector<double> a, std::size_t n) {
  using namespace eigenvalue_detail;
  if (n == 0) return {};
  double unit = 0, sum = 0;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      unit = std::max(unit, std::abs(a[i * n + j]));
      sum += a[i * n + j];
    }
  }
  if (!std::isfinite(unit) || std::isnan(sum)) return {std::numeric_limits<double>::quiet_NaN(), 0};
  if (unit == 0) return {};
  for (double& e : a) e /= unit;
  double square = 0;  // of the Frobenius norm
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j <= i; ++j) square += (i == j ? 1 : 2) * a[i * n + j] * a[i * n + j];
  }
  const Tridiagonal t = Reduced(a, n);
  // By halves, from an interval that has it: the norm is the largest that it may be without its
  // sign. `high` is never below it.
  constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
  double high = *std::min_element(t.diagonal.begin(), t.diagonal.end());
  double low = -std::sqrt(square) * (1 + static_cast<double>(n) * kEpsilon);
  while (high - low > kEpsilon / 2 * std::sqrt(square)) {
    const double middle = low + (high - low) / 2;
    if (!(low < middle && middle < high)) break;
    (AnyUpTo(t, middle) ? high : low) = middle;
  }
  const double rounding = 4 * kEpsilon * static_cast<double>(n - 1) * std::sqrt(square);
  return {unit * high, unit * rounding};
}

}  // namespace switchyard
