// core/gcs/transitions.hpp - at which vertices a program counts transitions, and where their points
// stand.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/gcs/pruning.hpp"

namespace switchyard {

/// From an arc into a vertex to an arc out of it, not back to where it came from.
struct Transition {
  enum class Copy : std::int8_t {
    kOut,  // the only one to its arc out: it is that arc's tail
    kIn,   // the only one from its arc in, not the only one to its arc out: that arc's head
    kOwn,
  };
  std::int32_t in, out;  // arcs
  std::int32_t vertex;
  Copy copy;
};

/// Where a vertex has no more transitions than arcs, in corridors and at crossings, its set and
/// terms stand at a copy of its point for each transition, and an arc's flow and point are sums of
/// its transitions': a tighter program, at least as tight as all two-cycle rows, and hardly a
/// larger one. Elsewhere, and at source and target, they stand at the copy of each arc.
class TransitionPlan {
 public:
  TransitionPlan(const PrunedGraph& graph, bool any);

  [[nodiscard]] bool At(std::int32_t vertex) const {
    return at_[static_cast<std::size_t>(vertex)] != 0;
  }
  [[nodiscard]] const std::vector<Transition>& all() const { return all_; }
  /// The transitions from an arc at its head, and to an arc at its tail; none where the vertex does
  /// not count them.
  [[nodiscard]] std::span<const std::int32_t> From(std::size_t arc) const {
    return Of(from_start_, from_, arc);
  }
  [[nodiscard]] std::span<const std::int32_t> To(std::size_t arc) const {
    return Of(to_start_, to_, arc);
  }
  /// Has the arc a copy of its tail's point; of its head's?
  [[nodiscard]] bool OwnsTail(std::size_t arc) const {
    const auto to = To(arc);
    return to.empty() || (to.size() == 1 && Of(to[0]).copy == Transition::Copy::kOut);
  }
  [[nodiscard]] bool OwnsHead(std::size_t arc) const {
    const auto from = From(arc);
    return from.empty() || (from.size() == 1 && Of(from[0]).copy == Transition::Copy::kIn);
  }

 private:
  [[nodiscard]] const Transition& Of(std::int32_t k) const {
    return all_[static_cast<std::size_t>(k)];
  }
  static std::span<const std::int32_t> Of(const std::vector<std::int32_t>& start,
                                          const std::vector<std::int32_t>& all, std::size_t arc) {
    return std::span(all).subspan(static_cast<std::size_t>(start[arc]),
                                  static_cast<std::size_t>(start[arc + 1] - start[arc]));
  }
  void Choose(const PrunedGraph& graph, std::int32_t vertex, std::span<const std::int32_t> in,
              std::span<const std::int32_t> out);
  void ListByArc(std::size_t num_arcs);

  std::vector<std::uint8_t> at_;
  std::vector<Transition> all_;
  std::vector<std::int32_t> from_start_, from_, to_start_, to_;
};

}  // namespace switchyard
