// Transitions: at which vertices they are counted, and that the program with them has the same
// paths, a relaxation that is no lower, and hints that say the truth.
#include "core/gcs/transitions.hpp"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <random>
#include <set>

#include "core/solve/check.hpp"
#include "tests/gcs/path_points.hpp"
#include "tests/gcs/set_grid.hpp"

namespace switchyard::testing {
namespace {

// Before the process's own host is made.
[[maybe_unused]] const int set_before_main =
    setenv("SWITCHYARD_PLUGIN_PATH", SWITCHYARD_PLUGIN_FOLDER, 1);

std::size_t At(std::int32_t i) { return static_cast<std::size_t>(i); }

PrunedGraph GraphOf(std::int32_t num_vertices,
                    const std::vector<std::pair<std::int32_t, std::int32_t>>& arcs) {
  PrunedGraph graph;
  graph.vertices.resize(At(num_vertices));
  for (const auto& [u, v] : arcs) {
    graph.tail.push_back(u);
    graph.head.push_back(v);
  }
  graph.source = 0;
  graph.target = num_vertices - 1;
  return graph;
}

/// Pairs (e, f) through v that do not turn back.
std::set<std::pair<std::int32_t, std::int32_t>> PairsAt(const PrunedGraph& g, std::int32_t v) {
  std::set<std::pair<std::int32_t, std::int32_t>> pairs;
  for (std::int32_t e = 0; e < static_cast<std::int32_t>(g.tail.size()); ++e) {
    for (std::int32_t f = 0; f < static_cast<std::int32_t>(g.tail.size()); ++f) {
      if (g.head[At(e)] != v || g.tail[At(f)] != v) continue;
      if (g.tail[At(e)] != g.head[At(f)]) pairs.emplace(e, f);
    }
  }
  return pairs;
}

std::int32_t Degree(const PrunedGraph& g, std::int32_t v) {
  return static_cast<std::int32_t>(std::count(g.tail.begin(), g.tail.end(), v) +
                                   std::count(g.head.begin(), g.head.end(), v));
}

void ExpectAsDefined(const PrunedGraph& g, const TransitionPlan& plan,
                     std::array<int, 3>& count_of_copy) {
  std::map<std::int32_t, std::set<std::pair<std::int32_t, std::int32_t>>> listed;
  for (const Transition& t : plan.all()) {
    EXPECT_TRUE(listed[t.vertex].emplace(t.in, t.out).second) << "twice";
  }
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(g.vertices.size()); ++v) {
    const auto pairs = PairsAt(g, v);
    EXPECT_EQ(listed[v], plan.At(v) ? pairs : decltype(pairs)());
    if (!plan.At(v)) continue;
    EXPECT_NE(v, g.source);
    EXPECT_NE(v, g.target);
    EXPECT_LE(static_cast<std::int32_t>(pairs.size()), Degree(g, v));
  }
  for (const Transition& t : plan.all()) {
    const std::size_t from = plan.From(At(t.in)).size(), to = plan.To(At(t.out)).size();
    EXPECT_GE(from, 1u);
    EXPECT_GE(to, 1u);
    using Copy = Transition::Copy;
    EXPECT_EQ(t.copy, to == 1 ? Copy::kOut : from == 1 ? Copy::kIn : Copy::kOwn);
    EXPECT_EQ(plan.OwnsTail(At(t.out)), to == 1);
    EXPECT_EQ(plan.OwnsHead(At(t.in)), from == 1 && t.copy == Copy::kIn);
    ++count_of_copy[static_cast<std::size_t>(t.copy)];
  }
}

TEST(TransitionPlan, CountsWhereTransitionsAreFewEachOnceAndNeverBack) {
  std::mt19937_64 engine(1);
  std::array<int, 3> count_of_copy{};
  int counted = 0, not_counted = 0;
  for (int draw = 0; draw < 300; ++draw) {
    const auto n = static_cast<std::int32_t>(3 + engine() % 6);
    std::vector<std::pair<std::int32_t, std::int32_t>> arcs;
    for (std::uint64_t k = engine() % 20 + 2; k > 0; --k) {
      const auto u = static_cast<std::int32_t>(engine() % static_cast<std::uint64_t>(n));
      const auto v = static_cast<std::int32_t>(engine() % static_cast<std::uint64_t>(n));
      if (u != v) arcs.emplace_back(u, v);
    }
    const PrunedGraph g = GraphOf(n, arcs);
    const TransitionPlan plan(g, true);
    ExpectAsDefined(g, plan, count_of_copy);
    for (std::int32_t v = 1; v + 1 < n; ++v) {
      ++(plan.At(v) ? counted : not_counted);
      const auto pairs = PairsAt(g, v);
      std::set<std::int32_t> met;
      for (const auto& [e, f] : pairs) met.insert({e, f});
      const bool all_met = static_cast<std::int32_t>(met.size()) == Degree(g, v);
      const bool few = static_cast<std::int32_t>(pairs.size()) <= Degree(g, v);
      EXPECT_EQ(plan.At(v), !pairs.empty() && all_met && few);  // degrees are small here
    }
  }
  for (const int count : count_of_copy) EXPECT_GT(count, 20);
  EXPECT_GT(counted, 100);
  EXPECT_GT(not_counted, 100);
}

TEST(TransitionPlan, LeavesAVertexOfManyTransitionsItsForm) {
  std::vector<std::pair<std::int32_t, std::int32_t>> arcs = {{0, 1}, {1, 12}};
  for (std::int32_t w = 2; w < 12; ++w) {
    arcs.emplace_back(1, w);
    arcs.emplace_back(w, 1);
  }
  const TransitionPlan plan(GraphOf(13, arcs), true);
  EXPECT_FALSE(plan.At(1));
  EXPECT_TRUE(plan.all().empty());
  for (std::size_t a = 0; a < arcs.size(); ++a) {
    EXPECT_TRUE(plan.OwnsHead(a) && plan.OwnsTail(a));
  }
}

TEST(TransitionPlan, CountsNoneWhereItMayNot) {
  const PrunedGraph g = GraphOf(3, {{0, 1}, {1, 2}});
  EXPECT_EQ(TransitionPlan(g, true).all().size(), 1u);
  EXPECT_TRUE(TransitionPlan(g, false).all().empty());
}

const std::vector<SetKind> kWithoutOwn = {SetKind::kBox, SetKind::kPolyhedron, SetKind::kEllipsoid,
                                          SetKind::kPoint, SetKind::kNothing};
const std::vector<SetKind> kLinear = {SetKind::kBox, SetKind::kPolyhedron, SetKind::kVPolytope,
                                      SetKind::kPoint, SetKind::kNothing};

struct Case {
  EdgeCost cost;
  bool linear;
};

class WithTransitions : public ::testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    const char* needed = GetParam().linear ? "highs" : "clarabel";
    if (host.Find(needed) == nullptr) GTEST_SKIP() << needed << " is not built";
  }
  [[nodiscard]] SetGrid Graph(unsigned seed, double size = 0.7) const {
    return {3, 3, GetParam().linear ? kLinear : kWithoutOwn, GetParam().cost, seed, size};
  }
  Host& host = Host::Default();
};
INSTANTIATE_TEST_SUITE_P(Costs, WithTransitions,
                         ::testing::Values(Case{EdgeCost::kLinear, true}, Case{EdgeCost::kL1, true},
                                           Case{EdgeCost::kL2, false},
                                           Case{EdgeCost::kSquared, false}));

