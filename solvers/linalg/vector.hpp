// solvers/linalg/vector.hpp - sums over long vectors.
#pragma once

#include "solvers/linalg/simd.hpp"
#include "solvers/linalg/symmetric_pattern.hpp"

namespace switchyard::linalg {

double Dot(const double* a, const double* b, std::size_t count);
/// The largest |v_i|; NaN where one is NaN or infinite.
double MaxAbs(const double* v, std::size_t count);
/// y += alpha x.
void AddMultiple(double alpha, const double* x, std::size_t count, double* y);

inline double Dot(const Vector& a, const Vector& b) { return Dot(a.data(), b.data(), a.size()); }
inline double MaxAbs(const Vector& v) { return MaxAbs(v.data(), v.size()); }
inline void AddMultiple(double alpha, const Vector& x, Vector& y) {
  AddMultiple(alpha, x.data(), x.size(), y.data());
}

}  // namespace switchyard::linalg
