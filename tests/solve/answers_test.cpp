// Honest answers, in the program's own terms.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/support/fake_backend.hpp"

namespace switchyard::testing {
namespace {

/// min or max x - 2 y + 10, 0 <= x <= 3, -1 <= y <= 4.
struct Box {
  explicit Box(ObjectiveSense sense = ObjectiveSense::kMinimize) {
    program.set_objective_sense(sense);
    program.AddLinearCost(Eigen::Vector2d(1, -2), 10, x);
  }
  MathematicalProgram program;
  VectorXDecisionVariable x = program.NewContinuousVariables(2, "x");
  Binding<BoundingBoxConstraint> box =
      program.AddBoundingBoxConstraint(Eigen::Vector2d(0, -1), Eigen::Vector2d(3, 4), x);
};

TEST(Answers, AnOptimumWithItsDualsStands) {
  Box b;
  FakeBackend fake;
  const auto result = fake.Solve(b.program);
  EXPECT_EQ(result.termination, Termination::kOptimal) << result.message;
  EXPECT_TRUE(result.is_success());
  EXPECT_EQ(result.primal, PointKind::kFeasible);
  EXPECT_EQ(result.dual, PointKind::kFeasible);
  EXPECT_EQ(result.GetSolution(b.x), Eigen::Vector2d(0, 4));
  EXPECT_EQ(result.objective, 2);
  EXPECT_LE(result.bound, 2);
  EXPECT_NEAR(result.bound, 2, 1e-12);
  EXPECT_NEAR(result.gap(), 0, 1e-12);
  EXPECT_EQ(result.GetDualSolution(b.box), Eigen::Vector2d(1, -2));
  EXPECT_EQ(result.violation.bounds, 0);
  EXPECT_EQ(result.solver, "test.fake");
  EXPECT_EQ(result.solver_version, "1.0");
  EXPECT_TRUE(result.notes.empty());
  EXPECT_TRUE(result.bridges.empty());
}

TEST(Answers, WhereItMaximizesEverySignIsTheUsers) {
  Box b(ObjectiveSense::kMaximize);
  FakeBackend fake;
  const auto result = fake.Solve(b.program);
  EXPECT_EQ(result.termination, Termination::kOptimal);
  EXPECT_EQ(result.GetSolution(b.x), Eigen::Vector2d(3, -1));
  EXPECT_EQ(result.objective, 15);
  EXPECT_GE(result.bound, 15);
  EXPECT_NEAR(result.bound, 15, 1e-12);
  // d(optimal cost) / d(side): x <= 3 is worth 1, y >= -1 is worth -2.
  EXPECT_EQ(result.GetDualSolution(b.box), Eigen::Vector2d(1, -2));
}

TEST(Answers, ADualIsOfTheFirstBindingThatSetsTheSide) {
  Box b;
  const auto wide = b.program.AddBoundingBoxConstraint(-9, 9, b.x);
  const auto tight = b.program.AddBoundingBoxConstraint(1, 2, b.x);
  const auto again = b.program.AddBoundingBoxConstraint(1, 2, VariableList{b.x[0], b.x[0]});
  FakeBackend fake;
  const auto result = fake.Solve(b.program);
  EXPECT_EQ(result.GetSolution(b.x), Eigen::Vector2d(1, 2));
  EXPECT_EQ(result.GetDualSolution(b.box), Eigen::Vector2d(0, 0));
  EXPECT_EQ(result.GetDualSolution(wide), Eigen::Vector2d(0, 0));
  EXPECT_EQ(result.GetDualSolution(tight), Eigen::Vector2d(1, -2));
  EXPECT_EQ(result.GetDualSolution(again), Eigen::Vector2d(0, 0));
}

TEST(Answers, ADualOfAVariableThatStandsTwiceInABoxIsGivenOnce) {
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(1);
  program.AddLinearCost(Eigen::VectorXd::Ones(1), x);
  const auto box = program.AddBoundingBoxConstraint(1, 2, VariableList{x[0], x[0]});
  FakeBackend fake;
  EXPECT_EQ(fake.Solve(program).GetDualSolution(box), Eigen::Vector2d(1, 0));
}

/// min x + y, x + y >= 2 (row), (x, y) in the Lorentz cone: 2 at (2, 0) with any dual of the row 1.
struct RowAndCone {
  RowAndCone() {
    rows.evaluator()->set_row_names({"demand"});
    program.AddLinearCost(Eigen::Vector2d(1, 1), x);
  }
  MathematicalProgram program;
  VectorXDecisionVariable x = program.NewContinuousVariables(2, "x");
  Binding<LinearConstraint> rows = program.AddLinearConstraint(
      Eigen::RowVector2d(1, 1), 2.0, std::numeric_limits<double>::infinity(), x);
  Binding<LorentzConeConstraint> cone = program.AddLorentzConeConstraint(x);

