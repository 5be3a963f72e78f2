#include "core/gcs/pruning.hpp"

#include <algorithm>

#include "switchyard/error.hpp"
#include "switchyard/problem.hpp"

namespace switchyard {
namespace {

using Vertex = GraphOfConvexSets::Vertex;
using Edge = GraphOfConvexSets::Edge;

std::vector<std::int32_t> IndexById(const std::vector<const Vertex*>& vertices) {
  std::vector<std::int32_t> index;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const auto id = static_cast<std::size_t>(vertices[i]->id().value);
    if (id >= index.size()) index.resize(id + id / 2 + 1, -1);
    index[id] = static_cast<std::int32_t>(i);
  }
  return index;
}

/// What user and sets exclude.
std::vector<std::uint8_t> Allowed(const PrunedGraph& g) {
  const std::vector<const Edge*>& edges = g.edges;
  std::vector<std::uint8_t> allowed(edges.size(), 1);
  std::vector<std::int32_t> forced_out(g.vertices.size(), -1);
  std::vector<std::int32_t> forced_in = forced_out;
  std::vector<std::uint8_t> empty(g.vertices.size());
  for (std::size_t v = 0; v < empty.size(); ++v) {
    empty[v] = g.vertices[v]->set().bounding_box().empty ? 1 : 0;
  }
  for (std::size_t a = 0; a < edges.size(); ++a) {
    if (edges[a]->phi_value() != true) continue;
    forced_out[static_cast<std::size_t>(g.tail[a])] = static_cast<std::int32_t>(a);
    forced_in[static_cast<std::size_t>(g.head[a])] = static_cast<std::int32_t>(a);
  }
  for (std::size_t a = 0; a < edges.size(); ++a) {
    const auto u = static_cast<std::size_t>(g.tail[a]), v = static_cast<std::size_t>(g.head[a]);
    const std::int32_t out = forced_out[u], in = forced_in[v];
    const auto self = static_cast<std::int32_t>(a);
    const bool beside_forced = (out >= 0 && out != self) || (in >= 0 && in != self);
    const bool never = edges[a]->phi_value() == false || empty[u] != 0 || empty[v] != 0;
    if (never || beside_forced) allowed[a] = 0;
  }
  return allowed;
}

void KeepArcs(const std::vector<std::uint8_t>& keep, PrunedGraph& g) {
  g.edges = Keep(g.edges, keep);
  g.place = Keep(g.place, keep);
  g.tail = Keep(g.tail, keep);
  g.head = Keep(g.head, keep);
}

}  // namespace

PrunedGraph Prune(const GraphOfConvexSets& graph, const Vertex& source, const Vertex& target,
                  bool by_dominators) {
  PrunedGraph g;
  g.vertices = graph.Vertices();
  g.edges = graph.Edges();
  g.place.resize(g.edges.size());
  for (std::size_t e = 0; e < g.edges.size(); ++e) g.place[e] = static_cast<int>(e);
  const std::vector<std::int32_t> index = IndexById(g.vertices);
  const auto index_of = [&](const Vertex& v) {
    return index[static_cast<std::size_t>(v.id().value)];
  };
  g.source = index_of(source);
  g.target = index_of(target);
  for (const Edge* edge : g.edges) {
    g.tail.push_back(index_of(edge->u()));
    g.head.push_back(index_of(edge->v()));
  }
  std::vector<const Edge*> forced;
  for (const Edge* edge : g.edges) {
    if (edge->phi_value() == true) forced.push_back(edge);
  }
  KeepArcs(Allowed(g), g);
  const std::vector<std::uint8_t> useful = UsefulArcs(g.arcs(), g.source, g.target);
  const bool any = std::find(useful.begin(), useful.end(), 1) != useful.end();
  if (!any) {
    g.why_no_path = Text("no path of edges leads from ", source.name(), " to ", target.name());
  }
  if (by_dominators || !any) {
    KeepArcs(useful, g);
  } else {
    std::vector<std::uint8_t> keep(g.edges.size());
    for (std::size_t a = 0; a < keep.size(); ++a) {
      const bool loop = g.tail[a] == g.head[a];
      keep[a] = !loop && g.head[a] != g.source && g.tail[a] != g.target ? 1 : 0;
    }
    KeepArcs(keep, g);
  }
  std::size_t left = 0;
  for (const Edge* edge : g.edges) left += edge->phi_value() == true ? 1 : 0;
  if (any && left < forced.size()) {
    g.why_no_path = "an edge that must be on the path is on no path from " + source.name() +
                    " to " + target.name();
  }
  return g;
}

}  // namespace switchyard
