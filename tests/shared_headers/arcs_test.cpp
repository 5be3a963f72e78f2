// Graphs of arcs against brute force: useful arcs, dominators, distances, the sampling walk.
#include "switchyard/arcs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

namespace switchyard {
namespace {

using Path = std::vector<std::int32_t>;

struct Graph {
  std::int32_t num_vertices = 0;
  std::vector<std::int32_t> tail, head;
  [[nodiscard]] Arcs arcs() const { return {num_vertices, tail, head}; }
  void Add(std::int32_t u, std::int32_t v) {
    tail.push_back(u);
    head.push_back(v);
  }
};

/// Loops and parallel arcs among them.
Graph RandomGraph(Random& random, std::int32_t vertices, int arcs) {
  Graph g{vertices, {}, {}};
  const auto draw = [&] { return static_cast<std::int32_t>(random.Uniform() * vertices); };
  for (int a = 0; a < arcs; ++a) {
    const std::int32_t u = draw();
    g.Add(u, draw());
  }
  return g;
}

void Extend(const Graph& g, std::int32_t u, std::int32_t target, std::vector<bool>& visited,
            Path& path, std::set<Path>& all) {
  if (u == target) {
    all.insert(path);
    return;
  }
  visited[static_cast<std::size_t>(u)] = true;
  for (std::size_t a = 0; a < g.tail.size(); ++a) {
    if (g.tail[a] != u || visited[static_cast<std::size_t>(g.head[a])]) continue;
    path.push_back(static_cast<std::int32_t>(a));
    Extend(g, g.head[a], target, visited, path, all);
    path.pop_back();
  }
  visited[static_cast<std::size_t>(u)] = false;
}

std::set<Path> SimplePaths(const Graph& g, std::int32_t source, std::int32_t target) {
  std::set<Path> all;
  Path path;
  std::vector<bool> visited(static_cast<std::size_t>(g.num_vertices), false);
  Extend(g, source, target, visited, path, all);
  return all;
}

TEST(UsefulArcs, WhatGoesIsOnNoSimplePath) {
  Random random(1);
  int gone = 0, exact = 0, graphs = 400;
  for (int k = 0; k < graphs; ++k) {
    const Graph g = RandomGraph(random, 7, 6 + k % 12);
    const auto keep = UsefulArcs(g.arcs(), 0, 1);
    std::vector<std::uint8_t> on_path(g.tail.size(), 0);
    for (const Path& path : SimplePaths(g, 0, 1)) {
      for (const auto a : path) on_path[static_cast<std::size_t>(a)] = 1;
    }
    for (std::size_t a = 0; a < keep.size(); ++a) {
      EXPECT_LE(on_path[a], keep[a]) << "arc " << a << " of graph " << k;
      gone += keep[a] == 0;
    }
    exact += keep == on_path;
  }
  EXPECT_GT(gone, graphs);
  EXPECT_GT(exact, graphs * 9 / 10);  // the rest needs disjoint paths, not walks
}

TEST(UsefulArcs, OneMoreRoundChangesNothing) {
  Random random(2);
  for (int k = 0; k < 100; ++k) {
    const Graph g = RandomGraph(random, 30, 70);
    const auto keep = UsefulArcs(g.arcs(), 0, 1);
    Graph kept{g.num_vertices, {}, {}};
    for (std::size_t a = 0; a < keep.size(); ++a) {
      if (keep[a] != 0) kept.Add(g.tail[a], g.head[a]);
    }
    const auto again = UsefulArcs(kept.arcs(), 0, 1);
    EXPECT_EQ(std::count(again.begin(), again.end(), 0), 0);
  }
}

TEST(UsefulArcs, AQuarterOfAMillionArcsTakeNoTimeEvenInALongCorridor) {
  Graph g{100000, {}, {}};
  for (std::int32_t v = 0; v + 2 < g.num_vertices; ++v) {
    g.Add(v, v + 1);
    g.Add(v, v + 2);
    g.Add(v + 1, v);
  }
  const auto keep = UsefulArcs(g.arcs(), 0, g.num_vertices - 1);
  EXPECT_GT(std::count(keep.begin(), keep.end(), 1), 2 * 99000);
}

TEST(UsefulArcs, OneVertexIsAPathWithoutArcs) {
  Graph g{2, {}, {}};
  g.Add(0, 1);
  g.Add(1, 0);
  EXPECT_EQ(UsefulArcs(g.arcs(), 0, 0), (std::vector<std::uint8_t>{0, 0}));
}

TEST(Dominators, AreTheVerticesWithoutWhichNoWalkArrives) {
  Random random(3);
  for (int k = 0; k < 100; ++k) {
    const Graph g = RandomGraph(random, 9, 20);
    const Leaving out(g.arcs()), in(Reversed(g.arcs()));
    const Dominators d(g.arcs(), out, in, 0);
    const auto reached = Reached(g.arcs(), out, 0);
    for (std::int32_t v = 0; v < g.num_vertices; ++v) {
      ASSERT_EQ(d.Reached(v), reached[static_cast<std::size_t>(v)] != 0);
      for (std::int32_t u = 1; u < g.num_vertices && d.Reached(v); ++u) {
        if (!d.Reached(u)) continue;
        std::vector<std::uint8_t> without(g.tail.size());
        for (std::size_t a = 0; a < without.size(); ++a) without[a] = g.tail[a] != u;
        const auto still = Reached(g.arcs(), Leaving(g.arcs(), without), 0);
        EXPECT_EQ(d.Dominate(u, v), u == v || still[static_cast<std::size_t>(v)] == 0);
      }
    }
  }
}

TEST(Distances, AreThoseOfTheShortestSimplePathWhereNoCycleIsNegative) {
  Random random(4);
  int negative = 0;
  for (int k = 0; k < 300; ++k) {
    const Graph g = RandomGraph(random, 6, 14);
    std::vector<double> length;
    for (std::size_t a = 0; a < g.tail.size(); ++a) {
      length.push_back(std::floor(random.Uniform() * 10) - (k % 2 == 0 ? 0 : 1));
    }
    const Leaving out(g.arcs());
    const ShortestWalks walks = WalksOfAnySign(g.arcs(), out, length, 0);
    if (!walks.negative_cycle.empty()) {
      ++negative;
      double sum = 0;
      std::int32_t at = g.tail[static_cast<std::size_t>(walks.negative_cycle.front())];
      for (const auto a : walks.negative_cycle) {
        EXPECT_EQ(g.tail[static_cast<std::size_t>(a)], at);
        at = g.head[static_cast<std::size_t>(a)];
        sum += length[static_cast<std::size_t>(a)];
      }
      EXPECT_EQ(at, g.tail[static_cast<std::size_t>(walks.negative_cycle.front())]);
      EXPECT_LT(sum, 0);
      continue;
    }
    if (k % 2 == 0) {
      EXPECT_EQ(Distances(g.arcs(), out, length, 0), walks.distance);
    }
    for (std::int32_t v = 1; v < g.num_vertices; ++v) {
      double least = std::numeric_limits<double>::infinity();
      for (const Path& path : SimplePaths(g, 0, v)) {
        double sum = 0;
        for (const auto a : path) sum += length[static_cast<std::size_t>(a)];
        least = std::min(least, sum);
      }
      EXPECT_EQ(walks.distance[static_cast<std::size_t>(v)], least);
    }
  }
  EXPECT_GT(negative, 5);
}

TEST(SamplePath, IsSimpleAndUsesNoArcAtOrBelowTheTolerance) {
  Random random(5);
  for (int k = 0; k < 300; ++k) {
    const Graph g = RandomGraph(random, 8, 18);
    std::vector<double> flow;
    Graph open{g.num_vertices, {}, {}};
    for (std::size_t a = 0; a < g.tail.size(); ++a) {
      flow.push_back(random.Uniform());
      if (flow.back() > 0.4) open.Add(g.tail[a], g.head[a]);
    }
    const auto path = SamplePath(g.arcs(), Leaving(g.arcs()), flow, 0.4, 0, 1, random);
    EXPECT_EQ(path.has_value(), !SimplePaths(open, 0, 1).empty());
    if (!path) continue;
    EXPECT_TRUE(SimplePaths(g, 0, 1).contains(*path));
    for (const auto a : *path) EXPECT_GT(flow[static_cast<std::size_t>(a)], 0.4);
  }
}

TEST(SamplePath, ParallelArcsAreDrawnAsTheirFlowsSayAndASeedGivesTheSameAgain) {
  Graph g{2, {}, {}};
  for (int a = 0; a < 3; ++a) g.Add(0, 1);
  const std::vector<double> flow = {0.2, 0.5, 0.3};
  std::map<Path, int> count;
  Random random(6), same(6);
  for (int k = 0; k < 10000; ++k) {
    const auto path = SamplePath(g.arcs(), Leaving(g.arcs()), flow, 1e-5, 0, 1, random);
    EXPECT_EQ(path, SamplePath(g.arcs(), Leaving(g.arcs()), flow, 1e-5, 0, 1, same));
    ++count[*path];
  }
  EXPECT_NEAR(count[{0}], 2000, 200);
  EXPECT_NEAR(count[{1}], 5000, 250);
  EXPECT_NEAR(count[{2}], 3000, 250);
}

TEST(SamplePath, FromTheTargetIsThePathWithoutArcs) {
  const Graph g{1, {}, {}};
  Random random(7);
  EXPECT_EQ(SamplePath(g.arcs(), Leaving(g.arcs()), {}, 1e-5, 0, 0, random), Path());
}

}  // namespace
}  // namespace switchyard
