// What reduced costs along paths close, against all simple paths of small graphs.
#include "solvers/mip/path_costs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "solvers/mip/path_pricing.hpp"
#include "solvers/mip/propagation.hpp"
#include "solvers/rounding/backend.hpp"
#include "tests/solvers/grid_graph.hpp"

namespace switchyard::test {
namespace {

using mip::BoundFrom;
using mip::NodeBound;
using mip::NodeBoxes;
using rounding::Duals;
using rounding::PathProblem;

class PathCosts : public testing::TestWithParam<EdgeCost> {
 protected:
  void SetUp() override {
    const std::string native = std::string(SWITCHYARD_PLUGIN_FOLDER) + "/native.so";
    if (!std::filesystem::exists(native)) GTEST_SKIP() << "the module native is not here";
    HostOptions options;
    options.folders = std::vector<std::string>{};
    options.files = {native};
    host_ = std::make_unique<Host>(options);
  }

  [[nodiscard]] const sy_solver& BackendFor(const sy_problem& problem) const {
    return rounding::FindBackend(*host_->table(), problem, nullptr, 1);
  }
  /// Of the relaxation, as good as the tolerance.
  [[nodiscard]] Duals Relaxed(const PathProblem& paths, double tolerance) const {
    sy_control control = Unlimited();
    control.feasibility = control.optimality = tolerance;
    const sy_problem& relaxation = paths.relaxation();
    const rounding::Answer answer =
        rounding::SolveBy(BackendFor(relaxation), *host_->table(), relaxation, control);
    return {answer.row_dual, answer.cone_dual};
  }
  [[nodiscard]] Duals Priced(const PathProblem& paths, const Duals& duals,
                             const NodeBoxes& boxes) const {
    rounding::Budget budget(Unlimited());
    return WithPricedBlocks(paths, duals, boxes, BackendFor(paths.relaxation()), *host_->table(),
                            budget);
  }

  std::unique_ptr<Host> host_;
};
INSTANTIATE_TEST_SUITE_P(Costs, PathCosts,
                         testing::Values(EdgeCost::kLinear, EdgeCost::kOneNorm, EdgeCost::kTwoNorm,
                                         EdgeCost::kSquared));

std::vector<std::uint8_t> ClosedBy(const PathProblem& paths, const NodeBound& bound, double cutoff,
                                   const NodeBoxes& boxes) {
  std::vector<std::uint8_t> closed(static_cast<std::size_t>(paths.problem().num_vars), 0);
  for (const auto& box : ByPathCosts(paths, bound, cutoff, boxes.lower(), boxes.upper())) {
    EXPECT_EQ(box.upper, 0);
    closed[static_cast<std::size_t>(box.variable)] = 1;
  }
  return closed;
}

TEST_P(PathCosts, CloseNoArcOfAPathBelowTheCutoffWhateverTheDuals) {
  std::ptrdiff_t closed_before = 0, closed_after = 0;
  for (const std::uint64_t seed : {1, 2, 3}) {
    const GridGraph graph(3, 3, GetParam(), seed);
    const PathProblem paths(graph.view());
    const mip::Propagator propagator(graph.view());
    const NodeBoxes boxes = propagator.Bounds();
    const auto simple = graph.SimplePaths();
    std::vector<double> cost;
    for (const auto& path : simple) cost.push_back(OptimumBy(*host_, graph.FixedTo(path).view()));
    const double best = *std::min_element(cost.begin(), cost.end());
    for (const double tolerance : {1e-8, 1e-2}) {
      const Duals duals = Relaxed(paths, tolerance);
      const Duals priced = Priced(paths, duals, boxes);
      for (const double cutoff : {best + 1e-6, best + 0.2, best + 1}) {
        for (const Duals* given : {&duals, &priced}) {
          const NodeBound bound = BoundFrom(graph.view(), *given, boxes.lower(), boxes.upper());
          const auto closed = ClosedBy(paths, bound, cutoff, boxes);
          (given == &duals ? closed_before : closed_after) +=
              std::count(closed.begin(), closed.end(), 1);
          for (std::size_t k = 0; k < simple.size(); ++k) {
            if (cost[k] >= cutoff) continue;
            for (const std::int32_t arc : simple[k]) {
              EXPECT_EQ(closed[static_cast<std::size_t>(paths.paths().flow[arc])], 0)
                  << "arc " << arc << " of a path that costs " << cost[k] << ", below " << cutoff;
            }
          }
        }
      }
    }
  }
  EXPECT_GT(closed_before, 0);
  EXPECT_GT(closed_after, closed_before);
}

// Potentials that are shared out badly: every arc alone is cheap, each detour is dear.
TEST(PathCostsByHand, AddUpAlongAPath) {
  const GridGraph graph(3, 1, EdgeCost::kLinear, 1);
  const PathProblem paths(graph.view());
  const mip::Propagator propagator(graph.view());
  const NodeBoxes boxes = propagator.Bounds();
  NodeBound bound;
  bound.value = 1;
  bound.slope.assign(static_cast<std::size_t>(graph.view().num_vars), 0.0);
  for (std::int32_t a = 0; a < paths.paths().num_arcs; ++a) {
    bound.slope[static_cast<std::size_t>(paths.paths().flow[a])] = 0.5;
  }
  const auto count = [&](double cutoff) {
    const auto closed = ClosedBy(paths, bound, cutoff, boxes);
    return std::count(closed.begin(), closed.end(), 1);
  };
  const auto all = static_cast<std::ptrdiff_t>(paths.paths().num_arcs);
  EXPECT_EQ(count(1.9), all);  // from 0 over 1 to 2 costs 1 + 0.5 + 0.5
  EXPECT_EQ(count(2), all - 2);
  EXPECT_EQ(count(kInfinity), 0);
}

}  // namespace
}  // namespace switchyard::test
