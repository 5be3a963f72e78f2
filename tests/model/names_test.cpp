// Calls as users of Drake write them: each compiles, and means what its name says.
#include <gtest/gtest.h>

#include "switchyard/model/program.hpp"

namespace switchyard {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kInf = std::numeric_limits<double>::infinity();

struct Names : ::testing::Test {
  MathematicalProgram prog;
  VectorXDecisionVariable x = prog.NewContinuousVariables(3, "x");
  MatrixDecisionVariable<2, 2> X = prog.NewContinuousVariables<2, 2>("X");
  VectorDecisionVariable<2> b = prog.NewBinaryVariables<2>("b");
};

TEST_F(Names, OfCosts) {
  prog.AddLinearCost(Vector3d(1, 2, 3), x);
  prog.AddLinearCost(Vector3d(1, 2, 3), 4, x);
  prog.AddLinearCost(VectorXd::Ones(5), 0, {x, b});
  prog.AddLinearCost(2 * x[0] - x[1] + 1);
  prog.AddQuadraticCost(Matrix2d::Identity(), Vector2d(1, 2), b);
  prog.AddQuadraticCost(Matrix2d::Identity(), Vector2d(1, 2), 3.0, b, true);
  prog.AddQuadraticCost(x[0] * x[0] + x[1] * x[2], false);
  prog.AddQuadraticErrorCost(2.0, Vector3d(1, 2, 3), x);
  prog.AddQuadraticErrorCost(Matrix2d::Identity(), Vector2d(1, 2), {x.head(2)});
  prog.Add2NormSquaredCost(Eigen::Matrix3d::Identity(), Vector3d(1, 2, 3), x);
  prog.AddL2NormCost(Eigen::Matrix3d::Identity(), Vector3d(1, 2, 3), x);
  prog.AddL2NormCost((2 * x - Vector3d(1, 1, 1)).norm());
  const auto [slack, cost, cone] =
      prog.AddL2NormCostUsingConicConstraint(Eigen::Matrix3d::Identity(), Vector3d(1, 2, 3), x);
  EXPECT_TRUE(cone.ContainsVariable(slack));
  const auto linear = prog.AddCost(x.cast<Expression>().sum());
  EXPECT_NE(std::dynamic_pointer_cast<LinearCost>(linear.evaluator()), nullptr);
  const auto quadratic = prog.AddCost(x.dot(x));
  EXPECT_NE(std::dynamic_pointer_cast<QuadraticCost>(quadratic.evaluator()), nullptr);
  const auto general = prog.AddCost(exp(x[0]) * x[1]);
  EXPECT_NE(std::dynamic_pointer_cast<FunctionCost>(general.evaluator()), nullptr);
  const auto shared = std::make_shared<LinearCost>(Vector3d(1, 1, 1));
  EXPECT_EQ(prog.AddCost(shared, x).evaluator(), shared);
  EXPECT_EQ(prog.RemoveCost(general), 1);
  EXPECT_EQ(prog.GetAllCosts().size(), prog.linear_costs().size() + prog.quadratic_costs().size() +
                                           prog.norm_costs().size() + prog.generic_costs().size());
  EXPECT_EQ(prog.l2norm_costs().size(), 2u);
}

TEST_F(Names, OfLinearConstraints) {
  const Eigen::MatrixXd A = Eigen::MatrixXd::Ones(2, 3);
  prog.AddLinearConstraint(A, Vector2d(0, 0), Vector2d(1, 1), x);
  prog.AddLinearConstraint(Eigen::SparseMatrix<double>(A.sparseView()), Vector2d(0, 0),
                           Vector2d(1, 1), x);
  prog.AddLinearConstraint(Eigen::RowVector3d(1, 2, 3), -1, 1, x);
  prog.AddLinearConstraint(Eigen::RowVectorXd::Ones(5), -1, 1, {x, b});
  prog.AddLinearConstraint(x[0] + 2 * x[1], -1, 1);
  prog.AddLinearConstraint(A * x, Vector2d(0, 0), Vector2d(1, 1));
  prog.AddLinearConstraint(x[0] + x[1] <= 3);
  prog.AddLinearConstraint((A * x).array() <= Vector2d(1, 2).array());
  prog.AddLinearEqualityConstraint(x[0] - x[1], 2);
  prog.AddLinearEqualityConstraint(x[0] == x[1]);
  prog.AddLinearEqualityConstraint(A * x, Vector2d(1, 2));
  prog.AddLinearEqualityConstraint(A, Vector2d(1, 2), x);
  prog.AddLinearEqualityConstraint(Eigen::RowVector3d(1, 2, 3), 4, x);
  prog.AddBoundingBoxConstraint(Vector3d(0, 0, 0), Vector3d(1, 1, 1), x);
  prog.AddBoundingBoxConstraint(0, 1, x[0]);
  prog.AddBoundingBoxConstraint(0, 1, x);
  prog.AddBoundingBoxConstraint(0, 1, X);
  prog.AddBoundingBoxConstraint(0, 1, {x, b});
  prog.AddBoundingBoxConstraint(Matrix2d::Zero(), Matrix2d::Ones(), X);
  EXPECT_EQ(prog.bounding_box_constraints().back().variables()[1], X(1, 0));
  const auto box = prog.AddConstraint(x[0] <= 3);
  EXPECT_NE(std::dynamic_pointer_cast<BoundingBoxConstraint>(box.evaluator()), nullptr);
  const auto equal = prog.AddConstraint(x[0] + x[1] == 3);
  EXPECT_NE(std::dynamic_pointer_cast<LinearEqualityConstraint>(equal.evaluator()), nullptr);
  EXPECT_EQ(prog.RemoveConstraint(box), 1);
  EXPECT_EQ(prog.GetAllLinearConstraints().size(),
            prog.affine_constraints().size() + prog.bounding_box_constraints().size());
}

TEST_F(Names, OfConesAndFunctions) {
  prog.AddLorentzConeConstraint(Eigen::Matrix3d::Identity(), Vector3d(1, 0, 0), x);
  prog.AddLorentzConeConstraint(x);
  prog.AddLorentzConeConstraint(Eigen::Vector3<Expression>(1 + x[0], x[1], 2 * x[2]));
  prog.AddLorentzConeConstraint(x.norm() <= 2 + x[0]);
  prog.AddLorentzConeConstraint(x[0] + 1, x[1] * x[1] + x[2] * x[2]);
  prog.AddRotatedLorentzConeConstraint(Eigen::Matrix3d::Identity(), Vector3d(1, 0, 0), x);
  prog.AddRotatedLorentzConeConstraint(x);
  prog.AddRotatedLorentzConeConstraint(x[0] + 1, x[1], x[2] * x[2]);
  prog.AddQuadraticConstraint(Matrix2d::Identity(), Vector2d(0, 0), -kInf, 1, b);
  prog.AddQuadraticAsRotatedLorentzConeConstraint(Matrix2d::Identity(), Vector2d(0, 0), -1, b);
  const auto quadratic = prog.AddConstraint(x.squaredNorm() <= 4);
  EXPECT_NE(std::dynamic_pointer_cast<QuadraticConstraint>(quadratic.evaluator()), nullptr);
  const auto general = prog.AddConstraint(exp(x[0]) + x[1] >= 1);
  EXPECT_NE(std::dynamic_pointer_cast<FunctionConstraint>(general.evaluator()), nullptr);
  prog.AddConstraint(sin(x[0]) * x[1], -1, 1);
  const auto own =
      prog.AddConstraint([](const auto& v) { return v[0] * v[1]; }, VectorXd::Constant(1, 0),
                         VectorXd::Constant(1, 1), x.head(2), {.description = "product"});
  EXPECT_EQ(own.evaluator()->get_description(), "product");
  EXPECT_TRUE(prog.IsThreadSafe());
  const auto clone = prog.Clone();
  EXPECT_EQ(clone->GetAllConstraints().size(), prog.GetAllConstraints().size());
}

TEST_F(Names, OfGuessesAndEvaluation) {
  prog.SetInitialGuess(x, Vector3d(1, 2, 3));
  prog.SetInitialGuess(b[0], 1);
  EXPECT_EQ(prog.GetInitialGuess(x[1]), 2);
  EXPECT_TRUE(std::isnan(prog.GetInitialGuess(b[1])));
  const auto cost = prog.AddLinearCost(Vector3d(1, 1, 1), x);
  EXPECT_EQ(prog.EvalBindingAtInitialGuess(cost)[0], 6);
  const auto row = prog.AddLinearConstraint(Eigen::RowVector3d(1, 1, 1), 0, 5, x);
  EXPECT_FALSE(prog.CheckSatisfiedAtInitialGuess(row));
  VectorXd values = VectorXd::Zero(prog.num_vars());
  prog.SetDecisionVariableValueInVector(x, Vector3d(1, 1, 1), values);
  prog.SetDecisionVariableValueInVector(x[0], 3, values);
  EXPECT_EQ(prog.EvalBinding(cost, values)[0], 5);
  EXPECT_EQ(prog.EvalBindings(std::vector<Binding<LinearCost>>{cost, cost}, values).sum(), 10);
  prog.SetInitialGuessForAllVariables(VectorXd::Zero(prog.num_vars()));
  EXPECT_EQ(prog.initial_guess().sum(), 0);
}

TEST_F(Names, InWords) {
  prog.AddLinearCost(Vector3d(1, -2, 0), 4, x);
  prog.AddQuadraticCost(2 * Matrix2d::Identity(), Vector2d(0, 1), b);
  prog.AddLinearConstraint(Eigen::RowVector3d(1, 1, 1), 0, 5, x);
  prog.AddLorentzConeConstraint(Eigen::Matrix3d::Identity(), Vector3d(1, 0, 0), x);
  prog.AddCost([](const auto& v) { return exp(v[0]); }, x.head(1), {.description = "growth"});
  EXPECT_EQ(prog.to_string(),
            "9 variables, 2 of them integer\n"
            "minimize\n"
            "  linear cost: 4 + x(0) - 2*x(1)\n"
            "  quadratic cost: b(1) + b(0)^2 + b(1)^2\n"
            "  growth: growth(x(0))\n"
            "subject to\n"
            "  linear constraint: 0 <= x(0) + x(1) + x(2) <= 5\n"
            "  Lorentz cone constraint: (1 + x(0), x(1), x(2))\n");
}

}  // namespace
}  // namespace switchyard
