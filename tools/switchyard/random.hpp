// tools/switchyard/random.hpp - random numbers that are the same on every machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace switchyard::cli {

/// SplitMix64. The distributions of the standard library differ between machines; these are integer
/// arithmetic alone.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t Next() {
    std::uint64_t z = (state_ += 0x9E3779B97F4A7C15U);
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
    return z ^ (z >> 31U);
  }
  /// Of 0, ..., count - 1, count > 0. No value is likelier than another by more than count / 2^32.
  int Below(int count) {
    constexpr unsigned kHalf = 32;
    return static_cast<int>((Next() >> kHalf) * static_cast<std::uint64_t>(count) >> kHalf);
  }
  /// Of lower, ..., upper.
  int Between(int lower, int upper) { return lower + Below(upper - lower + 1); }

  template <class T>
  void Shuffle(std::vector<T>& v) {
    for (std::size_t i = v.size(); i > 1; --i) {
      std::swap(v[i - 1], v[static_cast<std::size_t>(Below(static_cast<int>(i)))]);
    }
  }

 private:
  std::uint64_t state_;
};

}  // namespace switchyard::cli
