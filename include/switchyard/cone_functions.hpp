// switchyard/cone_functions.hpp - what the rows of the table in cones.hpp name: for each kind of
// cone its dimensions, the distance of a point, and the move of a dual into the dual cone.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "switchyard/smallest_eigenvalue.hpp"

namespace switchyard::cones_detail {

/// v where it is positive or NaN, else 0.
inline double Positive(double v) { return v <= 0 ? 0.0 : v; }

/// A double above v by more than one rounding of it.
inline double Above(long double v) {
  return std::nextafter(std::nextafter(static_cast<double>(v), HUGE_VAL), HUGE_VAL);
}

/// `Violation` of a point that has no NaN, which no cone holds and no comparison finds.
template <double (*Violation)(const double*, int, double)>
double OrNaN(const double* s, int dim, double parameter) {
  const bool nan = std::any_of(s, s + dim, [](double v) { return std::isnan(v); });
  return nan ? std::numeric_limits<double>::quiet_NaN() : Violation(s, dim, parameter);
}

inline double LargestEntry(const double* s, int dim) {
  double largest = 0;
  for (int i = 0; i < dim; ++i) largest = std::max(largest, std::abs(s[i]));
  return largest;
}

/// |w|, with neither overflow nor underflow on the way.
inline double Norm(const double* w, int dim) {
  double sum = 0;
  for (int i = 0; i < dim; ++i) sum += w[i] * w[i];
  if (sum > 1e-280 && sum < 1e280) return std::sqrt(sum);
  const double unit = LargestEntry(w, dim);
  if (unit == 0 || std::isinf(unit)) return unit;
  sum = 0;
  for (int i = 0; i < dim; ++i) sum += (w[i] / unit) * (w[i] / unit);
  return unit * std::sqrt(sum);
}

/// |w|^2 where the exponent of a long double holds it and its longer mantissa judges boundaries.
inline long double LongSquare(const double* w, int dim) {
  long double sum = 0;
  for (int i = 0; i < dim; ++i) sum += static_cast<long double>(w[i]) * w[i];
  return sum;
}

// ---- zero and nonnegative ------------------------------------------------------------------

/// The need of a kind whose dimension is `least` (0 to 2) or more.
template <int least>
const char* AtLeast(int dim, double) {
  constexpr std::array kTexts = {"a dimension of 0 or more", "a dimension of 1 or more",
                                 "a dimension of 2 or more"};
  return dim >= least ? nullptr : kTexts[least];
}

inline double ZeroViolation(const double* s, int dim, double) { return LargestEntry(s, dim); }
inline void AnyDual(double*, int, double) {}

inline double NonnegativeViolation(const double* s, int dim, double) {
  return dim > 0 ? Positive(-*std::min_element(s, s + dim)) : 0.0;
}

inline void NonnegativeIntoDual(double* y, int dim, double) {
  for (int i = 0; i < dim; ++i) y[i] = std::max(0.0, y[i]);
}

// ---- second-order: s_0 >= |w|, w = s_1.. ------------------------------------------------------

inline double SecondOrderViolation(const double* s, int dim, double) {
  return Positive(Norm(s + 1, dim - 1) - s[0]);
}

inline void SecondOrderIntoDual(double* y, int dim, double) {
  const long double norm = std::sqrt(LongSquare(y + 1, dim - 1));
  if (!(y[0] >= norm)) y[0] = norm > 0 ? Above(norm) : 0.0;
}

// ---- rotated: 2 s_0 s_1 >= |w|^2, w = s_2.. ---------------------------------------------------

/// In the orthogonal coordinates u_0 = (s_0 + s_1)/sqrt 2, u_1 = (s_0 - s_1)/sqrt 2 the cone is
/// u_0 >= |(u_1, w)|, and u_0^2 - u_1^2 = 2 s_0 s_1. So for u_0 > 0 the violation is
/// (|w|^2 - 2 s_0 s_1) / (|(u_1, w)| + u_0), which does not cancel where s_0 and s_1 differ much.
inline double RotatedViolation(const double* s, int dim, double) {
  const double unit = LargestEntry(s, dim);
  if (unit == 0) return 0;
  const double s0 = s[0] / unit, s1 = s[1] / unit, w = Norm(s + 2, dim - 2) / unit;
  const double root = std::sqrt(0.5);
  const double u0 = root * (s0 + s1), norm = std::hypot(root * (s0 - s1), w);
  if (u0 <= 0) return unit * (norm - u0);
  return unit * Positive((w * w - 2 * s0 * s1) / (norm + u0));
}

inline void RotatedIntoDual(double* y, int dim, double) {
  y[0] = std::max(0.0, y[0]);
  y[1] = std::max(0.0, y[1]);
  const long double needed = LongSquare(y + 2, dim - 2) / (2 * static_cast<long double>(y[1]));
  if (y[1] > 0 && needed < std::numeric_limits<double>::max()) {
    if (!(y[0] >= needed)) y[0] = Above(needed);
  } else {
    std::fill(y + 2, y + dim, 0.0);
  }
}

// ---- positive semidefinite --------------------------------------------------------------------

/// The k with k(k+1)/2 = dim; -1 where there is none.
inline int OrderOf(int dim) {
  if (dim < 0) return -1;
  const auto k = static_cast<long>((std::sqrt(8.0 * dim + 1.0) - 1.0) / 2.0 + 0.5);
  return k * (k + 1) / 2 == dim ? static_cast<int>(k) : -1;
}

inline const char* SemidefiniteNeed(int dim, double) {
  return OrderOf(dim) >= 0 ? nullptr : "a dimension of k(k+1)/2";
}

/// Of smat(s).
inline SmallestEigenvalue SmallestOf(const double* s, int dim) {
  const int order = OrderOf(dim);
  if (order <= 0) return {};
  const auto n = static_cast<std::size_t>(order);
  std::vector<double> matrix(n * n);
  const double root = std::sqrt(0.5);
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t i = 0; i < j; ++i) matrix[j * n + i] = root * *s++;
    matrix[j * n + j] = *s++;
  }
  return SmallestEigenvalueOf(std::move(matrix), n);
}

