// relax-and-round where the front end solves paths itself: whom it asks, in what order, from where,
// and what it leaves out.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/solvers/grid_graph.hpp"

namespace switchyard::test {
namespace {

using Path = std::vector<std::int32_t>;

/// Asks for `extra` times the arcs' numbers, taken by their residues, on top of what dropping
/// blocks gives: never less.
struct FrontEnd {
  const GridGraph* graph = nullptr;
  double extra = 0;
  std::vector<Path> asked;
  std::vector<double> estimates;
  double best = kInfinity;
  bool starts_hold = true;

  static double Toll(const Path& path) {
    std::int32_t sum = 0;
    for (const std::int32_t a : path) sum += a % 5;
    return sum;
  }
  static sy_status Solve(void* context, const std::int32_t* arcs, std::int32_t count,
                         const sy_control*, sy_result* r, sy_error*) noexcept {
    auto& self = *static_cast<FrontEnd*>(context);
    const Path path(arcs, arcs + count);
    self.asked.push_back(path);
    self.estimates.push_back(r->relaxed);
    if (r->relaxed_x != nullptr) self.Check(path, *r);
    r->termination = SY_LOCALLY_OPTIMAL;
    r->primal = SY_FEASIBLE;
    r->objective = r->relaxed + self.extra * Toll(path);
    self.best = std::min(self.best, r->objective);
    return SY_OK;
  }

  /// The point is on the path, and costs what is said.
  void Check(const Path& path, const sy_result& r) {
    const sy_problem& p = graph->view();
    double flow = 0;
    for (const std::int32_t a : path) flow += r.relaxed_x[flow_of[static_cast<std::size_t>(a)]];
    const double size = 1 + std::abs(r.relaxed);
    starts_hold = starts_hold && flow == static_cast<double>(path.size()) &&
                  std::abs(Objective(p, r.relaxed_x) - r.relaxed) <= 1e-6 * size;
  }
  std::vector<std::int32_t> flow_of;
};

class OwnRestrictions : public testing::Test {
 protected:
  void SetUp() override {
    if (host_->Find("clarabel") == nullptr) GTEST_SKIP() << "clarabel was not built";
  }

  StrategyAnswer Ask(GridGraph& graph, FrontEnd& front_end, bool bounds, int paths,
                     int threads = 1) {
    return Ask(graph, front_end, bounds, paths, Unlimited(threads));
  }
  StrategyAnswer Ask(GridGraph& graph, FrontEnd& front_end, bool bounds, int paths,
                     const sy_control& control) {
    front_end.graph = &graph;
    front_end.flow_of.assign(graph.paths().flow, graph.paths().flow + graph.paths().num_arcs);
    graph.paths().context = &front_end;
    graph.paths().solve_path = FrontEnd::Solve;
    graph.paths().flags = bounds ? SY_PATHS_BOUND : 0;
    return RelaxAndRoundOn(*host_, graph.view(),
                           {"paths=" + std::to_string(paths), "trials=1000", "flow_tolerance=0"},
                           control);
  }

  std::unique_ptr<Host> host_ = HostWith({"clarabel"});
};

TEST_F(OwnRestrictions, BeginWithTheCheapestByDroppingBlocksAndAtItsPoint) {
  GridGraph graph(4, 3, EdgeCost::kOneNorm, 7);
  FrontEnd front_end;
  front_end.extra = 0.01;
  ASSERT_EQ(Ask(graph, front_end, false, 3).status, SY_OK);
  ASSERT_GE(front_end.asked.size(), 3u);
  EXPECT_TRUE(std::is_sorted(front_end.estimates.begin(), front_end.estimates.begin() + 3));
  EXPECT_TRUE(front_end.starts_hold);
  for (std::size_t k = 0; k < front_end.asked.size(); ++k) {
    const double alone = OptimumBy(*host_, graph.FixedTo(front_end.asked[k]).view());
    EXPECT_NEAR(front_end.estimates[k], alone, 1e-6 * (1 + std::abs(alone)));
  }
}

TEST_F(OwnRestrictions, AreNotAskedForWhereTheyCannotBeBetterThanTheBest) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    GridGraph graph(4, 3, EdgeCost::kOneNorm, seed);
    FrontEnd all, some;
    all.extra = some.extra = 0.01;
    const StrategyAnswer plain = Ask(graph, all, false, 12);
    const StrategyAnswer bounded = Ask(graph, some, true, 12);
    if (plain.result.termination == SY_INFEASIBLE) continue;
    EXPECT_LE(some.asked.size(), all.asked.size());
    EXPECT_EQ(bounded.result.objective, some.best);
    EXPECT_LE(bounded.result.objective, plain.result.objective + 1e-9);
    double before = kInfinity;  // the best of those that were asked for earlier
    for (std::size_t k = 0; k < some.asked.size(); ++k) {
      EXPECT_LT(some.estimates[k], before);
      before = std::min(before, some.estimates[k] + some.extra * FrontEnd::Toll(some.asked[k]));
    }
  }
}