TEST_P(WithTransitions, EveryPathWithPointsInItsSetsIsAPointOfTheProgram) {
  std::size_t own = 0;
  for (unsigned seed = 1; seed <= 6; ++seed) {
    SetGrid graph = Graph(seed);
    const Transcribed t(graph);
    if (!t.pruned.why_no_path.empty()) continue;
    own += At(t.blocks().num_blocks) - t.pruned.edges.size();
    for (const auto& path : graph.Paths()) {
      const auto arcs = t.ArcsOf(path);
      ASSERT_FALSE(arcs.empty()) << "an edge of a simple path was pruned";
      std::vector<Eigen::VectorXd> points = graph.PointsOn(path);
      std::vector<double> x = PointOfPath(host, t, arcs, points);
      ASSERT_LE(RelativeViolation(t.view(), x), 1e-9) << "seed " << seed;
      EXPECT_GE(t.program.CostOf(arcs, x), 0);
      EXPECT_NEAR(t.program.CostOf(arcs, x), Objective(t.view(), x.data()), 1e-9);
    }
  }
  EXPECT_GT(own, 20u);
}

TEST_P(WithTransitions, APointOutsideASetOnThePathIsNone) {
  SetGrid graph(3, 3, {SetKind::kBox, SetKind::kPolyhedron}, GetParam().cost, 3);
  const Transcribed t(graph);
  for (const auto& path : graph.Paths()) {
    const auto arcs = t.ArcsOf(path);
    for (std::size_t k = 1; k < path.size(); ++k) {
      std::vector<Eigen::VectorXd> points = graph.PointsOn(path);
      points[k] += Eigen::Vector2d(0, 4);
      EXPECT_GT(RelativeViolation(t.view(), PointOfPath(host, t, arcs, points)), 1e-3);
    }
  }
}

TEST_P(WithTransitions, TheRelaxationIsNoLowerAndBelowEveryPath) {
  int higher = 0;
  for (unsigned seed = 1; seed <= 6; ++seed) {
    SetGrid graph = Graph(seed, 1.4);
    const Transcribed with(graph), without(graph, false);
    if (!with.pruned.why_no_path.empty()) continue;
    const Solved high = SolvedBy(host, with.view()), low = SolvedBy(host, without.view());
    ASSERT_EQ(high.termination, SY_OPTIMAL);
    ASSERT_EQ(low.termination, SY_OPTIMAL);
    const double tolerance = 1e-5 * (1 + std::abs(high.objective));
    EXPECT_GE(high.objective, low.objective - tolerance) << "seed " << seed;
    if (high.objective > low.objective + 10 * tolerance) ++higher;
    double best = kInfinity;
    for (const auto& path : graph.Paths()) {
      const auto alone = graph.graph.SolveConvexRestriction(path);
      if (alone.is_success()) best = std::min(best, alone.objective);
    }
    EXPECT_LE(high.objective, best + tolerance) << "seed " << seed;
  }
  if (GetParam().cost == EdgeCost::kSquared) {
    EXPECT_GT(higher, 0);
  }
}

