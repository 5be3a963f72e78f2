// core/trajectory/joins.hpp - when one segment starts where another ends.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace switchyard {

/// Finite, and equal up to the rounding of the sums of durations that times are.
inline bool Joins(double end, double start) {
  constexpr double kRounding = 64 * std::numeric_limits<double>::epsilon();
  return std::isfinite(end) && std::abs(start - end) <= kRounding * std::max(1.0, std::abs(end));
}

}  // namespace switchyard
