// Ranges, offsets and partitions along continuous revolute joints.
#include "switchyard/sets/geodesic_convexity.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "switchyard/error.hpp"
#include "tests/sets/random_sets.hpp"

namespace switchyard::testing {
namespace {

using std::numbers::pi;
using Ranges = std::vector<std::pair<double, double>>;

template <class Mistake>
std::string Complaint(const Mistake& mistake) {
  try {
    mistake();
  } catch (const InvalidArgument& e) {
    return e.what();
  }
  return "";
}

/// {x : |x_0 - 2 x_1| <= 1, |x_1| <= half}, from -2 half - 1 to 2 half + 1 along x_0.
HPolyhedron Slanted(double half) {
  const Eigen::MatrixXd A = (Eigen::MatrixXd(4, 2) << 1, -2, -1, 2, 0, 1, 0, -1).finished();
  return {A, Eigen::Vector4d(1, 1, half, half)};
}

TEST(GeodesicConvexity, FindsTheRangeAlongADimension) {
  const auto [lower, upper] = GetMinimumAndMaximumValueAlongDimension(Slanted(2), 0);
  EXPECT_NEAR(lower, -5, 1e-9);
  EXPECT_NEAR(upper, 5, 1e-9);
  const Hyperrectangle box(Eigen::Vector3d(0, -1, 2), Eigen::Vector3d(1, 5, 2));
  EXPECT_EQ(GetMinimumAndMaximumValueAlongDimension(box, std::vector<int>{2, 1}),
            (Ranges{{2, 2}, {-1, 5}}));
  // Of the diamond |x| + |y| <= 1 in the box, whose rows alone would say 1 and not 0.75.
  const Eigen::MatrixXd A = (Eigen::MatrixXd(5, 2) << 1, 1, 1, -1, -1, 1, -1, -1, 0, -1).finished();
  Eigen::VectorXd b = Eigen::VectorXd::Ones(5);
  b[4] = -0.25;  // y >= 0.25
  EXPECT_NEAR(GetMinimumAndMaximumValueAlongDimension(HPolyhedron(A, b), 0).second, 0.75, 1e-9);
  const auto ball = GetMinimumAndMaximumValueAlongDimension(
      Hyperellipsoid::MakeHypersphere(2, Eigen::Vector2d(1, 7)), 1);
  EXPECT_NEAR(ball.first, 5, 1e-8);
  EXPECT_NEAR(ball.second, 9, 1e-8);
}

TEST(GeodesicConvexity, NamesWhatHasNoRange) {
  const HPolyhedron half(Eigen::RowVector2d(1, 0), Eigen::VectorXd::Ones(1));
  EXPECT_EQ(Complaint([&] { GetMinimumAndMaximumValueAlongDimension(half, 0); }),
            "a hpolyhedron in R^2 is unbounded along dimension 0");
  EXPECT_EQ(Complaint([&] { GetMinimumAndMaximumValueAlongDimension(half, 2); }),
            "a hpolyhedron in R^2 has no dimension 2");
  const Eigen::MatrixXd A = (Eigen::MatrixXd(2, 1) << 1, -1).finished();
  EXPECT_EQ(Complaint([&] {
              GetMinimumAndMaximumValueAlongDimension(HPolyhedron(A, Eigen::Vector2d(0, -1)), 0);
            }),
            "an empty hpolyhedron has no values along dimension 0");
}

TEST(GeodesicConvexity, RefusesAListOfJointsThatIsNone) {
  EXPECT_NO_THROW(ThrowsForInvalidContinuousJointsList(3, {2, 0}));
  EXPECT_EQ(Complaint([] {
              ThrowsForInvalidContinuousJointsList(3, {0, 3});
            }),
            "continuous revolute joints: index 3 is not one of 3 positions");
  EXPECT_EQ(Complaint([] {
              ThrowsForInvalidContinuousJointsList(3, {1, 0, 1});
            }),
            "continuous revolute joints: index 1 stands twice");
}

TEST(GeodesicConvexity, OffsetsAreTheLargestThatBeginBeforeTheOtherEnds) {
  RandomSets random(31);
  for (int trial = 0; trial < 200; ++trial) {
    const double a = random.Uniform(-30, 30);
    const double b = random.Uniform(-30, 30);
    const double width = random.Uniform(0, 3);
    const Eigen::VectorXd tau =
        ComputeOffsetContinuousRevoluteJoints(4, {2}, {{a, a + 1}}, {{b, b + width}});
    EXPECT_NEAR(std::remainder(tau[2], 2 * pi), 0, 1e-12);
    EXPECT_LE(a + tau[2], b + width + 1e-9);
    EXPECT_GT(a + tau[2] + 2 * pi, b + width);
    EXPECT_EQ(tau.cwiseAbs().sum(), std::abs(tau[2]));
  }
  // The end of one turn is the beginning of the next.
  EXPECT_EQ(ComputeOffsetContinuousRevoluteJoints(1, {0}, {{2 * pi, 7}}, {{-1, 0}})[0], -2 * pi);
}

TEST(GeodesicConvexity, TheRadiusIsHalfATurn) {
  const auto box = [](double width) {
    return Hyperrectangle(Eigen::Vector2d(1, 0), Eigen::Vector2d(1 + width, 100));
  };
  EXPECT_TRUE(CheckIfSatisfiesConvexityRadius(box(3.14), {0}));
  EXPECT_FALSE(CheckIfSatisfiesConvexityRadius(box(3.15), {0}));
  EXPECT_TRUE(CheckIfSatisfiesConvexityRadius(box(3.15), {}));
  EXPECT_FALSE(CheckIfSatisfiesConvexityRadius(box(1), {0, 1}));
}

/// Every point of the set is in a piece, and the pieces are narrow and overlap by epsilon.
void ExpectPartition(const ConvexSet& set, const ConvexSets& pieces, const std::vector<int>& joints,
                     double epsilon) {
  for (const ConvexSetPointer& piece : pieces) {
    EXPECT_FALSE(piece->IsEmpty());
    EXPECT_TRUE(CheckIfSatisfiesConvexityRadius(*piece, joints));
    for (const auto& [lower, upper] : GetMinimumAndMaximumValueAlongDimension(*piece, joints)) {
      EXPECT_LE(upper - lower, pi - epsilon + 1e-9);
    }
  }
  RandomSets random(32);
  const SetBox& box = set.bounding_box();
  int seen = 0;
  for (int k = 0; k < 3000; ++k) {
    Eigen::VectorXd x = box.lower;
    for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = random.Uniform(box.lower[i], box.upper[i]);
    const auto holds = [&](const ConvexSetPointer& piece) { return piece->PointInSet(x, 1e-12); };
    const bool inside = set.PointInSet(x);
    EXPECT_EQ(std::any_of(pieces.begin(), pieces.end(), holds), inside);
    seen += inside ? 1 : 0;
  }
  EXPECT_GT(seen, 100);
}

TEST(GeodesicConvexity, PartitionsCoverTheSetByNarrowPieces) {
  const HPolyhedron slanted = Slanted(4.5);  // 20 wide: 7 pieces
  const ConvexSets pieces = PartitionConvexSet(slanted, {0});
  EXPECT_EQ(pieces.size(), 7u);
  ExpectPartition(slanted, pieces, {0}, 1e-5);
  // Of 7 times 3 boxes only those along the diagonal hold points.
  const ConvexSets both = PartitionConvexSet(slanted, {0, 1}, 1e-2);
  EXPECT_LT(both.size(), 21u);
  ExpectPartition(slanted, both, {0, 1}, 1e-2);
  const Hyperellipsoid ball = Hyperellipsoid::MakeHypersphere(4, Eigen::Vector2d(2, -1));
  ExpectPartition(ball, PartitionConvexSet(ball, {1}), {1}, 1e-5);
}

TEST(GeodesicConvexity, NeighbouringPiecesOverlapByEpsilon) {
  const double epsilon = 1e-2;
  const Hyperrectangle line(Eigen::VectorXd::Zero(1), Eigen::VectorXd::Constant(1, 10));
  const ConvexSets pieces = PartitionConvexSet(line, {0}, epsilon);
  for (std::size_t k = 1; k < pieces.size(); ++k) {
    const double end = GetMinimumAndMaximumValueAlongDimension(*pieces[k - 1], 0).second;
    const double begin = GetMinimumAndMaximumValueAlongDimension(*pieces[k], 0).first;
    EXPECT_NEAR(end - begin, epsilon, 1e-9);
  }
}

TEST(GeodesicConvexity, WhatIsNarrowStaysWhole) {
  const Hyperrectangle box(Eigen::Vector2d(0, 0), Eigen::Vector2d(3, 100));
  const ConvexSets whole = PartitionConvexSet(box, {0});
  ASSERT_EQ(whole.size(), 1u);
  EXPECT_EQ(whole[0]->Kind(), "hyperrectangle");
  const ConvexSets parts = PartitionConvexSet(MakeConvexSets(box, Slanted(4.5), box), {0});
  EXPECT_EQ(parts.size(), 9u);
  const Eigen::MatrixXd A = (Eigen::MatrixXd(2, 1) << 1, -1).finished();
  EXPECT_TRUE(PartitionConvexSet(HPolyhedron(A, Eigen::Vector2d(0, -1)), {0}).empty());
}

TEST(GeodesicConvexity, RefusesWhatCannotBePartitioned) {
  const HPolyhedron half(Eigen::RowVector2d(1, 0), Eigen::VectorXd::Ones(1));
  EXPECT_EQ(Complaint([&] { PartitionConvexSet(half, {0}); }),
            "a hpolyhedron in R^2 is unbounded along dimension 0");
  EXPECT_EQ(Complaint([&] { PartitionConvexSet(Slanted(1), {0}, 0); }),
            "PartitionConvexSet needs an epsilon in (0, pi / 2), got 0");
}

}  // namespace
}  // namespace switchyard::testing
