// switchyard/model/parallelism.hpp - how many threads a call may use.
#pragma once

#include "switchyard/export.hpp"

namespace switchyard {

/// How many threads at most: of one, of all that the process may use, or of a number.
class SWITCHYARD_EXPORT Parallelism {
 public:
  Parallelism() = default;  // one
  explicit Parallelism(int num_threads) : num_threads_(num_threads < 1 ? 1 : num_threads) {}
  static Parallelism None() { return Parallelism(1); }
  static Parallelism Max();
  [[nodiscard]] int num_threads() const { return num_threads_; }

 private:
  int num_threads_ = 1;
};

}  // namespace switchyard
