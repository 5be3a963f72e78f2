// solvers/presolve/narrow.hpp - two intervals into one.
#pragma once

#include <algorithm>
#include <cmath>

namespace switchyard::presolve {

/// How far numbers that should meet may be apart, relative to what they are made of.
inline constexpr double kRounding = 1e-9;

struct Narrowed {
  bool apart = false;                 // they do not meet
  bool lower = false, upper = false;  // which ends moved
};

/// [lower, upper] becomes its intersection with [low, high]. Intervals that miss each other by
/// rounding meet at an old end; what then differs by rounding alone is one number.
inline Narrowed Narrow(double low, double high, double& lower, double& upper) {
  constexpr double kSame = 1e-13;
  const auto room = [](double end) { return kRounding * (1 + std::abs(end)); };
  if (low > upper + room(upper) || high < lower - room(lower)) return {true, false, false};
  const Narrowed moved{false, low > lower, high < upper};
  if (moved.lower) lower = std::min(low, upper);
  if (moved.upper) upper = std::max(high, lower);
  if (!moved.lower && !moved.upper) return moved;
  const double size = std::max(std::abs(lower), std::abs(upper));
  if (std::isfinite(size) && upper - lower <= kSame * size)
    (moved.lower ? lower : upper) = moved.lower ? upper : lower;
  return moved;
}

}  // namespace switchyard::presolve
