// switchyard/cone_intervals.hpp - what membership in a cone says about the ranges of the
// coordinates: the column `narrow` of the table in cones.hpp. All rounding is outward.
#pragma once

#include <algorithm>
#include <cfloat>
#include <cmath>

namespace switchyard {

/// All v with lower <= v <= upper; empty where lower > upper.
struct Interval {
  double lower;
  double upper;
};

namespace cones_detail {

/// Above and below a value that a handful of operations, among them pow, exp and log, rounded.
inline double RoundUp(double v) { return v + 16 * DBL_EPSILON * std::abs(v) + DBL_MIN; }
inline double RoundDown(double v) { return -RoundUp(-v); }

inline void RaiseLower(Interval& s, double lower) { s.lower = std::max(s.lower, lower); }
inline void CutUpper(Interval& s, double upper) { s.upper = std::min(s.upper, upper); }
inline void WithinRadius(Interval& s, double radius) {
  RaiseLower(s, -radius);
  CutUpper(s, radius);
}

inline double LeastSize(const Interval& s) { return std::max({0.0, s.lower, -s.upper}); }

/// At most sum w_i^2 over the ranges.
inline double LeastSquare(const Interval* w, int dim) {
  double sum = 0;
  for (int i = 0; i < dim; ++i) sum += LeastSize(w[i]) * LeastSize(w[i]);
  return sum * (1 - (dim + 2) * DBL_EPSILON);
}

/// At least s^a t^b over the ranges of two nonnegative coordinates, a + b = 1; infinity only where
/// neither is 0.
inline double LargestMean(const Interval& s, double a, const Interval& t, double b) {
  if (s.upper <= 0 || t.upper <= 0) return 0;
  return RoundUp(std::pow(s.upper, a) * std::pow(t.upper, b));
}

inline void NarrowZero(Interval* s, int dim, double) {
  for (int i = 0; i < dim; ++i) WithinRadius(s[i], 0);
}

inline void NarrowNonnegative(Interval* s, int dim, double) {
  for (int i = 0; i < dim; ++i) RaiseLower(s[i], 0);
}

/// |w_i| <= |w| <= s_0.
inline void NarrowSecondOrder(Interval* s, int dim, double) {
  RaiseLower(s[0], RoundDown(std::sqrt(LeastSquare(s + 1, dim - 1))));
  RaiseLower(s[0], 0);
  for (int i = 1; i < dim; ++i) WithinRadius(s[i], std::max(0.0, s[0].upper));
}

/// At least sqrt 2 times a mean; 0 for 0, so that what a head of 0 leaves is fixed.
inline double TimesRootTwo(double mean) {
  return mean == 0 ? 0 : RoundUp(RoundUp(std::sqrt(2.0)) * mean);
}

/// |w_i|^2 <= |w|^2 <= 2 s_0 s_1.
inline void NarrowRotated(Interval* s, int dim, double) {
  RaiseLower(s[0], 0);
  RaiseLower(s[1], 0);
  const double square = LeastSquare(s + 2, dim - 2);
  if (s[1].upper > 0) RaiseLower(s[0], RoundDown(square / (2 * s[1].upper)));
  if (s[0].upper > 0) RaiseLower(s[1], RoundDown(square / (2 * s[0].upper)));
  const double radius = TimesRootTwo(LargestMean(s[0], 0.5, s[1], 0.5));
  for (int i = 2; i < dim; ++i) WithinRadius(s[i], radius);
}

/// The minors of order 2: S_ij^2 <= S_ii S_jj; an off-diagonal entry is sqrt 2 S_ij.
inline void NarrowSemidefinite(Interval* s, int dim, double) {
  const auto diagonal = [s](int j) -> Interval& { return s[j * (j + 1) / 2 + j]; };
  for (int j = 0; j * (j + 1) / 2 < dim; ++j) {
    RaiseLower(diagonal(j), 0);
    for (int i = 0; i < j; ++i) {
      const double radius = TimesRootTwo(LargestMean(diagonal(i), 0.5, diagonal(j), 0.5));
      WithinRadius(s[j * (j + 1) / 2 + i], radius);
    }
  }
}

/// s_1 log(s_2/s_1) is concave in s_1 with its top at s_2/e; s_1 exp(s_0/s_1) is convex in s_1
/// with its bottom at s_0 > 0 and rises where s_0 <= 0; and s_0 + s_1 <= s_2, since 1 + t <= exp t.
/// s_1 = 0 leaves s_0 <= 0, whatever s_2 is; s_2 = 0 leaves s_1 = 0.
inline void NarrowExponential(Interval* s, int, double) {
  RaiseLower(s[1], 0);
  RaiseLower(s[2], 0);
  CutUpper(s[1], s[2].upper <= 0 ? 0 : RoundUp(s[2].upper - s[0].lower));
  if (s[1].lower > s[1].upper) return;
  if (s[1].upper == 0) return CutUpper(s[0], 0);
  if (std::isfinite(s[2].upper)) {
    const double top = std::clamp(s[2].upper * std::exp(-1.0), s[1].lower, s[1].upper);
    const double height = top > 0 ? top * std::log(s[2].upper / top) : 0.0;
    CutUpper(s[0], RoundUp(height + 4 * DBL_EPSILON * top));
  }
  if (std::isfinite(s[0].lower)) {
    const double bottom = std::clamp(s[0].lower, s[1].lower, s[1].upper);
    const double rate = s[0].lower / bottom;
    if (bottom > 0 && rate < 700) {  // exp(rate) is finite
      RaiseLower(s[2], bottom * std::exp(rate) * (1 - (8 + 4 * std::abs(rate)) * DBL_EPSILON));
    }
  }
}

/// |s_2| <= s_0^a s_1^(1-a).
inline void NarrowPower(Interval* s, int, double a) {
  RaiseLower(s[0], 0);
  RaiseLower(s[1], 0);
  WithinRadius(s[2], LargestMean(s[0], a, s[1], 1 - a));
}

}  // namespace cones_detail
}  // namespace switchyard
