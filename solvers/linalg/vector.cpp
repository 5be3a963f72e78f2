#include "solvers/linalg/vector.hpp"

namespace switchyard::linalg {
namespace {

SWITCHYARD_INLINE Lanes Load(const double* p) { return *reinterpret_cast<const LooseLanes*>(p); }

}  // namespace

SWITCHYARD_EACH_ISA double Dot(const double* a, const double* b, std::size_t count) {
  Lanes even = Lanes{}, odd = Lanes{};
  std::size_t i = 0;
  for (; i + 2 * kLanes <= count; i += 2 * kLanes) {
    even += Load(a + i) * Load(b + i);
    odd += Load(a + i + kLanes) * Load(b + i + kLanes);
  }
  even += odd;
  double sum = 0;
  for (int l = 0; l < kLanes; ++l) sum += even[l];
  for (; i < count; ++i) sum += a[i] * b[i];
  return sum;
}

SWITCHYARD_EACH_ISA double MaxAbs(const double* v, std::size_t count) {
  Lanes largest = Lanes{}, sum = Lanes{};
  std::size_t i = 0;
  for (; i + kLanes <= count; i += kLanes) {
    const Lanes at = Load(v + i);
    largest = Max(largest, Max(at, -at));
    sum += at * 0;  // NaN where there is one
  }
  double max = 0;
  for (int l = 0; l < kLanes; ++l) max = Max(max, largest[l] + sum[l]);
  double rest = 0;
  for (; i < count; ++i) {
    max = Max(max, std::abs(v[i]));
    rest += v[i] * 0;
  }
  for (int l = 0; l < kLanes; ++l) rest += sum[l];
  return max + rest;
}

SWITCHYARD_EACH_ISA void AddMultiple(double alpha, const double* x, std::size_t count, double* y) {
  std::size_t i = 0;
  for (; i + kLanes <= count; i += kLanes) {
    *reinterpret_cast<LooseLanes*>(y + i) += Load(x + i) * alpha;
  }
  for (; i < count; ++i) y[i] += alpha * x[i];
}

}  // namespace switchyard::linalg
