// relax-and-round over real backends: its bound and its path against enumeration, its verdicts.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "tests/solvers/grid_graph.hpp"

namespace switchyard::test {
namespace {
using testing::HasSubstr;

struct Case {
  const char* backend;
  EdgeCost cost;
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.backend << static_cast<int>(c.cost); }

class Strategy : public testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    host_ = HostWith({GetParam().backend});
    if (host_->Find(GetParam().backend) == nullptr) {
      GTEST_SKIP() << GetParam().backend << " was not built";
    }
  }
  std::unique_ptr<Host> host_;
};

INSTANTIATE_TEST_SUITE_P(
    Backends, Strategy,
    testing::Values(Case{"clp", EdgeCost::kLinear}, Case{"clp", EdgeCost::kOneNorm},
                    Case{"clp", EdgeCost::kInfinityNorm}, Case{"highs", EdgeCost::kOneNorm},
                    Case{"clarabel", EdgeCost::kOneNorm}, Case{"clarabel", EdgeCost::kInfinityNorm},
                    Case{"clarabel", EdgeCost::kTwoNorm}, Case{"clarabel", EdgeCost::kSquared}));

TEST_P(Strategy, BoundAndPathEncloseTheBestPath) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const GridGraph graph(3, 3, GetParam().cost, seed);
    const double best = BestPath(*host_, graph);
    const StrategyAnswer answer = RelaxAndRoundOn(*host_, graph.view());
    const sy_result& r = answer.result;
    ASSERT_EQ(answer.status, SY_OK) << answer.error;
    if (best == kInfinity) {
      EXPECT_EQ(r.termination, SY_INFEASIBLE);
      continue;
    }
    ASSERT_EQ(r.primal, SY_FEASIBLE) << answer.text;
    EXPECT_LE(r.bound, best + 1e-9);
    EXPECT_GE(r.objective, best - 1e-5 * (1 + std::abs(best)));
    EXPECT_NEAR(r.objective, Objective(graph.view(), answer.x.data()), 1e-12);
    EXPECT_NEAR(r.bound, r.relaxed, 1e-4 * (1 + std::abs(r.relaxed))) << "the bound is loose";
    const double gap = (r.objective - r.bound) / std::max(1e-10, std::abs(r.objective));
    EXPECT_EQ(r.termination, gap <= 1e-4 ? SY_OPTIMAL : SY_LOCALLY_OPTIMAL);
    EXPECT_THAT(answer.text, HasSubstr("relaxation by "));
  }
}

TEST_P(Strategy, EveryPathIsWorthWhatTheWholeProblemWithItsFlowsFixedIs) {
  GridGraph graph(3, 3, GetParam().cost, 7);
  struct Told {
    std::vector<std::pair<std::vector<std::int32_t>, double>> paths;
  } told;
  graph.paths().context = &told;
  graph.paths().tried = [](void* context, const std::int32_t* arcs, std::int32_t count,
                           const sy_result* r) noexcept {
    if (count == 0) return;  // the relaxation
    static_cast<Told*>(context)->paths.emplace_back(std::vector<std::int32_t>(arcs, arcs + count),
                                                    r->objective);
  };
  RelaxAndRoundOn(*host_, graph.view(), {"flow_tolerance=0"});
  ASSERT_FALSE(told.paths.empty());
  for (const auto& [path, objective] : told.paths) {
    const double alone = OptimumBy(*host_, graph.FixedTo(path).view());
    EXPECT_NEAR(objective, alone, 1e-5 * (1 + std::abs(alone)));
  }
}

TEST_P(Strategy, AnyNumberOfThreadsGivesTheSameAnswer) {
  const GridGraph graph(4, 4, GetParam().cost, 3);
  const StrategyAnswer one = RelaxAndRoundOn(*host_, graph.view(), {}, Unlimited(1));
  for (const int threads : {2, 8}) {
    const StrategyAnswer many = RelaxAndRoundOn(*host_, graph.view(), {}, Unlimited(threads));
    EXPECT_EQ(many.result.termination, one.result.termination);
    EXPECT_EQ(many.x, one.x);
    EXPECT_EQ(many.result.objective, one.result.objective);
    EXPECT_EQ(many.result.bound, one.result.bound);
  }
}

/// The cheapest backend there is for linear costs.
class LinearStrategy : public testing::Test {
 protected:
  void SetUp() override {
    if (host_->Find("clp") == nullptr) GTEST_SKIP() << "clp was not built";
  }
  std::unique_ptr<Host> host_ = HostWith({"clp"});
  GridGraph graph_{3, 3, EdgeCost::kOneNorm, 7};
};

TEST_F(LinearStrategy, WithoutPathsItIsTheBoundAlone) {
  const StrategyAnswer answer = RelaxAndRoundOn(*host_, graph_.view(), {"paths=0"});
  EXPECT_EQ(answer.result.termination, SY_NOT_SOLVED);
  EXPECT_EQ(answer.result.primal, SY_NO_POINT);
  EXPECT_NEAR(answer.result.bound, answer.result.relaxed, 1e-6);
  EXPECT_NEAR(Objective(graph_.view(), answer.relaxed_x.data()), answer.result.relaxed, 1e-12);
}