  static Answer Says(double x, double y, double row, double first, double second) {
    return [=](const sy_problem&, const sy_control&, sy_result& r) {
      r.termination = SY_OPTIMAL;
      r.primal = r.dual = SY_FEASIBLE;
      r.x[0] = x;
      r.x[1] = y;
      r.row_dual[0] = row;
      r.cone_dual[0] = first;
      r.cone_dual[1] = second;
    };
  }
};

TEST(Answers, RowsAndConesHaveTheirDuals) {
  RowAndCone p;
  FakeBackend fake;
  fake.behaviour().answer = RowAndCone::Says(2, 0, 1, 0, 0);
  const auto result = fake.Solve(p.program);
  EXPECT_EQ(result.termination, Termination::kOptimal);
  EXPECT_EQ(result.GetDualSolution(p.rows)[0], 1);
  EXPECT_EQ(result.GetDualSolution(p.cone), Eigen::Vector2d(0, 0));
  EXPECT_NEAR(result.bound, 2, 1e-12);
}

TEST(Answers, ViolationsAreExact) {
  RowAndCone p;
  p.program.AddBoundingBoxConstraint(0, 0.25, VariableList{p.x[0]});
  FakeBackend fake;
  fake.behaviour().answer = [](const sy_problem&, const sy_control&, sy_result& r) {
    r.termination = SY_ITERATION_LIMIT;
    r.primal = SY_INFEASIBLE_POINT;
    r.x[0] = 0.5;
    r.x[1] = 1;
  };
  const auto result = fake.Solve(p.program);
  EXPECT_EQ(result.termination, Termination::kIterationLimit);
  EXPECT_EQ(result.primal, PointKind::kInfeasible);
  EXPECT_EQ(result.violation.rows, 0.5);
  EXPECT_EQ(result.violation.cones, 0.5);
  EXPECT_EQ(result.violation.bounds, 0.25);
  EXPECT_EQ(result.violation.integrality, 0);
  EXPECT_EQ(result.objective, 1.5);
  EXPECT_TRUE(std::isnan(result.bound));
  EXPECT_TRUE(std::isnan(result.gap()));
  EXPECT_FALSE(result.has_duals());
  EXPECT_EQ(result.GetInfeasibleConstraintNames(p.program)[0],
            "bounding box constraint[0]: 0 <= 0.5 <= 0.25");
  EXPECT_EQ(Thrown([&] { static_cast<void>(result.GetDualSolution(p.rows)); }),
            "there is no dual of linear constraint: the backend gave none");
}

TEST(Answers, DualsAtALimitProveABound) {
  RowAndCone p;
  FakeBackend fake;
  // The row's dual 0.5 leaves (0.5, 0.5), which the cone's dual (0.5, 0.5) takes: worth 1.
  const Answer says = RowAndCone::Says(3, 1, 0.5, 0.5, 0.5);
  fake.behaviour().answer = [&](const sy_problem& q, const sy_control& c, sy_result& r) {
    says(q, c, r);
    r.termination = SY_TIME_LIMIT;
  };
  const auto result = fake.Solve(p.program);
  EXPECT_EQ(result.termination, Termination::kTimeLimit);
  EXPECT_FALSE(result.is_success());
  EXPECT_EQ(result.objective, 4);
  EXPECT_NEAR(result.bound, 1, 1e-12);
  EXPECT_LE(result.bound, 1);
  EXPECT_NEAR(result.gap(), 0.75, 1e-12);
}

TEST(Answers, AContradictionIsARay) {
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(1);
  program.AddLinearCost(Eigen::VectorXd::Ones(1), x);
  const auto row = program.AddLinearConstraint(Eigen::MatrixXd::Ones(2, 1), Eigen::Vector2d(2, -9),
                                               Eigen::Vector2d(9, 1), x);
  FakeBackend fake;
  fake.behaviour().answer = [](const sy_problem&, const sy_control&, sy_result& r) {
    r.termination = SY_INFEASIBLE;
    r.dual = SY_CERTIFICATE;
    r.row_dual[0] = 1;
    r.row_dual[1] = -1;
  };
  const auto result = fake.Solve(program);
  EXPECT_EQ(result.termination, Termination::kInfeasible);
  EXPECT_EQ(result.dual, PointKind::kRay);
  EXPECT_EQ(result.primal, PointKind::kNone);
  EXPECT_EQ(result.GetDualSolution(row), Eigen::Vector2d(1, -1));
  EXPECT_EQ(Thrown([&] { static_cast<void>(result.GetSolution(x[0])); }),
            "there is no solution to read: the solve ended with infeasible");
}

TEST(Answers, ARayOfAnUnboundedProgramHasNoObjective) {
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(2);
  program.AddLinearCost(Eigen::Vector2d(0, -1), x);
  program.AddBoundingBoxConstraint(0, std::numeric_limits<double>::infinity(), x);
  FakeBackend fake;
  const auto result = fake.Solve(program);
  EXPECT_EQ(result.termination, Termination::kUnbounded);
  EXPECT_EQ(result.primal, PointKind::kRay);
  EXPECT_EQ(result.get_x_val(), Eigen::Vector2d(0, 1));
  EXPECT_TRUE(std::isnan(result.objective));
  EXPECT_TRUE(std::isnan(result.bound));
}

TEST(Answers, WithIntegersTheBoundIsTheBackendsWord) {
  MathematicalProgram program;
  const auto x = program.NewIntegerVariables(1);
  program.set_objective_sense(ObjectiveSense::kMaximize);
  program.AddLinearCost(Eigen::VectorXd::Ones(1), x);
  program.AddBoundingBoxConstraint(0, 3.5, x);
  FakeBackend fake;
  fake.behaviour().answer = [](const sy_problem&, const sy_control&, sy_result& r) {
    r.termination = SY_NODE_LIMIT;
    r.primal = SY_FEASIBLE;
    r.x[0] = 2;
    r.bound = -3;
    r.nodes = 7;
    r.iterations = 70;
  };
  const auto result = fake.Solve(program);
  EXPECT_EQ(result.termination, Termination::kNodeLimit);
  EXPECT_EQ(result.objective, 2);
  EXPECT_EQ(result.bound, 3);
  EXPECT_EQ(result.gap(), 0.5);
  EXPECT_EQ(result.nodes, 7);
  EXPECT_EQ(result.iterations, 70);
  EXPECT_EQ(result.dual, PointKind::kNone);
}

TEST(Answers, BoundsThatExcludeEachOtherAskNoBackend) {
  Box b;
  b.program.AddBoundingBoxConstraint(5, 6, b.x);
  FakeBackend fake;
  const auto result = fake.Solve(b.program);
  EXPECT_EQ(result.termination, Termination::kInfeasible);
  EXPECT_EQ(result.message, "the bounds of x(0) exclude each other");
  EXPECT_EQ(fake.behaviour().loads, 0);
}

TEST(Answers, TheBackendsWordsHaveTheUsersNames) {
  RowAndCone p;
  FakeBackend fake;
  const Answer says = RowAndCone::Says(2, 0, 1, 0, 0);
  fake.behaviour().answer = [&](const sy_problem& q, const sy_control& c, sy_result& r) {
    says(q, c, r);
    std::snprintf(r.text, r.text_size, "row[0] binds x[0]");
  };
  EXPECT_EQ(fake.Solve(p.program).message, "demand binds x(0)");
}

TEST(Answers, BridgesAreNamed) {
  Box b;
  FakeBackend fake([](sy_solver& t) { t.accepts = SY_ACCEPTS_ROWS; });
  fake.behaviour().answer = [](const sy_problem&, const sy_control&, sy_result& r) {
    r.termination = SY_OPTIMAL;
    r.primal = r.dual = SY_FEASIBLE;
    r.x[0] = 0;
    r.x[1] = 4;
    r.row_dual[0] = 1;
    r.row_dual[1] = -2;
  };
  const auto result = fake.Solve(b.program);
  EXPECT_EQ(result.termination, Termination::kOptimal);
  EXPECT_EQ(result.bridges, std::vector<std::string>{"variable bounds to rows"});
  EXPECT_EQ(result.GetDualSolution(b.box), Eigen::Vector2d(1, -2));
}

TEST(Answers, WordsOfTerminationsAndKinds) {
  EXPECT_EQ(to_string(Termination::kOptimal), "optimal");
  EXPECT_EQ(to_string(Termination::kInfeasibleOrUnbounded), "infeasible_or_unbounded");
  EXPECT_EQ(to_string(Termination::kBackendFailed), "backend_failed");
  EXPECT_EQ(to_string(PointKind::kNearlyFeasible), "nearly_feasible");
  EXPECT_EQ(to_string(PointKind::kRay), "ray");
}

}  // namespace
}  // namespace switchyard::testing
