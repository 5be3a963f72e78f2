#include <cmath>
#include <limits>

#include "switchyard/model/program.hpp"
#include "tests/model/said.hpp"

namespace switchyard {
namespace {

using Eigen::MatrixXd;
using Eigen::RowVector2d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// Classes of a user's own, without derivatives.
class Sine final : public Cost {
 public:
  Sine() : Cost(1) {}
  [[nodiscard]] std::string Kind() const override { return "sine"; }

 private:
  [[nodiscard]] VectorXd DoEval(const VectorRef& x) const override { return x.array().sin(); }
};

class SineRow final : public Constraint {
 public:
  explicit SineRow(bool with_bounds) : Constraint(1, 1) {
    if (with_bounds) SetBounds("sine row", VectorXd::Zero(1), VectorXd::Zero(1));
  }
  [[nodiscard]] std::string Kind() const override { return "sine row"; }

 private:
  [[nodiscard]] VectorXd DoEval(const VectorRef& x) const override { return x.array().sin(); }
  [[nodiscard]] double ViolationOf(const VectorXd& y) const override { return std::abs(y[0]); }
};

TEST(Terms, AreStoredByTheTypeOfTheirEvaluator) {
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(2);
  const MatrixXd I = MatrixXd::Identity(2, 2);
  const Vector2d zero = Vector2d::Zero();
  const std::vector<std::shared_ptr<Cost>> costs = {
      std::make_shared<LinearCost>(zero), std::make_shared<QuadraticCost>(I, zero),
      std::make_shared<L1NormCost>(I, zero), std::make_shared<PerspectiveQuadraticCost>(I, zero)};
  const std::vector<std::shared_ptr<Constraint>> constraints = {
      std::make_shared<LinearConstraint>(I, zero, zero),
      std::make_shared<LinearEqualityConstraint>(I, zero),
      std::make_shared<BoundingBoxConstraint>(zero, zero),
      std::make_shared<LorentzConeConstraint>(I, zero),
      std::make_shared<RotatedLorentzConeConstraint>(I, zero)};
  for (const auto& cost : costs) program.AddCost(cost, x);
  for (const auto& constraint : constraints) program.AddConstraint(constraint, x);
  EXPECT_EQ(program.linear_costs().size(), 1u);
  EXPECT_EQ(program.quadratic_costs().size(), 1u);
  EXPECT_EQ(program.norm_costs().size(), 2u);
  EXPECT_EQ(program.affine_constraints().size(), 2u);
  EXPECT_EQ(program.linear_constraints().at(0).evaluator(), constraints[0]);
  EXPECT_EQ(program.linear_constraints().size(), 1u);
  EXPECT_EQ(program.linear_equality_constraints().at(0).evaluator(), constraints[1]);
  EXPECT_EQ(program.linear_equality_constraints().size(), 1u);
  EXPECT_EQ(program.bounding_box_constraints().at(0).evaluator(), constraints[2]);
  EXPECT_EQ(program.cone_constraints().size(), 2u);
  EXPECT_EQ(program.lorentz_cone_constraints().at(0).evaluator(), constraints[3]);
  EXPECT_EQ(program.rotated_lorentz_cone_constraints().at(0).evaluator(), constraints[4]);
  EXPECT_EQ(program.GetAllCosts().size(), costs.size());
  EXPECT_EQ(program.GetAllConstraints().size(), constraints.size());
}

TEST(Terms, OfAUsersOwnClassAreGeneric) {
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(1);
  const auto cost = program.AddCost(std::make_shared<Sine>(), x);
  const auto row = program.AddConstraint(std::make_shared<SineRow>(true), x);
  EXPECT_EQ(program.generic_costs().size(), 1u);
  EXPECT_EQ(program.generic_constraints().size(), 1u);
  EXPECT_FALSE(cost.evaluator()->has_jacobian());
  EXPECT_NEAR(program.EvalCosts(VectorXd::Constant(1, 0.5)), std::sin(0.5), 1e-15);
  EXPECT_EQ(program.RemoveCost(cost), 1);
  EXPECT_EQ(program.RemoveConstraint(row), 1);
  EXPECT_TRUE(program.GetAllCosts().empty());
}

TEST(Terms, ConstraintsWithoutBoundsAreRefused) {
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(1);
  EXPECT_EQ(Said([&] { program.AddConstraint(std::make_shared<SineRow>(false), x); }),
            "sine row: it needs bounds of its 1 rows, and its class has set none");
  EXPECT_TRUE(program.GetAllConstraints().empty());
}

TEST(Terms, OnVariablesOfNoOrAnotherProgramAreRefused) {
  MathematicalProgram theirs;
  MathematicalProgram ours;
  const auto y = theirs.NewContinuousVariables(1);
  const auto x = ours.NewContinuousVariables(1);
  EXPECT_EQ(Said([&] {
              ours.AddLinearCost(Vector2d::Ones(), {x, y});
            }),
            "linear cost: variable 1 of 2 is not of this program");
  EXPECT_EQ(Said([&] {
              ours.AddLinearConstraint(RowVector2d(1, 1), 0, 1, {Variable(), x[0]});
            }),
            "linear constraint: variable 0 of 2 is a dummy, it belongs to no program");
  auto named = std::make_shared<LinearCost>(Vector2d::Ones());
  named->set_description("fuel");
  EXPECT_EQ(Said([&] {
              ours.AddCost(named, {y, x});
            }),
            "fuel: variable 0 of 2 is not of this program");
  EXPECT_TRUE(ours.GetAllCosts().empty());
  EXPECT_TRUE(ours.GetAllConstraints().empty());
}

TEST(Terms, OfAnotherSizeThanTheirVariablesAreRefused) {
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(2);
  EXPECT_EQ(Said([&] { program.AddLinearCost(Vector3d::Ones(), x); }),
            "linear cost takes 3 variables, got 2");
  EXPECT_EQ(Said([&] { program.AddBoundingBoxConstraint(Vector3d::Zero(), Vector3d::Ones(), x); }),
            "bounding box constraint takes 3 variables, got 2");
  EXPECT_EQ(Said([&] { program.AddCost(std::shared_ptr<LinearCost>(), x); }),
            "a binding needs an evaluator, got a null pointer");
  EXPECT_EQ(Said([&] { program.AddLinearCost(Vector2d(1, kNaN), x); }),
            "linear cost: a[1] needs to be finite, got nan");
  EXPECT_EQ(Said([&] { program.AddBoundingBoxConstraint(1, 0, x); }),
            "bounding box constraint: bounds: lower[0] = 1 is above upper[0] = 0");
}

TEST(Terms, TakeOneVariableAVectorAMatrixOrAList) {
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(2);
  const auto X = program.NewContinuousVariables(2, 2);
  program.AddBoundingBoxConstraint(0, 1, x[0]);
  program.AddBoundingBoxConstraint(0, 1, x);
  program.AddBoundingBoxConstraint(0, 1, X);
  program.AddBoundingBoxConstraint(0, 1, {x.head(1), X.col(1)});
  program.AddBoundingBoxConstraint(0, 1, VariableRefList{x.tail(1), x.head(1)});
  program.AddBoundingBoxConstraint(0, 1, {x[1], x[0]});
  const auto boxes = program.bounding_box_constraints();
  EXPECT_EQ(boxes[0].variables().size(), 1);
  EXPECT_EQ(boxes[2].variables()[1], X(1, 0));
  EXPECT_EQ(boxes[3].variables()[2], X(1, 1));
  EXPECT_EQ(boxes[4].variables()[0], x[1]);
  EXPECT_EQ(boxes[5], CreateBinding(boxes[5].evaluator(), {x[1], x[0]}));
  EXPECT_TRUE(boxes[3].ContainsVariable(X(0, 1)));
  EXPECT_FALSE(boxes[3].ContainsVariable(x[1]));
}

TEST(Terms, MayHoldOneVariableTwice) {
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(1);
  program.AddLinearCost(Vector2d(2, 3), {x[0], x[0]});
  EXPECT_EQ(program.EvalCosts(VectorXd::Constant(1, 4)), 20);
}

TEST(Terms, OfAMatrixOfVariablesNeedItSymmetric) {
  MathematicalProgram program;
  const auto X = program.NewContinuousVariables(2, 2);
  EXPECT_EQ(Said([&] { program.AddPositiveSemidefiniteConstraint(X); }),
            "positive semidefinite constraint: the matrix needs to be symmetric, got two variables "
            "at (0,1) and (1,0)");
  EXPECT_EQ(Said([&] { program.AddPositiveSemidefiniteConstraint(X.leftCols(1)); }),
            "positive semidefinite constraint: the matrix needs to be square, got 2 x 1");
  const auto S = program.NewSymmetricContinuousVariables(3);
  EXPECT_EQ(program.AddPositiveSemidefiniteConstraint(S).variables().size(), 9);
  EXPECT_EQ(program.cone_constraints().size(), 1u);
}

TEST(Terms, AreRemovedByEvaluatorAndVariables) {
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(2);
  const auto cost = program.AddLinearCost(Vector2d::Ones(), x);
  program.AddCost(cost);
  program.AddCost(cost.evaluator(), {x[1], x[0]});
  program.AddLinearCost(Vector2d::Ones(), x);
  EXPECT_EQ(program.RemoveCost(cost), 2);
  EXPECT_EQ(program.RemoveCost(cost), 0);
  EXPECT_EQ(program.linear_costs().size(), 2u);
  const auto box = program.AddBoundingBoxConstraint(0, 1, x);
  const auto row = program.AddLinearEqualityConstraint(RowVector2d(1, 1), 1, x);
  const auto cone = program.AddLorentzConeConstraint(x);
  for (const Binding<Constraint>& binding : program.GetAllConstraints()) {
    EXPECT_EQ(program.RemoveConstraint(binding), 1);
  }
  EXPECT_TRUE(program.GetAllConstraints().empty());
}

TEST(Terms, SumUpToTheObjective) {
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(2);
  program.AddLinearCost(Vector2d(1, 2), 3, x);
  program.AddQuadraticCost(2 * MatrixXd::Identity(2, 2), Vector2d::Zero(), x);
  program.AddL2NormCost(MatrixXd::Identity(2, 2), Vector2d::Zero(), x);
  EXPECT_DOUBLE_EQ(program.EvalCosts(Vector2d(3, 4)), (3 + 8 + 3) + 25 + 5);
  EXPECT_EQ(Said([&] { (void)program.EvalCosts(Vector3d::Zero()); }),
            "evaluation: x needs 2 entries, got 3");
}

TEST(Terms, AreSatisfiedAtThePointOfTheWholeProgram) {
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(3);
  const auto row = program.AddLinearConstraint(RowVector2d(1, -1), 0, 1, {x[2], x[0]});
  EXPECT_TRUE(program.CheckSatisfied(row, Vector3d(1, 99, 2)));
  EXPECT_FALSE(program.CheckSatisfied(row, Vector3d(2, 99, 1)));
  EXPECT_EQ(program.EvalBinding(row, Vector3d(2, 99, 1))[0], -1);
  EXPECT_EQ(program.ValuesOf(row.variables(), Vector3d(2, 99, 1)), Vector2d(1, 2));
}

TEST(Clone, HasTheSameVariablesAndSharesEvaluators) {
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(2, "x");
  program.set_name("one");
  program.set_objective_sense(ObjectiveSense::kMaximize);
  program.SetInitialGuess(x[0], 7);
  const auto cost = program.AddLinearCost(Vector2d::Ones(), x);
  program.AddLorentzConeConstraint(x);
  const auto clone = program.Clone();
  EXPECT_EQ(clone->name(), "one");
  EXPECT_EQ(clone->objective_sense(), ObjectiveSense::kMaximize);
  EXPECT_EQ(clone->FindDecisionVariableIndex(x[1]), 1);
  EXPECT_EQ(clone->VariableName(1), "x(1)");
  EXPECT_EQ(clone->GetInitialGuess(x[0]), 7);
  EXPECT_EQ(clone->linear_costs().at(0), cost);
  EXPECT_EQ(clone->cone_constraints().size(), 1u);
}

TEST(Clone, ChangesWithoutTheOriginal) {
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(2);
  const auto clone = program.Clone();
  const auto y = clone->NewContinuousVariables(1);
  const auto z = program.NewContinuousVariables(1);
  clone->AddLinearCost(Vector2d::Ones(), {x[0], y[0]});
  EXPECT_TRUE(program.GetAllCosts().empty());
  EXPECT_FALSE(program.Contains(y[0]));
  EXPECT_FALSE(clone->Contains(z[0]));
  EXPECT_EQ(clone->FindDecisionVariableIndex(y[0]), program.FindDecisionVariableIndex(z[0]));
}

}  // namespace
}  // namespace switchyard
