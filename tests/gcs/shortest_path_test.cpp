// A shortest path through backends of the host, checked against every simple path.
#include "switchyard/gcs/shortest_path.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "tests/gcs/grid.hpp"

namespace switchyard::testing {
namespace {

using Edge = GraphOfConvexSets::Edge;
using Transcription = GraphOfConvexSets::Transcription;

// Before the process's own host is made.
[[maybe_unused]] const int set_before_main =
    setenv("SWITCHYARD_PLUGIN_PATH", SWITCHYARD_PLUGIN_FOLDER, 1);

struct Case {
  const char* backend;
  EdgeCost cost;
};

class ShortestPaths : public ::testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    for (const char* name : {GetParam().backend, "relax-and-round"}) {
      if (Host::Default().Find(name) == nullptr) GTEST_SKIP() << name << " is not built";
    }
    options.solver = &solver;
  }
  SolverInterface solver{GetParam().backend};
  GraphOfConvexSetsOptions options;
};

TEST_P(ShortestPaths, HaveABoundBelowAndAPathAmongAllPaths) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    const bool balls = GetParam().cost == EdgeCost::kL2;
    const Grid grid(3, GetParam().cost, seed, balls);
    double best = kInfinity;
    for (const auto& path : SimplePaths(grid.source(), grid.target())) {
      const auto restriction = grid.graph.SolveConvexRestriction(path, options);
      ASSERT_TRUE(restriction.is_success()) << restriction.message;
      best = std::min(best, restriction.objective);
    }
    const ShortestPath found = FindShortestPath(grid.graph, grid.source(), grid.target(), options);
    ASSERT_EQ(found.result.primal, PointKind::kFeasible) << found.result.message;
    EXPECT_LE(found.result.bound, best + 1e-9);
    EXPECT_GE(found.result.objective, best - 1e-6 * (1 + std::abs(best)));
    EXPECT_LE(found.result.objective, 1.2 * best + 1e-6);  // one of ten sampled paths is not far
    ASSERT_EQ(found.points.size(), found.edges.size() + 1);
    EXPECT_EQ(&found.edges.front()->u(), &grid.source());
    EXPECT_EQ(&found.edges.back()->v(), &grid.target());
    for (std::size_t k = 0; k < found.edges.size(); ++k) {
      EXPECT_LE(found.edges[k]->v().set().Violation(found.points[k + 1]), 1e-6);
    }
  }
}

TEST_P(ShortestPaths, ReadTheirSolutionInTheGraphsTerms) {
  const Grid grid(3, GetParam().cost, 5);
  const ShortestPath found = FindShortestPath(grid.graph, grid.source(), grid.target(), options);
  ASSERT_EQ(found.result.primal, PointKind::kFeasible) << found.result.message;
  EXPECT_EQ(grid.graph.GetSolutionPath(grid.source(), grid.target(), found.result), found.edges);
  double cost = 0;
  for (const Edge* edge : grid.graph.Edges()) cost += *edge->GetSolutionCost(found.result);
  EXPECT_NEAR(cost, found.result.objective, 1e-9 * (1 + std::abs(cost)));
  for (std::size_t k = 0; k < found.edges.size(); ++k) {
    EXPECT_EQ(*found.edges[k]->u().GetSolution(found.result), found.points[k]);
    EXPECT_EQ(*found.edges[k]->GetSolutionPhiXu(found.result), found.points[k]);
    EXPECT_EQ(found.result.GetSolution(found.edges[k]->phi()), 1);
  }
  int off = 0;
  for (const GraphOfConvexSets::Vertex* v : grid.graph.Vertices()) {
    off += v->GetSolution(found.result).has_value() ? 0 : 1;
  }
  EXPECT_EQ(off, 9 - static_cast<int>(found.points.size()));
}

