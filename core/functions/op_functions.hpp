// core/functions/op_functions.hpp - the elementary operations and their derivatives, as the rows of
// op_table.cpp name them: v = Name(a, b, c); FirstOfName and SecondOfName write those derivatives
// to d that the row says are computed, in the order by a, b, c and by aa, ab, bb.
#pragma once

#include <cmath>

namespace switchyard::op_functions {

inline double Add(double a, double b, double) { return a + b; }
inline double Subtract(double a, double b, double) { return a - b; }
inline double Multiply(double a, double b, double) { return a * b; }
inline double Divide(double a, double b, double) { return a / b; }
inline double Negate(double a, double, double) { return -a; }
inline double Sqrt(double a, double, double) { return std::sqrt(a); }
inline double Exp(double a, double, double) { return std::exp(a); }
inline double Log(double a, double, double) { return std::log(a); }
inline double Sin(double a, double, double) { return std::sin(a); }
inline double Cos(double a, double, double) { return std::cos(a); }
inline double Tan(double a, double, double) { return std::tan(a); }
inline double Asin(double a, double, double) { return std::asin(a); }
inline double Acos(double a, double, double) { return std::acos(a); }
inline double Atan(double a, double, double) { return std::atan(a); }
inline double Sinh(double a, double, double) { return std::sinh(a); }
inline double Cosh(double a, double, double) { return std::cosh(a); }
inline double Tanh(double a, double, double) { return std::tanh(a); }
inline double Abs(double a, double, double) { return std::abs(a); }
inline double Floor(double a, double, double) { return std::floor(a); }
inline double Ceil(double a, double, double) { return std::ceil(a); }
inline double Power(double a, double b, double) { return std::pow(a, b); }
inline double Atan2(double a, double b, double) { return std::atan2(a, b); }
inline double Min(double a, double b, double) { return b < a ? b : a; }
inline double Max(double a, double b, double) { return a < b ? b : a; }
inline double IfPositive(double a, double b, double c) { return a > 0 ? b : c; }
inline double IfNonnegative(double a, double b, double c) { return a >= 0 ? b : c; }
inline double Square(double a, double, double) { return a * a; }

inline void FirstOfSquare(double a, double, double, double* d) { *d = 2 * a; }
inline void FirstOfSqrt(double, double, double v, double* d) { *d = 0.5 / v; }
inline void SecondOfSqrt(double a, double, double v, double* d) { *d = -0.25 / (v * a); }
inline void FirstOfLog(double a, double, double, double* d) { *d = 1 / a; }
inline void SecondOfLog(double a, double, double, double* d) { *d = -1 / (a * a); }
inline void FirstOfSin(double a, double, double, double* d) { *d = std::cos(a); }
inline void FirstOfCos(double a, double, double, double* d) { *d = -std::sin(a); }
inline void MinusResult(double, double, double v, double* d) { *d = -v; }
inline void FirstOfTan(double, double, double v, double* d) { *d = 1 + v * v; }
inline void SecondOfTan(double, double, double v, double* d) { *d = 2 * v * (1 + v * v); }
inline void FirstOfSinh(double a, double, double, double* d) { *d = std::cosh(a); }
inline void FirstOfCosh(double a, double, double, double* d) { *d = std::sinh(a); }

inline void FirstOfAbs(double a, double, double, double* d) {
  *d = static_cast<double>(a > 0) - static_cast<double>(a < 0);
}

inline void FirstOfDivide(double, double b, double v, double* d) {
  d[0] = 1 / b;
  d[1] = -v / b;
}
inline void SecondOfDivide(double, double b, double v, double* d) {
  const double q = 1 / b;
  d[0] = -q * q;
  d[1] = 2 * v * q * q;
}

// (1 - a)(1 + a) has its leading digits near a = 1, where 1 - a^2 has lost them.
inline double AsinSlope(double a) { return 1 / std::sqrt((1 - a) * (1 + a)); }
inline double AsinBend(double a) { return a * AsinSlope(a) / ((1 - a) * (1 + a)); }
inline void FirstOfAsin(double a, double, double, double* d) { *d = AsinSlope(a); }
inline void SecondOfAsin(double a, double, double, double* d) { *d = AsinBend(a); }
inline void FirstOfAcos(double a, double, double, double* d) { *d = -AsinSlope(a); }
inline void SecondOfAcos(double a, double, double, double* d) { *d = -AsinBend(a); }

inline double AtanSlope(double a) { return 1 / (1 + a * a); }
inline void FirstOfAtan(double a, double, double, double* d) { *d = AtanSlope(a); }
inline void SecondOfAtan(double a, double, double, double* d) {
  *d = -2 * a * AtanSlope(a) * AtanSlope(a);
}

// 1 / cosh^2 and not 1 - tanh^2, which is 0 to rounding where |a| > 19.
inline double TanhSlope(double a) {
  const double s = 1 / std::cosh(a);
  return s * s;
}
inline void FirstOfTanh(double a, double, double, double* d) { *d = TanhSlope(a); }
inline void SecondOfTanh(double a, double, double v, double* d) { *d = -2 * v * TanhSlope(a); }

// c a^e, where c = 0 makes 0 of an infinite power: the second derivative of a^1 is 0 at 0.
inline double ScaledPower(double c, double a, double e) { return c == 0 ? 0 : c * std::pow(a, e); }

// a^e log(a)^k for k > 0, with its limit 0 at a = 0 where e > 0.
inline double PowerLog(double a, double e, int k) {
  if (a == 0 && e > 0) return 0;
  return std::pow(a, e) * std::pow(std::log(a), k);
}

// b a^(b-1) and b (b-1) a^(b-2) from v = a^b, by a division where that loses nothing: it takes a
// tenth of the time of a power.
inline double FirstByBase(double a, double b, double v) {
  return std::isnormal(v) && a != 0 ? b * v / a : ScaledPower(b, a, b - 1);
}
inline double SecondByBase(double a, double b, double v) {
  const double c = b * (b - 1);
  const double square = a * a;
  return std::isnormal(v) && std::isnormal(square) ? c * v / square : ScaledPower(c, a, b - 2);
}

inline void FirstOfPowerByBase(double a, double b, double v, double* d) {
  *d = FirstByBase(a, b, v);
}
inline void SecondOfPowerByBase(double a, double b, double v, double* d) {
  *d = SecondByBase(a, b, v);
}
inline void FirstOfPowerByExponent(double a, double b, double, double* d) {
  *d = PowerLog(a, b, 1);
}
inline void SecondOfPowerByExponent(double a, double b, double, double* d) {
  *d = PowerLog(a, b, 2);
}
inline void FirstOfPower(double a, double b, double v, double* d) {
  d[0] = FirstByBase(a, b, v);
  d[1] = PowerLog(a, b, 1);
}
// The derivative of b a^(b-1) by b is a^(b-1) + b a^(b-1) log a.
inline void SecondOfPower(double a, double b, double v, double* d) {
  d[0] = SecondByBase(a, b, v);
  d[1] = std::pow(a, b - 1) + b * PowerLog(a, b - 1, 1);
  d[2] = PowerLog(a, b, 2);
}

// With r = a^2 + b^2 the gradient of atan2(a, b) is (b, -a) / r.
inline void FirstOfAtan2(double a, double b, double, double* d) {
  const double r = a * a + b * b;
  d[0] = b / r;
  d[1] = -a / r;
}
inline void SecondOfAtan2(double a, double b, double, double* d) {
  const double r = a * a + b * b;
  const double p = a / r;
  const double q = b / r;
  d[0] = -2 * p * q;
  d[1] = (p - q) * (p + q);
  d[2] = 2 * p * q;
}

// One of two is selected, and moves with v.
inline void Select(bool first, double* d) {
  d[0] = first ? 1 : 0;
  d[1] = first ? 0 : 1;
}
inline void FirstOfMin(double a, double b, double, double* d) { Select(!(b < a), d); }
inline void FirstOfMax(double a, double b, double, double* d) { Select(!(a < b), d); }
inline void FirstOfIfPositive(double a, double, double, double* d) { Select(a > 0, d); }
inline void FirstOfIfNonnegative(double a, double, double, double* d) { Select(a >= 0, d); }

}  // namespace switchyard::op_functions
