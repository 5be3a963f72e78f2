// switchyard/arc_graph.hpp - a directed graph as arrays of arcs: what leaves a vertex, what is
// reachable, what dominates what. Everything goes along arcs: towards a target is from it in
// Reversed(arcs). Knows the standard library alone.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace switchyard {

/// Arc a goes from tail[a] to head[a]. Borrows both arrays.
struct Arcs {
  std::int32_t num_vertices = 0;
  std::span<const std::int32_t> tail;
  std::span<const std::int32_t> head;

  [[nodiscard]] std::size_t size() const { return tail.size(); }
};

inline Arcs Reversed(const Arcs& arcs) { return {arcs.num_vertices, arcs.head, arcs.tail}; }

/// The arcs that leave each vertex, ascending: all, or those with keep[a].
class Leaving {
 public:
  explicit Leaving(const Arcs& arcs, std::span<const std::uint8_t> keep = {})
      : start_(static_cast<std::size_t>(arcs.num_vertices) + 1, 0) {
    const auto kept = [&](std::size_t a) { return keep.empty() || keep[a] != 0; };
    for (std::size_t a = 0; a < arcs.size(); ++a) {
      if (kept(a)) ++start_[static_cast<std::size_t>(arcs.tail[a]) + 1];
    }
    std::partial_sum(start_.begin(), start_.end(), start_.begin());
    arc_.resize(static_cast<std::size_t>(start_.back()));
    std::vector<std::int32_t> next(start_.begin(), start_.end() - 1);
    for (std::size_t a = 0; a < arcs.size(); ++a) {
      if (!kept(a)) continue;
      const auto to = next[static_cast<std::size_t>(arcs.tail[a])]++;
      arc_[static_cast<std::size_t>(to)] = static_cast<std::int32_t>(a);
    }
  }

  [[nodiscard]] std::span<const std::int32_t> Of(std::int32_t vertex) const {
    const auto v = static_cast<std::size_t>(vertex);
    return std::span(arc_).subspan(static_cast<std::size_t>(start_[v]),
                                   static_cast<std::size_t>(start_[v + 1] - start_[v]));
  }

 private:
  std::vector<std::int32_t> start_;  // num_vertices + 1
  std::vector<std::int32_t> arc_;
};

namespace arcs_detail {

inline std::size_t At(std::int32_t i) { return static_cast<std::size_t>(i); }

}  // namespace arcs_detail

/// For each vertex, whether a walk from `from` reaches it.
inline std::vector<std::uint8_t> Reached(const Arcs& arcs, const Leaving& out, std::int32_t from) {
  using arcs_detail::At;
  std::vector<std::uint8_t> reached(At(arcs.num_vertices), 0);
  std::vector<std::int32_t> stack = {from};
  reached[At(from)] = 1;
  while (!stack.empty()) {
    const std::int32_t u = stack.back();
    stack.pop_back();
    for (const std::int32_t a : out.Of(u)) {
      const std::int32_t v = arcs.head[At(a)];
      if (std::exchange(reached[At(v)], std::uint8_t{1}) == 0) stack.push_back(v);
    }
  }
  return reached;
}

/// Which vertices are on every walk from a root to a vertex: Lengauer and Tarjan's algorithm with
/// path compression (TOPLAS 1, 1979), O(m log n) for m arcs and n vertices, without recursion.
class Dominators {
 public:
  /// `in` are the arcs that leave each vertex of Reversed(arcs).
  Dominators(const Arcs& arcs, const Leaving& out, const Leaving& in, std::int32_t root)
      : number_(arcs_detail::At(arcs.num_vertices), -1) {
    Search(arcs, out, root);
    FindSemidominators(arcs, in);
    NestIntervals();
  }

  [[nodiscard]] bool Reached(std::int32_t v) const { return number_[At(v)] >= 0; }
  /// Is u on every walk from the root to v? Both reached; a vertex dominates itself.
  [[nodiscard]] bool Dominate(std::int32_t u, std::int32_t v) const {
    const auto i = At(number_[At(u)]), j = At(number_[At(v)]);
    return begin_[i] <= begin_[j] && begin_[j] < begin_[i] + size_[i];
  }

