// tests/model/cpu_time.hpp - how long a thing takes, on a machine that others use too.
#pragma once

#include <ctime>

namespace switchyard {

/// Processor seconds of this process since the clock was made: what others run does not count.
class CpuClock {
 public:
  [[nodiscard]] double seconds() const {
    return static_cast<double>(std::clock() - start_) / CLOCKS_PER_SEC;
  }

 private:
  std::clock_t start_ = std::clock();
};

/// Does a limit of time mean anything in this build?
#if defined(NDEBUG) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
inline constexpr bool kTimed = true;
#else
inline constexpr bool kTimed = false;
#endif

}  // namespace switchyard
