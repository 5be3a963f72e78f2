// Curves of B-splines: the same curve by other knots, by Bezier, by differences.
#include "switchyard/trajectory/bspline_trajectory.hpp"

#include "switchyard/trajectory/bezier_curve.hpp"
#include "tests/model/said.hpp"
#include "tests/trajectory/curves.hpp"

namespace switchyard::testing {
namespace {

using Basis = BsplineBasis<double>;
using Curve = BsplineTrajectory<double>;

TEST(BsplineTrajectory, ClampedWithAsManyPointsAsItsOrderIsABezierCurve) {
  RandomCurves random(1);
  for (int k = 1; k <= 6; ++k) {
    const Eigen::MatrixXd points = random.Matrix(2, k);
    const BezierCurve<double> bezier(-1, 4, points);
    std::vector<Eigen::MatrixXd> columns;
    for (int i = 0; i < k; ++i) columns.emplace_back(points.col(i));
    const Curve bspline(Basis(k, k, KnotVectorType::kClampedUniform, -1, 4), columns);
    ExpectSameCurve(bezier, bspline, 1e-14);
    for (int j = 1; j <= k; ++j) {
      ExpectSameCurve(*bezier.MakeDerivative(j), *bspline.MakeDerivative(j), 1e-11);
      if (j == k) continue;
      EXPECT_LE(Distance(bezier.AsLinearInControlPoints(j), bspline.AsLinearInControlPoints(j)),
                1e-11);
    }
  }
}

TEST(BsplineTrajectory, HasDerivativesByDifferencesAndByTheLinearMap) {
  RandomCurves random(2);
  for (int k = 1; k <= 5; ++k) {
    const Curve curve(Basis(k, k + 4, KnotVectorType::kClampedUniform, 1, 6),
                      random.Matrices(k + 4, 2, 3));
    ExpectDerivativesOfDifferences(curve, k + 1, {1.01, 2.4, 3.3, 5.99}, 1e-8);
    for (int j = 0; j <= k + 1; ++j) {
      for (const double t : {1.0, 2.4, 3.0, 6.0}) {
        const Eigen::VectorXd weights = curve.EvaluateLinearInControlPoints(t, j);
        Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(2, 3);
        for (int i = 0; i < weights.size(); ++i) {
          sum += weights(i) * curve.control_points()[static_cast<std::size_t>(i)];
        }
        EXPECT_LE(Distance(curve.EvalDerivative(t, j), sum), 1e-12);
      }
    }
  }
}

TEST(BsplineTrajectory, OnMoreKnotsIsTheSameCurve) {
  RandomCurves random(3);
  for (int k = 1; k <= 5; ++k) {
    for (const auto type : {KnotVectorType::kUniform, KnotVectorType::kClampedUniform}) {
      const Curve curve(Basis(k, k + 2, type, 0, 3), random.Matrices(k + 2, 2, 2));
      Curve more = curve;
      more.InsertKnots({2.9, 0.5, 1, 1.7, 0.5, 0, 3});
      EXPECT_EQ(more.num_control_points(), k + 9);
      ExpectSameCurve(curve, more, 1e-13);
      if (k > 2) {
        ExpectSameCurve(*curve.MakeDerivative(), *more.MakeDerivative(), 1e-11);
      }
      EXPECT_FALSE(curve == more);
    }
  }
}

TEST(BsplineTrajectory, ClampedStartsAndEndsAtItsControlPointsAndStaysThereOutside) {
  RandomCurves random(4);
  const Curve curve(Basis(4, 7, KnotVectorType::kClampedUniform, 0.1, 0.7),
                    random.Matrices(7, 3, 1));
  EXPECT_EQ(curve.InitialValue(), curve.control_points().front());
  EXPECT_EQ(curve.FinalValue(), curve.control_points().back());
  EXPECT_EQ(curve.value(-1), curve.InitialValue());
  EXPECT_EQ(curve.value(5), curve.FinalValue());
}

TEST(BsplineTrajectory, OfSelectedRowsIsTheRowsOfTheCurve) {
  RandomCurves random(5);
  const Curve curve(Basis(3, 5), random.Matrices(5, 3, 2));
  const Curve block = curve.CopyBlock(1, 0, 2, 1);
  EXPECT_LE(Distance(block.value(0.4), curve.value(0.4).block(1, 0, 2, 1)), 1e-15);
  const Curve doubled = curve.CopyWithSelector(
      [](const Eigen::MatrixXd& point) -> Eigen::MatrixXd { return 2 * point; });
  EXPECT_LE(Distance(doubled.value(0.4), 2 * curve.value(0.4)), 1e-15);
  EXPECT_TRUE(curve.CopyBlock(0, 0, 3, 2) == curve);
  EXPECT_TRUE(curve.CopyBlock(0, 0, 3, 1).CopyHead(2) == curve.CopyBlock(0, 0, 2, 1));
}

TEST(BsplineTrajectory, MovesInTime) {
  RandomCurves random(6);
  const Curve curve(Basis(4, 6, KnotVectorType::kUniform, 2, 3), random.Matrices(6, 1, 1));
  const auto moved = curve.StartingAt(0);
  EXPECT_EQ(moved->start_time(), 0);
  EXPECT_EQ(moved->end_time(), 1);
  EXPECT_LE(Distance(moved->value(0.3), curve.value(2.3)), 1e-14);
}

TEST(BsplineTrajectory, SaysWhatACallerGotWrong) {
  RandomCurves random(7);
  EXPECT_EQ(Said([&] { Curve(Basis(2, 3), random.Matrices(2, 1, 1)); }),
            "a B-spline trajectory needs 3 control points, one for each basis function, got 2");
  EXPECT_EQ(Said([&] {
              Curve(Basis(1, 2), {Eigen::MatrixXd::Zero(2, 1), Eigen::MatrixXd::Zero(1, 2)});
            }),
            "control points: control point 1 needs to be 2 x 1 as the first, got 1 x 2");
  Curve curve(Basis(2, 3), random.Matrices(3, 1, 2));
  EXPECT_EQ(Said([&] {
              curve.InsertKnots({0.5, 1.5});
            }),
            "a knot to insert needs to be from 0 to 1, got 1.5");
  EXPECT_EQ(curve.num_control_points(), 3);
  EXPECT_EQ(Said([&] { (void)curve.CopyHead(1); }),
            "CopyHead needs values of one column, got 1 x 2");
  EXPECT_EQ(Said([&] { (void)curve.CopyBlock(0, 1, 1, 2); }),
            "a block of 1 x 2 from (0, 1) on is not inside values of 1 x 2");
}

}  // namespace
}  // namespace switchyard::testing
