#include "switchyard/model/parse.hpp"

#include <limits>
#include <random>

#include "switchyard/model/program.hpp"
#include "tests/model/said.hpp"

namespace switchyard {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
constexpr double kInf = std::numeric_limits<double>::infinity();

class Parse : public testing::Test {
 protected:
  MathematicalProgram program_;
  VectorXDecisionVariable x = program_.NewContinuousVariables(4, "x");
  Variable y = program_.NewContinuousVariables(1, "y")[0];
  std::mt19937 random_;

  // The values of the cost or constraint are those of the expressions, at random points.
  template <class C>
  void ExpectValues(const Binding<C>& binding, const Eigen::VectorX<Expression>& e) {
    for (int trial = 0; trial < 5; ++trial) {
      VectorXd point(program_.num_vars());
      Expression::Values values;
      for (int i = 0; i < point.size(); ++i) {
        point[i] = std::uniform_real_distribution<>(0.5, 2)(random_);
        values[program_.decision_variable(i)] = point[i];
      }
      const VectorXd found = program_.EvalBinding(binding, point);
      ASSERT_EQ(found.size(), e.size());
      EXPECT_LT((found - Evaluate(e, values)).cwiseAbs().maxCoeff(), 1e-9) << e.transpose();
    }
  }
  template <class C>
  void ExpectValue(const Binding<C>& binding, const Expression& e) {
    ExpectValues(binding, Eigen::VectorX<Expression>::Constant(1, e));
  }
  template <class C, class Base>
  static bool IsA(const Binding<Base>& binding) {
    return dynamic_cast<const C*>(binding.evaluator().get()) != nullptr;
  }
};

// ---- Costs ----

TEST_F(Parse, ACostIsTheSimplestThatTheExpressionIs) {
  const Expression linear = 2 * x[0] - y + 3;
  const Expression quadratic = pow(x[0] - y, 2) + x[1] * x[2] - 4 * y + 1;
  const Expression norm = 2 * (x.head(2) - x.tail(2)).norm();
  const Expression other = exp(x[0]) * y + x[1];
  const Expression cancelled = pow(x[0] + 1, 2) - x[0] * x[0];
  EXPECT_TRUE(IsA<LinearCost>(program_.AddCost(linear)));
  EXPECT_TRUE(IsA<QuadraticCost>(program_.AddCost(quadratic)));
  EXPECT_TRUE(IsA<L2NormCost>(program_.AddCost(norm)));
  EXPECT_TRUE(IsA<FunctionCost>(program_.AddCost(other)));
  EXPECT_TRUE(IsA<LinearCost>(program_.AddCost(cancelled)));
  EXPECT_EQ(program_.linear_costs().size(), 2U);
  EXPECT_EQ(program_.quadratic_costs().size(), 1U);
  EXPECT_EQ(program_.norm_costs().size(), 1U);
  EXPECT_EQ(program_.generic_costs().size(), 1U);
  for (const Expression& e : {linear, quadratic, norm, other, cancelled}) {
    ExpectValue(ParseCost(e), e);
  }
  EXPECT_EQ(ParseCost(other).evaluator()->get_description(), "x(1) + exp(x(0))*y");
}

TEST_F(Parse, ACostOfAMatrixProductNeedsNoIndex) {
  const MatrixXd Q = MatrixXd::Identity(4, 4);
  const auto cost = program_.AddCost(x.transpose() * Q * x);
  EXPECT_TRUE(IsA<QuadraticCost>(cost));
  ExpectValue(cost, x.dot(x));
  EXPECT_EQ(program_.AddCost(x[1]).variables(), VectorXDecisionVariable(x.segment(1, 1)));
  EXPECT_EQ(program_.AddCost(4).variables().size(), 0);
}

TEST_F(Parse, ACostOfTheAskedKindIsThatKind) {
  const auto linear = program_.AddLinearCost(y + 3 * x[2] + 1);
  EXPECT_EQ(linear.variables(), Eigen::Vector2<Variable>(y, x[2]));
  EXPECT_EQ(linear.evaluator()->a(), Eigen::Vector2d(1, 3));
  EXPECT_EQ(linear.evaluator()->b(), 1);
  const auto quadratic = program_.AddQuadraticCost(x[0] * x[0] - x[1] * x[1]);
  EXPECT_FALSE(quadratic.evaluator()->is_convex());
  EXPECT_TRUE(program_.AddQuadraticCost(x[0] * x[0], true).evaluator()->is_convex());
  EXPECT_EQ(program_.AddQuadraticCost(x[0] + 1).evaluator()->Q().nonZeros(), 0);
  ExpectValue(program_.AddL2NormCost(x.norm()), x.norm());
  EXPECT_EQ(Said([&] { program_.AddLinearCost(x[0] * y); }),
            "x(0)*y is not affine: the term x(0)*y is not");
  EXPECT_EQ(Said([&] { program_.AddQuadraticCost(sin(y)); }),
            "sin(y) is not quadratic: the term sin(y) is not");
  EXPECT_EQ(Said([&] { program_.AddL2NormCost(sqrt(x[0])); }),
            "sqrt(x(0)) is no norm |Ax + b|: it needs to be a multiple of the root of a sum of "
            "squares of affine expressions");
}

TEST_F(Parse, AVariableOfAnotherProgramIsRefusedAndNothingIsAdded) {
  MathematicalProgram other;
  EXPECT_EQ(Said([&] { other.AddCost(x[0] + 1); }),
            "linear cost: variable 0 of 1 is not of this program");
  EXPECT_TRUE(other.GetAllCosts().empty());
}

// ---- Rows ----

TEST_F(Parse, AffineRowsOfOneCallAreOneConstraint) {
  MatrixXd A = MatrixXd::Random(3, 4);
  const VectorXd b = VectorXd::Random(3);
  const auto rows = program_.AddLinearConstraint((A * x + b).array() <= VectorXd::Zero(3).array());
  EXPECT_FALSE(IsA<BoundingBoxConstraint>(rows));
  EXPECT_EQ(rows.variables(), x);
  EXPECT_EQ(rows.evaluator()->GetDenseA(), A);
  EXPECT_EQ(rows.evaluator()->upper_bound(), -b);
  EXPECT_EQ(rows.evaluator()->lower_bound(), VectorXd::Constant(3, -kInf));
  const auto same =
      program_.AddLinearConstraint(A * x + b, VectorXd::Constant(3, -kInf), VectorXd::Zero(3));
  EXPECT_EQ(same.evaluator()->upper_bound(), -b);
  const auto one_formula = program_.AddConstraint(A * x >= b);
  EXPECT_EQ(one_formula.evaluator()->lower_bound(), b);
  EXPECT_EQ(program_.linear_constraints().size(), 3U);
  const auto single = program_.AddLinearConstraint(x[0] + 2 * y, -1, 3);
  EXPECT_EQ(single.evaluator()->GetDenseA(), Eigen::RowVector2d(1, 2));
}

TEST_F(Parse, EqualitiesAreALinearEqualityConstraint) {
  const MatrixXd A = MatrixXd::Random(3, 4);
  const VectorXd b = VectorXd::Random(3);
  const auto expect = [&](const Binding<Constraint>& found) {
    const auto* equality = dynamic_cast<const LinearEqualityConstraint*>(found.evaluator().get());
    ASSERT_NE(equality, nullptr);
    EXPECT_EQ(equality->GetDenseA(), A);
    EXPECT_EQ(equality->lower_bound(), b);
  };
  expect(program_.AddLinearEqualityConstraint(A * x, b));
  expect(program_.AddLinearEqualityConstraint(A * x == b));
  expect(program_.AddLinearEqualityConstraint((A * x).array() == b.array()));
  expect(program_.AddConstraint(A * x == b));
  expect(program_.AddConstraint(A * x, b, b));
  const auto one = program_.AddConstraint(x[0] == y);
  EXPECT_TRUE(IsA<LinearEqualityConstraint>(one));
  EXPECT_EQ(one.variables(), Eigen::Vector2<Variable>(x[0], y));
  EXPECT_TRUE(IsA<LinearEqualityConstraint>(program_.AddConstraint(x[0] == 3)));
  EXPECT_EQ(program_.AddLinearEqualityConstraint(x[0] + 1, 3).evaluator()->lower_bound()[0], 2);
  EXPECT_EQ(Said([&] { program_.AddLinearEqualityConstraint(x[0] <= y); }),
            "x(0) <= y is no equality");
}

TEST_F(Parse, EqualitiesOfMatricesStandColumnByColumn) {
  const MatrixXDecisionVariable X = program_.NewContinuousVariables(2, 2, "X");
  const Eigen::Matrix2d B = Eigen::Matrix2d::Random();
  const auto all = program_.AddLinearEqualityConstraint(X, B);
  EXPECT_EQ(all.variables(), VectorXDecisionVariable(X.reshaped()));
  EXPECT_EQ(all.evaluator()->lower_bound(), VectorXd(B.reshaped()));
  const auto lower = program_.AddLinearEqualityConstraint(2 * X, B, true);
  EXPECT_EQ(lower.variables(), Eigen::Vector3<Variable>(X(0, 0), X(1, 0), X(1, 1)));
  EXPECT_EQ(lower.evaluator()->lower_bound(), Eigen::Vector3d(B(0, 0), B(1, 0), B(1, 1)));
  EXPECT_EQ(Said([&] { program_.AddLinearEqualityConstraint(X, MatrixXd::Zero(2, 3)); }),
            "2 x 2 expressions need as many lower bounds, got 2 x 3");
}

TEST_F(Parse, RowsOfOneVariableEachAreABoundingBox) {
  const auto box = program_.AddConstraint(2 * x[0] <= 4 && -x[1] <= 3 && x[0] >= 1);
  ASSERT_TRUE(IsA<BoundingBoxConstraint>(box));
  EXPECT_EQ(box.variables(), Eigen::Vector3<Variable>(x[0], x[1], x[0]));
  EXPECT_EQ(box.evaluator()->lower_bound(), Eigen::Vector3d(-kInf, -3, 1));
  EXPECT_EQ(box.evaluator()->upper_bound(), Eigen::Vector3d(2, kInf, kInf));
  EXPECT_TRUE(IsA<BoundingBoxConstraint>(program_.AddLinearConstraint(x[2], 0, 1)));
  EXPECT_TRUE(IsA<BoundingBoxConstraint>(program_.AddConstraint(x.array() >= 0)));
  EXPECT_EQ(program_.bounding_box_constraints().size(), 3U);
}

TEST_F(Parse, WhatCancelsIsLinear) {
  const auto rows =
      program_.AddConstraint(pow(x[0] + y, 2) <= x[0] * x[0] + 2 * x[0] * y + y * y + y);
  ASSERT_TRUE(IsA<BoundingBoxConstraint>(rows));
  EXPECT_EQ(rows.variables()[0], y);
  EXPECT_NE(MaybeParseLinearConstraint(x[0] * y - y * x[0] + y, 0, 1), nullptr);
  EXPECT_EQ(MaybeParseLinearConstraint(x[0] * y, 0, 1), nullptr);
}

TEST_F(Parse, ARowWithoutVariablesIsRefusedOrKept) {
  EXPECT_EQ(Said([&] { program_.AddConstraint(Expression(1) <= 0); }),
            "1 <= 0 is always false: no point satisfies it");
  EXPECT_EQ(Said([&] { program_.AddConstraint(x[0] <= x[0] + 1); }),
            "x(0) <= 1 + x(0) is always true: it constrains nothing");
  EXPECT_EQ(Said([&] { program_.AddConstraint(x[0] >= 1 && Expression(2) == 3); }),
            "2 == 3, row 1 of 2, is always false: no point satisfies it");
  EXPECT_EQ(Said([&] { program_.AddConstraint(Formula::True()); }),
            "true is always true: it constrains nothing");
  EXPECT_EQ(Said([&] { program_.AddConstraint(Formula::False()); }),
            "false is always false: no point satisfies it");
  EXPECT_EQ(Said([&] { program_.AddLinearConstraint(x[0] - x[0] + 1, 2, 3); }),
            "2 <= 1 <= 3 is always false: no point satisfies it");
  MatrixXd A = MatrixXd::Zero(2, 4);
  A(1, 1) = 1;
  const auto kept = program_.AddLinearConstraint((A * x).array() <= 1);
  EXPECT_EQ(kept.evaluator()->num_constraints(), 2);
  EXPECT_EQ(Said([&] { program_.AddConstraint(x[0] == x[0]); }),
            "x(0) == x(0) is always true: it constrains nothing");
}

TEST_F(Parse, AFormulaThatIsNoConstraintIsRefused) {
  EXPECT_EQ(Said([&] { program_.AddConstraint(x[0] < 1); }),
            "x(0) < 1: a strict comparison is no constraint: it takes <=, >= or ==");
  EXPECT_EQ(Said([&] { program_.AddConstraint(x[0] + 0 != 1); }),
            "x(0) != 1: an inequality by != is no constraint: it takes <=, >= or ==");
  EXPECT_EQ(Said([&] { program_.AddConstraint(x[0] <= 1 || y <= 1); }),
            "x(0) <= 1 or y <= 1: alternatives are no constraint");
  EXPECT_EQ(Said([&] { program_.AddConstraint(!(x[0] <= 1)); }),
            "not (x(0) <= 1): a negation is no constraint");
  EXPECT_EQ(Said([&] { program_.AddLinearConstraint(x[0] * y <= 1); }),
            "x(0)*y is not affine: the term x(0)*y is not");
  EXPECT_EQ(Said([&] { program_.AddLinearConstraint(x[0], 1, 0); }),
            "bounding box constraint: bounds: lower[0] = 1 is above upper[0] = 0");
}

// ---- Nonlinear ----

TEST_F(Parse, AQuadraticRowIsAQuadraticConstraint) {
  const auto found = program_.AddConstraint(x.squaredNorm() + y <= 3 + x[0]);
  ASSERT_TRUE(IsA<QuadraticConstraint>(found));
  EXPECT_EQ(found.evaluator()->upper_bound()[0], 3);
  ExpectValue(found, x.squaredNorm() + y - x[0]);
  const auto by_bounds = program_.AddQuadraticConstraint(x[0] * y + 1, 0, 2);
  EXPECT_EQ(by_bounds.evaluator()->lower_bound()[0], -1);
  EXPECT_EQ(by_bounds.evaluator()->upper_bound()[0], 1);
  EXPECT_EQ(program_.quadratic_constraints().size(), 2U);
}

TEST_F(Parse, OtherRowsAreAFunctionDescribedByItsExpression) {
  const auto found = program_.AddConstraint(sin(x[0]) * y + x[1], -1, 2);
  ASSERT_TRUE(IsA<FunctionConstraint>(found));
  EXPECT_EQ(found.evaluator()->get_description(), "x(1) + sin(x(0))*y");
  EXPECT_EQ(found.evaluator()->lower_bound()[0], -1);
  EXPECT_EQ(found.evaluator()->upper_bound()[0], 2);
  ExpectValue(found, sin(x[0]) * y + x[1]);
  const Eigen::Vector3<Expression> e(exp(y), x[0] - x[1], x[2] * x[3]);
  const auto rows = program_.AddConstraint(e, VectorXd::Zero(3), VectorXd::Ones(3));
  EXPECT_TRUE(IsA<FunctionConstraint>(rows));
  ExpectValues(rows, e);
  const auto formula = program_.AddConstraint(exp(y) + 1 >= x[0] + 3);
  EXPECT_EQ(formula.evaluator()->lower_bound()[0], 2);
  EXPECT_EQ(program_.generic_constraints().size(), 3U);
}

// ---- Cones ----

TEST_F(Parse, ANormUnderAnAffineBoundIsALorentzCone) {
  const MatrixXd A = MatrixXd::Random(3, 4);
  const VectorXd b = VectorXd::Random(3);
  const Expression norm = (A * x + b).norm();
  Eigen::VectorX<Expression> z(4);
  z << 2 * y + 1, A * x + b;
  ExpectValues(program_.AddConstraint(norm <= 2 * y + 1), z);
  ExpectValues(program_.AddConstraint(2 * y + 1 >= norm), z);
  ExpectValues(program_.AddLorentzConeConstraint(norm - 2 * y <= 1), z);
  ExpectValues(program_.AddConstraint(norm - 2 * y, -kInf, 1), z);
  ExpectValues(program_.AddLorentzConeConstraint(z), z);
  EXPECT_EQ(program_.lorentz_cone_constraints().size(), 5U);
  EXPECT_TRUE(IsA<FunctionConstraint>(program_.AddConstraint(norm >= 2 * y + 1)));
  EXPECT_TRUE(IsA<FunctionConstraint>(program_.AddConstraint(norm, 1, 2)));
  EXPECT_EQ(Said([&] { program_.AddLorentzConeConstraint(x.norm() >= y); }),
            "sqrt(x(0)^2 + x(1)^2 + x(2)^2 + x(3)^2) >= y is no Lorentz cone: it needs the form "
            "|Ax + b| <= c'x + d, the norm written as .norm() or as the root of a sum of squares");
}

TEST_F(Parse, AnAbsoluteValueUnderAnAffineBoundIsTwoRows) {
  const auto box = program_.AddConstraint(abs(x[0] - 1) <= 3);
  ASSERT_TRUE(IsA<BoundingBoxConstraint>(box));
  EXPECT_EQ(box.evaluator()->lower_bound()[0], -2);
  EXPECT_EQ(box.evaluator()->upper_bound()[0], 4);
  const auto rows = program_.AddConstraint(2 * abs(x[0] - 1) <= y);
  ASSERT_TRUE(IsA<LinearConstraint>(rows));
  EXPECT_EQ(rows.evaluator()->num_constraints(), 2);
  EXPECT_TRUE(rows.evaluator()->CheckSatisfied(Eigen::Vector2d(2, 1)));  // y = 2, x(0) = 1
  EXPECT_FALSE(rows.evaluator()->CheckSatisfied(Eigen::Vector2d(2, 2.5)));
  EXPECT_FALSE(rows.evaluator()->CheckSatisfied(Eigen::Vector2d(2, -0.5)));
}

TEST_F(Parse, ALinearAndAQuadraticExpressionAreACone) {
  const Eigen::Vector3<Expression> z(y + 1, x[0], 2 * x[1] + 1);
  ExpectValues(program_.AddLorentzConeConstraint(y + 1, pow(x[0], 2) + pow(2 * x[1] + 1, 2)), z);
  const auto completed =
      program_.AddLorentzConeConstraint(y, x[0] * x[0] + 2 * x[0] * x[1] + 2 * x[1] * x[1]);
  EXPECT_EQ(completed.evaluator()->A().rows(), 3);
  const auto rotated = program_.AddRotatedLorentzConeConstraint(x[0], y, x[1] * x[1] + x[2] * x[2]);
  ExpectValues(rotated, Eigen::Vector4<Expression>(x[0], y, x[1], x[2]));
  ExpectValues(program_.AddRotatedLorentzConeConstraint(x[0], y, 4),
               Eigen::Vector3<Expression>(x[0], y, 2));
  ExpectValues(program_.AddRotatedLorentzConeConstraint(z), z);
  EXPECT_EQ(program_.AddLorentzConeConstraint(x).variables(), x);
  EXPECT_EQ(program_.AddRotatedLorentzConeConstraint(x).variables(), x);
  EXPECT_EQ(Said([&] { program_.AddLorentzConeConstraint(y, x[0] * x[1]); }),
            "x(0)*x(1) is no sum of squares of affine expressions");
}

TEST_F(Parse, ADiagonallyDominantDualConeHasARowForEachOfItsRays) {
  const MatrixXDecisionVariable X = program_.NewSymmetricContinuousVariables(3, "S");
  const auto found = program_.AddPositiveDiagonallyDominantDualConeMatrixConstraint(X);
  EXPECT_EQ(found.evaluator()->num_constraints(), 9);
  const auto satisfied = [&](const Eigen::Matrix3d& value) {
    VectorXd point = VectorXd::Zero(program_.num_vars());
    for (int j = 0; j < 3; ++j) {
      for (int i = 0; i < 3; ++i) point[program_.FindDecisionVariableIndex(X(i, j))] = value(i, j);
    }
    return program_.CheckSatisfied(found, point);
  };
  Eigen::Matrix3d M;
  M << 1, 1, -1, 1, 1, 1, -1, 1, 1;
  EXPECT_TRUE(satisfied(M));
  M(0, 1) = M(1, 0) = 1.1;
  EXPECT_FALSE(satisfied(M));
}

TEST_F(Parse, MatricesOfCoefficientsAreStillTaken) {
  const MatrixXd A = MatrixXd::Ones(2, 4);
  const VectorXd b = VectorXd::Ones(2);
  program_.AddLinearConstraint(A, -b, b, x);
  program_.AddLinearEqualityConstraint(A, b, x);
  program_.AddLorentzConeConstraint(A, b, x);
  program_.AddLorentzConeConstraint({x, VectorXDecisionVariable::Constant(1, y)});
  program_.AddLinearCost(VectorXd::Ones(4), x);
  program_.AddQuadraticCost(MatrixXd::Identity(4, 4), VectorXd::Zero(4), x);
  program_.AddL2NormCost(A, b, x);
  EXPECT_EQ(program_.GetAllConstraints().size(), 4U);
}

}  // namespace
}  // namespace switchyard
