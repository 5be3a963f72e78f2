// core/gcs/name_index.hpp - vertices and edges by their names.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>
#include <vector>

#include "switchyard/gcs/graph_of_convex_sets.hpp"

namespace switchyard {

/// Elements by the hashes of their names. What was added since the last question is taken in at the
/// next, so that a graph that is asked for no names pays for none.
template <class Element>
class NameIndex {
 public:
  /// The first of that name among all that are valid in the graph.
  const Element* First(const std::string& name, const std::vector<std::unique_ptr<Element>>& all,
                       const GraphOfConvexSets& graph) {
    for (; covered_ < all.size(); ++covered_) {
      const Element* element = all[covered_].get();
      if (element == nullptr || !graph.IsValid(*element)) continue;
      by_hash_.emplace(Hash(element->name()), element);
    }
    const Element* first = nullptr;
    const auto [begin, end] = by_hash_.equal_range(Hash(name));
    for (auto entry = begin; entry != end; ++entry) {
      const Element* element = entry->second;
      if (first != nullptr && first->id() < element->id()) continue;
      if (element->name() == name) first = element;
    }
    return first;
  }

  /// To be called before the element stops being valid.
  void Forget(const Element& element) {
    if (static_cast<std::size_t>(element.id().value) >= covered_) return;
    const auto [begin, end] = by_hash_.equal_range(Hash(element.name()));
    for (auto entry = begin; entry != end; ++entry) {
      if (entry->second != &element) continue;
      by_hash_.erase(entry);
      return;
    }
  }

 private:
  static std::size_t Hash(const std::string& name) { return std::hash<std::string>()(name); }

  std::size_t covered_ = 0;  // elements with a smaller id are taken in
  std::unordered_multimap<std::size_t, const Element*> by_hash_;
};

struct GraphOfConvexSets::Names {
  std::mutex mutex;  // questions are const
  NameIndex<Vertex> vertices;
  NameIndex<Edge> edges;
};

}  // namespace switchyard
