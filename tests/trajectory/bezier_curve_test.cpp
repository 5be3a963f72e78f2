// Bezier curves by the sums of Bernstein, by differences, and by the maps of their control points.
#include "switchyard/trajectory/bezier_curve.hpp"

#include <cmath>

#include "switchyard/model/new_ids.hpp"
#include "tests/model/said.hpp"
#include "tests/trajectory/curves.hpp"

namespace switchyard::testing {
namespace {

double Bernstein(int m, int i, double s) {
  const double binomial = std::tgamma(m + 1) / (std::tgamma(i + 1) * std::tgamma(m - i + 1));
  return binomial * std::pow(s, i) * std::pow(1 - s, m - i);
}

TEST(BezierCurve, IsTheSumOfBernsteinPolynomialsTimesControlPoints) {
  RandomCurves random(1);
  for (int m = 0; m <= 7; ++m) {
    const Eigen::MatrixXd points = random.Matrix(3, m + 1);
    const BezierCurve<double> curve(-1, 3, points);
    EXPECT_EQ(curve.order(), m);
    for (const double t : {-1.0, -0.7, 0.0, 2.2, 3.0}) {
      const double s = (t + 1) / 4;
      Eigen::VectorXd sum = Eigen::VectorXd::Zero(3);
      double total = 0;
      for (int i = 0; i <= m; ++i) {
        EXPECT_NEAR(curve.BernsteinBasis(i, t), Bernstein(m, i, s), 1e-14);
        EXPECT_NEAR(curve.BernsteinBasis(i, t, m + 2), Bernstein(m + 2, i, s), 1e-14);
        total += curve.BernsteinBasis(i, t);
        sum += Bernstein(m, i, s) * points.col(i);
      }
      EXPECT_NEAR(total, 1, 1e-14);
      EXPECT_LE(Distance(curve.value(t), sum), 1e-14);
    }
  }
}

TEST(BezierCurve, StartsAndEndsAtItsControlPointsAndStaysThereOutside) {
  RandomCurves random(2);
  const Eigen::MatrixXd points = random.Matrix(2, 6);
  const BezierCurve<double> curve(0.1, 0.7, points);
  EXPECT_EQ(curve.value(0.1), points.col(0));
  EXPECT_EQ(curve.value(-5), points.col(0));
  EXPECT_EQ(curve.value(0.7), points.col(5));
  EXPECT_EQ(curve.value(9), points.col(5));
  EXPECT_EQ(curve.EvalDerivative(9, 2), curve.EvalDerivative(0.7, 2));
}

TEST(BezierCurve, IsInTheConvexHullOfItsControlPoints) {
  RandomCurves random(3);
  const Eigen::MatrixXd points = random.Matrix(2, 9);
  const BezierCurve<double> curve(0, 1, points);
  for (int k = 0; k < 40; ++k) {
    const Eigen::Vector2d a(std::cos(k), std::sin(k));
    const double support = (a.transpose() * points).maxCoeff();
    EXPECT_LE(a.dot(curve.value(k / 39.0).col(0)), support + 1e-15);
  }
}

TEST(BezierCurve, HasDerivativesByDifferencesAndByTheLinearMap) {
  RandomCurves random(4);
  for (int m = 0; m <= 6; ++m) {
    const BezierCurve<double> curve(2, 2.5, random.Matrix(3, m + 1));
    ExpectDerivativesOfDifferences(curve, m + 2, {2.01, 2.2, 2.49}, 1e-7);
    for (int k = 0; k <= m + 1; ++k) {
      const Eigen::SparseMatrix<double> map = curve.AsLinearInControlPoints(k);
      ASSERT_EQ(map.rows(), m + 1);
      ASSERT_EQ(map.cols(), std::max(0, m + 1 - k));
      const auto made = curve.MakeDerivative(k);
      const auto& derivative = dynamic_cast<const BezierCurve<double>&>(*made);
      if (k > m) {
        EXPECT_EQ(derivative.control_points(), Eigen::MatrixXd::Zero(3, 1));
        continue;
      }
      const Eigen::MatrixXd mapped = curve.control_points() * map;
      EXPECT_LE(Distance(derivative.control_points(), mapped),
                1e-13 * (1 + mapped.cwiseAbs().maxCoeff()));
    }
  }
}

TEST(BezierDerivativeMap, IsTheProductOfMapsOfOneOrderEach) {
  for (int m = 0; m <= 8; ++m) {
    Eigen::MatrixXd product = Eigen::MatrixXd::Identity(m + 1, m + 1);
    for (int k = 0; k <= m; ++k) {
      EXPECT_EQ(Eigen::MatrixXd(BezierDerivativeMap(m, k)), product);
      if (k == m) break;
      Eigen::MatrixXd one = Eigen::MatrixXd::Zero(m + 1 - k, m - k);
      for (int i = 0; i < m - k; ++i) {
        one(i, i) = k - m;
        one(i + 1, i) = m - k;
      }
      product = (product * one).eval();
    }
    EXPECT_EQ(BezierDerivativeMap(m, m + 1).cols(), 0);
    EXPECT_EQ(BezierDerivativeMap(m, m + 3).rows(), m + 1);
  }
}

TEST(BezierCurve, OfElevatedOrderIsTheSameCurve) {
  RandomCurves random(5);
  const BezierCurve<double> curve(-2, 5, random.Matrix(2, 4));
  BezierCurve<double> elevated = curve;
  for (int m = 4; m <= 9; ++m) {
    elevated.ElevateOrder();
    EXPECT_EQ(elevated.order(), m);
    ExpectSameCurve(curve, elevated, 1e-14);
  }
}

TEST(BezierCurve, IsAnExpressionOfTime) {
  RandomCurves random(6);
  const Variable t(NewVariableIds(1));
  for (int m = 0; m <= 5; ++m) {
    const BezierCurve<double> curve(1, 3, random.Matrix(2, m + 1));
    const Eigen::VectorX<Expression> expression = curve.GetExpression(t);
    for (const double at : {1.0, 1.3, 3.0}) {
      for (Eigen::Index i = 0; i < 2; ++i) {
        EXPECT_NEAR(expression(i).Evaluate({{t, at}}), curve.value(at)(i), 1e-14);
      }
    }
    EXPECT_EQ(expression(0).nonlinear().empty(), m <= 1);
  }
  const BezierCurve<double> line(0, 2, Eigen::RowVector2d(1, 5));
  const Expression of_new_variable = line.GetExpression()(0);
  ASSERT_EQ(of_new_variable.GetVariables().size(), 1U);
  EXPECT_EQ(of_new_variable.Evaluate({{of_new_variable.GetVariables()[0], 1.0}}), 3);
}

TEST(BezierCurve, MovesInTime) {
  RandomCurves random(7);
  const BezierCurve<double> curve(1, 3, random.Matrix(2, 4));
  const auto moved = curve.StartingAt(-1);
  EXPECT_EQ(moved->end_time(), 1);
  for (const double t : {1.0, 1.7, 3.0}) EXPECT_EQ(moved->value(t - 2), curve.value(t));
}

TEST(BezierCurve, SaysWhatACallerGotWrong) {
  EXPECT_EQ(Said([] { BezierCurve<double>(1, 1, Eigen::Vector2d(0, 1)); }),
            "a Bezier curve needs finite times, the end after the start, got 1 to 1");
  EXPECT_EQ(Said([] { BezierCurve<double>(0, 1, Eigen::MatrixXd(2, 0)); }),
            "a Bezier curve needs a control point or more, by columns, got a matrix of 2 x 0");
  EXPECT_EQ(Said([] { (void)BezierCurve<double>().BernsteinBasis(1, 0); }),
            "the number of a Bernstein polynomial of order 0 needs to be from 0 to 0, got 1");
  EXPECT_EQ(Said([] { (void)BezierDerivativeMap(2, -1); }),
            "the order of a derivative needs to be 0 or more, got -1");
}

}  // namespace
}  // namespace switchyard::testing
