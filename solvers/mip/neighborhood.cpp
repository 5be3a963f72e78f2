#include "solvers/mip/neighborhood.hpp"

#include <algorithm>
#include <cmath>

#include "solvers/mip/run.hpp"

namespace switchyard::mip {

std::vector<Solution> SearchNear(const Instance& instance, const std::vector<double>& relaxed,
                                 const std::vector<double>& best, double cutoff,
                                 rounding::Budget& budget) {
  constexpr double kSame = 0.1;      // of an integer's value
  constexpr std::size_t kShare = 3;  // at least a third stays
  constexpr std::int64_t kNodes = 60;
  constexpr double kSeconds = 0.05;  // of what was spent so far
  std::vector<double> lower = instance.root.lower(), upper = instance.root.upper();
  std::size_t kept = 0;
  for (const std::int32_t j : instance.whole.integers()) {
    const auto at = static_cast<std::size_t>(j);
    if (std::abs(relaxed[at] - best[at]) > kSame) continue;
    lower[at] = upper[at] = best[at];
    ++kept;
  }
  const std::size_t all = instance.whole.integers().size();
  if (kept * kShare < all || kept == all) return {};
  sy_problem near = instance.problem();
  near.x_lower = lower.data();
  near.x_upper = upper.data();
  const rounding::IntegerProblem whole(near);
  Options options = instance.options;
  options.dives = options.probing = options.deterministic = 0;
  options.pool = 1;
  sy_control control = budget.Part(1);
  control.nodes = kNodes;
  control.cutoff = cutoff;
  if (instance.options.deterministic == 0) {
    control.seconds = std::min(control.seconds, 1 + kSeconds * budget.Seconds());
  }
  const std::vector<double> no_start;
  Run run(whole, nullptr, options, instance.host, control, no_start);
  run.Solve();
  return run.Pool();
}

}  // namespace switchyard::mip
