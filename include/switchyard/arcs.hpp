// switchyard/arcs.hpp - paths of a directed graph of arcs: which arcs no simple path from source to
// target uses, distances, and the walk that samples a path from a flow.
//
// Parallel arcs and loops are legal; a path is a list of arcs, and two paths differ where any arc
// does. Knows the standard library alone.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <queue>
#include <span>
#include <utility>
#include <vector>

#include "switchyard/arc_graph.hpp"

namespace switchyard {

/// For each arc, 0 where no simple path from source to target uses it, as far as walks and
/// dominators tell: it enters the source, leaves the target, is a loop, is on no walk from source
/// to target, or goes from u to v where v is on every way to u or u on every way from v. Arcs that
/// go may make others go: repeated until nothing changes, each round near-linear.
inline std::vector<std::uint8_t> UsefulArcs(const Arcs& arcs, std::int32_t source,
                                            std::int32_t target) {
  std::vector<std::uint8_t> keep(arcs.size());
  for (std::size_t a = 0; a < arcs.size(); ++a) {
    const std::int32_t u = arcs.tail[a], v = arcs.head[a];
    keep[a] = u != v && v != source && u != target ? 1 : 0;
  }
  for (bool changed = true; changed;) {
    changed = false;
    const Leaving out(arcs, keep), in(Reversed(arcs), keep);
    const Dominators from(arcs, out, in, source), to(Reversed(arcs), in, out, target);
    for (std::size_t a = 0; a < arcs.size(); ++a) {
      const std::int32_t u = arcs.tail[a], v = arcs.head[a];
      if (keep[a] == 0) continue;
      const bool on_a_walk = from.Reached(u) && to.Reached(v);
      if (on_a_walk && !from.Dominate(v, u) && !to.Dominate(u, v)) continue;
      keep[a] = 0;
      changed = true;
    }
  }
  return keep;
}

/// The length of a shortest walk from `from` to each vertex, infinity where there is none, for
/// lengths >= 0 (Dijkstra).
inline std::vector<double> Distances(const Arcs& arcs, const Leaving& out,
                                     std::span<const double> length, std::int32_t from) {
  using arcs_detail::At;
  using Entry = std::pair<double, std::int32_t>;
  std::vector<double> distance(At(arcs.num_vertices), std::numeric_limits<double>::infinity());
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  distance[At(from)] = 0;
  queue.emplace(0.0, from);
  while (!queue.empty()) {
    const auto [d, u] = queue.top();
    queue.pop();
    if (d > distance[At(u)]) continue;
    for (const std::int32_t a : out.Of(u)) {
      const std::int32_t v = arcs.head[At(a)];
      if (!(d + length[At(a)] < distance[At(v)])) continue;
      distance[At(v)] = d + length[At(a)];
      queue.emplace(distance[At(v)], v);
    }
  }
  return distance;
}

/// Shortest walks for lengths of any sign.
struct ShortestWalks {
  std::vector<double> distance;              // infinity: not reached
  std::vector<std::int32_t> last;            // the last arc of a shortest walk; -1: none
  std::vector<std::int32_t> negative_cycle;  // its arcs in order, where one is reached: then the
                                             // distances mean nothing
};

namespace arcs_detail {

/// The arcs, in order, of a cycle of v -> tail of last[v]; none where there is no cycle.
inline std::vector<std::int32_t> CycleOf(const Arcs& arcs, const std::vector<std::int32_t>& last) {
  std::vector<std::int32_t> seen(last.size(), -1), cycle;  // seen: by the walk from which vertex
  for (std::int32_t start = 0; start < arcs.num_vertices; ++start) {
    std::int32_t v = start;
    while (seen[At(v)] < 0 && last[At(v)] >= 0) {
      seen[At(v)] = start;
      v = arcs.tail[At(last[At(v)])];
    }
    if (seen[At(v)] != start || last[At(v)] < 0) continue;
    const std::int32_t end = v;
    do {
      cycle.push_back(last[At(v)]);
      v = arcs.tail[At(last[At(v)])];
    } while (v != end);
    std::reverse(cycle.begin(), cycle.end());
    return cycle;
  }
  return cycle;
}

}  // namespace arcs_detail

/// Bellman and Ford: rounds over the arcs that leave vertices whose distance fell in the round
/// before. The arcs that gave the distances are a forest until there is a negative cycle; this is
/// looked at each time as many distances fell as there are vertices, so that it adds nothing to the
/// order of the whole.
inline ShortestWalks WalksOfAnySign(const Arcs& arcs, const Leaving& out,
                                    std::span<const double> length, std::int32_t from) {
  using arcs_detail::At;
  const std::size_t count = At(arcs.num_vertices);
  ShortestWalks walks{std::vector<double>(count, std::numeric_limits<double>::infinity()),
                      std::vector<std::int32_t>(count, -1),
                      {}};
  std::vector<std::int32_t> fell = {from}, next;
  std::vector<std::uint8_t> waits(count, 0);
  walks.distance[At(from)] = 0;
  for (std::size_t falls = 0; !fell.empty(); fell.swap(next)) {
    next.clear();
    for (const std::int32_t u : fell) {
      waits[At(u)] = 0;
      for (const std::int32_t a : out.Of(u)) {
        const std::int32_t v = arcs.head[At(a)];
        const double through = walks.distance[At(u)] + length[At(a)];
        if (!(through < walks.distance[At(v)])) continue;
        walks.distance[At(v)] = through;
        walks.last[At(v)] = a;
        ++falls;
        if (std::exchange(waits[At(v)], std::uint8_t{1}) == 0) next.push_back(v);
      }
    }
    if (falls < count) continue;
    falls = 0;
    walks.negative_cycle = arcs_detail::CycleOf(arcs, walks.last);
    if (!walks.negative_cycle.empty()) return walks;
  }
  return walks;
}

/// Numbers that depend on the seed alone, on every machine (Steele, Lea and Flood's SplitMix64).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t Next() {
    state_ += 0x9e3779b97f4a7c15u;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  /// In [0, 1), a multiple of 2^-53.
  double Uniform() { return static_cast<double>(Next() >> 11) * 0x1p-53; }

