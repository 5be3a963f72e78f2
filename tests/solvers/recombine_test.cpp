// Detours of a path along another one, over all pairs of paths of small graphs.
#include "solvers/rounding/recombine.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>

namespace switchyard::test {
namespace {

using Path = std::vector<std::int32_t>;

std::size_t At(std::int32_t i) { return static_cast<std::size_t>(i); }

struct Graph {
  explicit Graph(std::uint64_t seed) {
    std::mt19937_64 engine(seed);
    num_vertices = static_cast<std::int32_t>(4 + engine() % 3);
    for (int k = 0; k < 11; ++k) {  // loops and parallel arcs among them
      tail.push_back(static_cast<std::int32_t>(engine() % At(num_vertices)));
      head.push_back(static_cast<std::int32_t>(engine() % At(num_vertices)));
    }
    Path path;
    Extend(0, path);
  }
  [[nodiscard]] Arcs arcs() const { return {num_vertices, tail, head}; }
  /// Source, then the heads.
  [[nodiscard]] std::vector<std::int32_t> Along(const Path& path) const {
    std::vector<std::int32_t> along = {0};
    for (const std::int32_t a : path) along.push_back(head[At(a)]);
    return along;
  }
  void Extend(std::int32_t u, Path& path) {
    if (u == num_vertices - 1) return paths.push_back(path);
    const auto along = Along(path);
    for (std::int32_t a = 0; a < static_cast<std::int32_t>(tail.size()); ++a) {
      if (tail[At(a)] != u) continue;
      if (std::find(along.begin(), along.end(), head[At(a)]) != along.end()) continue;
      path.push_back(a);
      Extend(head[At(a)], path);
      path.pop_back();
    }
  }
  std::int32_t num_vertices = 0;
  std::vector<std::int32_t> tail, head;
  std::vector<Path> paths;  // simple, from 0 to the last vertex
};

/// Each part of `other` that has no more than its two ends on `path`, the second behind the first,
/// and is not an arc of it, in the place of what is between these.
std::set<Path> ByDefinition(const Graph& g, const Path& path, const Path& other) {
  const auto base = g.Along(path), along = g.Along(other);
  const auto place = [&](std::int32_t v) { return std::find(base.begin(), base.end(), v); };
  std::set<Path> all;
  for (std::size_t i = 0; i < along.size(); ++i) {
    for (std::size_t j = i + 1; j < along.size(); ++j) {
      const auto from = place(along[i]), to = place(along[j]);
      if (from == base.end() || to == base.end() || to <= from) continue;
      bool within = false;
      for (std::size_t k = i + 1; k < j; ++k) within = within || place(along[k]) != base.end();
      if (within) continue;
      Path made(path.begin(), path.begin() + (from - base.begin()));
      made.insert(made.end(), other.begin() + static_cast<std::ptrdiff_t>(i),
                  other.begin() + static_cast<std::ptrdiff_t>(j));
      made.insert(made.end(), path.begin() + (to - base.begin()), path.end());
      if (made != path) all.insert(made);
    }
  }
  return all;
}

TEST(Detours, AreThoseOfTheDefinitionAndSimplePaths) {
  std::size_t pairs = 0, made = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const Graph g(seed);
    const std::set<Path> simple(g.paths.begin(), g.paths.end());
    for (const Path& path : g.paths) {
      for (const Path& other : g.paths) {
        const auto detours = rounding::Detours(g.arcs(), path, other);
        const std::set<Path> distinct(detours.begin(), detours.end());
        EXPECT_EQ(distinct.size(), detours.size());
        EXPECT_EQ(distinct, ByDefinition(g, path, other));
        EXPECT_EQ(distinct.empty(), path == other);
        for (const Path& detour : detours) {
          EXPECT_EQ(simple.count(detour), 1u);
          for (const std::int32_t a : detour) {
            EXPECT_TRUE(std::count(path.begin(), path.end(), a) > 0 ||
                        std::count(other.begin(), other.end(), a) > 0);
          }
        }
        ++pairs;
        made += detours.size();
      }
    }
  }
  EXPECT_GT(pairs, 500u);
  EXPECT_GT(made, 500u);
}

TEST(Detours, OfNothingAreNone) {
  const Graph g(1);
  EXPECT_TRUE(rounding::Detours(g.arcs(), {}, {}).empty());
}

/// Of arcs; infinite: not to be used.
std::vector<double> RandomLengths(const Graph& g, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  std::vector<double> length;
  for (std::size_t a = 0; a < g.tail.size(); ++a) {
    length.push_back(engine() % 6 == 0 ? HUGE_VAL : 0.1 + 1e-3 * double(engine() % 1000));
  }
  return length;
}

double LengthOf(const std::vector<double>& length, const Path& path) {
  double sum = 0;
  for (const std::int32_t a : path) sum += length[At(a)];
  return sum;
}

/// For each place and other arc there: the shortest simple path that begins so.
TEST(Deviations, AreTheShortestPathsThatLeaveAPathThere) {
  std::size_t made = 0;
  for (std::uint64_t seed = 1; seed <= 800; ++seed) {
    const Graph g(seed);
    const std::vector<double> length = RandomLengths(g, seed);
    const Leaving out(g.arcs());
    for (const Path& path : g.paths) {
      if (LengthOf(length, path) == HUGE_VAL) continue;
      std::vector<double> shortest;  // by place and arc
      for (std::size_t k = 0; k < path.size(); ++k) {
        for (const std::int32_t a : out.Of(g.tail[At(path[k])])) {
          double best = HUGE_VAL;
          for (const Path& other : g.paths) {
            const bool begins =
                other.size() > k && other[k] == a && a != path[k] &&
                std::equal(path.begin(), path.begin() + std::ptrdiff_t(k), other.begin());
            if (begins) best = std::min(best, LengthOf(length, other));
          }
          if (best < HUGE_VAL) shortest.push_back(best);
        }
      }
      std::sort(shortest.begin(), shortest.end());
      const auto deviations = rounding::Deviations(g.arcs(), out, length, path, g.num_vertices - 1);
      ASSERT_EQ(deviations.size(), shortest.size());
      for (std::size_t k = 0; k < shortest.size(); ++k) {
        EXPECT_NEAR(LengthOf(length, deviations[k]), shortest[k], 1e-12);
        EXPECT_EQ(std::count(g.paths.begin(), g.paths.end(), deviations[k]), 1);
      }
      made += shortest.size();
    }
  }
  EXPECT_GT(made, 500u);
}

/// Simple paths that differ from one in a stretch of at most three arcs, by arcs that may be used,
/// by their lengths.
std::multimap<double, Path> ExchangesByDefinition(const Graph& g, const Path& path,
                                                  const std::vector<double>& length) {
  std::multimap<double, Path> all;
  for (const Path& other : g.paths) {
    const auto shorter = std::min(path.size(), other.size());
    std::size_t front = 0, back = 0;
    while (front < shorter && path[front] == other[front]) ++front;
    while (front + back < shorter && path[path.size() - 1 - back] == other[other.size() - 1 - back])
      ++back;
    if (other == path || std::max(path.size(), other.size()) - front - back > 3) continue;
    const double sum = LengthOf(length, other);
    if (sum < HUGE_VAL) all.emplace(sum, other);
  }
  return all;
}

TEST(Exchanges, AreThePathsThatDifferInAShortStretchTheShortestFirst) {
  std::size_t made = 0, turned = 0;
  for (std::uint64_t seed = 1; seed <= 800; ++seed) {
    const Graph g(seed);
    const std::vector<double> length = RandomLengths(g, seed);
    for (const Path& path : g.paths) {
      if (LengthOf(length, path) == HUGE_VAL) continue;
      const auto exchanges = rounding::Exchanges(g.arcs(), Leaving(g.arcs()), length, path);
      const auto expected = ExchangesByDefinition(g, path, length);
      std::set<Path> wanted, all(exchanges.begin(), exchanges.end());
      for (const auto& [sum, other] : expected) wanted.insert(other);
      EXPECT_EQ(all, wanted);
      ASSERT_EQ(exchanges.size(), expected.size());  // none twice
      auto next = expected.begin();
      for (const Path& other : exchanges) {
        EXPECT_NEAR(LengthOf(length, other), (next++)->first, 1e-12);
        auto along = g.Along(path), by_other = g.Along(other);
        std::sort(along.begin(), along.end());
        std::sort(by_other.begin(), by_other.end());
        turned += along == by_other && g.Along(path) != g.Along(other) ? 1 : 0;
      }
      made += exchanges.size();
    }
  }
  EXPECT_GT(made, 1000u);
  EXPECT_GT(turned, 5u);  // the same vertices in another order
}

}  // namespace
}  // namespace switchyard::test
