// The restriction to a path against the whole problem with the flows fixed.
#include "solvers/rounding/restriction.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "solvers/rounding/verify.hpp"
#include "tests/solvers/grid_graph.hpp"

namespace switchyard::test {
namespace {

using rounding::InWhole;
using rounding::PathProblem;
using rounding::Restrict;
using rounding::Restriction;

class EachCost : public testing::TestWithParam<EdgeCost> {};
INSTANTIATE_TEST_SUITE_P(Costs, EachCost,
                         testing::Values(EdgeCost::kLinear, EdgeCost::kOneNorm,
                                         EdgeCost::kInfinityNorm, EdgeCost::kTwoNorm,
                                         EdgeCost::kSquared));

TEST_P(EachCost, HoldsWhereTheWholeWithItsFlowsFixedDoesAtTheSameObjective) {
  const GridGraph graph(3, 3, GetParam(), 11);
  const PathProblem whole(graph.view());
  Random random(5);
  int fail = 0;
  for (const auto& path : graph.SimplePaths()) {
    const Restriction restriction = Restrict(whole, path);
    ASSERT_EQ(restriction.contradiction, "");
    const Problem small(restriction.problem);
    ProblemData rows = graph.FixedTo(path).data();  // the restriction has no bounds that rows imply
    rows.x_lower.clear();
    rows.x_upper.clear();
    const Problem fixed(rows);
    for (int k = 0; k < 100; ++k) {
      std::vector<double> x;
      for (std::int32_t j = 0; j < small.data().num_vars; ++j) x.push_back(3 * random.Uniform());
      const auto point = InWhole(whole, restriction, x);
      EXPECT_NEAR(Objective(small.view(), x.data()), Objective(graph.view(), point.data()), 1e-9);
      // Sizes of sides differ by at most a factor 4: what holds to t in one does to 4 t in the
      // other.
      const double t = 0.15 * (1 + random.Uniform());
      const bool holds = rounding::WhatIsViolated(fixed.view(), point.data(), t).empty();
      if (holds) {
        EXPECT_EQ(rounding::WhatIsViolated(small.view(), x.data(), 4 * t), "");
      }
      if (rounding::WhatIsViolated(small.view(), x.data(), t).empty()) {
        EXPECT_EQ(rounding::WhatIsViolated(fixed.view(), point.data(), 4 * t), "");
      }
      fail += holds ? 0 : 1;
    }
  }
  EXPECT_GT(fail, 0);
}

TEST(Restriction, HasWhatIsOnThePathAndNothingElse) {
  const GridGraph graph(4, 4, EdgeCost::kTwoNorm, 11);
  const PathProblem whole(graph.view());
  const auto path = graph.SimplePaths().front();
  const Restriction r = Restrict(whole, path);
  EXPECT_EQ(r.variables.size(), 5 * path.size());
  EXPECT_EQ(r.ones.size(), path.size());
  EXPECT_EQ(r.problem.cones.size(), path.size());
  EXPECT_EQ(r.problem.row_lower.size(), 8 * path.size() + 2 * (path.size() - 1));
  EXPECT_FALSE(r.problem.has_integers());
}

TEST(Restriction, OfAListThatIsNoPathIsAContradiction) {
  const GridGraph graph(4, 4, EdgeCost::kTwoNorm, 11);
  const PathProblem whole(graph.view());
  auto path = graph.SimplePaths().front();
  path.pop_back();
  EXPECT_NE(Restrict(whole, path).contradiction, "");
  EXPECT_NE(Restrict(whole, {}).contradiction, "");
}

TEST(Restriction, TakesCurvatureOfCouplingVariablesAlong) {
  ProblemData d;
  // x0: the one flow, x1 and x2 coupling; P joins all three.
  d.num_vars = 3;
  d.flags = SY_PROBLEM_CONVEX;
  d.P = Csc(3, 3);
  d.P.start = {0, 1, 3, 5};
  d.P.row = {0, 0, 1, 0, 2};
  d.P.value = {4, 1, 4, 2, 6};
  d.q = {1, 2, 3};
  d.offset = 0.5;
  d.x_lower = {0, -5, -5};
  d.x_upper = {1, 5, 5};
  d.integer = {1, 0, 0};
  d.A = Csc(1, 3);
  d.A.start = {0, 1, 1, 1};
  d.A.row = {0};
  d.A.value = {1};
  d.row_lower = d.row_upper = {1};
  d.F = Csc(0, 3);
  const std::int32_t none[] = {-1, -1, -1}, zero[] = {0}, one[] = {1};
  const sy_blocks blocks = {sizeof(sy_blocks), 0, none, none, none, nullptr};
  sy_paths paths{};
  paths.size = sizeof paths;
  paths.num_vertices = 2;
  paths.num_arcs = 1;
  paths.target = 1;
  paths.tail = paths.flow = zero;
  paths.head = one;
  const sy_hint hints[] = {{"sy.blocks/1", &blocks}, {"sy.paths/1", &paths}, {nullptr, nullptr}};
  d.hints = hints;
  const Problem problem(d);
  const PathProblem whole(problem.view());
  const Restriction r = Restrict(whole, std::vector<std::int32_t>{0});
  ASSERT_EQ(r.contradiction, "");
  ASSERT_EQ(r.variables, (std::vector<std::int32_t>{1, 2}));
  EXPECT_EQ(r.problem.row_lower.size(), 0u);
  const double x[] = {0.7, -1.3};
  const double point[] = {1, 0.7, -1.3};
  EXPECT_NEAR(Objective(Problem(r.problem).view(), x), Objective(problem.view(), point), 1e-12);
}

}  // namespace
}  // namespace switchyard::test
