#include "solvers/mip/path_costs.hpp"

#include <algorithm>
#include <cfloat>
#include <cmath>

#include "switchyard/arcs.hpp"

namespace switchyard::mip {
namespace {

std::size_t At(std::int32_t i) { return static_cast<std::size_t>(i); }

}  // namespace

std::vector<VariableBox> ByPathCosts(const rounding::PathProblem& paths, const NodeBound& bound,
                                     double cutoff, const std::vector<double>& lower,
                                     const std::vector<double>& upper) {
  std::vector<VariableBox> closed;
  if (!(cutoff < kInfinity) || bound.slope.empty() || !std::isfinite(bound.value)) return closed;
  const sy_paths& p = paths.paths();
  std::vector<std::uint8_t> open(At(p.num_arcs));
  std::vector<double> length(At(p.num_arcs), 0.0);
  for (std::int32_t a = 0; a < p.num_arcs; ++a) {
    const std::size_t j = At(p.flow[a]);
    open[At(a)] = upper[j] >= 1 ? 1 : 0;
    if (lower[j] <= 0) length[At(a)] = std::max(0.0, bound.slope[j]);
  }
  const Leaving out(paths.arcs(), open), in(Reversed(paths.arcs()), open);
  const std::vector<double> from = Distances(paths.arcs(), out, length, p.source);
  const std::vector<double> to = Distances(Reversed(paths.arcs()), in, length, p.target);
  // A sum of a path's arcs is rounded as often as it has arcs; two more for what is added here.
  const double inward = 1 - (p.num_vertices + 8.0) * DBL_EPSILON;
  const double room =
      (cutoff - bound.value) + DBL_EPSILON * (std::abs(cutoff) + std::abs(bound.value));
  for (std::int32_t a = 0; a < p.num_arcs; ++a) {
    if (open[At(a)] == 0) continue;
    const double through = from[At(p.tail[a])] + length[At(a)] + to[At(p.head[a])];
    if (through * inward > room) closed.push_back({p.flow[a], 0, 0});
  }
  return closed;
}

}  // namespace switchyard::mip