TEST_F(LinearStrategy, ATargetThatNoArcReachesIsInfeasibleWithoutASolver) {
  GridGraph graph(3, 3, EdgeCost::kOneNorm, 7);
  graph.problem().Change([&](ProblemData& d) {
    for (std::int32_t a = 0; a < graph.paths().num_arcs; ++a) {
      if (graph.paths().tail[a] != graph.source()) continue;
      d.x_upper[static_cast<std::size_t>(graph.paths().flow[a])] = 0;
    }
  });
  const auto alone = HostWith({});
  const StrategyAnswer answer = RelaxAndRoundOn(*alone, graph.view());
  EXPECT_EQ(answer.result.termination, SY_INFEASIBLE) << answer.error;
  EXPECT_EQ(answer.text, "no arcs lead from source to target");
}

TEST_F(LinearStrategy, AContradictoryRelaxationIsInfeasibleWithItsCertificate) {
  GridGraph graph(3, 3, EdgeCost::kOneNorm, 7);
  graph.problem().Change([&](ProblemData& d) { d.row_upper[1] = 0.25; });  // of the source's degree
  const StrategyAnswer answer = RelaxAndRoundOn(*host_, graph.view());
  EXPECT_EQ(answer.result.termination, SY_INFEASIBLE) << answer.text;
  EXPECT_EQ(answer.result.primal, SY_NO_POINT);
  EXPECT_EQ(answer.result.dual, SY_CERTIFICATE);
}

TEST_F(LinearStrategy, AFlowThatTheProblemFixesIsOnThePath) {
  GridGraph graph(3, 3, EdgeCost::kOneNorm, 7);
  const auto flow = static_cast<std::size_t>(graph.paths().flow[graph.paths().num_arcs / 2]);
  graph.problem().Change([&](ProblemData& d) { d.x_lower[flow] = 1; });
  const StrategyAnswer answer = RelaxAndRoundOn(*host_, graph.view(), {"paths=50"});
  ASSERT_EQ(answer.result.primal, SY_FEASIBLE) << answer.text;
  EXPECT_EQ(answer.x[flow], 1);
}

TEST_F(LinearStrategy, AFlowBelowTheToleranceIsNoPath) {
  const StrategyAnswer answer = RelaxAndRoundOn(*host_, graph_.view(), {"flow_tolerance=1"});
  EXPECT_EQ(answer.result.termination, SY_NO_PATH);
  EXPECT_EQ(answer.result.primal, SY_NO_POINT);
  EXPECT_GT(answer.result.bound, 0);
}

TEST_F(LinearStrategy, TheFrontEndsOwnRestrictionStands) {
  GridGraph graph(3, 3, EdgeCost::kOneNorm, 7);
  graph.paths().solve_path = [](void*, const std::int32_t*, std::int32_t count, const sy_control*,
                                sy_result* r, sy_error* error) noexcept -> sy_status {
    if (count < 1) return std::strcpy(error->text, "no arcs"), SY_E_ARGUMENT;
    r->termination = SY_LOCALLY_OPTIMAL;
    r->primal = SY_FEASIBLE;
    r->objective = 1000 + count;
    return SY_OK;
  };
  const StrategyAnswer answer = RelaxAndRoundOn(*host_, graph.view());
  EXPECT_EQ(answer.result.termination, SY_LOCALLY_OPTIMAL);
  EXPECT_GT(answer.result.objective, 1000);
  EXPECT_EQ(answer.result.primal, SY_NO_POINT);  // it gave no point of this problem
}

TEST_F(LinearStrategy, ANamedBackendServesAndAnAbsentOneIsASentence) {
  const StrategyAnswer named = RelaxAndRoundOn(*host_, graph_.view(), {"solver=clp"});
  EXPECT_THAT(named.text, HasSubstr("relaxation by org.coin-or.clp"));
  const StrategyAnswer absent = RelaxAndRoundOn(*host_, graph_.view(), {"solver=nobody"});
  EXPECT_EQ(absent.status, SY_E_UNSUPPORTED);
  EXPECT_THAT(absent.error, HasSubstr("no backend underneath"));
}

TEST_F(LinearStrategy, APathProblemWithoutHintsIsRoundedAsAnyOther) {
  const double best = BestPath(*host_, graph_);
  graph_.problem().Change([](ProblemData& d) { d.hints = nullptr; });
  const StrategyAnswer answer = RelaxAndRoundOn(*host_, graph_.view());
  ASSERT_EQ(answer.result.primal, SY_FEASIBLE) << answer.error << answer.text;
  EXPECT_GE(answer.result.objective, best - 1e-6 * (1 + std::abs(best)));
  EXPECT_LE(answer.result.bound, best + 1e-9);
  EXPECT_THAT(answer.text, HasSubstr("then dives"));
}

TEST_F(LinearStrategy, AHintThatDoesNotFitIsNamed) {
  graph_.paths().target = 9;
  const StrategyAnswer answer = RelaxAndRoundOn(*host_, graph_.view());
  EXPECT_EQ(answer.status, SY_E_ARGUMENT);
  EXPECT_EQ(answer.error, "sy.paths/1: target[0] must be in [0, 9), and is 9");
}

}  // namespace
}  // namespace switchyard::test
