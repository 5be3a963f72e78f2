// solvers/mip/interval_math.hpp - intervals of finite numbers, each operation rounded outward.
#pragma once

#include <algorithm>
#include <cmath>

#include "switchyard/cones.hpp"
#include "switchyard/problem.hpp"

namespace switchyard::mip {

inline double Below(double v) { return std::nextafter(v, -kInfinity); }
inline double Above(double v) { return std::nextafter(v, kInfinity); }

inline bool IsExactly(const Interval& a, double v) { return a.lower == v && a.upper == v; }
inline double Middle(const Interval& a) { return 0.5 * a.lower + 0.5 * a.upper; }

inline Interval Plus(const Interval& a, const Interval& b) {
  if (IsExactly(a, 0)) return b;
  if (IsExactly(b, 0)) return a;
  return {Below(a.lower + b.lower), Above(a.upper + b.upper)};
}
inline Interval Minus(const Interval& a) { return {-a.upper, -a.lower}; }
inline Interval Times(const Interval& a, const Interval& b) {
  if (IsExactly(a, 0) || IsExactly(b, 0)) return {0, 0};
  if (IsExactly(a, 1)) return b;
  if (IsExactly(b, 1)) return a;
  const auto [least, most] =
      std::minmax({a.lower * b.lower, a.lower * b.upper, a.upper * b.lower, a.upper * b.upper});
  return {Below(least), Above(most)};
}
/// Of a b that is on one side of 0.
inline Interval Over(const Interval& a, const Interval& b) {
  if (IsExactly(b, 1)) return a;
  return Times(a, {Below(1 / b.upper), Above(1 / b.lower)});
}
inline Interval Square(const Interval& a) {
  const double least = std::max({0.0, a.lower, -a.upper});
  const double most = std::max(std::abs(a.lower), std::abs(a.upper));
  if (most == 0) return {0, 0};
  return {std::max(0.0, Below(least * least)), Above(most * most)};
}
/// Of an a that is not negative.
inline Interval Root(const Interval& a) {
  return {std::max(0.0, Below(std::sqrt(a.lower))), Above(std::sqrt(a.upper))};
}

}  // namespace switchyard::mip
