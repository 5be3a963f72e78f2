#include "solvers/linalg/ordering.hpp"

#include <amd.h>
#include <metis.h>

#include <mutex>
#include <new>
#include <numeric>

namespace switchyard::linalg {

std::vector<Index> MinimumDegreeOrder(const SymmetricPattern& pattern) {
  std::vector<Index> order(pattern.n);
  if (pattern.n == 0) return order;
  double control[AMD_CONTROL];
  double info[AMD_INFO];
  amd_defaults(control);
  const int status =
      amd_order(pattern.n, pattern.start.data(), pattern.row.data(), order.data(), control, info);
  if (status == AMD_OUT_OF_MEMORY) throw std::bad_alloc();
  if (status == AMD_INVALID) std::iota(order.begin(), order.end(), 0);
  return order;
}

namespace {

/// Neighbours of each node, without itself: what METIS calls a graph.
struct Graph {
  std::vector<idx_t> start, neighbour;
};

Graph GraphOf(const SymmetricPattern& p) {
  Graph g;
  g.start.assign(p.n + 1, 0);
  for (Index j = 0; j < p.n; ++j) {
    for (Index k = p.start[j]; k < p.start[j + 1]; ++k) {
      if (p.row[k] == j) continue;
      ++g.start[j + 1];
      ++g.start[p.row[k] + 1];
    }
  }
  std::partial_sum(g.start.begin(), g.start.end(), g.start.begin());
  g.neighbour.resize(g.start.back());
  std::vector<idx_t> next(g.start.begin(), g.start.end() - 1);
  for (Index j = 0; j < p.n; ++j) {
    for (Index k = p.start[j]; k < p.start[j + 1]; ++k) {
      if (p.row[k] == j) continue;
      g.neighbour[next[j]++] = p.row[k];
      g.neighbour[next[p.row[k]]++] = j;
    }
  }
  return g;
}

}  // namespace

std::vector<Index> NestedDissectionOrder(const SymmetricPattern& pattern) {
  static_assert(sizeof(idx_t) == sizeof(Index));
  Graph graph = GraphOf(pattern);
  if (graph.neighbour.empty()) return {};
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  // METIS keeps its random numbers, and for the time of a call its handlers of SIGABRT and SIGTERM,
  // for the whole process: one call at a time leaves both as they were.
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  idx_t n = pattern.n;
  std::vector<idx_t> order(pattern.n), place(pattern.n);
  const int status = METIS_NodeND(&n, graph.start.data(), graph.neighbour.data(), nullptr, options,
                                  order.data(), place.data());
  if (status != METIS_OK) return {};
  return order;
}

std::vector<Index> Delayed(const SymmetricPattern& pattern, const std::vector<Index>& group,
                           const std::vector<Index>& order) {
  const Graph graph = GraphOf(pattern);
  const auto each_other = [&](Index j, auto&& take) {  // neighbours of the other group
    for (Index k = graph.start[j]; k < graph.start[j + 1]; ++k) {
      if (group[graph.neighbour[k]] != group[j]) take(graph.neighbour[k]);
    }
  };
  std::vector<Index> waits_for(pattern.n, 0), delayed;
  std::vector<std::uint8_t> due(pattern.n, 0);
  for (Index j = 0; j < pattern.n; ++j) {
    if (group[j] == 1) each_other(j, [&](Index) { ++waits_for[j]; });
  }
  delayed.reserve(order.size());
  for (const Index j : order) {
    due[j] = 1;
    if (group[j] == 1) {
      if (waits_for[j] == 0) delayed.push_back(j);
      continue;
    }
    delayed.push_back(j);
    each_other(j, [&](Index r) {
      if (--waits_for[r] == 0 && due[r] != 0) delayed.push_back(r);
    });
  }
  return delayed;
}

}  // namespace switchyard::linalg
