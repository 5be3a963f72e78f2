#include "solvers/mip/path_branching.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "switchyard/arcs.hpp"

namespace switchyard::mip {
namespace {

std::size_t At(std::int32_t i) { return static_cast<std::size_t>(i); }

/// Open arcs of a vertex by their flow, the largest first; and what they carry.
struct Carried {
  std::vector<std::int32_t> arcs;
  double flow = 0, largest = 0;
};

Carried CarriedBy(const rounding::PathProblem& paths, const NodeBoxes& boxes,
                  const std::vector<double>& x, std::span<const std::int32_t> arcs) {
  Carried carried;
  const auto flow = [&](std::int32_t a) { return std::max(0.0, x[At(paths.paths().flow[a])]); };
  for (const std::int32_t a : arcs) {
    if (boxes.upper(paths.paths().flow[a]) < 1) continue;
    carried.arcs.push_back(a);
    carried.flow += flow(a);
    carried.largest = std::max(carried.largest, flow(a));
  }
  std::stable_sort(carried.arcs.begin(), carried.arcs.end(),
                   [&](std::int32_t a, std::int32_t b) { return flow(a) > flow(b); });
  return carried;
}

/// Each arc, the one with more flow before, to the part that has less.
Split InTwo(const rounding::PathProblem& paths, const std::vector<double>& x,
            const Carried& carried) {
  Split split;
  double part[2] = {0, 0};
  for (const std::int32_t a : carried.arcs) {
    const std::int32_t j = paths.paths().flow[a];
    const std::size_t fewer =
        split.children[0].decided.size() <= split.children[1].decided.size() ? 1 : 0;
    const int to = part[0] == part[1] ? static_cast<int>(fewer) : (part[0] < part[1] ? 0 : 1);
    part[to] += std::max(0.0, x[At(j)]);
    split.children[1 - to].decided.push_back({j, 0, 0});
  }
  split.first = part[0] >= part[1] ? 0 : 1;
  return split;
}

}  // namespace

std::optional<Split> SplitOfArcs(const rounding::PathProblem& paths, const NodeBoxes& boxes,
                                 const std::vector<double>& x) {
  constexpr double kWhole = 1e-6;
  const Leaving in(Reversed(paths.arcs()));
  Carried best;
  double most = 0;
  for (std::int32_t v = 0; v < paths.paths().num_vertices; ++v) {
    for (const auto& arcs : {paths.out().Of(v), in.Of(v)}) {
      Carried carried = CarriedBy(paths, boxes, x, arcs);
      const double divided = carried.flow - carried.largest;
      if (carried.arcs.size() < 2 || divided <= kWhole) continue;
      const double worth = divided * std::min(1.0, carried.flow);
      if (worth <= most) continue;
      most = worth;
      best = std::move(carried);
    }
  }
  if (best.arcs.empty()) return std::nullopt;
  return InTwo(paths, x, best);
}

bool PropagatePaths(const rounding::PathProblem& paths, NodeBoxes& boxes) {
  std::vector<std::int32_t> open, tail, head;
  for (std::int32_t a = 0; a < paths.paths().num_arcs; ++a) {
    if (boxes.upper(paths.paths().flow[a]) < 1) continue;
    open.push_back(a);
    tail.push_back(paths.paths().tail[a]);
    head.push_back(paths.paths().head[a]);
  }
  const Arcs arcs{paths.paths().num_vertices, tail, head};
  const std::vector<std::uint8_t> useful =
      UsefulArcs(arcs, paths.paths().source, paths.paths().target);
  bool any = false;
  for (std::size_t k = 0; k < open.size(); ++k) {
    any = any || useful[k] != 0;
    if (useful[k] == 0) boxes.Impose(paths.paths().flow[open[k]], 0, 0);
  }
  return any && !boxes.contradiction();
}

}  // namespace switchyard::mip