 private:
  std::uint64_t state_;
};

/// A simple path from source to target, drawn from a flow: from a vertex by an arc drawn with
/// probability proportional to its flow, among those above `tolerance` to vertices not visited;
/// back where there is none, and what was visited stays so. Each vertex is entered once, so a draw
/// ends, and finds a path wherever arcs above the tolerance hold one. Nothing where they do not.
inline std::optional<std::vector<std::int32_t>> SamplePath(const Arcs& arcs, const Leaving& out,
                                                           std::span<const double> flow,
                                                           double tolerance, std::int32_t source,
                                                           std::int32_t target, Random& random) {
  using arcs_detail::At;
  std::vector<std::uint8_t> visited(At(arcs.num_vertices), 0);
  std::vector<std::int32_t> path, open;
  visited[At(source)] = 1;
  for (std::int32_t u = source; u != target;) {
    open.clear();
    double total = 0;
    for (const std::int32_t a : out.Of(u)) {
      if (!(flow[At(a)] > tolerance) || visited[At(arcs.head[At(a)])] != 0) continue;
      open.push_back(a);
      total += flow[At(a)];
    }
    if (open.empty()) {
      if (path.empty()) return std::nullopt;
      u = arcs.tail[At(path.back())];
      path.pop_back();
      continue;
    }
    double left = total * random.Uniform();
    std::size_t drawn = 0;
    while (drawn + 1 < open.size() && left >= flow[At(open[drawn])]) {
      left -= flow[At(open[drawn++])];
    }
    path.push_back(open[drawn]);
    u = arcs.head[At(open[drawn])];
    visited[At(u)] = 1;
  }
  return path;
}

}  // namespace switchyard
