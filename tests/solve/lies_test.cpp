// Answers that the program does not support: none of them passes.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "core/lower/lowering.hpp"
#include "core/solve/check.hpp"
#include "tests/support/fake_backend.hpp"

namespace switchyard::testing {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

/// min x + 2 y, 1 <= x <= 3, y >= 0, x + y >= 2 (row "demand"): 2 at (2, 0), with the dual 1 of the
/// row and 1 of y's bound.
struct Diet {
  Diet() {
    row.evaluator()->set_row_names({"demand"});
    program.AddLinearCost(Eigen::Vector2d(1, 2), x);
    program.AddBoundingBoxConstraint(Eigen::Vector2d(1, 0), Eigen::Vector2d(3, kInf), x);
  }
  MathematicalProgram program;
  VectorXDecisionVariable x = program.NewContinuousVariables(2, "x");
  Binding<LinearConstraint> row =
      program.AddLinearConstraint(Eigen::RowVector2d(1, 1), 2.0, kInf, x);
};

struct Claim {
  sy_termination termination = SY_OPTIMAL;
  double x = 2;
  double y = 0;
  double row_dual = 1;
  double y_dual = 1;
  double x_dual = 0;
  sy_point_kind primal = SY_FEASIBLE;
  sy_point_kind dual = SY_FEASIBLE;
};

Answer Says(const Claim& claim) {
  return [claim](const sy_problem&, const sy_control&, sy_result& r) {
    r.termination = claim.termination;
    r.primal = claim.primal;
    r.dual = claim.dual;
    r.x[0] = claim.x;
    r.x[1] = claim.y;
    r.row_dual[0] = claim.row_dual;
    r.x_dual[0] = claim.x_dual;
    r.x_dual[1] = claim.y_dual;
    r.objective = -1e9;  // whatever it says, the program's own counts
  };
}

MathematicalProgramResult Solve(const Claim& claim) {
  Diet diet;
  FakeBackend fake;
  fake.behaviour().answer = Says(claim);
  return fake.Solve(diet.program);
}

std::string OnlyNote(const MathematicalProgramResult& result) {
  return result.notes.size() == 1 ? result.notes[0]
                                  : std::to_string(result.notes.size()) + " notes";
}

TEST(Lies, TheTruthStands) {
  const auto result = Solve({});
  EXPECT_EQ(result.termination, Termination::kOptimal) << OnlyNote(result);
  EXPECT_EQ(result.objective, 2);
}

TEST(Lies, APointThatViolatesARowIsNoOptimum) {
  const auto result = Solve({.x = 1.5});
  EXPECT_EQ(result.termination, Termination::kNumericalTrouble);
  EXPECT_FALSE(result.is_success());
  EXPECT_EQ(result.primal, PointKind::kInfeasible);
  EXPECT_EQ(result.violation.rows, 0.5);
  EXPECT_EQ(OnlyNote(result),
            "test.fake says optimal; our check finds its point infeasible: rows are violated by "
            "0.5, bounds by 0, cones by 0, functions by 0, integrality by 0");
}

TEST(Lies, APointThatNearlyFitsIsSaidToNearlyFit) {
  const auto result = Solve({.x = 2 - 1e-4});
  EXPECT_EQ(result.termination, Termination::kNumericalTrouble);
  EXPECT_EQ(result.primal, PointKind::kNearlyFeasible);
}

TEST(Lies, APointThatOverflowsARowIsNoOptimum) {
  Diet diet;
  diet.program.AddLinearConstraint(Eigen::RowVector2d(0, 10), -kInf, 5.0, diet.x);
  FakeBackend fake([](sy_solver& t) { t.traits = 0; });
  fake.behaviour().answer = Says({.y = 1e308, .dual = SY_NO_POINT});
  const auto result = fake.Solve(diet.program);
  EXPECT_EQ(result.termination, Termination::kNumericalTrouble);
  EXPECT_EQ(result.primal, PointKind::kInfeasible);
}

TEST(Lies, AFeasiblePointThatIsNotOptimalIsFoundOutByItsDuals) {
  const auto result = Solve({.x = 3});
  EXPECT_EQ(result.termination, Termination::kNumericalTrouble);
  EXPECT_EQ(result.primal, PointKind::kFeasible);
  EXPECT_EQ(result.objective, 3);
  EXPECT_NEAR(result.bound, 2, 1e-12);
  EXPECT_NEAR(result.gap(), 1.0 / 3, 1e-12);
  EXPECT_EQ(OnlyNote(result), "test.fake says optimal; its duals support 3 only to the bound 2");
}

TEST(Lies, WrongDualsSupportNothing) {
  for (const double row_dual : {-1.0, 0.0, 0.5, 1.5, 100.0}) {
    const auto result = Solve({.row_dual = row_dual});
    EXPECT_EQ(result.termination, Termination::kNumericalTrouble) << row_dual;
    EXPECT_NE(result.dual, PointKind::kFeasible) << row_dual;
    EXPECT_TRUE(std::isnan(result.bound) || result.bound <= 2) << row_dual;
  }
}

TEST(Lies, AnOptimumNeedsTheDualsThatTheBackendDeclares) {
  const auto result = Solve({.dual = SY_NO_POINT});
  EXPECT_EQ(result.termination, Termination::kNumericalTrouble);
  EXPECT_EQ(OnlyNote(result), "test.fake says optimal; it gives no duals to support that");
}

TEST(Lies, AnOptimumWithoutAPointIsNone) {
  const auto result = Solve({.primal = SY_NO_POINT});
  EXPECT_EQ(result.termination, Termination::kNumericalTrouble);
  EXPECT_EQ(result.primal, PointKind::kNone);
  EXPECT_EQ(result.get_x_val().size(), 0);
}

TEST(Lies, FractionsAreNoIntegers) {
  MathematicalProgram program;
  const auto x = program.NewIntegerVariables(1);
  program.AddLinearCost(Eigen::VectorXd::Ones(1), x);
  program.AddBoundingBoxConstraint(0.25, 3, x);
  FakeBackend fake;
  const auto result = fake.Solve(program);  // x = 0.25, the bound
  EXPECT_EQ(result.termination, Termination::kNumericalTrouble);
  EXPECT_EQ(result.violation.integrality, 0.25);
  EXPECT_EQ(result.primal, PointKind::kInfeasible);
}

TEST(Lies, ATargetNeedsAFeasiblePoint) {
  EXPECT_EQ(Solve({.termination = SY_TARGET}).termination, Termination::kTarget);
  EXPECT_EQ(Solve({.termination = SY_TARGET, .x = 1}).termination, Termination::kNumericalTrouble);
}

TEST(Lies, AFalseContradictionIsFoundOut) {
  const auto result =
      Solve({.termination = SY_INFEASIBLE, .primal = SY_NO_POINT, .dual = SY_CERTIFICATE});
  EXPECT_EQ(result.termination, Termination::kNumericalTrouble);
  EXPECT_EQ(result.dual, PointKind::kNone);
  EXPECT_FALSE(result.has_duals());
  EXPECT_EQ(OnlyNote(result),
            "test.fake says infeasible; its certificate does not hold: the duals prove no "
            "contradiction");
}

TEST(Lies, AFalseRayIsFoundOut) {
  for (const double x : {1.0, -1.0, 0.0}) {  // leaves x <= 3, leaves the row, gains nothing
    const auto result = Solve({.termination = SY_UNBOUNDED,
                               .x = x,
                               .y = 0,
                               .primal = SY_CERTIFICATE,
                               .dual = SY_NO_POINT});
    EXPECT_EQ(result.termination, Termination::kNumericalTrouble);
    EXPECT_EQ(result.primal, PointKind::kNone);
    EXPECT_EQ(result.get_x_val().size(), 0) << "what is no point is not given out as one";
    EXPECT_EQ(OnlyNote(result),
              "test.fake says unbounded; its ray leaves the constraints, or gains nothing");
  }
}

// min x - y, x = y: along (1, 1 + 1e-10) the objective falls by 1e-10, by as much as the row gives.
TEST(Lies, ARayThatGainsByRoundingAloneIsNone) {
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(2);
  program.AddLinearCost(Eigen::Vector2d(1, -1), x);
  program.AddLinearEqualityConstraint(Eigen::RowVector2d(1, -1), 0.0, x);
  FakeBackend fake;
  fake.behaviour().answer = [](const sy_problem&, const sy_control&, sy_result& r) {
    r.termination = SY_UNBOUNDED;
    r.primal = SY_CERTIFICATE;
    r.x[0] = 1;
    r.x[1] = 1 + 1e-10;
  };
  EXPECT_EQ(fake.Solve(program).termination, Termination::kNumericalTrouble);
}

TEST(Lies, NumbersThatAreNoneAreAFailure) {
  const auto result = Solve({.x = std::nan("")});
  EXPECT_EQ(result.termination, Termination::kBackendFailed);
  EXPECT_NE(result.message.find("it returned nan in x(0)"), std::string::npos) << result.message;
  EXPECT_EQ(result.primal, PointKind::kNone);
  EXPECT_EQ(Solve({.row_dual = kInf}).termination, Termination::kBackendFailed);
}

TEST(Lies, WhatItThrowsIsAFailure) {
  Diet diet;
  FakeBackend fake;
  fake.behaviour().answer = [](const sy_problem&, const sy_control&, sy_result&) {
    throw std::runtime_error("the factor of row[0] is singular");
  };
  const auto result = fake.Solve(diet.program);
  EXPECT_EQ(result.termination, Termination::kBackendFailed);
  EXPECT_NE(result.message.find("the factor of demand is singular"), std::string::npos)
      << result.message;
  EXPECT_EQ(result.solver, "test.fake");
}

TEST(Lies, WordsOfANewerVersionAreReadAsNothing) {
  const auto result = Solve({.termination = 99, .primal = 77, .dual = -3});
  EXPECT_EQ(result.termination, Termination::kNotSolved);
  EXPECT_EQ(result.primal, PointKind::kNone);
  EXPECT_EQ(result.dual, PointKind::kNone);
}

constexpr std::uint64_t kTolerances = SY_HONORS_FEASIBILITY | SY_HONORS_OPTIMALITY;

TEST(Lies, AnAnswerThatIsNotSupportedIsAskedForAgainMoreTightly) {
  Diet diet;
  FakeBackend fake([](sy_solver& t) { t.honors = kTolerances; });
  fake.behaviour().answer = [](const sy_problem& p, const sy_control& c, sy_result& r) {
    const bool tight = c.optimality <= 1e-10 && c.feasibility <= 1e-10;
    Says({.x = tight ? 2 : 2 + 1e-4})(p, c, r);
  };
  const auto result = fake.Solve(diet.program);
  EXPECT_EQ(fake.behaviour().solves, 2);
  EXPECT_EQ(result.termination, Termination::kOptimal);
  EXPECT_EQ(result.objective, 2);
  EXPECT_EQ(OnlyNote(result),
            "solved again at tolerances of 1e-10, since the first answer was not supported to "
            "1e-6");
}

TEST(Lies, AnAnswerIsNotAskedForAgainWhereTheUserSetTheTolerance) {
  Diet diet;
  FakeBackend fake([](sy_solver& t) { t.honors = kTolerances; });
  fake.behaviour().answer = Says({.x = 2 + 1e-4});
  const auto result =
      fake.Solve(diet.program, With([](SolverOptions& o) { o.optimality_tolerance = 1e-4; }));
  EXPECT_EQ(fake.behaviour().solves, 1);
  EXPECT_EQ(result.termination, Termination::kNumericalTrouble);
  EXPECT_EQ(result.dual, PointKind::kNearlyFeasible);
}

// 1e-8 x >= 1 holds at x = 1e8, though its row with the dual 1 looks like a contradiction.
TEST(Certificates, ASmallResidualOnAFreeColumnProvesNothing) {
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(1);
  program.AddLinearConstraint(Eigen::RowVectorXd::Constant(1, 1e-8), 1, kInfinity, x);
  const Lowering lowering(program);
  EXPECT_FALSE(ProvesInfeasible(lowering.problem().view(), {{}, {-1e-8}, {1}, {}}));
}

}  // namespace
}  // namespace switchyard::testing
