// A lowering that looks at its program again; and the user's names in its texts.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <memory>
#include <string>

#include "core/lower/lowering.hpp"
#include "core/problem/difference.hpp"

namespace switchyard {
namespace {

/// A program of every kind of term, the evaluators at hand.
struct Everything {
  MathematicalProgram program;
  VectorXDecisionVariable x = program.NewContinuousVariables(3, "x");
  Binding<LinearCost> linear = program.AddLinearCost(Eigen::Vector3d(1, 2, 3), 1, x);
  Binding<QuadraticCost> quadratic =
      program.AddQuadraticCost(Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero(), 0, x);
  Binding<L2NormCost> norm =
      program.AddL2NormCost(Eigen::Matrix3d::Identity(), Eigen::Vector3d::Ones(), x);
  Binding<BoundingBoxConstraint> box = program.AddBoundingBoxConstraint(-1, 1, x);
  Binding<LinearConstraint> rows = program.AddLinearConstraint(
      Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones(), x);
  Binding<LorentzConeConstraint> cone =
      program.AddLorentzConeConstraint(Eigen::Matrix3d::Identity(), Eigen::Vector3d::UnitX(), x);
  Lowering lowering{program};

  /// What Refresh says, having compared its problem with one lowered anew.
  std::uint64_t Refresh() {
    const std::uint64_t kinds = lowering.Refresh(program);
    const Lowering anew(program);
    EXPECT_EQ(ProblemDifference(lowering.problem().data(), anew.problem().data()), 0u);
    EXPECT_EQ(lowering.problem().data().flags, anew.problem().data().flags);
    EXPECT_EQ(lowering.FirstConeRow(0), anew.FirstConeRow(0));
    EXPECT_EQ(lowering.FirstRow(0), anew.FirstRow(0));
    return kinds;
  }
};

constexpr std::uint64_t kBounds = SY_UPDATES_BOUNDS;
constexpr std::uint64_t kVectors = SY_UPDATES_VECTORS;
constexpr std::uint64_t kValues = SY_UPDATES_VALUES;

TEST(Refresh, SaysWhichKindsOfNumbersChanged) {
  Everything e;
  EXPECT_EQ(e.Refresh(), 0u);
  e.linear.evaluator()->UpdateCoefficients(Eigen::Vector3d(1, 2, 4), 1);
  EXPECT_EQ(e.Refresh(), kVectors);
  e.linear.evaluator()->UpdateCoefficients(Eigen::Vector3d(1, 2, 4), 7);
  EXPECT_EQ(e.Refresh(), kVectors) << "the offset";
  e.quadratic.evaluator()->UpdateCoefficients(2 * Eigen::Matrix3d::Identity(),
                                              Eigen::Vector3d::Zero());
  EXPECT_EQ(e.Refresh(), kValues);
  e.box.evaluator()->UpdateBounds(Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones());
  EXPECT_EQ(e.Refresh(), kBounds);
  e.rows.evaluator()->UpdateCoefficients(3 * Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero(),
                                         2 * Eigen::Vector3d::Ones());
  EXPECT_EQ(e.Refresh(), kBounds | kValues);
  e.cone.evaluator()->UpdateCoefficients(2 * Eigen::Matrix3d::Identity(), Eigen::Vector3d::Ones());
  EXPECT_EQ(e.Refresh(), kVectors | kValues);
  e.norm.evaluator()->UpdateCoefficients(Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero());
  EXPECT_EQ(e.Refresh(), kVectors);
  e.program.set_objective_sense(ObjectiveSense::kMinimize);
  EXPECT_EQ(e.Refresh(), 0u);
}

TEST(Refresh, ConvexityIsAmongTheValues) {
  Everything e;
  e.quadratic.evaluator()->UpdateCoefficients(-Eigen::Matrix3d::Identity(),
                                              Eigen::Vector3d::Zero());
  EXPECT_EQ(e.Refresh(), kValues);
  EXPECT_EQ(e.lowering.problem().view().flags & SY_PROBLEM_CONVEX, 0u);
}

TEST(Refresh, SaysThatTheStructureChangedAndIsThenInStepAgain) {
  Everything e;
  e.program.AddLinearConstraint(Eigen::RowVector3d(1, 1, 1), -1.0 * Eigen::VectorXd::Ones(1),
                                Eigen::VectorXd::Ones(1), e.x);
  EXPECT_EQ(e.Refresh(), kStructureChanged);
  EXPECT_EQ(e.Refresh(), 0u);
  const auto cone = e.program.AddLorentzConeConstraint(Eigen::Matrix3d::Identity(),
                                                       Eigen::Vector3d::UnitX(), e.x);
  EXPECT_EQ(e.Refresh(), kStructureChanged);
  e.program.RemoveConstraint(cone);
  EXPECT_EQ(e.Refresh(), kStructureChanged);
  e.program.NewContinuousVariables(1);
  EXPECT_EQ(e.Refresh(), kStructureChanged);
  e.rows.evaluator()->UpdateCoefficients(Eigen::Matrix3d::Ones(), Eigen::Vector3d::Zero(),
                                         Eigen::Vector3d::Ones());
  EXPECT_EQ(e.Refresh(), kStructureChanged) << "entries where there were none";
  e.linear.evaluator()->UpdateCoefficients(Eigen::Vector3d(0, 0, 4), 7);
  EXPECT_EQ(e.Refresh(), kVectors);
}

TEST(Refresh, ACostTakesTheRowsOfAnother) {
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(2);
  const Eigen::Matrix2d I = Eigen::Matrix2d::Identity();
  const auto first =
      program.AddCost(CreateBinding(std::make_shared<LInfNormCost>(I, Eigen::Vector2d::Zero()), x));
  Lowering lowering(program);
  program.RemoveCost(first);
  program.AddLinearConstraint(Eigen::Matrix<double, 4, 2>::Ones(), -Eigen::Vector4d::Ones(),
                              Eigen::Vector4d::Ones(), x);
  EXPECT_EQ(lowering.Refresh(program), kStructureChanged);
  EXPECT_EQ(ProblemDifference(lowering.problem().data(), Lowering(program).problem().data()), 0u);
}

TEST(Refresh, AFailureLeavesTheProblemAsItWas) {
  Everything e;
  const ProblemData before = e.lowering.problem().data();
  e.program.set_objective_sense(ObjectiveSense::kMaximize);
  EXPECT_THROW(e.lowering.Refresh(e.program), InvalidArgument);
  EXPECT_EQ(ProblemDifference(before, e.lowering.problem().data()), 0u);
  e.program.set_objective_sense(ObjectiveSense::kMinimize);
  EXPECT_EQ(e.Refresh(), 0u);
}

TEST(WithNames, PutsTheUsersNamesWhereTheProblemsStand) {
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(2, "p");
  auto rows = program.AddLinearConstraint(Eigen::Matrix2d::Identity(), Eigen::Vector2d::Zero(),
                                          Eigen::Vector2d::Ones(), x);
  rows.evaluator()->set_row_names({"supply", "demand"});
  auto free =
      program.AddLinearEqualityConstraint(Eigen::Matrix2d::Identity(), Eigen::Vector2d::Zero(), x);
  free.evaluator()->set_description("balance");
  auto cone = program.AddLorentzConeConstraint(x);
  cone.evaluator()->set_description("reach");
  auto norm = program.AddL2NormCost(Eigen::Matrix2d::Identity(), Eigen::Vector2d::Zero(), x);
  norm.evaluator()->set_description("effort");
  program.AddCost(CreateBinding(
      std::make_shared<LInfNormCost>(Eigen::Matrix2d::Identity(), Eigen::Vector2d::Zero()), x));
  const Lowering lowering(program);
  const auto said = [&](const std::string& text) { return lowering.WithNames(program, text); };
  EXPECT_EQ(said("x[0] and x[1]"), "p(0) and p(1)");
  EXPECT_EQ(said("row[1] meets row[2], row[3]"), "demand meets balance[0], balance[1]");
  EXPECT_EQ(said("cone[0]:cone[1]"), "reach:a norm cost's cone");
  EXPECT_EQ(said("x[2], x[3]"), "the epigraph of effort, the epigraph of infinity-norm cost");
  EXPECT_EQ(said("row[4]"), "a norm cost's row");
  EXPECT_EQ(said("max[0] x[99] x[] x[0 x[a] row[] [0]"), "max[0] x[99] x[] x[0 x[a] row[] [0]");
  EXPECT_EQ(said("x[99999999999999999999]"), "x[99999999999999999999]");
  EXPECT_EQ(said(""), "");
}

TEST(WithNames, WhereThereAreRowsOfNormsAlone) {
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(1);
  program.AddCost(CreateBinding(
      std::make_shared<L1NormCost>(Eigen::MatrixXd::Identity(1, 1), Eigen::VectorXd::Zero(1)), x));
  EXPECT_EQ(Lowering(program).WithNames(program, "row[1]"), "a norm cost's row");
}

}  // namespace
}  // namespace switchyard
