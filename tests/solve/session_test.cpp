// A program solved again after changes: what reaches the backend, and that the answers are those of
// a fresh solve.
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "tests/support/fake_backend.hpp"

namespace switchyard::testing {
namespace {

struct Box {
  MathematicalProgram program;
  VectorXDecisionVariable x = program.NewContinuousVariables(2, "x");
  Binding<LinearCost> cost = program.AddLinearCost(Eigen::Vector2d(1, -2), x);
  Binding<BoundingBoxConstraint> box =
      program.AddBoundingBoxConstraint(Eigen::Vector2d::Zero(), Eigen::Vector2d(3, 4), x);

  void SetBox(double lower, double upper) {
    box.evaluator()->UpdateBounds(Eigen::Vector2d::Constant(lower),
                                  Eigen::Vector2d::Constant(upper));
  }
  void SetCost(double first, double second) {
    cost.evaluator()->UpdateCoefficients(Eigen::Vector2d(first, second));
  }
  void AddBox(double lower, double upper) { program.AddBoundingBoxConstraint(lower, upper, x); }
};

/// The session's answer is a fresh solve's.
void ExpectFresh(SolverSession& session, Box& b) {
  FakeBackend fresh;
  const auto expected = fresh.Solve(b.program);
  const auto result = session.Solve();
  EXPECT_EQ(result.termination, expected.termination) << result.message;
  EXPECT_EQ(result.get_x_val(), expected.get_x_val());
  EXPECT_EQ(result.objective, expected.objective);
  EXPECT_EQ(result.bound, expected.bound);
}

TEST(SolverSession, SendsNumbersAsUpdates) {
  Box b;
  FakeBackend fake;
  SolverSession session(b.program, "", {}, fake.host());
  EXPECT_EQ(session.num_loads(), 0);
  ExpectFresh(session, b);
  EXPECT_EQ(session.num_loads(), 1);
  EXPECT_EQ(session.num_updates(), 0);
  EXPECT_EQ(fake.behaviour().declared & SY_UPDATES_VECTORS, SY_UPDATES_VECTORS);
  EXPECT_EQ(fake.behaviour().control.flags, SY_CONTINUE);

  ExpectFresh(session, b);  // nothing changed
  EXPECT_EQ(session.num_updates(), 0);
  b.SetCost(-1, 1);
  ExpectFresh(session, b);
  b.SetBox(-1, 1);
  ExpectFresh(session, b);
  EXPECT_EQ(session.num_loads(), 1);
  EXPECT_EQ(session.num_updates(), 2);
  EXPECT_EQ(fake.behaviour().updates, 2);
}

TEST(SolverSession, LoadsAnotherStructureAnew) {
  Box b;
  FakeBackend fake;
  SolverSession session(b.program, "", {}, fake.host());
  ExpectFresh(session, b);
  const auto more = b.program.NewContinuousVariables(1, "y");
  b.program.AddBoundingBoxConstraint(2, 3, more);
  b.program.AddLinearCost(Eigen::VectorXd::Ones(1), more);
  ExpectFresh(session, b);
  EXPECT_EQ(fake.behaviour().loads, 2);
  EXPECT_EQ(fake.behaviour().updates, 0);
}

TEST(SolverSession, ReloadsWhatTheBackendTakesNoUpdateOf) {
  Box b;
  FakeBackend fake([](sy_solver& t) { t.updates = SY_UPDATES_BOUNDS; });
  SolverSession session(b.program, "", {}, fake.host());
  ExpectFresh(session, b);
  b.SetBox(-1, 1);
  ExpectFresh(session, b);
  EXPECT_EQ(session.num_loads(), 1);
  b.SetCost(-1, 1);
  ExpectFresh(session, b);
  EXPECT_EQ(session.num_loads(), 2);
}

// What changed while the bounds excluded each other, and no backend was asked, is not lost.
TEST(SolverSession, KeepsWhatChangedWhileNoBackendWasAsked) {
  Box b;
  FakeBackend fake;
  SolverSession session(b.program, "", {}, fake.host());
  ExpectFresh(session, b);
  const auto crossed = b.program.AddBoundingBoxConstraint(8, 9, b.x);
  b.SetCost(-3, 5);
  EXPECT_EQ(session.Solve().termination, Termination::kInfeasible);
  EXPECT_EQ(fake.behaviour().solves, 1);
  b.program.RemoveConstraint(crossed);
  ExpectFresh(session, b);
  EXPECT_EQ(session.Solve().GetSolution(b.x), Eigen::Vector2d(3, 0));
}

TEST(SolverSession, KeepsAnotherStructureThatCameWhileNoBackendWasAsked) {
  Box b;
  FakeBackend fake;
  SolverSession session(b.program, "", {}, fake.host());
  ExpectFresh(session, b);
  const auto crossed = b.program.AddBoundingBoxConstraint(8, 9, b.x);
  b.program.AddBoundingBoxConstraint(0, 1, b.program.NewContinuousVariables(2, "y"));
  EXPECT_EQ(session.Solve().termination, Termination::kInfeasible);
  b.program.RemoveConstraint(crossed);
  ExpectFresh(session, b);
}

TEST(SolverSession, StartsOverAfterAFailure) {
  Box b;
  FakeBackend fake;
  SolverSession session(b.program, "", {}, fake.host());
  ExpectFresh(session, b);
  fake.behaviour().answer = [](const sy_problem&, const sy_control&, sy_result&) {
    throw std::runtime_error("broken");
  };
  b.SetCost(2, 2);
  EXPECT_EQ(session.Solve().termination, Termination::kBackendFailed);
  fake.behaviour().answer = SolveBox;
  b.SetCost(3, -3);
  ExpectFresh(session, b);
  EXPECT_EQ(fake.behaviour().loads, 2);
  EXPECT_EQ(fake.behaviour().updates, 1) << "the update before the failure; then a load is whole";
}

TEST(SolverSession, AMistakeInAGuessLosesNoChange) {
  Box b;
  FakeBackend fake;
  SolverSession session(b.program, "", {}, fake.host());
  ExpectFresh(session, b);
  b.SetCost(-3, 5);
  EXPECT_THROW(session.Solve(Eigen::VectorXd(Eigen::Vector3d::Zero())), InvalidArgument);
  ExpectFresh(session, b);
}

TEST(SolverSession, AnswersAsAFreshSolveThroughRandomChanges) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  Box b;
  FakeBackend fake;
  SolverSession session(b.program, "", {}, fake.host());
  for (int k = 0; k < 40; ++k) {
    switch (random() % 4) {
      case 0:
        b.SetCost(normal(random), normal(random));
        break;
      case 1: {
        const double lower = normal(random);
        b.SetBox(lower, lower + std::abs(normal(random)));
        break;
      }
      case 2:
        b.AddBox(-5 - std::abs(normal(random)), 5);
        break;
      default:
        b.program.set_objective_sense(random() % 2 == 0 ? ObjectiveSense::kMinimize
                                                        : ObjectiveSense::kMaximize);
    }
    ExpectFresh(session, b);
  }
  EXPECT_EQ(session.num_loads(), 1);
}

}  // namespace
}  // namespace switchyard::testing
