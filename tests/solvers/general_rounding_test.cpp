// relax-and-round over problems without paths: points and bounds against enumeration, its verdicts.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iostream>

#include "solvers/rounding/integer_problem.hpp"
#include "switchyard/hints.h"
#include "tests/solvers/grid_graph.hpp"
#include "tests/solvers/small_integer_problem.hpp"

namespace switchyard::test {
namespace {
using ::testing::HasSubstr;

std::unique_ptr<Host> AllBackends() { return HostWith({"clp", "highs", "clarabel"}); }

class General : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const char* name : {"clp", "clarabel"}) {
      if (host_->Find(name) == nullptr) GTEST_SKIP() << name << " was not built";
    }
  }
  std::unique_ptr<Host> host_ = AllBackends();
};

struct Case {
  IntegerKind kind;
  const char* name;
  int count;
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

class Drawn : public General, public ::testing::WithParamInterface<Case> {
 protected:
  struct Tally {
    int solvable = 0, points = 0, optimal = 0, proven = 0;
    double gap = 0;
  };
  /// What holds of any answer, against enumeration.
  void Check(const SmallIntegerProblem& drawn, const StrategyAnswer& answer) {
    const sy_result& r = answer.result;
    ASSERT_EQ(answer.status, SY_OK) << answer.error;
    const double best = drawn.Optimum();
    EXPECT_LE(r.bound, best + 1e-9 * (1 + std::abs(best)));
    if (r.termination == SY_INFEASIBLE) {
      EXPECT_EQ(best, kInfinity);
    }
    if (best < kInfinity) ++tally_.solvable;
    if (r.primal != SY_FEASIBLE) {
      EXPECT_NE(r.termination, SY_OPTIMAL);
      EXPECT_NE(r.termination, SY_LOCALLY_OPTIMAL);
      return;
    }
    for (std::int32_t j = 0; j < drawn.num_integers(); ++j) {
      const double x = answer.x[static_cast<std::size_t>(j)];
      EXPECT_EQ(x, std::round(x));
    }
    const double slack = 1e-5 * (1 + std::abs(best));
    EXPECT_GE(r.objective, best - slack) << "better than the optimum";
    EXPECT_NEAR(r.objective, drawn.OptimumOfRest(answer.x), slack) << "of its integers";
    EXPECT_EQ(r.objective, Objective(drawn.view(), answer.x.data()));
    if (r.termination == SY_OPTIMAL) {
      EXPECT_LE(r.objective, best + 1e-4 * std::abs(best) + slack);
      ++tally_.proven;
    }
    ++tally_.points;
    if (r.objective <= best + slack) ++tally_.optimal;
    tally_.gap += std::max(0.0, r.objective - best) / std::max(1.0, std::abs(best));
  }
  Tally tally_;
};
INSTANTIATE_TEST_SUITE_P(Kinds, Drawn,
                         ::testing::Values(Case{IntegerKind::kLinear, "MILP", 800},
                                           Case{IntegerKind::kQuadratic, "MIQP", 600},
                                           Case{IntegerKind::kConic, "MISOCP", 600}),
                         [](const auto& of) { return of.param.name; });

TEST_P(Drawn, PointsAndBoundsEncloseTheOptimum) {
  for (int seed = 1; seed <= GetParam().count && !HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    const SmallIntegerProblem drawn(GetParam().kind, static_cast<std::uint64_t>(seed));
    Check(drawn, RelaxAndRoundOn(*host_, drawn.view()));
  }
  std::cout << GetParam().name << ": " << tally_.solvable << " of " << GetParam().count
            << " have a point, " << tally_.points << " were given one, " << tally_.optimal
            << " the best, " << tally_.proven << " within the gap; mean distance "
            << tally_.gap / std::max(1, tally_.points) << "\n";
  EXPECT_GE(tally_.points, tally_.solvable * 9 / 10);
  EXPECT_GE(tally_.optimal, tally_.points * 6 / 10);
}

TEST_P(Drawn, AnyNumberOfThreadsGivesTheSameAnswer) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const SmallIntegerProblem drawn(GetParam().kind, seed);
    const StrategyAnswer one = RelaxAndRoundOn(*host_, drawn.view(), {}, Unlimited(1));
    for (const int threads : {2, 8}) {
      const StrategyAnswer many = RelaxAndRoundOn(*host_, drawn.view(), {}, Unlimited(threads));
      EXPECT_EQ(many.result.termination, one.result.termination);
      EXPECT_EQ(many.x, one.x);
      EXPECT_EQ(many.result.bound, one.result.bound);
    }
  }
}

