// All simple paths of a graph, each solved by itself.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "tests/gcs/grid.hpp"

namespace switchyard::testing {

/// Those that the phi constraints allow.
class EveryPath {
 public:
  using Vertex = GraphOfConvexSets::Vertex;
  using Edge = GraphOfConvexSets::Edge;
  using Path = std::vector<const Edge*>;

  EveryPath(const GraphOfConvexSets& graph, const Vertex& source, const Vertex& target)
      : graph_(graph), paths_(SimplePaths(source, target)) {
    std::erase_if(paths_, [&](const Path& path) { return !Allowed(path); });
  }
  [[nodiscard]] std::size_t size() const { return paths_.size(); }

  void Solve() {
    GraphOfConvexSetsOptions options;
    options.parallelism = Parallelism::None();
    for (const Path& path : paths_) {
      const auto found = graph_.SolveConvexRestriction(path, options);
      if (found.primal == PointKind::kFeasible) {
        cost_.emplace(path, found.objective);
        best_ = std::min(best_, found.objective);
      } else if (found.termination != Termination::kInfeasible) {
        ++undecided_;
      }
    }
  }
  /// Infinite where no path has a point.
  [[nodiscard]] double best() const { return best_; }
  [[nodiscard]] bool any() const { return !cost_.empty(); }
  [[nodiscard]] int undecided() const { return undecided_; }
  /// NaN: it is none of them, or has no point.
  [[nodiscard]] double CostOf(const Path& path) const {
    const auto found = cost_.find(path);
    return found == cost_.end() ? std::nan("") : found->second;
  }

 private:
  [[nodiscard]] bool Allowed(const Path& path) const {
    for (const Edge* edge : graph_.Edges()) {
      const bool on = std::find(path.begin(), path.end(), edge) != path.end();
      if (edge->phi_value() == !on) return false;
    }
    return true;
  }

  const GraphOfConvexSets& graph_;
  std::vector<Path> paths_;
  std::map<Path, double> cost_;
  double best_ = kInfinity;
  int undecided_ = 0;
};

}  // namespace switchyard::testing
