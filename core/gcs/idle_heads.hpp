// core/gcs/idle_heads.hpp - coordinates of points that no copy at an edge's head needs.
#pragma once

#include <cstdint>
#include <vector>

#include "core/gcs/pruning.hpp"
#include "core/gcs/term_block.hpp"
#include "core/gcs/transitions.hpp"

namespace switchyard {

/// Of each vertex, the groups of coordinates that no edge into it speaks of; at a vertex that
/// counts transitions, that its own terms do not speak of either. Its set is a product of one set
/// for each group, X = X_1 x ... x X_k, and bounded.
///
/// Such a group g is in z_e^g in phi_e X_g and sum_in z^g = sum_out y^g alone. Where the out-edges'
/// y_f^g are in phi_f X_g, and flows in and out are the same, z_e^g = phi_e sum_out y^g / sum_out
/// phi fulfils both: the copies and their spatial rows say nothing, and are left out. So are a
/// transition's, of which the same is true of w_ef^g = lambda_ef y_f^g / phi_f. What is left out of
/// a program has the same projection: neither the relaxation nor the integer program changes.
class IdleHeads {
 public:
  IdleHeads(const PrunedGraph& graph, const TransitionPlan& plan,
            const std::vector<VertexBlocks>& of_vertex, const std::vector<EdgeBlocks>& of_edge);

  /// By coordinate; empty: none is idle.
  [[nodiscard]] const std::vector<std::uint8_t>& At(std::int32_t vertex) const {
    return idle_[static_cast<std::size_t>(vertex)];
  }
  /// Those, and what no edge into it speaks of; where a vertex counts no transitions, the same.
  [[nodiscard]] const std::vector<std::uint8_t>& Unread(std::int32_t vertex) const {
    return unread_[static_cast<std::size_t>(vertex)];
  }
  [[nodiscard]] bool At(std::int32_t vertex, std::size_t coordinate) const {
    return !At(vertex).empty() && At(vertex)[coordinate] != 0;
  }

 private:
  std::vector<std::vector<std::uint8_t>> idle_, unread_;
};

}  // namespace switchyard