inline double SemidefiniteViolation(const double* s, int dim, double) {
  return Positive(-SmallestOf(s, dim).value);
}

/// Of each row of smat(s), a number that rows share which nonzero entries connect: its blocks.
inline std::vector<int> BlocksOf(const double* s, int dim) {
  std::vector<int> block(static_cast<std::size_t>(std::max(0, OrderOf(dim))));
  std::iota(block.begin(), block.end(), 0);
  for (std::size_t j = 0; j < block.size(); ++j, ++s) {
    for (std::size_t i = 0; i < j; ++i) {
      const int from = block[j], to = block[i];
      if (*s++ != 0 && from != to) std::replace(block.begin(), block.end(), from, to);
    }
  }
  return block;
}

/// The diagonal of each block is raised by what it lacks: a row of zeros lacks nothing.
inline void SemidefiniteIntoDual(double* y, int dim, double) {
  const std::vector<int> block = BlocksOf(y, dim);
  std::vector<double> part;
  const auto order = static_cast<int>(block.size());
  const auto in = [&](int j, int b) { return block[static_cast<std::size_t>(j)] == b; };
  for (int b = 0; b < order; ++b) {
    part.clear();
    for (int j = 0; j < order; ++j) {
      for (int i = 0; i <= j && in(j, b); ++i) {
        if (in(i, b)) part.push_back(y[j * (j + 1) / 2 + i]);
      }
    }
    if (part.empty()) continue;
    const SmallestEigenvalue smallest = SmallestOf(part.data(), static_cast<int>(part.size()));
    const double shift = Positive(smallest.rounding - smallest.value);
    for (int j = 0; j < order; ++j) {
      if (in(j, b)) y[j * (j + 1) / 2 + j] += shift;
    }
  }
}

// ---- exponential: the closure of s_1 exp(s_0/s_1) <= s_2, s_1 > 0 -----------------------------

inline const char* ExponentialNeed(int dim, double) {
  return dim == 3 ? nullptr : "a dimension of 3";
}

/// The shortest of three moves: s_2 up, s_0 down, or to the face s_1 = 0, s_0 <= 0, s_2 >= 0.
inline double ExponentialViolation(const double* s, int, double) {
  double shortest = std::max({0.0, s[0], std::abs(s[1]), -s[2]});
  if (s[1] > 0) {
    shortest = std::min(shortest, Positive(s[1] * std::exp(s[0] / s[1]) - s[2]));
    if (s[2] > 0) {
      shortest = std::min(shortest, Positive(s[0] - s[1] * (std::log(s[2]) - std::log(s[1]))));
    }
  }
  return shortest;
}

/// The dual cone is the closure of -y_0 exp(y_1/y_0 - 1) <= y_2, y_0 < 0.
inline void ExponentialIntoDual(double* y, int, double) {
  if (y[0] < 0) {
    const long double y0 = y[0];
    const long double needed = -y0 * std::exp(y[1] / y0 - 1);
    if (needed < std::numeric_limits<double>::max()) {
      if (!(y[2] >= needed)) y[2] = Above(needed);
      return;
    }
  }
  y[0] = 0;
  y[1] = std::max(0.0, y[1]);
  y[2] = std::max(0.0, y[2]);
}

// ---- power: s_0^a s_1^(1-a) >= |s_2|, s_0 >= 0, s_1 >= 0 --------------------------------------

inline const char* PowerNeed(int dim, double a) {
  if (dim != 3) return "a dimension of 3";
  return a > 0 && a < 1 ? nullptr : "a parameter between 0 and 1";
}

/// The shortest of three moves: s_2 towards 0, or s_0 or s_1 up; each after s_0 and s_1 are
/// nonnegative.
inline double PowerViolation(const double* s, int, double a) {
  const double p0 = std::max(0.0, s[0]), p1 = std::max(0.0, s[1]), height = std::abs(s[2]);
  double shortest = Positive(height - std::pow(p0, a) * std::pow(p1, 1 - a));
  if (shortest > 0 && p1 > 0) {
    const double needed = std::exp((std::log(height) - (1 - a) * std::log(p1)) / a);
    shortest = std::min(shortest, Positive(needed - s[0]));
  }
  if (shortest > 0 && p0 > 0) {
    const double needed = std::exp((std::log(height) - a * std::log(p0)) / (1 - a));
    shortest = std::min(shortest, Positive(needed - s[1]));
  }
  return std::max({shortest, -s[0], -s[1]});
}

/// The dual cone is (y_0/a)^a (y_1/(1-a))^(1-a) >= |y_2|, y_0 >= 0, y_1 >= 0.
inline void PowerIntoDual(double* y, int, double a) {
  y[0] = std::max(0.0, y[0]);
  y[1] = std::max(0.0, y[1]);
  const long double b = a, c = 1 - b;
  const long double limit = std::pow(y[0] / b, b) * std::pow(y[1] / c, c);
  if (std::abs(y[2]) <= limit) return;
  y[2] = std::copysign(std::max(0.0, -Above(-limit)), y[2]);
}

}  // namespace switchyard::cones_detail
