#include "solvers/rounding/recombine.hpp"

#include <algorithm>
#include <limits>
#include <unordered_map>
#include <utility>

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

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::size_t At(std::int32_t i) { return static_cast<std::size_t>(i); }

using Ranked = std::vector<std::pair<double, std::vector<std::int32_t>>>;

/// The paths alone, the shortest first.
std::vector<std::vector<std::int32_t>> InOrder(Ranked found) {
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::vector<std::int32_t>> paths;
  for (auto& [total, path] : found) paths.push_back(std::move(path));
  return paths;
}

/// Ways to a target beside vertices that are not to be met.
class WaysTo {
 public:
  WaysTo(const Arcs& arcs, const Leaving& out, std::span<const double> length,
         const std::vector<std::uint8_t>& met, std::int32_t target)
      : arcs_(arcs), out_(out), target_(target), length_(length.begin(), length.end()) {
    for (std::size_t a = 0; a < length_.size(); ++a) {
      if (met[At(arcs.tail[a])] != 0 || met[At(arcs.head[a])] != 0) length_[a] = kInfinity;
    }
    const Arcs back = Reversed(arcs);
    distance_ = Distances(back, Leaving(back), length_, target);
  }

  [[nodiscard]] double From(std::int32_t v) const { return distance_[At(v)]; }
  /// Appends a shortest one; false: ties lead in a circle.
  bool Follow(std::int32_t v, std::vector<std::int32_t>& path) const {
    for (std::size_t steps = 0; v != target_; ++steps) {
      if (steps > distance_.size()) return false;
      std::int32_t next = -1;
      double best = kInfinity;
      for (const std::int32_t a : out_.Of(v)) {
        const double through = length_[At(a)] + distance_[At(arcs_.head[At(a)])];
        if (!(through < best)) continue;
        best = through;
        next = a;
      }
      if (next < 0) return false;
      path.push_back(next);
      v = arcs_.head[At(next)];
    }
    return true;
  }

 private:
  const Arcs& arcs_;
  const Leaving& out_;
  std::int32_t target_;
  std::vector<double> length_, distance_;
};

}  // namespace

std::vector<std::vector<std::int32_t>> Deviations(const Arcs& arcs, const Leaving& out,
                                                  std::span<const double> length,
                                                  std::span<const std::int32_t> path,
                                                  std::int32_t target) {
  Ranked found;
  std::vector<std::uint8_t> met(At(arcs.num_vertices), 0);
  double before = 0;
  for (std::size_t k = 0; k < path.size(); ++k) {
    const std::int32_t v = arcs.tail[At(path[k])];
    met[At(v)] = 1;
    const WaysTo ways(arcs, out, length, met, target);
    for (const std::int32_t a : out.Of(v)) {
      const std::int32_t w = arcs.head[At(a)];
      const double total = before + length[At(a)] + ways.From(w);
      if (a == path[k] || met[At(w)] != 0 || !(total < kInfinity)) continue;
      std::vector<std::int32_t> other(path.begin(), path.begin() + static_cast<std::ptrdiff_t>(k));
      other.push_back(a);
      if (ways.Follow(w, other)) found.emplace_back(total, std::move(other));
    }
    before += length[At(path[k])];
  }
  return InOrder(std::move(found));
}

namespace {

/// Ways of at most three arcs in the place of a stretch of a path.
class Exchanging {
 public:
  Exchanging(const Arcs& arcs, const Leaving& out, std::span<const double> length,
             std::span<const std::int32_t> path)
      : arcs_(arcs), out_(out), length_(length), path_(path), met_(At(arcs.num_vertices), 0) {
    for (const std::int32_t a : path) {
      met_[At(arcs.tail[At(a)])] = met_[At(arcs.head[At(a)])] = 1;
      whole_ += length[At(a)];
    }
  }

  /// Of arcs [from, to) of the path.
  void Exchange(std::size_t from, std::size_t to) {
    from_ = from;
    to_ = to;
    kept_ = whole_;
    for (std::size_t k = from; k < to; ++k) kept_ -= length_[At(path_[k])];
    for (std::size_t k = from + 1; k < to; ++k) met_[At(arcs_.tail[At(path_[k])])] = 0;
    Extend(arcs_.tail[At(path_[from])]);
    for (std::size_t k = from + 1; k < to; ++k) met_[At(arcs_.tail[At(path_[k])])] = 1;
  }
  [[nodiscard]] Ranked found() && { return std::move(found_); }

 private:
  void Extend(std::int32_t v) {
    constexpr std::size_t kMost = 3;
    const std::int32_t end = arcs_.head[At(path_[to_ - 1])];
    for (const std::int32_t a : out_.Of(v)) {
      const std::int32_t w = arcs_.head[At(a)];
      if (!(length_[At(a)] < kInfinity) || (w != end && met_[At(w)] != 0)) continue;
      way_.push_back(a);
      if (w == end) {
        Take();
      } else if (way_.size() < kMost) {
        met_[At(w)] = 1;
        Extend(w);
        met_[At(w)] = 0;
      }
      way_.pop_back();
    }
  }

  // Where it begins or ends as the path does, a shorter stretch has the same.
  void Take() {
    if (way_.front() == path_[from_] || way_.back() == path_[to_ - 1]) return;
    std::vector<std::int32_t> other(path_.begin(), path_.begin() + Offset(from_));
    other.insert(other.end(), way_.begin(), way_.end());
    other.insert(other.end(), path_.begin() + Offset(to_), path_.end());
    double total = kept_;
    for (const std::int32_t a : way_) total += length_[At(a)];
    found_.emplace_back(total, std::move(other));
  }

  static std::ptrdiff_t Offset(std::size_t k) { return static_cast<std::ptrdiff_t>(k); }

  const Arcs& arcs_;
  const Leaving& out_;
  std::span<const double> length_;
  std::span<const std::int32_t> path_;
  std::vector<std::uint8_t> met_;
  double whole_ = 0, kept_ = 0;
  std::size_t from_ = 0, to_ = 0;
  std::vector<std::int32_t> way_;
  Ranked found_;
};

}  // namespace

std::vector<std::vector<std::int32_t>> Exchanges(const Arcs& arcs, const Leaving& out,
                                                 std::span<const double> length,
                                                 std::span<const std::int32_t> path) {
  constexpr std::size_t kMost = 3;  // arcs
  Exchanging exchanging(arcs, out, length, path);
  for (std::size_t from = 0; from < path.size(); ++from) {
    for (std::size_t to = from + 1; to <= std::min(path.size(), from + kMost); ++to) {
      exchanging.Exchange(from, to);
    }
  }
  return InOrder(std::move(exchanging).found());
}

}  // namespace switchyard::rounding
