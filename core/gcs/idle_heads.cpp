#include "core/gcs/idle_heads.hpp"

#include <algorithm>

namespace switchyard {
namespace {

std::size_t Index(std::int32_t i) { return static_cast<std::size_t>(i); }

/// Marks the groups of the coordinates whose places, from `first` on, a block uses.
void Mark(const TermBlock& block, std::size_t first, const std::vector<std::int32_t>& group,
          std::uint8_t* needed) {
  for (std::size_t i = 0; i < group.size(); ++i) {
    if (block.uses[first + i] != 0) needed[group[i]] = 1;
  }
}

/// The coordinates of other groups; nothing where there are none.
std::vector<std::uint8_t> Without(const std::uint8_t* needed,
                                  const std::vector<std::int32_t>& group) {
  std::vector<std::uint8_t> others;
  const auto is_needed = [&](std::int32_t g) { return needed[g] != 0; };
  if (std::all_of(group.begin(), group.end(), is_needed)) return others;
  for (const std::int32_t g : group) others.push_back(is_needed(g) ? 0 : 1);
  return others;
}

/// Where each vertex' groups begin in one list of all.
std::vector<std::size_t> FirstGroups(const std::vector<VertexBlocks>& of_vertex) {
  std::vector<std::size_t> first = {0};
  for (const VertexBlocks& of : of_vertex) {
    first.push_back(first.back() + (of.group != nullptr ? of.group->size() : 0));
  }
  return first;
}

}  // namespace

IdleHeads::IdleHeads(const PrunedGraph& graph, const TransitionPlan& plan,
                     const std::vector<VertexBlocks>& of_vertex,
                     const std::vector<EdgeBlocks>& of_edge)
    : idle_(graph.vertices.size()), unread_(graph.vertices.size()) {
  const std::vector<std::size_t> first = FirstGroups(of_vertex);
  std::vector<std::uint8_t> needed(first.back(), 0), entered(of_vertex.size(), 0);
  for (std::size_t a = 0; a < of_edge.size(); ++a) {
    const auto v = Index(graph.head[a]);
    const std::vector<std::int32_t>* group = of_vertex[v].group;
    if (group == nullptr || graph.head[a] == graph.target) continue;
    entered[v] = 1;
    const auto of_u = Index(graph.vertices[Index(graph.tail[a])]->ambient_dimension());
    Mark(*of_edge[a].terms, 1 + of_u, *group, needed.data() + first[v]);
  }
  for (std::size_t v = 0; v < of_vertex.size(); ++v) {
    if (entered[v] == 0) continue;
    const std::vector<std::int32_t>& group = *of_vertex[v].group;
    std::uint8_t* const of_v = needed.data() + first[v];
    unread_[v] = Without(of_v, group);
    if (plan.At(static_cast<std::int32_t>(v))) Mark(*of_vertex[v].terms, 1, group, of_v);
    idle_[v] = Without(of_v, group);
  }
}

}  // namespace switchyard