TEST_F(OwnRestrictions, AreAskedForOnceWhereTheyCostNoMore) {
  GridGraph graph(4, 3, EdgeCost::kOneNorm, 7);
  FrontEnd front_end;  // what dropping blocks gives is what paths cost
  const StrategyAnswer answer = Ask(graph, front_end, true, 40);
  ASSERT_EQ(answer.status, SY_OK) << answer.error;
  EXPECT_EQ(front_end.asked.size(), 1u) << answer.text;
  const double best = BestPath(*host_, graph);
  EXPECT_NEAR(answer.result.objective, best, 1e-6 * (1 + std::abs(best)));
}

TEST_F(OwnRestrictions, HaveTheSameBestForAnyNumberOfThreads) {
  for (const bool bounds : {false, true}) {
    GridGraph graph(4, 4, EdgeCost::kOneNorm, 3);
    double best = 0;
    for (const int threads : {1, 3, 8}) {
      FrontEnd front_end;
      front_end.extra = 0.01;
      const StrategyAnswer answer = Ask(graph, front_end, bounds, 5, threads);
      if (threads == 1) best = answer.result.objective;
      EXPECT_EQ(answer.result.objective, best);
    }
  }
}

TEST_F(OwnRestrictions, OfAPathThatHasNoPointAreAskedForOnlyWhereThatProvesNothing) {
  GridGraph graph(3, 3, EdgeCost::kOneNorm, 7);
  const auto must = graph.paths().num_arcs / 2;  // paths without this arc have no point
  graph.problem().Change(
      [&](ProblemData& d) { d.x_lower[static_cast<std::size_t>(graph.paths().flow[must])] = 1; });
  for (const bool bounds : {false, true}) {
    FrontEnd front_end;
    ASSERT_EQ(Ask(graph, front_end, bounds, 50).status, SY_OK);
    ASSERT_FALSE(front_end.asked.empty());
    for (const Path& path : front_end.asked) {
      if (bounds) {
        EXPECT_EQ(std::count(path.begin(), path.end(), must), 1);
      }
    }
  }
}

TEST_F(OwnRestrictions, ThatAreCancelledAtAnyPointAreNoProofThatThereIsNoPath) {
  struct Watch {
    int calls = 0, last = 0;
  };
  int cancelled = 0;
  for (int last = 0; last < 400; last += 7) {
    GridGraph graph(3, 3, EdgeCost::kOneNorm, 7);
    FrontEnd front_end;
    front_end.extra = 0.01;
    Watch watch{0, last};
    sy_control control = Unlimited();
    control.context = &watch;
    control.cancelled = [](void* context) noexcept -> std::int32_t {
      auto& w = *static_cast<Watch*>(context);
      return ++w.calls > w.last ? 1 : 0;
    };
    const StrategyAnswer answer = Ask(graph, front_end, true, 5, control);
    ASSERT_EQ(answer.status, SY_OK) << answer.error;
    const bool ended = watch.calls <= last;
    cancelled += ended ? 0 : 1;
    EXPECT_EQ(answer.result.termination, ended ? SY_LOCALLY_OPTIMAL : SY_CANCELLED) << answer.text;
    if (!front_end.asked.empty()) {
      EXPECT_EQ(answer.result.objective, front_end.best);
    }
  }
  EXPECT_GT(cancelled, 3);
}

}  // namespace
}  // namespace switchyard::test
