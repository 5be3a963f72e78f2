// The nonnegative orthant, f(s) = -sum log s_i.
#include "solvers/cones/group.hpp"

namespace switchyard::cones {

using linalg::kLanes;
using linalg::Lanes;
using linalg::LooseLanes;

namespace {

SWITCHYARD_INLINE Lanes Load(const double* p) { return *reinterpret_cast<const LooseLanes*>(p); }
SWITCHYARD_INLINE void Store(const Lanes& v, double* p) { *reinterpret_cast<LooseLanes*>(p) = v; }

}  // namespace

// The ray leaves coordinate i at -s_i / ds_i. To look for the largest -ds_i / s_i instead needs no
// branch.
SWITCHYARD_EACH_ISA double Orthant::Step(const double* s, const double* z, const double* ds,
                                         const double* dz, Index count, double most) {
  Lanes rate = Lanes{} + 1 / most;
  Index i = 0;
  for (; i + kLanes <= count; i += kLanes) {
    rate = linalg::Max(rate, -Load(ds + i) / Load(s + i));
    rate = linalg::Max(rate, -Load(dz + i) / Load(z + i));
  }
  double largest = -linalg::Least(-rate);
  for (; i < count; ++i) {
    largest = linalg::Max(largest, -ds[i] / s[i]);
    largest = linalg::Max(largest, -dz[i] / z[i]);
  }
  return 1 / largest;
}

SWITCHYARD_EACH_ISA void Orthant::Scale(const double* s, const double* z, Index count, double* h) {
  Index i = 0;
  for (; i + kLanes <= count; i += kLanes) Store(Load(s + i) / Load(z + i), h + i);
  for (; i < count; ++i) h[i] = s[i] / z[i];
}

SWITCHYARD_EACH_ISA void Orthant::Recenter(const double* trial_s, const double* trial_z,
                                           const double* z, Index count, double low, double high,
                                           double* xi) {
  Index i = 0;
  for (; i + kLanes <= count; i += kLanes) {
    const Lanes lack = IntoRange<Lanes>(Load(trial_s + i) * Load(trial_z + i), low, high);
    Store(Load(xi + i) - lack / Load(z + i), xi + i);
  }
  for (; i < count; ++i) xi[i] -= IntoRange(trial_s[i] * trial_z[i], low, high) / z[i];
}

SWITCHYARD_EACH_ISA void Orthant::Correct(const double* s, const double* z, const double* ds,
                                          const double* dz, Index count, double target,
                                          double* xi) {
  Index i = 0;
  for (; i + kLanes <= count; i += kLanes) {
    Store(Load(s + i) + (Load(ds + i) * Load(dz + i) - target) / Load(z + i), xi + i);
  }
  for (; i < count; ++i) xi[i] = s[i] + (ds[i] * dz[i] - target) / z[i];
}

}  // namespace switchyard::cones
