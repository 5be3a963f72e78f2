// Polynomials in pieces: from samples, differentiated, integrated, cut.
#include "switchyard/trajectory/piecewise_polynomial.hpp"

#include <limits>

#include "tests/model/said.hpp"
#include "tests/trajectory/curves.hpp"

namespace switchyard::testing {
namespace {

using Pieces = PiecewisePolynomial<double>;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(Polynomial, IsItsSumOfPowers) {
  const Polynomial<double> p(Eigen::Vector4d(1, -2, 0, 3));
  EXPECT_EQ(p.GetDegree(), 3);
  EXPECT_EQ(p.EvaluateUnivariate(2), 1 - 4 + 24);
  EXPECT_EQ(p.EvaluateUnivariate(2, 1), -2 + 36);
  EXPECT_EQ(p.EvaluateUnivariate(2, 3), 18);
  EXPECT_EQ(p.EvaluateUnivariate(2, 4), 0);
  EXPECT_TRUE(p.Derivative() == Polynomial<double>(Eigen::Vector3d(-2, 0, 9)));
  EXPECT_TRUE(p.Derivative().Integral(1) == p);
  EXPECT_TRUE(p.Derivative(7) == Polynomial<double>());
  EXPECT_EQ(Said([] { Polynomial<double>(Eigen::VectorXd()); }),
            "a polynomial needs a coefficient or more, got none");
}

// Of numbers, and of matrices, over two segments.
Pieces Random(RandomCurves* random) {
  std::vector<Pieces::PolynomialMatrix> matrices;
  for (int segment = 0; segment < 2; ++segment) {
    Pieces::PolynomialMatrix matrix(2, 3);
    for (Eigen::Index i = 0; i < matrix.size(); ++i) {
      matrix.data()[i] = Polynomial<double>(random->Matrix(1 + (i + segment) % 4, 1));
    }
    matrices.push_back(matrix);
  }
  return {matrices, {1, 2.5, 3}};
}

TEST(PiecewisePolynomial, IsItsPolynomialsOnEachSegment) {
  const Polynomial<double> p(Eigen::Vector3d(1, 2, 3));
  const Polynomial<double> q(Eigen::Vector2d(5, -1));
  const Pieces pieces({p, q}, {1, 2, 4});
  EXPECT_EQ(pieces.get_number_of_segments(), 2);
  EXPECT_EQ(pieces.value(1.5)(0), p.EvaluateUnivariate(0.5));
  EXPECT_EQ(pieces.value(2)(0), 5);
  EXPECT_EQ(pieces.value(4)(0), 3);
  EXPECT_EQ(pieces.value(9)(0), 3);
  EXPECT_EQ(pieces.value(-9)(0), 1);
  EXPECT_EQ(pieces.EvalDerivative(2)(0), -1);
  EXPECT_EQ(pieces.duration(1), 2);
  EXPECT_EQ(pieces.get_segment_index(1.999), 0);
  EXPECT_EQ(pieces.get_segment_index(2), 1);
  EXPECT_EQ(pieces.get_segment_index(4), 1);
  EXPECT_EQ(pieces.get_segment_index(-1), 0);
  EXPECT_TRUE(pieces.is_time_in_range(4));
  EXPECT_FALSE(pieces.is_time_in_range(4.1));
}

TEST(PiecewisePolynomial, HasDerivativesByDifferences) {
  RandomCurves random(1);
  ExpectDerivativesOfDifferences(Random(&random), 5, {1.1, 2.4, 2.6, 2.9}, 1e-8);
}

TEST(PiecewisePolynomial, IsTheDerivativeOfItsIntegralWhichIsContinuous) {
  RandomCurves random(2);
  const Pieces pieces = Random(&random);
  const Eigen::MatrixXd start = random.Matrix(2, 3);
  const Pieces integral = pieces.integral(start);
  EXPECT_EQ(integral.value(1), start);
  EXPECT_LE(Distance(integral.value(2.5 - 1e-13), integral.value(2.5)), 1e-12);
  ExpectSameCurve(pieces, integral.derivative(), 1e-14);
  EXPECT_EQ(pieces.integral(2).value(1), Eigen::MatrixXd::Constant(2, 3, 2));
  // Simpson's rule is exact up to cubics.
  const double h = 1.5;
  const Eigen::MatrixXd simpson =
      h / 6 * (pieces.value(1) + 4 * pieces.value(1.75) + pieces.value(2.5 - 1e-15 * 4));
  EXPECT_LE(Distance(integral.value(2.5) - start, simpson), 1e-13);
}

TEST(PiecewisePolynomial, KeepsItsEntriesInOtherShapes) {
  RandomCurves random(3);
  const Pieces pieces = Random(&random);
  Pieces reshaped = pieces;
  reshaped.Reshape(3, 2);
  EXPECT_EQ(reshaped.value(2.2), Eigen::MatrixXd(pieces.value(2.2).reshaped(3, 2)));
  EXPECT_EQ(pieces.Block(1, 1, 1, 2).value(2.2), pieces.value(2.2).block(1, 1, 1, 2));
  EXPECT_EQ(reshaped.rows(), 3);
  EXPECT_EQ(reshaped.cols(), 2);
}

TEST(PiecewisePolynomial, HoldsSamplesAtTheirBreaks) {
  RandomCurves random(4);
  const std::vector<double> breaks = random.Times(6, -1, 2);
  const auto samples = random.Matrices(6, 2, 1);
  const auto slopes = random.Matrices(6, 2, 1);
  const Pieces lines = Pieces::FirstOrderHold(breaks, samples);
  const Pieces cubics = Pieces::CubicHermite(breaks, samples, slopes);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_LE(Distance(lines.value(breaks[i]), samples[i]), 1e-15);
    EXPECT_LE(Distance(lines.value(breaks[i] - 1e-13), samples[i]), 1e-11);
    EXPECT_LE(Distance(cubics.value(breaks[i]), samples[i]), 1e-14);
    EXPECT_LE(Distance(cubics.EvalDerivative(breaks[i]), slopes[i]), 1e-12);
    EXPECT_LE(Distance(cubics.EvalDerivative(breaks[i] - 1e-13), slopes[i]), 1e-9);
  }
  EXPECT_LE(Distance(lines.value(0.5 * (breaks[1] + breaks[2])), 0.5 * (samples[1] + samples[2])),
            1e-15);
  Eigen::MatrixXd columns(2, 6);
  for (int i = 0; i < 6; ++i) columns.col(i) = samples[static_cast<std::size_t>(i)];
  const Eigen::VectorXd times = Eigen::Map<const Eigen::VectorXd>(breaks.data(), 6);
  ExpectSameCurve(lines, Pieces::FirstOrderHold(times, columns), 0);
  ExpectSameCurve(Pieces::CubicShapePreserving(breaks, samples),
                  Pieces::CubicShapePreserving(times, columns), 0);
}

TEST(PiecewisePolynomial, KeepsTheShapeOfMonotoneSamples) {
  RandomCurves random(5);
  for (const bool zero_ends : {false, true}) {
    const std::vector<double> breaks = random.Times(9, 0, 4);
    const std::vector<double> heights = random.Times(9, -3, 5);
    std::vector<Eigen::MatrixXd> samples;
    for (const double height : heights) samples.push_back(Eigen::Vector2d(height, -height));
    const Pieces spline = Pieces::CubicShapePreserving(breaks, samples, zero_ends);
    for (int i = 0; i <= 400; ++i) {
      const Eigen::MatrixXd slope = spline.EvalDerivative(i / 100.0);
      EXPECT_GE(slope(0), -1e-10);
      EXPECT_LE(slope(1), 1e-10);
    }
    for (std::size_t i = 1; i + 1 < breaks.size(); ++i) {
      EXPECT_LE(
          Distance(spline.EvalDerivative(breaks[i] - 1e-12), spline.EvalDerivative(breaks[i])),
          1e-7 * (1 + spline.EvalDerivative(breaks[i], 2).norm()));
    }
    if (!zero_ends) continue;
    EXPECT_EQ(spline.EvalDerivative(0), Eigen::Vector2d(0, 0));
    EXPECT_LE(spline.EvalDerivative(4).norm(), 1e-12);
  }
}

// Of data on a parabola the formulas of three points are exact, where they need no cutting.
TEST(PiecewisePolynomial, KeepsAStraightLineAndTheEndsOfAParabola) {
  const std::vector<double> breaks = {1, 1.5, 3, 4};
  std::vector<Eigen::MatrixXd> line;
  std::vector<Eigen::MatrixXd> parabola;
  for (const double t : breaks) {
    line.push_back(Eigen::VectorXd::Constant(1, 3 * t - 1));
    parabola.push_back(Eigen::VectorXd::Constant(1, t * t));
  }
  ExpectSameCurve(Pieces::CubicShapePreserving(breaks, line), Pieces::FirstOrderHold(breaks, line),
                  1e-14);
  const Pieces bent = Pieces::CubicShapePreserving(breaks, parabola);
  EXPECT_NEAR(bent.EvalDerivative(1)(0), 2, 1e-13);
  EXPECT_NEAR(bent.EvalDerivative(4)(0), 8, 1e-13);
}

TEST(PiecewisePolynomial, IsConstantForEver) {
  const Pieces constant(Eigen::Vector2d(1, 2));
  EXPECT_EQ(constant.start_time(), -kInfinity);
  EXPECT_EQ(constant.end_time(), kInfinity);
  EXPECT_EQ(constant.value(1e300), Eigen::Vector2d(1, 2));
  EXPECT_EQ(constant.value(-kInfinity), Eigen::Vector2d(1, 2));
  EXPECT_EQ(constant.EvalDerivative(3), Eigen::Vector2d(0, 0));
  EXPECT_EQ(Said([&] { (void)constant.integral(); }),
            "an integral needs a finite time to start at, got -inf");
}

TEST(PiecewisePolynomial, DrawsTimesThatRise) {
  std::default_random_engine generator(3);
  const std::vector<double> times = Pieces::RandomSegmentTimes(5, generator);
  ASSERT_EQ(times.size(), 6U);
  EXPECT_EQ(times[0], 0);
  for (std::size_t i = 1; i < 6; ++i) EXPECT_GE(times[i] - times[i - 1], 0.0999);
}

TEST(PiecewisePolynomial, SaysWhatACallerGotWrong) {
  const Polynomial<double> p(Eigen::Vector2d(1, 2));
  const std::vector<Eigen::MatrixXd> samples = {Eigen::Vector2d(1, 2), Eigen::Vector3d(1, 2, 3)};
  EXPECT_EQ(Said([&] {
              Pieces({p, p}, {0, 1, 1});
            }),
            "breaks: breaks[2] = 1 needs to be above breaks[1] = 1");
  EXPECT_EQ(Said([&] {
              Pieces({p, p}, {0, 1});
            }),
            "polynomials: 1 are needed, one for each segment between breaks, got 2");
  EXPECT_EQ(Said([&] {
              Pieces({p}, {-kInfinity, 1});
            }),
            "a segment that starts at -inf needs degree 0, got 1");
  EXPECT_EQ(Said([&] {
              (void)Pieces::FirstOrderHold({0, 1}, samples);
            }),
            "samples: number 1 needs to be 2 x 1 as the first, got 3 x 1");
  EXPECT_EQ(Said([&] {
              (void)Pieces::FirstOrderHold({0, 1, 2}, samples);
            }),
            "samples: 3 are needed, one for each break, got 2");
  EXPECT_EQ(Said([&] {
              (void)Pieces::CubicShapePreserving({0, 1}, {samples[0], samples[0]});
            }),
            "breaks: 3 or more are needed, got 2");
  EXPECT_EQ(Said([] { (void)Pieces().value(0); }),
            "a piecewise polynomial with segments is needed, got one without");
  EXPECT_EQ(Said([&] {
              (void)Pieces({p}, {0, 1}).end_time(1);
            }),
            "the number of a segment needs to be from 0 to 0, got 1");
  EXPECT_EQ(Said([&] {
              Pieces({p}, {0, 1}).Reshape(2, 1);
            }),
            "a shape for 1 x 1 entries is needed, got 2 x 1");
}

}  // namespace
}  // namespace switchyard::testing