TEST_P(ShortestPaths, GiveTheRelaxationAlone) {
  const Grid grid(3, GetParam().cost, 6);
  const ShortestPath rounded = FindShortestPath(grid.graph, grid.source(), grid.target(), options);
  options.max_rounded_paths = 0;
  const ShortestPath relaxed = FindShortestPath(grid.graph, grid.source(), grid.target(), options);
  EXPECT_EQ(relaxed.result.termination, Termination::kOptimal) << relaxed.result.message;
  EXPECT_NEAR(relaxed.result.objective, relaxed.result.bound,
              1e-6 * (1 + std::abs(relaxed.result.bound)));
  EXPECT_LE(relaxed.result.objective, rounded.result.objective + 1e-6);
  EXPECT_TRUE(relaxed.edges.empty());
  double cost = 0;
  double out = 0;
  for (const Edge* edge : grid.graph.Edges()) {
    cost += *edge->GetSolutionCost(relaxed.result);
    if (&edge->u() == &grid.source()) out += relaxed.result.GetSolution(edge->phi());
  }
  EXPECT_NEAR(out, 1, 1e-6);
  EXPECT_NEAR(cost, relaxed.result.objective, 1e-5 * (1 + std::abs(cost)));
}

TEST_P(ShortestPaths, AreTheSameForAnyNumberOfThreads) {
  const Grid grid(4, GetParam().cost, 7);
  std::vector<double> objectives;
  for (const int threads : {1, 2, 5}) {
    options.parallelism = Parallelism(threads);
    const ShortestPath found = FindShortestPath(grid.graph, grid.source(), grid.target(), options);
    objectives.push_back(found.result.objective);
    ASSERT_FALSE(found.rounded.empty());
  }
  EXPECT_EQ(objectives[0], objectives[1]);
  EXPECT_EQ(objectives[0], objectives[2]);
}

TEST_P(ShortestPaths, CountATermOfTheRestrictionInThePathAlone) {
  Grid grid(3, GetParam().cost, 8);
  const auto fee = std::make_shared<LinearCost>(Eigen::VectorXd(), 5.0);
  for (Edge* edge : grid.graph.Edges()) {
    edge->AddCost(Binding<Cost>(fee, VectorXDecisionVariable()), {Transcription::kRestriction});
  }
  const ShortestPath found = FindShortestPath(grid.graph, grid.source(), grid.target(), options);
  ASSERT_EQ(found.result.primal, PointKind::kFeasible) << found.result.message;
  const double fees = 5.0 * static_cast<double>(found.edges.size());
  EXPECT_GE(found.result.objective, fees);
  EXPECT_LE(found.result.bound, found.result.objective - fees + 1e-6);
}

std::string NameOf(const ::testing::TestParamInfo<Case>& which) {
  constexpr const char* kNames[] = {"L1", "L2", "Squared", "Linear"};
  return which.param.backend + std::string(kNames[static_cast<int>(which.param.cost)]);
}
INSTANTIATE_TEST_SUITE_P(Backends, ShortestPaths,
                         ::testing::Values(Case{"clp", EdgeCost::kLinear},
                                           Case{"clp", EdgeCost::kL1},
                                           Case{"clarabel", EdgeCost::kL2},
                                           Case{"clarabel", EdgeCost::kSquared}),
                         NameOf);

class WithoutABackend : public ::testing::Test {};

TEST_F(WithoutABackend, AnUnreachableTargetIsInfeasibleWithoutASolver) {
  Grid grid(2, EdgeCost::kL2, 1);
  for (Edge* edge : grid.graph.Edges()) {
    if (&edge->v() == &grid.target()) grid.graph.RemoveEdge(edge);
  }
  Host empty(HostOptions{{}, std::vector<std::string>{}, nullptr});
  const ShortestPath found = FindShortestPath(grid.graph, grid.source(), grid.target(), {}, empty);
  EXPECT_EQ(found.result.termination, Termination::kInfeasible);
  EXPECT_EQ(found.result.message, "no path of edges leads from v0 to v3");
}

TEST_F(WithoutABackend, SaysWhoWasAsked) {
  const Grid grid(2, EdgeCost::kL2, 1);
  Host empty(HostOptions{{}, std::vector<std::string>{}, nullptr});
  const ShortestPath found = FindShortestPath(grid.graph, grid.source(), grid.target(), {}, empty);
  EXPECT_EQ(found.result.termination, Termination::kNoBackend);
  EXPECT_NE(found.result.message.find("relax-and-round"), std::string::npos);
}

TEST_F(WithoutABackend, RefusesAVertexOfAnotherGraph) {
  const Grid grid(2, EdgeCost::kL2, 1);
  const Grid other(2, EdgeCost::kL2, 1);
  EXPECT_THROW(FindShortestPath(grid.graph, grid.source(), other.target()), InvalidArgument);
}

}  // namespace
}  // namespace switchyard::testing