 private:
  static std::size_t At(std::int32_t i) { return arcs_detail::At(i); }

  // From here on vertices go by their number in a depth-first search.
  void Search(const Arcs& arcs, const Leaving& out, std::int32_t root) {
    std::vector<std::size_t> next(number_.size(), 0);  // of the arcs that leave
    const auto enter = [&](std::int32_t v, std::int32_t from) {
      number_[At(v)] = static_cast<std::int32_t>(vertex_.size());
      vertex_.push_back(v);
      parent_.push_back(from);
    };
    enter(root, -1);
    for (std::int32_t i = 0; i >= 0;) {
      const std::int32_t u = vertex_[At(i)];
      const auto leaving = out.Of(u);
      if (next[At(u)] == leaving.size()) {
        i = parent_[At(i)];
        continue;
      }
      const std::int32_t v = arcs.head[At(leaving[next[At(u)]++])];
      if (number_[At(v)] >= 0) continue;
      enter(v, i);
      i = number_[At(v)];
    }
  }

  void FindSemidominators(const Arcs& arcs, const Leaving& in) {
    const std::size_t count = vertex_.size();
    semi_.resize(count);
    std::iota(semi_.begin(), semi_.end(), 0);
    label_ = semi_;
    ancestor_.assign(count, -1);
    dominator_.assign(count, 0);
    std::vector<std::int32_t> first(count, -1), after(count, -1);  // buckets, as lists
    for (auto w = static_cast<std::int32_t>(count) - 1; w > 0; --w) {
      for (const std::int32_t a : in.Of(vertex_[At(w)])) {
        const std::int32_t v = number_[At(arcs.tail[At(a)])];
        if (v >= 0) semi_[At(w)] = std::min(semi_[At(w)], semi_[At(Least(v))]);
      }
      after[At(w)] = std::exchange(first[At(semi_[At(w)])], w);
      const std::int32_t p = ancestor_[At(w)] = parent_[At(w)];
      for (std::int32_t v = std::exchange(first[At(p)], -1); v >= 0; v = after[At(v)]) {
        const std::int32_t u = Least(v);
        dominator_[At(v)] = semi_[At(u)] < semi_[At(v)] ? u : p;
      }
    }
    for (std::size_t w = 1; w < count; ++w) {
      if (dominator_[w] != semi_[w]) dominator_[w] = dominator_[At(dominator_[w])];
    }
  }

  /// Of v and its ancestors in the forest below its root: the one with the least semidominator.
  std::int32_t Least(std::int32_t v) {
    if (ancestor_[At(v)] < 0) return v;
    path_.clear();
    for (std::int32_t u = v; ancestor_[At(ancestor_[At(u)])] >= 0; u = ancestor_[At(u)]) {
      path_.push_back(u);
    }
    for (auto u = path_.rbegin(); u != path_.rend(); ++u) {
      const std::int32_t above = ancestor_[At(*u)];
      if (semi_[At(label_[At(above)])] < semi_[At(label_[At(*u)])]) {
        label_[At(*u)] = label_[At(above)];
      }
      ancestor_[At(*u)] = ancestor_[At(above)];
    }
    return label_[At(v)];
  }

  /// u dominates v iff the interval of v in the dominator tree lies in that of u.
  void NestIntervals() {
    const std::size_t count = vertex_.size();
    size_.assign(count, 1);
    begin_.assign(count, 0);
    for (std::size_t w = count; w-- > 1;) size_[At(dominator_[w])] += size_[w];
    std::vector<std::int32_t> next(count, 1);
    for (std::size_t w = 1; w < count; ++w) {
      begin_[w] = next[At(dominator_[w])];
      next[At(dominator_[w])] += size_[w];
      next[w] = begin_[w] + 1;
    }
  }

  std::vector<std::int32_t> number_;  // of each vertex; -1: not reached
  std::vector<std::int32_t> vertex_, parent_, semi_, label_, ancestor_, dominator_, path_;
  std::vector<std::int32_t> begin_, size_;
};

}  // namespace switchyard
