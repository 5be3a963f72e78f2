#include "core/gcs/idle_heads.hpp"

#include <algorithm>

namespace switchyard {
namespace {

std::size_t Index(std::int32_t i) { return static_cast<std::size_t>(i); }

/// Marks the groups of the coordinates whose places, from `first` on, a block uses.
void Mark(const TermBlock& block, std::size_t first, const std::vector<std::int32_t>& group,
          std::vector<std::uint8_t>& needed) {
  for (std::size_t i = 0; i < group.size(); ++i) {
    if (block.uses[first + i] != 0) needed[Index(group[i])] = 1;
  }
}

/// The coordinates of other groups; nothing where there are none.
std::vector<std::uint8_t> Without(const std::vector<std::uint8_t>& needed,
                                  const std::vector<std::int32_t>& group) {
  std::vector<std::uint8_t> others;
  const auto is_needed = [&](std::int32_t g) { return needed[Index(g)] != 0; };
  if (std::all_of(group.begin(), group.end(), is_needed)) return others;
  for (const std::int32_t g : group) others.push_back(is_needed(g) ? 0 : 1);
  return others;
}

}  // namespace

IdleHeads::IdleHeads(const PrunedGraph& graph, const TransitionPlan& plan,
                     const std::vector<VertexBlocks>& of_vertex,
                     const std::vector<EdgeBlocks>& of_edge)
    : idle_(graph.vertices.size()), unread_(graph.vertices.size()) {
  std::vector<std::vector<std::uint8_t>> needed(graph.vertices.size());  // by group
  for (std::size_t a = 0; a < of_edge.size(); ++a) {
    const auto v = Index(graph.head[a]);
    const std::vector<std::int32_t>* group = of_vertex[v].group;
    if (group == nullptr || graph.head[a] == graph.target) continue;
    needed[v].resize(group->size(), 0);
    const auto of_u = Index(graph.vertices[Index(graph.tail[a])]->ambient_dimension());
    Mark(*of_edge[a].terms, 1 + of_u, *group, needed[v]);
  }
  for (std::size_t v = 0; v < needed.size(); ++v) {
    if (needed[v].empty()) continue;
    const std::vector<std::int32_t>& group = *of_vertex[v].group;
    unread_[v] = Without(needed[v], group);
    if (plan.At(static_cast<std::int32_t>(v))) Mark(*of_vertex[v].terms, 1, group, needed[v]);
    idle_[v] = Without(needed[v], group);
  }
}

}  // namespace switchyard