/// min q'x, each x_j an integer in [lower, upper], a'x in [row_lower, row_upper].
Problem Knapsack(std::vector<double> q, const std::vector<double>& a, double row_lower,
                 double row_upper, double lower, double upper) {
  ProblemData d;
  d.num_vars = static_cast<std::int32_t>(q.size());
  d.q = std::move(q);
  d.x_lower.assign(d.q.size(), lower);
  d.x_upper.assign(d.q.size(), upper);
  d.integer.assign(d.q.size(), 1);
  d.P = Csc(d.num_vars, d.num_vars);
  d.F = Csc(0, d.num_vars);
  d.A = Csc(1, d.num_vars);
  for (std::size_t j = 0; j < a.size(); ++j) {
    d.A.row.push_back(0);
    d.A.value.push_back(a[j]);
    d.A.start[j + 1] = static_cast<std::int32_t>(j) + 1;
  }
  d.row_lower = {row_lower};
  d.row_upper = {row_upper};
  return Problem(d);
}

TEST_F(General, AnEquationOfCoprimeWeightsIsMetExactly) {
  int met = 0;
  for (int total = 60; total < 100; ++total) {  // 6 x + 10 y + 15 z = total, all have a solution
    const Problem problem = Knapsack({1, 1, 1}, {6, 10, 15}, total, total, 0, kInfinity);
    const StrategyAnswer answer = RelaxAndRoundOn(*host_, problem.view(), {"dives=40"});
    ASSERT_EQ(answer.status, SY_OK) << answer.error;
    if (answer.result.primal != SY_FEASIBLE) continue;
    ++met;
    EXPECT_EQ(6 * answer.x[0] + 10 * answer.x[1] + 15 * answer.x[2], total);
    EXPECT_LE(answer.result.bound, answer.result.objective);
  }
  std::cout << "equations: " << met << " of 40 met\n";
  EXPECT_GE(met, 20);
}

TEST_F(General, IntegersWithoutBoundsAreRounded) {
  Problem problem = Knapsack({-7.2, 8.6}, {1, 1}, -kInfinity, kInfinity, -kInfinity, kInfinity);
  problem.Change([](ProblemData& d) {  // x^2 + y^2 - 7.2 x + 8.6 y: least at (3.6, -4.3)
    d.P.row = {0, 1};
    d.P.value = {2, 2};
    d.P.start = {0, 1, 2};
    d.flags = SY_PROBLEM_CONVEX;
  });
  const StrategyAnswer answer = RelaxAndRoundOn(*host_, problem.view());
  ASSERT_EQ(answer.result.primal, SY_FEASIBLE) << answer.error << answer.text;
  EXPECT_EQ(answer.x, (std::vector<double>{4, -4}));
  EXPECT_NEAR(answer.result.bound, -3.6 * 3.6 - 4.3 * 4.3, 1e-6);
  EXPECT_EQ(answer.result.termination, SY_LOCALLY_OPTIMAL);
}

TEST_F(General, AGroupHasAtMostOneThatIsNotZero) {
  // The group alone says so: rows that say it too would do the work.
  Problem problem = Knapsack({-3, -4, -5, -1}, {2, 3, 4, 1}, -kInfinity, 8, 0, 2);
  const std::int32_t start[] = {0, 3}, members[] = {0, 1, 2};
  const sy_sos1 groups = {sizeof groups, 1, start, members};
  const sy_hint hints[] = {{"sy.sos1/1", &groups}, {nullptr, nullptr}};
  problem.Change([&](ProblemData& d) { d.hints = hints; });
  const StrategyAnswer answer = RelaxAndRoundOn(*host_, problem.view());
  ASSERT_EQ(answer.result.primal, SY_FEASIBLE) << answer.error << answer.text;
  EXPECT_EQ(std::count(answer.x.begin(), answer.x.begin() + 3, 0.0), 2);
  EXPECT_GE(answer.result.objective, -10);  // two of the third; the fourth has no room left
}

TEST_F(General, AGroupOfWhatIsNotThereIsNamed) {
  Problem problem = Knapsack({1, 1}, {1, 1}, 1, 1, 0, 1);
  const std::int32_t start[] = {0, 2}, members[] = {0, 2};
  const sy_sos1 groups = {sizeof groups, 1, start, members};
  const sy_hint hints[] = {{"sy.sos1/1", &groups}, {nullptr, nullptr}};
  problem.Change([&](ProblemData& d) { d.hints = hints; });
  const StrategyAnswer answer = RelaxAndRoundOn(*host_, problem.view());
  EXPECT_EQ(answer.status, SY_E_ARGUMENT);
  EXPECT_EQ(answer.error, "sy.sos1/1: x[1] must be in [0, 2), and is 2");
}

