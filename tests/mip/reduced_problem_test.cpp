// A problem without the variables that a box fixes, against the whole one in the box.
#include "solvers/mip/reduced_problem.hpp"

#include <gtest/gtest.h>

#include "solvers/rounding/verify.hpp"
#include "tests/solvers/grid_graph.hpp"

namespace switchyard::test {
namespace {

using mip::ReducedProblem;

std::size_t At(std::int32_t j) { return static_cast<std::size_t>(j); }

/// Some variables of the problem fixed, most at 0: those of one arc, all or none.
ProblemData SomeFixed(const GridGraph& graph, Random& random) {
  ProblemData d = graph.data();
  const auto* blocks = static_cast<const sy_blocks*>(graph.view().hints[0].data);
  std::vector<int> fate(At(blocks->num_blocks));
  for (int& f : fate) f = random.Uniform() < 0.6 ? 0 : random.Uniform() < 0.3 ? 1 : 2;
  for (std::int32_t j = 0; j < d.num_vars; ++j) {
    const std::int32_t b = blocks->x[j];
    if (b < 0 || fate[At(b)] == 2) continue;
    d.x_lower[At(j)] = d.x_upper[At(j)] = fate[At(b)] == 0 ? 0 : 0.25;
  }
  return d;
}

class ReducedProblemOf : public testing::TestWithParam<EdgeCost> {};
INSTANTIATE_TEST_SUITE_P(Costs, ReducedProblemOf,
                         testing::Values(EdgeCost::kLinear, EdgeCost::kOneNorm,
                                         EdgeCost::kInfinityNorm, EdgeCost::kTwoNorm,
                                         EdgeCost::kSquared));

TEST_P(ReducedProblemOf, HoldsWhereTheWholeDoesAtTheSameObjective) {
  const GridGraph graph(3, 3, GetParam(), 4);
  Random random(7);
  int smaller = 0, hold = 0;
  for (int k = 0; k < 20; ++k) {
    const Problem whole(SomeFixed(graph, random));
    const ProblemData& d = whole.data();
    const ReducedProblem reduced(whole.view(), d.x_lower, d.x_upper);
    EXPECT_TRUE(reduced.Covers(d.x_lower, d.x_upper));
    smaller += reduced.view().num_rows < whole.view().num_rows ? 1 : 0;
    for (int point = 0; point < 50; ++point) {
      rounding::Answer answer;
      for (std::size_t j = 0; j < reduced.num_vars(); ++j) answer.x.push_back(random.Uniform());
      answer.x_dual.assign(reduced.num_vars(), 1.0);
      answer.row_dual.assign(At(reduced.view().num_rows), 1.0);
      answer.cone_dual.assign(At(reduced.view().num_cone_rows), 1.0);
      const rounding::Answer back = reduced.Back(answer);
      EXPECT_EQ(reduced.Kept(back.x), answer.x);
      EXPECT_NEAR(Objective(reduced.view(), answer.x.data()),
                  Objective(whole.view(), back.x.data()), 1e-12);
      const double t = 4 * random.Uniform();
      const bool holds = rounding::WhatIsViolated(whole.view(), back.x.data(), t).empty();
      if (holds) {
        EXPECT_EQ(rounding::WhatIsViolated(reduced.view(), answer.x.data(), 4 * t + 1e-9), "");
        ++hold;
      }
      if (rounding::WhatIsViolated(reduced.view(), answer.x.data(), t).empty()) {
        EXPECT_EQ(rounding::WhatIsViolated(whole.view(), back.x.data(), 4 * t + 1e-9), "");
      }
    }
  }
  EXPECT_GT(smaller, 10);
  EXPECT_GT(hold, 10);
}

TEST(ReducedProblem, CoversBoxesThatFixWhatItIsWithout) {
  const GridGraph graph(2, 2, EdgeCost::kTwoNorm, 1);
  std::vector<double> lower = graph.data().x_lower, upper = graph.data().x_upper;
  lower[0] = upper[0] = 1;
  const ReducedProblem reduced(graph.view(), lower, upper);
  EXPECT_EQ(reduced.num_vars(), At(graph.view().num_vars) - 1);
  EXPECT_TRUE(reduced.Covers(lower, upper));
  upper[1] = lower[1];
  EXPECT_TRUE(reduced.Covers(lower, upper));
  lower[0] = 0;
  EXPECT_FALSE(reduced.Covers(lower, upper));
  upper[0] = 0;
  EXPECT_FALSE(reduced.Covers(lower, upper));
}

TEST(ReducedProblem, KeepsARowThatDoesNotHold) {
  ProblemData d;
  d.num_vars = 2;
  d.q = {1, 1};
  d.x_lower = {0, 0};
  d.x_upper = {1, 1};
  d.P = Csc(2, 2);
  d.A = Csc(2, 2);  // x_0 >= 1, x_0 >= 0
  d.A.start = {0, 2, 2};
  d.A.row = {0, 1};
  d.A.value = {1, 1};
  d.row_lower = {1, 0};
  d.row_upper = {kInfinity, kInfinity};
  d.F = Csc(0, 2);
  const Problem whole(d);
  const ReducedProblem reduced(whole.view(), {0, 0}, {0, 1});
  EXPECT_EQ(reduced.num_vars(), 1U);
  ASSERT_EQ(reduced.view().num_rows, 1);
  EXPECT_EQ(reduced.view().row_lower[0], 1);
}

}  // namespace
}  // namespace switchyard::test
