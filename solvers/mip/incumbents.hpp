// solvers/mip/incumbents.hpp - the best integer points found so far.
#pragma once

#include <cstddef>
#include <vector>

#include "switchyard/abi.h"
#include "switchyard/problem.hpp"

namespace switchyard::mip {

struct Solution {
  double objective;
  std::vector<double> x;
};

/// The best ones, each once, the best first. Whoever offers a point has verified it.
class Incumbents {
 public:
  explicit Incumbents(std::size_t capacity) : capacity_(capacity == 0 ? 1 : capacity) {}

  /// Is it the best now?
  bool Offer(double objective, const std::vector<double>& x);
  [[nodiscard]] bool empty() const { return all_.empty(); }
  [[nodiscard]] double objective() const {
    return all_.empty() ? kInfinity : all_.front().objective;
  }
  [[nodiscard]] const std::vector<Solution>& all() const { return all_; }

 private:
  std::size_t capacity_;
  std::vector<Solution> all_;
};

/// Relaxations are solved to a finite accuracy: a relative gap below this counts as closed.
inline constexpr double kLeastGap = 3e-7;

/// No point with an objective above this is worth finding: better than `best` by less than the gaps
/// that were asked for (1e-4 relative where none was), or not below the cutoff.
double Threshold(const sy_control& control, double best);

}  // namespace switchyard::mip