TEST_F(General, AContradictionOfTheRelaxationComesWithItsCertificate) {
  // x + y <= 1, x + y >= 2 over free integers: no box shows it, the sum of the rows does.
  Problem problem = Knapsack({1, 1}, {1, 1}, 2, kInfinity, -kInfinity, kInfinity);
  problem.Change([](ProblemData& d) {
    Csc other = d.A;
    d.A = StackRows(d.A, other);
    d.row_lower = {2, -kInfinity};
    d.row_upper = {kInfinity, 1};
  });
  const StrategyAnswer answer = RelaxAndRoundOn(*host_, problem.view());
  EXPECT_EQ(answer.result.termination, SY_INFEASIBLE) << answer.text;
  EXPECT_EQ(answer.result.primal, SY_NO_POINT);
  EXPECT_EQ(answer.result.dual, SY_CERTIFICATE);
}

TEST_F(General, WhatOnlyIntegralityContradictsIsNoProofUnlessBoxesShowIt) {
  const Problem shown = Knapsack({1}, {2}, 3, 3, 0, 9);  // 2 x = 3
  const StrategyAnswer one = RelaxAndRoundOn(*host_, shown.view());
  EXPECT_EQ(one.result.termination, SY_INFEASIBLE) << one.text;
  EXPECT_THAT(one.text, HasSubstr("row[0]"));
  const Problem hidden = Knapsack({1, 1}, {2, 2}, 3, 3, -kInfinity, kInfinity);  // 2 x + 2 y = 3
  const StrategyAnswer two = RelaxAndRoundOn(*host_, hidden.view());
  EXPECT_NE(two.result.termination, SY_INFEASIBLE);
  EXPECT_EQ(two.result.primal, SY_NO_POINT);
}

TEST(IntegerProblem, LargeIntegersExcuseNoViolatedRow) {
  const Problem odd = Knapsack({1, 1}, {2, 2}, 3, 3, -kInfinity, kInfinity);
  const rounding::IntegerProblem whole(odd.view());
  EXPECT_THAT(whole.WhatIsViolatedBy({1e7, 1 - 1e7}, 1e-6), HasSubstr("row[0]"));
  const Problem even = Knapsack({1, 1}, {2, 2}, 2, 2, -kInfinity, kInfinity);
  EXPECT_EQ(rounding::IntegerProblem(even.view()).WhatIsViolatedBy({1e7, 1 - 1e7}, 1e-6), "");
}

TEST(IntegerProblem, LocksAreRowsAndConesThatMayCeaseToHold) {
  // 2 x - 3 y <= 4, x + y = 1, and (x, y, 1) in the second-order cone.
  Problem problem = Knapsack({0, 0}, {2, -3}, -kInfinity, 4, 0, 9);
  problem.Change([](ProblemData& d) {
    Csc other(1, 2), f(3, 2);
    other.row = {0, 0};
    other.value = {1, 1};
    f.row = {0, 1};
    f.value = {1, 1};
    other.start = f.start = {0, 1, 2};
    d.A = StackRows(d.A, other);
    d.row_lower = {-kInfinity, 1};
    d.row_upper = {4, 1};
    d.F = f;
    d.g = {0, 0, 1};
    d.cones = {{SY_CONE_SECOND_ORDER, 3, 0}};
  });
  const rounding::IntegerProblem whole(problem.view());
  ASSERT_EQ(whole.locks().size(), 2u);
  EXPECT_EQ(whole.locks()[0].up, 2);    // the first row, the equation
  EXPECT_EQ(whole.locks()[0].down, 2);  // the equation, the cone's head
  EXPECT_EQ(whole.locks()[1].up, 2);    // the equation, the cone
  EXPECT_EQ(whole.locks()[1].down, 3);
}

TEST_F(General, NoPointFromAnyTryIsSaidWithAReason) {
  const Problem hidden = Knapsack({1, 1}, {2, 2}, 4001, 4001, 0, 3000);  // parity
  const StrategyAnswer answer = RelaxAndRoundOn(*host_, hidden.view());
  EXPECT_EQ(answer.result.termination, SY_RESTRICTIONS_FAILED);
  EXPECT_THAT(answer.text, HasSubstr("0 of 16 tries"));
  EXPECT_THAT(answer.text, HasSubstr("row[0]"));
  EXPECT_NEAR(answer.result.bound, 2000.5, 1e-6);
}

TEST_F(General, AnUnboundedRelaxationIsNotRounded) {
  const Problem problem = Knapsack({-1, 0}, {0, 1}, 0, 1, -kInfinity, kInfinity);
  const StrategyAnswer answer = RelaxAndRoundOn(*host_, problem.view());
  EXPECT_EQ(answer.result.termination, SY_INFEASIBLE_OR_UNBOUNDED) << answer.text;
  EXPECT_EQ(answer.result.primal, SY_NO_POINT);
}

