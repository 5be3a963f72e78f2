// core/gcs/pruning.hpp - the part of a graph in which a path from source to target can lie.
#pragma once

#include <string>
#include <vector>

#include "switchyard/arcs.hpp"
#include "switchyard/gcs/graph_of_convex_sets.hpp"

namespace switchyard {

/// The edges that are left, as arcs over all vertices of the graph.
struct PrunedGraph {
  std::vector<const GraphOfConvexSets::Vertex*> vertices;  // by arcs' vertex
  std::vector<const GraphOfConvexSets::Edge*> edges;       // by arc
  std::vector<int> place;                                  // of each arc's edge in Edges()
  std::vector<std::int32_t> tail, head;                    // of each arc
  std::int32_t source = -1;
  std::int32_t target = -1;
  std::string why_no_path;  // empty: there may be one

  [[nodiscard]] Arcs arcs() const {
    return {static_cast<std::int32_t>(vertices.size()), tail, head};
  }
};

/// Edges with phi fixed to 0 go, and those at a vertex whose set is proven empty; beside an edge
/// with phi fixed to 1 the others out of its tail and into its head. With `by_dominators` what no
/// simple path uses goes too; without, only loops, edges into the source and out of the target.
PrunedGraph Prune(const GraphOfConvexSets& graph, const GraphOfConvexSets::Vertex& source,
                  const GraphOfConvexSets::Vertex& target, bool by_dominators);

}  // namespace switchyard
