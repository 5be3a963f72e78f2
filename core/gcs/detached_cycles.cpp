#include "core/gcs/detached_cycles.hpp"

#include <cmath>

#include "core/problem/row_matrix.hpp"

namespace switchyard {
namespace {

constexpr double kNothing = 1e-9;  // relative to the whole cost

std::size_t At(std::int32_t i) { return static_cast<std::size_t>(i); }

/// The arcs of each cycle beside the path from source to target.
std::vector<std::vector<std::int32_t>> CyclesIn(const PrunedGraph& graph,
                                                const GcsTranscription& transcription,
                                                const std::vector<double>& x) {
  std::vector<std::int32_t> next(graph.vertices.size(), -1);
  for (std::size_t a = 0; a < graph.edges.size(); ++a) {
    if (x[At(transcription.flow(a))] > 0.5) {
      next[At(graph.tail[a])] = static_cast<std::int32_t>(a);
    }
  }
  std::vector<std::int32_t> seen(graph.vertices.size(), -1);  // from which start
  std::vector<std::vector<std::int32_t>> cycles;
  const auto walk = [&](std::int32_t start) {
    std::int32_t v = start;
    while (next[At(v)] >= 0 && seen[At(v)] < 0) {
      seen[At(v)] = start;
      v = graph.head[At(next[At(v)])];
    }
    return v;
  };
  walk(graph.source);
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(next.size()); ++v) {
    if (seen[At(v)] >= 0 || next[At(v)] < 0) continue;
    const std::int32_t end = walk(v);
    if (next[At(end)] < 0 || seen[At(end)] != v) continue;
    std::vector<std::int32_t>& cycle = cycles.emplace_back();
    std::int32_t at = end;
    do {
      cycle.push_back(next[At(at)]);
      at = graph.head[At(next[At(at)])];
    } while (at != end);
  }
  return cycles;
}

}  // namespace

bool ForbidCycles(const PrunedGraph& graph, const GcsTranscription& transcription,
                  const std::vector<double>& x, ProblemData& problem) {
  double whole = 1;
  for (std::size_t j = 0; j < problem.q.size(); ++j) whole += std::abs(problem.q[j] * x[j]);
  RowMatrix rows;
  for (const std::vector<std::int32_t>& cycle : CyclesIn(graph, transcription, x)) {
    bool forced = false;
    for (const std::int32_t a : cycle) forced |= graph.edges[At(a)]->phi_value() == true;
    if (!forced && transcription.CostOf(cycle, x) >= -kNothing * whole) continue;
    std::vector<std::uint8_t> in_cycle(graph.vertices.size(), 0);
    for (const std::int32_t a : cycle) in_cycle[At(graph.tail[At(a)])] = 1;
    for (const std::int32_t of : cycle) {
      const std::int32_t v = graph.tail[At(of)];
      rows.Begin();
      problem.row_lower.push_back(0);
      problem.row_upper.push_back(kInfinity);
      for (std::size_t a = 0; a < graph.edges.size(); ++a) {
        const bool enters = in_cycle[At(graph.head[a])] != 0 && in_cycle[At(graph.tail[a])] == 0;
        if (enters) rows.Add(transcription.flow(a), 1);
        if (graph.tail[a] == v) rows.Add(transcription.flow(a), -1);
      }
    }
  }
  if (rows.rows() == 0) return false;
  problem.A = StackRows(problem.A, rows.Take(problem.num_vars));
  return true;
}

}  // namespace switchyard
