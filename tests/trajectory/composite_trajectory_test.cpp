// Trajectories of any class one after the other.
#include "switchyard/trajectory/composite_trajectory.hpp"

#include "switchyard/trajectory/bezier_curve.hpp"
#include "switchyard/trajectory/bspline_trajectory.hpp"
#include "switchyard/trajectory/piecewise_polynomial.hpp"
#include "tests/model/said.hpp"
#include "tests/trajectory/curves.hpp"

namespace switchyard::testing {
namespace {

using Composite = CompositeTrajectory<double>;
using Segments = std::vector<TrajectoryPointer<double>>;

Segments OneOfEach(RandomCurves* random, double gap) {
  Segments segments;
  segments.emplace_back(BezierCurve<double>(0, 1, random->Matrix(2, 4)));
  segments.emplace_back(std::make_unique<BsplineTrajectory<double>>(
      BsplineBasis<double>(3, 5, KnotVectorType::kUniform, 1 + gap, 3 + gap),
      random->Matrices(5, 2, 1)));
  segments.push_back(PiecewisePolynomial<double>::FirstOrderHold({3 - gap, 3.5 - gap, 4 - gap},
                                                                 random->Matrices(3, 2, 1)));
  return segments;
}

TEST(CompositeTrajectory, IsItsSegmentsTheLaterOneAtABreak) {
  RandomCurves random(1);
  const Segments segments = OneOfEach(&random, 0);
  const Composite all(segments);
  EXPECT_EQ(all.get_number_of_segments(), 3);
  EXPECT_EQ(all.get_segment_times(), (std::vector<double>{0, 1, 3, 4}));
  EXPECT_EQ(all.value(0.3), segments[0]->value(0.3));
  EXPECT_EQ(all.value(1), segments[1]->value(1));
  EXPECT_EQ(all.value(3), segments[2]->value(3));
  EXPECT_EQ(all.value(4), segments[2]->value(4));
  EXPECT_EQ(all.value(9), segments[2]->value(4));
  EXPECT_EQ(all.value(-9), segments[0]->value(0));
  EXPECT_EQ(&all.segment(1), &*segments[1]);
  EXPECT_TRUE(all.has_derivative());
  EXPECT_EQ(all.EvalDerivative(1, 2), segments[1]->EvalDerivative(1, 2));
  ExpectDerivativesOfDifferences(all, 3, {0.4, 1.5, 3.7}, 1e-8);
}

TEST(CompositeTrajectory, AlignsSegmentsOfOtherTimes) {
  RandomCurves random(2);
  const Segments apart = OneOfEach(&random, 10);
  const Composite all = Composite::AlignAndConcatenate(apart);
  EXPECT_EQ(all.get_segment_times(), (std::vector<double>{0, 1, 3, 4}));
  for (const double t : {0.0, 0.3, 0.99}) {
    EXPECT_EQ(all.value(t), apart[0]->value(t));
    EXPECT_LE(Distance(all.value(1 + 2 * t), apart[1]->value(11 + 2 * t)), 1e-13);
    EXPECT_LE(Distance(all.value(3 + t), apart[2]->value(-7 + t)), 1e-13);
  }
  const auto later = all.StartingAt(100);
  EXPECT_EQ(later->start_time(), 100);
  EXPECT_LE(Distance(later->value(102.5), all.value(2.5)), 1e-12);
}

TEST(CompositeTrajectory, JoinsManySegmentsOfRoundedTimes) {
  Segments segments;
  for (int i = 0; i < 1000; ++i) {
    segments.push_back(BezierCurve<double>(i * 0.1, (i + 1) * 0.1, Eigen::RowVector2d(i, i + 1)));
  }
  const Composite all(segments);
  EXPECT_NEAR(all.value(50.05)(0), 500.5, 1e-9);
  const Composite again = Composite::AlignAndConcatenate(segments);
  EXPECT_NEAR(again.end_time(), 100, 1e-10);
  EXPECT_NEAR(again.StartingAt(1e6)->end_time(), 1e6 + 100, 1e-6);
}

TEST(CompositeTrajectory, MayHaveNoSegments) {
  const Composite none{Segments()};
  EXPECT_EQ(none.get_number_of_segments(), 0);
  EXPECT_EQ(Said([&] { (void)none.value(0); }),
            "a composite trajectory with segments is needed, got one without");
  EXPECT_EQ(Said([&] { (void)none.rows(); }), Said([&] { (void)none.value(0); }));
}

TEST(CompositeTrajectory, SaysWhatACallerGotWrong) {
  const BezierCurve<double> first(0, 1, Eigen::Vector2d(1, 2));
  EXPECT_EQ(Said([&] {
              Composite({first, BezierCurve<double>(2, 3, Eigen::Vector2d(1, 2))});
            }),
            "segments: segment 1 needs to start at 1, where segment 0 ends, got 2");
  EXPECT_EQ(Said([&] {
              Composite({first, BezierCurve<double>(1, 3, Eigen::Vector3d(1, 2, 3))});
            }),
            "segments: segment 1 needs values of 2 x 1 as the first, got 3 x 1");
  EXPECT_EQ(Said([&] { (void)Composite({first}).segment(1); }),
            "the number of a segment needs to be from 0 to 0, got 1");
}

}  // namespace
}  // namespace switchyard::testing
