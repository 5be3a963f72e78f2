// solvers/linalg/pivots.hpp - the pivots of a factorization LDL' whose signs are known.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace switchyard::linalg {

/// In a quasi-definite matrix each pivot has a sign that no order changes (Vanderbei, SIAM J.
/// Optim. 5, 1995), and here, in exact arithmetic, a size of at least `least`. One that has less
/// shows how large rounding was, and is made larger than that: a smaller one would only magnify it.
/// An infinite pivot takes its row and column out.
struct PivotRule {
  double least = 1e-13;

  /// The pivot to be used for d, a sum of terms whose sizes add up to `size`; counts into `raised`
  /// where it is another.
  [[nodiscard]] double Accept(double d, std::int8_t sign, double size, int& raised) const {
    constexpr double kHalf = 0.5, kBeyond = 10, kRounding = 1e-16;
    if (sign * d >= kHalf * least) return d;
    ++raised;
    return sign * std::max({least, -kBeyond * sign * d, kRounding * size});
  }

  /// The same for a sum of twofold numbers, which with an infinite term is NaN: its size tells.
  [[nodiscard]] double AcceptTwofold(double d, std::int8_t sign, double size, int& raised) const {
    return Accept(std::isinf(size) ? sign * size : d, sign, size, raised);
  }
};

}  // namespace switchyard::linalg
