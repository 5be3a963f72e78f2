// solvers/mip/pseudocosts.hpp - what the bound has gained so far for each unit by which a variable
// was moved from its value.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace switchyard::mip {

/// Means of observed gains, by variable and direction; where there are none, of all variables'.
/// (Achterberg, Koch and Martin, Branching rules revisited, 2005.)
class Pseudocosts {
 public:
  explicit Pseudocosts(std::int32_t num_vars) : of_(2 * static_cast<std::size_t>(num_vars)) {}

  /// A gain of the bound, at least 0, where x_j moved by `distance` > 0.
  void See(std::int32_t j, bool up, double distance, double gain) {
    if (!(distance > 1e-9) || !(gain < 1e100)) return;
    for (Sum* sum : {&of_[Index(j, up)], &all_[up ? 1 : 0]}) {
      sum->gain += std::max(0.0, gain) / distance;
      sum->count += 1;
    }
  }
  [[nodiscard]] int Count(std::int32_t j, bool up) const { return of_[Index(j, up)].count; }
  /// Per unit.
  [[nodiscard]] double Gain(std::int32_t j, bool up) const {
    const Sum& own = of_[Index(j, up)];
    const Sum& all = all_[up ? 1 : 0];
    if (own.count > 0) return own.gain / own.count;
    return all.count > 0 ? all.gain / all.count : 1;
  }
  /// Of a value with this fraction: the product of what both children would gain.
  [[nodiscard]] double Score(std::int32_t j, double fraction) const {
    return ScoreOf(Gain(j, false) * fraction, Gain(j, true) * (1 - fraction));
  }
  static double ScoreOf(double down, double up) {
    constexpr double kLeast = 1e-6;
    return std::max(down, kLeast) * std::max(up, kLeast);
  }

 private:
  struct Sum {
    double gain = 0;
    int count = 0;
  };
  static std::size_t Index(std::int32_t j, bool up) {
    return 2 * static_cast<std::size_t>(j) + (up ? 1 : 0);
  }

  std::vector<Sum> of_;
  Sum all_[2];
};

}  // namespace switchyard::mip
