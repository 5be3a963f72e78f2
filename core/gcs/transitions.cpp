#include "core/gcs/transitions.hpp"

#include <algorithm>
#include <numeric>

namespace switchyard {

TransitionPlan::TransitionPlan(const PrunedGraph& graph, bool any) : at_(graph.vertices.size(), 0) {
  const Arcs arcs = graph.arcs();
  if (any) {
    const Leaving out(arcs), in(Reversed(arcs));
    for (std::int32_t v = 0; v < arcs.num_vertices; ++v) {
      if (v != graph.source && v != graph.target) Choose(graph, v, in.Of(v), out.Of(v));
    }
  }
  ListByArc(arcs.size());
}

void TransitionPlan::Choose(const PrunedGraph& graph, std::int32_t vertex,
                            std::span<const std::int32_t> in, std::span<const std::int32_t> out) {
  const std::size_t arcs = in.size() + out.size(), before = all_.size();
  if (in.empty() || out.empty() || in.size() * out.size() > 4 * arcs) return;
  std::vector<std::int32_t> from(in.size(), 0), to(out.size(), 0);
  for (std::size_t i = 0; i < in.size(); ++i) {
    for (std::size_t k = 0; k < out.size(); ++k) {
      const auto tail = graph.tail[static_cast<std::size_t>(in[i])];
      if (tail == graph.head[static_cast<std::size_t>(out[k])]) continue;
      ++from[i];
      ++to[k];
      all_.push_back({in[i], out[k], vertex, Transition::Copy::kOwn});
    }
  }
  const auto none = [](const std::vector<std::int32_t>& count) {
    return std::find(count.begin(), count.end(), 0) != count.end();
  };
  if (all_.size() - before > arcs || none(from) || none(to)) {
    all_.resize(before);
    return;
  }
  at_[static_cast<std::size_t>(vertex)] = 1;
  std::size_t next = before;
  for (std::size_t i = 0; i < in.size(); ++i) {
    for (std::size_t k = 0; k < out.size() && next < all_.size(); ++k) {
      Transition& t = all_[next];
      if (t.in != in[i] || t.out != out[k]) continue;
      if (from[i] == 1) t.copy = Transition::Copy::kIn;
      if (to[k] == 1) t.copy = Transition::Copy::kOut;
      ++next;
    }
  }
}

void TransitionPlan::ListByArc(std::size_t num_arcs) {
  const auto list = [&](auto&& arc_of, std::vector<std::int32_t>& start,
                        std::vector<std::int32_t>& listed) {
    start.assign(num_arcs + 1, 0);
    for (const Transition& t : all_) ++start[static_cast<std::size_t>(arc_of(t)) + 1];
    std::partial_sum(start.begin(), start.end(), start.begin());
    listed.resize(all_.size());
    std::vector<std::int32_t> next(start.begin(), start.end() - 1);
    for (std::size_t k = 0; k < all_.size(); ++k) {
      listed[static_cast<std::size_t>(next[static_cast<std::size_t>(arc_of(all_[k]))]++)] =
          static_cast<std::int32_t>(k);
    }
  };
  list([](const Transition& t) { return t.in; }, from_start_, from_);
  list([](const Transition& t) { return t.out; }, to_start_, to_);
}

}  // namespace switchyard
