// Paths at times: the chain rule against closed forms.
#include "switchyard/trajectory/path_parameterized_trajectory.hpp"

#include <cmath>

#include "switchyard/trajectory/bezier_curve.hpp"
#include "switchyard/trajectory/piecewise_polynomial.hpp"
#include "tests/model/said.hpp"
#include "tests/trajectory/curves.hpp"

namespace switchyard::testing {
namespace {

using Along = PathParameterizedTrajectory<double>;
using Pieces = PiecewisePolynomial<double>;

Polynomial<double> Power(int k) { return Polynomial<double>(Eigen::VectorXd::Unit(k + 1, k)); }

// The path s^a at s = t^b is t^(ab).
TEST(PathParameterizedTrajectory, OfPowersIsAPower) {
  for (int a = 1; a <= 4; ++a) {
    for (int b = 1; b <= 3; ++b) {
      const Along along(Pieces({Power(a)}, {0, 9}), Pieces({Power(b)}, {0, 2}));
      const Polynomial<double> power = Power(a * b);
      for (int k = 0; k <= a * b + 1; ++k) {
        for (const double t : {0.0, 0.7, 1.3}) {
          const double expected = power.EvaluateUnivariate(t, k);
          EXPECT_NEAR(along.EvalDerivative(t, k)(0), expected, 1e-12 * (1 + std::abs(expected)))
              << a << " " << b << " " << k;
        }
      }
    }
  }
}

TEST(PathParameterizedTrajectory, HasDerivativesByDifferences) {
  RandomCurves random(1);
  const BezierCurve<double> path(0, 1, random.Matrix(3, 5));
  const BezierCurve<double> scaling(2, 5, Eigen::RowVector4d(0, 0.1, 0.8, 1));
  const Along along(path, scaling);
  EXPECT_EQ(along.rows(), 3);
  EXPECT_EQ(along.start_time(), 2);
  EXPECT_EQ(along.value(2), path.value(0));
  EXPECT_EQ(along.value(7), path.value(1));
  ExpectDerivativesOfDifferences(along, 5, {2.1, 3.3, 4.8}, 1e-7);
}

TEST(PathParameterizedTrajectory, OfAnAffineTimeScalingScalesDerivativesByPowers) {
  RandomCurves random(2);
  const BezierCurve<double> path(0, 1, random.Matrix(2, 6));
  const Along along(path, Pieces::FirstOrderHold(Eigen::Vector2d(0, 4), Eigen::RowVector2d(0, 1)));
  for (int k = 0; k <= 6; ++k) {
    EXPECT_LE(
        Distance(along.EvalDerivative(1, k), std::pow(0.25, k) * path.EvalDerivative(0.25, k)),
        1e-13);
  }
  const auto moved = along.StartingAt(-3);
  EXPECT_EQ(moved->end_time(), 1);
  EXPECT_EQ(moved->value(-2), along.value(1));
}

TEST(PathParameterizedTrajectory, SaysWhatACallerGotWrong) {
  const BezierCurve<double> path(0, 1, Eigen::Vector2d(1, 2));
  EXPECT_EQ(Said([&] { Along(path, path); }), "a time scaling needs values of 1 x 1, got 2 x 1");
}

}  // namespace
}  // namespace switchyard::testing
