// solvers/linalg/twofold.hpp - numbers of twice the digits of a double.
//
// Files that compute with them are compiled with -ffp-contract=off: a sum whose product is fused
// into it is not the sum whose error is computed. Those are the files named twofold_*.cpp.
#pragma once

#include <cmath>

#include "solvers/linalg/simd.hpp"

namespace switchyard::linalg {

/// How many doubles a number of a factorization takes.
enum class Digits { kPlain = 1, kTwofold = 2 };
constexpr int PartsOf(Digits digits) { return static_cast<int>(digits); }

/// Numbers of a matrix or vector; low parts where they are twofold.
template <class T>
struct NumbersOf {
  T* high = nullptr;
  T* low = nullptr;
  [[nodiscard]] Digits digits() const { return low == nullptr ? Digits::kPlain : Digits::kTwofold; }
};
using Numbers = NumbersOf<const double>;

// What a double and eight of them have in common.
SWITCHYARD_INLINE double Fma(double a, double b, double c) { return std::fma(a, b, c); }
SWITCHYARD_INLINE Lanes Fma(const Lanes& a, const Lanes& b, const Lanes& c) {
  Lanes r;
  for (int i = 0; i < kLanes; ++i) r[i] = std::fma(a[i], b[i], c[i]);
  return r;
}

/// The sum high + low, |low| at most half a unit in the last place of high (Dekker, Numer. Math.
/// 18, 1971): about 32 digits. V is double, or Lanes for eight of them.
template <class V>
struct __attribute__((may_alias)) Twofold {
  V high = V{}, low = V{};

  /// Of any a and b (Knuth).
  SWITCHYARD_INLINE static Twofold Sum(const V& a, const V& b) {
    const V sum = a + b;
    const V part = sum - a;
    return {sum, (a - (sum - part)) + (b - part)};
  }
  /// Of |a| >= |b|.
  SWITCHYARD_INLINE static Twofold QuickSum(const V& a, const V& b) {
    const V sum = a + b;
    return {sum, b - (sum - a)};
  }
  SWITCHYARD_INLINE static Twofold Product(const V& a, const V& b) {
    const V product = a * b;
    return {product, Fma(a, b, -product)};
  }

  SWITCHYARD_INLINE friend Twofold operator-(const Twofold& a) { return {-a.high, -a.low}; }
  SWITCHYARD_INLINE friend Twofold operator+(const Twofold& a, const Twofold& b) {
    const Twofold sum = Sum(a.high, b.high);
    return QuickSum(sum.high, sum.low + (a.low + b.low));
  }
  SWITCHYARD_INLINE friend Twofold operator-(const Twofold& a, const Twofold& b) { return a + -b; }
  SWITCHYARD_INLINE friend Twofold operator*(const Twofold& a, const Twofold& b) {
    const Twofold p = Product(a.high, b.high);
    return QuickSum(p.high, Fma(a.high, b.low, Fma(a.low, b.high, p.low)));
  }
  SWITCHYARD_INLINE friend Twofold operator*(const Twofold& a, const V& b) {
    const Twofold p = Product(a.high, b);
    return QuickSum(p.high, Fma(a.low, b, p.low));
  }
  SWITCHYARD_INLINE Twofold& operator+=(const Twofold& b) { return *this = *this + b; }
  SWITCHYARD_INLINE Twofold& operator-=(const Twofold& b) { return *this = *this - b; }
  SWITCHYARD_INLINE Twofold& operator*=(const Twofold& b) { return *this = *this * b; }
};

/// 1 / d; 0 where d is infinite. Of a twofold number, with a low part of up to a unit in the last
/// place of the high one.
SWITCHYARD_INLINE double Reciprocal(double d) { return 1 / d; }
SWITCHYARD_INLINE Lanes Reciprocal(const Lanes& d) { return 1 / d; }
template <class V>
SWITCHYARD_INLINE Twofold<V> Reciprocal(const Twofold<V>& d) {
  const V zero = V{};
  const V first = 1 / d.high;
  const V left = Fma(-first, d.low, Fma(-first, d.high, zero + 1));
  const V second = first * left;
  return {first, first == zero ? zero : second};
}

/// The leading part.
SWITCHYARD_INLINE double High(double v) { return v; }
SWITCHYARD_INLINE Lanes High(const Lanes& v) { return v; }
template <class V>
SWITCHYARD_INLINE V High(const Twofold<V>& v) {
  return v.high;
}

}  // namespace switchyard::linalg
