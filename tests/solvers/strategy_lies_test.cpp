// A backend underneath that lies makes neither a wrong path nor a wrong bound.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "solvers/rounding/relax_and_round.hpp"
#include "switchyard/plugin.hpp"
#include "tests/solvers/grid_graph.hpp"
#include "tests/support/fake_backend.hpp"

namespace switchyard::test {
namespace {
using ::testing::HasSubstr;

class Lies : public ::testing::TestWithParam<EdgeCost> {
 protected:
  Lies() {
    fake_.host().Register(plugin::Plugin<rounding::RelaxAndRound>("native", "1.0"));
    const auto honest = HostWith({"clarabel"});
    if (honest->Find("clarabel") != nullptr) best_ = BestPath(*honest, graph_);
  }
  /// Everything is optimal, and every number is drawn.
  void Lie(double size) {
    fake_.behaviour().answer = [this, size](const sy_problem& p, const sy_control&, sy_result& r) {
      const auto draw = [&] { return size * (2 * random_.Uniform() - 1); };
      r.termination = SY_OPTIMAL;
      r.primal = r.dual = SY_FEASIBLE;
      r.objective = r.bound = 1e9;
      for (std::int32_t j = 0; j < p.num_vars; ++j) r.x[j] = std::abs(draw());
      for (std::int32_t i = 0; i < p.num_rows; ++i) r.row_dual[i] = draw();
      for (std::int32_t i = 0; i < p.num_cone_rows; ++i) r.cone_dual[i] = draw();
    };
  }
  Random random_{13};
  GridGraph graph_{3, 3, GetParam(), 4};
  switchyard::testing::FakeBackend fake_;
  double best_ = std::nan("");
};
INSTANTIATE_TEST_SUITE_P(Costs, Lies,
                         ::testing::Values(EdgeCost::kOneNorm, EdgeCost::kInfinityNorm,
                                           EdgeCost::kTwoNorm, EdgeCost::kSquared));

TEST_P(Lies, OfOptimalityMakeNoPathAndNoBoundAboveTheBest) {
  for (const double size : {1e-6, 1e-2, 1.0, 1e3, 1e9}) {
    Lie(size);
    const StrategyAnswer answer = RelaxAndRoundOn(fake_.host(), graph_.view());
    EXPECT_EQ(answer.result.primal, SY_NO_POINT);
    EXPECT_TRUE(answer.result.termination == SY_RESTRICTIONS_FAILED ||
                answer.result.termination == SY_NO_PATH);
    if (answer.result.termination == SY_RESTRICTIONS_FAILED) {
      EXPECT_THAT(answer.text, HasSubstr("is violated by"));
    }
    EXPECT_FALSE(answer.result.bound > best_ + 1e-9);
  }
}

TEST_P(Lies, OfInfeasibilityWithoutAProofAreNumericalTrouble) {
  fake_.behaviour().answer = [](const sy_problem&, const sy_control&, sy_result& r) {
    r.termination = SY_INFEASIBLE;
  };
  const StrategyAnswer answer = RelaxAndRoundOn(fake_.host(), graph_.view());
  EXPECT_EQ(answer.result.termination, SY_NUMERICAL_TROUBLE);
  EXPECT_THAT(answer.text, HasSubstr("a contradiction without a proof"));
}

TEST_P(Lies, AndFailuresAreToldWithTheBackendsName) {
  fake_.behaviour().answer = [](const sy_problem&, const sy_control&, sy_result&) {
    throw plugin::Failure(SY_E_RESOURCE, "the license ran out");
  };
  const StrategyAnswer answer = RelaxAndRoundOn(fake_.host(), graph_.view());
  EXPECT_EQ(answer.status, SY_E_RESOURCE);
  EXPECT_THAT(answer.error, HasSubstr("test.fake"));
  EXPECT_THAT(answer.error, HasSubstr("the license ran out"));
}

}  // namespace
}  // namespace switchyard::test
