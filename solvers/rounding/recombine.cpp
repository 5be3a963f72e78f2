#include "solvers/rounding/recombine.hpp"

#include <unordered_map>

namespace switchyard::rounding {

std::vector<std::vector<std::int32_t>> Detours(const Arcs& arcs, std::span<const std::int32_t> path,
                                               std::span<const std::int32_t> other) {
  const auto tail = [&](std::int32_t a) { return arcs.tail[static_cast<std::size_t>(a)]; };
  const auto head = [&](std::int32_t a) { return arcs.head[static_cast<std::size_t>(a)]; };
  std::unordered_map<std::int32_t, std::size_t> place;  // of each vertex on the path
  for (std::size_t k = 0; k < path.size(); ++k) place.emplace(tail(path[k]), k);
  if (!path.empty()) place.emplace(head(path.back()), path.size());
  std::vector<std::vector<std::int32_t>> detours;
  std::size_t from = 0, begin = 0;  // where the stretch at hand left the path, and in `other`
  for (std::size_t k = 0; k < other.size(); ++k) {
    if (const auto at = place.find(tail(other[k])); at != place.end()) {
      from = at->second;
      begin = k;
    }
    const auto back = place.find(head(other[k]));
    if (back == place.end() || back->second <= from) continue;
    const std::size_t to = back->second;
    if (k == begin && to == from + 1 && path[from] == other[k]) continue;  // the same arc
    std::vector<std::int32_t>& detour = detours.emplace_back();
    detour.assign(path.begin(), path.begin() + static_cast<std::ptrdiff_t>(from));
    detour.insert(detour.end(), other.begin() + static_cast<std::ptrdiff_t>(begin),
                  other.begin() + static_cast<std::ptrdiff_t>(k) + 1);
    detour.insert(detour.end(), path.begin() + static_cast<std::ptrdiff_t>(to), path.end());
  }
  return detours;
}

}  // namespace switchyard::rounding
