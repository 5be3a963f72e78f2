// Duals made exact: any duals at all must leave a bound that is safe, and good ones a good bound.
#include "solvers/rounding/exact_duals.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "switchyard/safe_bound.hpp"
#include "tests/solvers/grid_graph.hpp"

namespace switchyard::test {
namespace {

class AnyDuals : public testing::TestWithParam<EdgeCost> {};
INSTANTIATE_TEST_SUITE_P(Costs, AnyDuals,
                         testing::Values(EdgeCost::kOneNorm, EdgeCost::kInfinityNorm,
                                         EdgeCost::kTwoNorm, EdgeCost::kSquared));

double Bound(const sy_problem& p, rounding::Duals duals) {
  rounding::MakeExact(p, p.x_lower, p.x_upper, duals);
  return SafeDualBound(p, nullptr, duals.row.data(), duals.cone.data(), nullptr, nullptr).value;
}

TEST_P(AnyDuals, LeaveEveryEpigraphClosedAndABoundBelowAnyPath) {
  const auto host = HostWith({"clarabel"});
  const GridGraph graph(3, 3, GetParam(), 2);
  const double best = host->Find("clarabel") != nullptr ? BestPath(*host, graph) : std::nan("");
  Random random(9);
  for (int k = 0; k < 300; ++k) {
    const double size = std::pow(10, 12 * random.Uniform() - 8);
    rounding::Duals duals;
    const auto draw = [&] { return k == 0 ? 0 : size * (2 * random.Uniform() - 1); };
    for (std::int32_t i = 0; i < graph.view().num_rows; ++i) duals.row.push_back(draw());
    for (std::int32_t i = 0; i < graph.view().num_cone_rows; ++i) duals.cone.push_back(draw());
    if (k == 1 && !duals.row.empty()) duals.row[0] = std::nan("");
    const double bound = Bound(graph.view(), duals);
    EXPECT_TRUE(std::isfinite(bound)) << k;
    EXPECT_FALSE(bound > best + 1e-9);
  }
}

TEST(ExactDuals, AColumnThatNoDualCanBearIsLeftOpen) {
  ProblemData d;  // minimize -t, t + x >= 0: unbounded
  d.num_vars = 2;
  d.q = {-1, 0};
  d.x_lower = {-kInfinity, 0};
  d.x_upper = {kInfinity, 1};
  d.A = Csc(1, 2);
  d.A.start = {0, 1, 2};
  d.A.row = {0, 0};
  d.A.value = {1, 1};
  d.row_lower = {0};
  d.row_upper = {kInfinity};
  d.F = Csc(0, 2);
  const Problem p(d);
  EXPECT_EQ(Bound(p.view(), {{0.3}, {}}), -kInfinity);
}

}  // namespace
}  // namespace switchyard::test
