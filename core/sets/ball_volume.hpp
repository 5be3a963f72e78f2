// core/sets/ball_volume.hpp - the volume of the unit ball.
#pragma once

#include <cmath>
#include <numbers>

namespace switchyard {

/// pi^(n/2) / Gamma(n/2 + 1).
inline double UnitBallVolume(int n) {
  return std::pow(std::numbers::pi, 0.5 * n) / std::tgamma(0.5 * n + 1);
}

}  // namespace switchyard
