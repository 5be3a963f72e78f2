// A backend underneath that lies makes neither a wrong integer point nor a wrong bound.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "solvers/rounding/relax_and_round.hpp"
#include "switchyard/plugin.hpp"
#include "tests/solvers/grid_graph.hpp"
#include "tests/solvers/small_integer_problem.hpp"
#include "tests/support/fake_backend.hpp"

namespace switchyard::test {
namespace {
using ::testing::HasSubstr;

class GeneralLies : public ::testing::TestWithParam<IntegerKind> {
 protected:
  GeneralLies() { fake_.host().Register(plugin::Plugin<rounding::RelaxAndRound>("native", "1.0")); }
  /// Everything is optimal, and every number is drawn.
  void Lie(double size) {
    fake_.behaviour().answer = [this, size](const sy_problem& p, const sy_control&, sy_result& r) {
      const auto draw = [&] { return size * (2 * random_.Uniform() - 1); };
      r.termination = SY_OPTIMAL;
      r.primal = r.dual = SY_FEASIBLE;
      r.objective = r.bound = 1e9;
      for (std::int32_t j = 0; j < p.num_vars; ++j) r.x[j] = draw();
      for (std::int32_t i = 0; i < p.num_rows; ++i) r.row_dual[i] = draw();
      for (std::int32_t i = 0; i < p.num_cone_rows; ++i) r.cone_dual[i] = draw();
    };
  }
  Random random_{13};
  switchyard::testing::FakeBackend fake_;
};
INSTANTIATE_TEST_SUITE_P(Kinds, GeneralLies,
                         ::testing::Values(IntegerKind::kLinear, IntegerKind::kQuadratic,
                                           IntegerKind::kConic));

TEST_P(GeneralLies, OfOptimalityMakeNoPointBetterThanTheBestAndNoBoundAboveIt) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const SmallIntegerProblem drawn(GetParam(), seed);
    const double best = drawn.Optimum();
    for (const double size : {1e-6, 1.0, 10.0, 1e9}) {
      Lie(size);
      const StrategyAnswer answer = RelaxAndRoundOn(fake_.host(), drawn.view());
      EXPECT_LE(answer.result.bound, best + 1e-9 * (1 + std::abs(best)));
      if (answer.result.primal != SY_FEASIBLE) continue;
      EXPECT_GE(answer.result.objective, best - 1e-5 * (1 + std::abs(best)));
      EXPECT_LT(drawn.OptimumOfRest(answer.x), kInfinity);
    }
  }
}

TEST_P(GeneralLies, OfInfeasibilityWithoutAProofAreNumericalTrouble) {
  fake_.behaviour().answer = [](const sy_problem& p, const sy_control&, sy_result& r) {
    r.termination = SY_INFEASIBLE;
    r.dual = SY_CERTIFICATE;
    std::fill(r.row_dual, r.row_dual + p.num_rows, 1.0);
  };
  const SmallIntegerProblem drawn(GetParam(), 5);
  ASSERT_LT(drawn.Optimum(), kInfinity);
  const StrategyAnswer answer = RelaxAndRoundOn(fake_.host(), drawn.view());
  EXPECT_EQ(answer.result.termination, SY_NUMERICAL_TROUBLE);
  EXPECT_EQ(answer.result.dual, SY_NO_POINT);
  EXPECT_THAT(answer.text, HasSubstr("a contradiction without a proof"));
}

TEST_P(GeneralLies, AFailureInADiveIsItsReasonAndNoMore) {
  int solves = 0, told = 0;
  fake_.behaviour().answer = [&](const sy_problem& p, const sy_control&, sy_result& r) {
    if (++solves > 1) throw plugin::Failure(SY_E_RESOURCE, "the license ran out");
    r.termination = SY_OPTIMAL;
    r.primal = r.dual = SY_FEASIBLE;
    for (std::int32_t j = 0; j < p.num_vars; ++j) r.x[j] = 0.5;
  };
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    solves = 0;
    const SmallIntegerProblem drawn(GetParam(), seed);
    const StrategyAnswer answer = RelaxAndRoundOn(fake_.host(), drawn.view());
    EXPECT_EQ(answer.status, SY_OK) << answer.error;
    if (answer.result.termination != SY_RESTRICTIONS_FAILED) continue;
    EXPECT_THAT(answer.text, HasSubstr("ran out"));
    ++told;
  }
  EXPECT_GT(told, 0);
}

// min -y over y <= x, x and z integer. Rounding gets no answer; the dive's first relaxed point is
// rounded as it stands, to (3, 1, 1), and nothing is below it. Then the best y for x = 3 is 3.
TEST(GeneralDive, APointFoundOnTheWayGetsTheBestRest) {
  switchyard::testing::FakeBackend fake;
  fake.host().Register(plugin::Plugin<rounding::RelaxAndRound>("native", "1.0"));
  int solves = 0;
  fake.behaviour().answer = [&](const sy_problem& p, const sy_control&, sy_result& r) {
    ++solves;
    const bool fixed = p.x_lower[0] == p.x_upper[0] && p.x_lower[1] == p.x_upper[1];
    r.termination = SY_INFEASIBLE;
    if (fixed ? solves == 2 : solves > 3) return;
    r.termination = SY_OPTIMAL;
    r.primal = SY_FEASIBLE;
    for (int j = 0; j < 2; ++j) r.x[j] = p.x_lower[j] + (p.x_lower[j] < p.x_upper[j] ? 0.5 : 0);
    r.x[2] = fixed ? r.x[0] : 1;
  };
  ProblemData d;
  d.num_vars = 3;  // x, z, y
  d.q = {0, 0, -1};
  d.x_lower = {1, 0, 0};
  d.x_upper = {9, 9, 9};
  d.integer = {1, 1, 0};
  d.P = Csc(3, 3);
  d.F = Csc(0, 3);
  d.A = Csc(1, 3);
  d.A.row = {0, 0};
  d.A.value = {-1, 1};
  d.A.start = {0, 1, 1, 2};
  d.row_lower = {-kInfinity};
  d.row_upper = {0};
  const Problem problem(d);
  const StrategyAnswer answer = RelaxAndRoundOn(fake.host(), problem.view(), {"dives=2"});
  ASSERT_EQ(answer.result.primal, SY_FEASIBLE) << answer.error << answer.text;
  EXPECT_EQ(answer.x, (std::vector<double>{3, 1, 3}));
}

}  // namespace
}  // namespace switchyard::test