TEST_F(General, WithoutIntegersTheRelaxationAnswersWithItsDuals) {
  Problem problem = Knapsack({-3, -4}, {2, 3}, -kInfinity, 5, 0, 2);
  problem.Change([](ProblemData& d) { d.integer.clear(); });
  const StrategyAnswer answer = RelaxAndRoundOn(*host_, problem.view());
  EXPECT_EQ(answer.result.termination, SY_OPTIMAL) << answer.error << answer.text;
  EXPECT_EQ(answer.result.primal, SY_FEASIBLE);
  EXPECT_EQ(answer.result.dual, SY_FEASIBLE);
  EXPECT_NEAR(answer.result.objective, -6 - 4.0 / 3, 1e-6);
  EXPECT_NEAR(answer.result.bound, answer.result.objective, 1e-6);
}

TEST_F(General, WithoutDivesItIsTheBoundAlone) {
  const Problem problem = Knapsack({-3, -4}, {2, 3}, -kInfinity, 5, 0, 2);
  const StrategyAnswer answer = RelaxAndRoundOn(*host_, problem.view(), {"dives=0"});
  EXPECT_EQ(answer.result.termination, SY_NOT_SOLVED);
  EXPECT_EQ(answer.result.primal, SY_NO_POINT);
  EXPECT_NEAR(answer.result.bound, answer.result.relaxed, 1e-6);
}

TEST_F(General, LimitsEndItWithWhatThereIs) {
  const SmallIntegerProblem drawn(IntegerKind::kLinear, 3);
  sy_control control = Unlimited();
  control.seconds = 0;
  EXPECT_EQ(RelaxAndRoundOn(*host_, drawn.view(), {}, control).result.termination, SY_TIME_LIMIT);
  control = Unlimited();
  control.cancelled = [](void*) noexcept { return 1; };
  EXPECT_EQ(RelaxAndRoundOn(*host_, drawn.view(), {}, control).result.termination, SY_CANCELLED);
  control = Unlimited();
  control.target = 1e9;
  const Problem loose = Knapsack({-3, -4}, {2, 3}, -kInfinity, 6.5, 0, 2);
  const StrategyAnswer target = RelaxAndRoundOn(*host_, loose.view(), {}, control);
  EXPECT_EQ(target.result.termination, SY_TARGET);
  EXPECT_EQ(target.result.primal, SY_FEASIBLE);
  control = Unlimited();
  control.cutoff = -100;
  EXPECT_EQ(RelaxAndRoundOn(*host_, loose.view(), {}, control).result.termination, SY_CUTOFF);
}

TEST_F(General, EachNewBestPointIsToldAndHolds) {
  struct Told {
    const SmallIntegerProblem* drawn;
    std::vector<double> objectives;
  };
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const SmallIntegerProblem drawn(IntegerKind::kLinear, seed);
    Told told{&drawn, {}};
    sy_control control = Unlimited();
    control.context = &told;
    control.progress = [](void* context, const sy_progress* p) noexcept {
      auto& t = *static_cast<Told*>(context);
      if (p->incumbent == nullptr) return 0;
      const std::vector<double> x(p->incumbent, p->incumbent + t.drawn->view().num_vars);
      EXPECT_NEAR(p->objective, t.drawn->OptimumOfRest(x), 1e-5 * (1 + std::abs(p->objective)));
      t.objectives.push_back(p->objective);
      return 0;
    };
    const StrategyAnswer answer = RelaxAndRoundOn(*host_, drawn.view(), {}, control);
    EXPECT_TRUE(std::is_sorted(told.objectives.rbegin(), told.objectives.rend()));
    if (answer.result.primal != SY_FEASIBLE) continue;
    ASSERT_FALSE(told.objectives.empty());
    EXPECT_EQ(told.objectives.back(), answer.result.objective);
  }
}

TEST_F(General, FunctionsAndNonconvexObjectivesAreRefusedWithASentence) {
  Problem problem = Knapsack({1, 1}, {1, 1}, 0, 1, 0, 1);
  problem.Change([](ProblemData& d) {
    d.P.row = {0};
    d.P.value = {-1};
    d.P.start = {0, 1, 1};
  });
  const auto ranked = host_->Rank(problem.view(), "relax-and-round");
  ASSERT_EQ(ranked.size(), 1u);
  EXPECT_FALSE(ranked[0].suitable);
  EXPECT_FALSE(ranked[0].why.empty());
}

TEST_F(General, TheHostAsksARealSolverUnlessTheStrategyIsNamed) {
  const Problem problem = Knapsack({1, 1}, {1, 1}, 1, 1, 0, 1);
  for (const auto& candidate : host_->Rank(problem.view())) {
    EXPECT_NE(candidate.backend->id, "org.switchyard.relax-and-round");
  }
  const auto named = host_->Rank(problem.view(), "relax-and-round");
  ASSERT_EQ(named.size(), 1u);
  EXPECT_TRUE(named[0].suitable) << named[0].why;
}

}  // namespace
}  // namespace switchyard::test