TEST_P(WithTransitions, FlowsFixedToAPathLeaveItsRestriction) {
  SetGrid graph = Graph(2);
  for (const bool transitions : {true, false}) {
    const Transcribed t(graph, transitions);
    for (const auto& path : graph.Paths()) {
      Problem fixed = t.program.problem();
      fixed.Change([&](ProblemData& d) {
        for (std::size_t a = 0; a < t.pruned.edges.size(); ++a) {
          const bool on = std::find(path.begin(), path.end(), t.pruned.edges[a]) != path.end();
          d.x_lower[At(t.program.flow(a))] = d.x_upper[At(t.program.flow(a))] = on ? 1 : 0;
        }
      });
      const Solved whole = SolvedBy(host, fixed.view());
      const auto alone = graph.graph.SolveConvexRestriction(path);
      ASSERT_TRUE(alone.is_success()) << alone.message;
      ASSERT_EQ(whole.termination, SY_OPTIMAL);
      EXPECT_NEAR(whole.objective, alone.objective, 1e-5 * (1 + std::abs(alone.objective)));
    }
  }
}

/// A row, or cone, of block b holds only variables of b, and has no constant.
void ExpectWithinBlocks(const sy_csc& columns, const std::int32_t* of_x,
                        const std::vector<std::int32_t>& of_row) {
  for (std::int32_t j = 0; j < columns.cols; ++j) {
    for (std::int32_t k = columns.start[j]; k < columns.start[j + 1]; ++k) {
      const std::int32_t row = of_row[At(columns.row[k])];
      EXPECT_TRUE(row == -1 || row == of_x[j]);
    }
  }
}

TEST_P(WithTransitions, BlocksAndScalesAreWhatTheHintsSay) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    const SetGrid graph = Graph(seed);
    const Transcribed t(graph);
    if (!t.pruned.why_no_path.empty()) continue;
    const ProblemData& d = t.data();
    const sy_blocks& blocks = t.blocks();
    const sy_paths& paths = t.paths();
    ExpectWithinBlocks(d.A.View(), blocks.x, {blocks.row, blocks.row + d.num_rows()});
    std::vector<std::int32_t> of_cone_row;
    for (std::size_t c = 0; c < d.cones.size(); ++c) {
      of_cone_row.insert(of_cone_row.end(), At(d.cones[c].dim), blocks.cone[c]);
    }
    ExpectWithinBlocks(d.F.View(), blocks.x, of_cone_row);
    for (std::int32_t i = 0; i < d.num_rows(); ++i) {
      if (blocks.row[i] < 0) continue;
      EXPECT_TRUE(d.row_lower[At(i)] == 0 || d.row_lower[At(i)] == -kInfinity);
      EXPECT_TRUE(d.row_upper[At(i)] == 0 || d.row_upper[At(i)] == kInfinity);
    }
    for (const double g : d.g) EXPECT_EQ(g, 0);
    EXPECT_EQ(d.P.nonzeros(), 0);
    for (std::int32_t b = 0; b < blocks.num_blocks; ++b) {
      EXPECT_EQ(blocks.x[paths.scale[b]], b);
      const std::int32_t in = paths.arc_in[b], out = paths.arc_out[b];
      if (b < paths.num_arcs) {
        EXPECT_TRUE(in == b && out == b && paths.scale[b] == paths.flow[b]);
        EXPECT_EQ(d.integer[At(paths.flow[b])], 1);
      } else {
        EXPECT_EQ(paths.head[in], paths.tail[out]);
        EXPECT_NE(paths.tail[in], paths.head[out]);
        EXPECT_EQ(d.integer[At(paths.scale[b])], 0);
        EXPECT_EQ(d.x_lower[At(paths.scale[b])], 0);
        EXPECT_EQ(d.x_upper[At(paths.scale[b])], 1);
      }
    }
  }
}

// Bounds of all but flows and scales are implied, so the relaxation is the same without them.
TEST_P(WithTransitions, BoundsBesideScalesAreImplied) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const SetGrid graph = Graph(seed);
    const Transcribed t(graph);
    if (!t.pruned.why_no_path.empty()) continue;
    Problem open = t.program.problem();
    open.Change([&](ProblemData& d) {
      std::set<std::int32_t> scales(t.paths().scale, t.paths().scale + t.blocks().num_blocks);
      for (std::int32_t j = 0; j < d.num_vars; ++j) {
        if (scales.count(j) > 0) continue;
        d.x_lower[At(j)] = -kInfinity;
        d.x_upper[At(j)] = kInfinity;
      }
    });
    const double bounded = SolvedBy(host, t.view()).objective;
    EXPECT_NEAR(SolvedBy(host, open.view()).objective, bounded, 1e-5 * (1 + std::abs(bounded)));
  }
}

}  // namespace
}  // namespace switchyard::testing
