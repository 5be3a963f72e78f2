// solvers/linalg/simd.hpp - eight doubles at a time, on whatever the processor has.
#pragma once

#include <cmath>
#include <cstddef>
#include <new>
#include <vector>

// A function marked so is compiled once for each instruction set, and the loader takes the best one
// of the machine. Its inner loops must be inlined into it: SWITCHYARD_INLINE.
#if defined(__x86_64__) && defined(__linux__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__) && (!defined(__clang__) || __clang_major__ >= 16)
#define SWITCHYARD_EACH_ISA __attribute__((target_clones("avx512f", "fma", "default")))
#else
#define SWITCHYARD_EACH_ISA
#endif
#define SWITCHYARD_INLINE __attribute__((always_inline)) inline

namespace switchyard::linalg {

inline constexpr int kLanes = 8;

/// Eight doubles; the second may stand anywhere a double may.
using Lanes = double __attribute__((vector_size(64), may_alias));
using LooseLanes = double __attribute__((vector_size(64), aligned(8), may_alias));

SWITCHYARD_INLINE Lanes& LanesAt(double* p) { return *reinterpret_cast<Lanes*>(p); }
SWITCHYARD_INLINE const Lanes& LanesAt(const double* p) {
  return *reinterpret_cast<const Lanes*>(p);
}

// What a double and eight of them have in common.
SWITCHYARD_INLINE double Sqrt(double v) { return std::sqrt(v); }
SWITCHYARD_INLINE Lanes Sqrt(const Lanes& v) {
  Lanes root;
  for (int i = 0; i < kLanes; ++i) root[i] = std::sqrt(v[i]);
  return root;
}
SWITCHYARD_INLINE double Min(double a, double b) { return a < b ? a : b; }
SWITCHYARD_INLINE Lanes Min(const Lanes& a, const Lanes& b) { return a < b ? a : b; }
SWITCHYARD_INLINE double Max(double a, double b) { return a > b ? a : b; }
SWITCHYARD_INLINE Lanes Max(const Lanes& a, const Lanes& b) { return a > b ? a : b; }
SWITCHYARD_INLINE double Least(double v) { return v; }
SWITCHYARD_INLINE double Least(const Lanes& v) {
  double least = v[0];
  for (int i = 1; i < kLanes; ++i) least = v[i] < least ? v[i] : least;
  return least;
}

/// The least multiple of kLanes that is not below n.
template <class Integer>
constexpr Integer RoundUp(Integer n) {
  return (n + kLanes - 1) / kLanes * kLanes;
}

/// Allocates on a cache line's boundary.
template <class T>
struct CacheAligned {
  using value_type = T;
  static constexpr std::align_val_t kAlignment{64};

  CacheAligned() = default;
  template <class U>
  explicit CacheAligned(const CacheAligned<U>&) {}
  T* allocate(std::size_t count) {
    return static_cast<T*>(::operator new(count * sizeof(T), kAlignment));
  }
  void deallocate(T* p, std::size_t) { ::operator delete(p, kAlignment); }
  bool operator==(const CacheAligned&) const { return true; }
};

using Vector = std::vector<double, CacheAligned<double>>;

}  // namespace switchyard::linalg
