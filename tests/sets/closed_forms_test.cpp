// What classes of sets know in closed form, and how one is made from another.
#include <Eigen/LU>
#include <Eigen/QR>
#include <cmath>
#include <numbers>

#include "switchyard/error.hpp"
#include "switchyard/sets/affine_ball.hpp"
#include "switchyard/sets/affine_subspace.hpp"
#include "switchyard/sets/cartesian_product.hpp"
#include "switchyard/sets/convex_hull.hpp"
#include "switchyard/sets/minkowski_sum.hpp"
#include "switchyard/sets/vpolytope.hpp"
#include "tests/sets/random_sets.hpp"

namespace switchyard::testing {
namespace {

TEST(AffineBall, IsTheEllipsoidThatItIsMadeOf) {
  RandomSets random(41);
  for (int n = 1; n <= 3; ++n) {
    const Hyperellipsoid ellipsoid = random.Ellipsoid(random.Vector(n, 2));
    const AffineBall ball(ellipsoid);
    const Hyperellipsoid back(ball);
    EXPECT_NEAR(ball.CalcVolume(), ellipsoid.Volume(), 1e-9 * ellipsoid.Volume());
    for (int k = 0; k < 20; ++k) {
      const Eigen::VectorXd a = random.Vector(n);
      EXPECT_NEAR(ball.SupportFunction(a), ellipsoid.SupportFunction(a), 1e-9);
      EXPECT_NEAR(back.SupportFunction(a), ellipsoid.SupportFunction(a), 1e-9);
      const Eigen::VectorXd x = ellipsoid.center() + random.Vector(n, 2);
      EXPECT_EQ(ball.PointInSet(x, 1e-6), ellipsoid.PointInSet(x, 1e-6));
    }
    EXPECT_NEAR(ellipsoid.Scale(3).Volume(), 3 * ellipsoid.Volume(), 1e-9 * ellipsoid.Volume());
  }
  EXPECT_THROW(AffineBall(Hyperellipsoid(Eigen::RowVector2d(1, 0), Eigen::Vector2d(0, 0))),
               InvalidArgument);
  EXPECT_THROW(Hyperellipsoid(AffineBall(Eigen::Vector2d(1, 0), Eigen::Vector2d(0, 0))),
               InvalidArgument);
}

TEST(AffineBall, AboutASegmentHasItForAnAxis) {
  const Eigen::Vector3d a(0, 0, 0);
  const Eigen::Vector3d b(0, 3, 4);
  const AffineBall ball = AffineBall::MakeAffineBallFromLineSegment(a, b, 0.1);
  const Eigen::Vector3d along(0, 0.6, 0.8);
  EXPECT_NEAR(ball.SupportFunction(along), 5, 1e-12);
  EXPECT_NEAR(ball.SupportFunction(-along), 0, 1e-12);
  EXPECT_NEAR(ball.SupportFunction(Eigen::Vector3d(1, 0, 0)), 0.1, 1e-12);
  EXPECT_NEAR(ball.CalcVolume(), 4 * std::numbers::pi / 3 * 2.5 * 0.01, 1e-12);
  EXPECT_EQ(AffineBall::MakeAffineBallFromLineSegment(a, b, 0).CalcVolume(), 0);
  EXPECT_THROW((void)AffineBall::MakeAffineBallFromLineSegment(a, a), InvalidArgument);
}

// Of the corners of a parallelepiped M [-1, 1]^n it is M times the ball of radius sqrt(n): the
// cube's is, by symmetry, and volumes of all bodies change by the same factor.
TEST(AffineBall, OfLeastVolumeAboutAParallelepiped) {
  RandomSets random(42);
  for (int n = 1; n <= 3; ++n) {
    const Eigen::MatrixXd map = random.Matrix(n, n) + 2 * Eigen::MatrixXd::Identity(n, n);
    const Eigen::MatrixXd corners = map * VPolytope::MakeUnitBox(n).vertices();
    const auto ball = Hyperellipsoid::MinimumVolumeCircumscribedEllipsoid(corners);
    const double expected = AffineBall(std::sqrt(n) * map, Eigen::VectorXd::Zero(n)).CalcVolume();
    EXPECT_NEAR(ball.Volume(), expected, 1e-5 * expected);
    for (Eigen::Index k = 0; k < corners.cols(); ++k) {
      EXPECT_TRUE(ball.PointInSet(corners.col(k), 1e-9));
    }
  }
  const Eigen::MatrixXd segment = (Eigen::MatrixXd(2, 2) << 0, 2, 0, 2).finished();
  const AffineBall flat = AffineBall::MinimumVolumeCircumscribedEllipsoid(segment);
  EXPECT_NEAR(flat.SupportFunction(Eigen::Vector2d(1, 0)), 2, 1e-6);
  EXPECT_NEAR(flat.SupportFunction(Eigen::Vector2d(1, -1)), 0, 1e-9);
}

TEST(Hyperellipsoid, TouchesABoxWhereItIsNearest) {
  const Hyperellipsoid ball = Hyperellipsoid::MakeHypersphere(2, Eigen::Vector2d(0, 0));
  const auto [scale, x] = ball.MinimumUniformScalingToTouch(
      Hyperrectangle(Eigen::Vector2d(3, 4), Eigen::Vector2d(9, 9)));
  EXPECT_NEAR(scale, 2.5, 1e-6);
  EXPECT_LE((x - Eigen::Vector2d(3, 4)).norm(), 1e-4);
}

TEST(AffineSubspace, HasCoordinates) {
  RandomSets random(43);
  const AffineSubspace plane(random.Matrix(4, 2), random.Vector(4));
  const Eigen::MatrixXd y = random.Matrix(2, 5);
  const Eigen::MatrixXd x = plane.ToGlobalCoordinates(y);
  EXPECT_LE((plane.ToLocalCoordinates(x) - y).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LE((plane.OrthogonalComplementBasis().transpose() * plane.basis()).cwiseAbs().maxCoeff(),
            1e-12);
  for (int k = 0; k < 5; ++k) EXPECT_TRUE(plane.PointInSet(x.col(k), 1e-12));
  const AffineSubspace same(plane.basis() * (Eigen::Matrix2d() << 1, 2, 0, 1).finished(), x.col(0));
  EXPECT_TRUE(plane.IsNearlyEqualTo(same, 1e-12));
  const AffineSubspace line(plane.basis().col(0), x.col(1));
  EXPECT_TRUE(line.ContainedIn(plane, 1e-12));
  EXPECT_FALSE(plane.ContainedIn(line, 1e-12));
  EXPECT_THROW(AffineSubspace(Eigen::MatrixXd::Ones(3, 2), Eigen::Vector3d(0, 0, 0)),
               InvalidArgument);
}

TEST(AffineSubspace, OfASetIsItsAffineHull) {
  RandomSets random(44);
  for (int k = 0; k <= 3; ++k) {
    const Eigen::MatrixXd axes = random.Matrix(3, k);
    const Eigen::VectorXd at = random.Vector(3);
    Eigen::MatrixXd points(3, k + 1);
    points << at, axes.colwise() + at;
    const AffineSubspace expected(axes, at);
    EXPECT_TRUE(AffineSubspace(VPolytope(points)).IsNearlyEqualTo(expected, 1e-6)) << k;
    EXPECT_TRUE(AffineSubspace(AffineBall(axes, at)).IsNearlyEqualTo(expected, 1e-5)) << k;
    EXPECT_TRUE(AffineSubspace(expected).IsNearlyEqualTo(expected, 1e-6)) << k;
  }
  EXPECT_EQ(AffineSubspace(Hyperellipsoid::MakeUnitBall(2)).AffineDimension(), 2);
  // x + y <= 1 and >= 1 by two rows, and by 2 x + 2 y <= 2; 0 <= z <= 1.
  Eigen::MatrixXd A(5, 3);
  A << 1, 1, 0, -1, -1, 0, 2, 2, 0, 0, 0, 1, 0, 0, -1;
  Eigen::VectorXd b(5);
  b << 1, -1, 2, 1, 0;
  Eigen::MatrixXd basis(3, 2);
  basis << 1, 0, -1, 0, 0, 1;
  EXPECT_TRUE(AffineSubspace(HPolyhedron(A, b))
                  .IsNearlyEqualTo(AffineSubspace(basis, Eigen::Vector3d(1, 0, 0)), 1e-9));
  b[4] = -1;  // z = 1
  EXPECT_EQ(AffineSubspace(HPolyhedron(A, b)).AffineDimension(), 1);
}

TEST(Projection, OnABoxIsTheNearestPoint) {
  const Hyperrectangle box(Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 1));
  Eigen::MatrixXd points(2, 3);
  points << 4, 0.5, -1, 5, 0.5, 0.5;
  const auto [distances, nearest] = *box.Projection(points);
  EXPECT_EQ(distances, (std::vector<double>{5, 0, 1}));
  EXPECT_EQ(nearest.col(0), Eigen::Vector2d(1, 1));
  EXPECT_EQ(nearest.col(1), Eigen::Vector2d(0.5, 0.5));
}

TEST(Projection, OnAPolytopeByAProgramIsThatOnTheBox) {
  RandomSets random(45);
  const Hyperrectangle box(Eigen::Vector3d(0, 1, 2), Eigen::Vector3d(1, 3, 5));
  const VPolytope polytope = VPolytope::MakeBox(box.lb(), box.ub());
  const Eigen::MatrixXd points = 5 * random.Matrix(3, 20);
  const auto by_clamping = *box.Projection(points);
  const auto by_program = *polytope.Projection(points);
  EXPECT_LE((by_clamping.second - by_program.second).cwiseAbs().maxCoeff(), 1e-5);
}

TEST(Violation, OfASetWithOwnVariablesIsADistance) {
  const VPolytope box = VPolytope::MakeBox(Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 1));
  EXPECT_EQ(box.Violation(Eigen::Vector2d(0.3, 1)), 0);
  EXPECT_NEAR(box.Violation(Eigen::Vector2d(3, 1.5)), 2, 1e-12);
  const AffineBall disc = AffineBall::MakeHypersphere(1, Eigen::Vector2d(1, 1));
  EXPECT_EQ(disc.Violation(Eigen::Vector2d(1, 2)), 0);
  // The nearest point by the largest coordinate of (3, 3) is (1, 1) + (1, 1) / sqrt(2).
  EXPECT_NEAR(disc.Violation(Eigen::Vector2d(3, 3)), 2 - std::sqrt(0.5), 1e-7);
  EXPECT_LE(disc.Violation(Eigen::Vector2d(3, 3)), 2 - std::sqrt(0.5) + 1e-12);
  EXPECT_FALSE(VPolytope(Eigen::MatrixXd(2, 0)).PointInSet(Eigen::Vector2d(0, 0), 0.1));
}

TEST(MaybeGetPoint, IsKnownOfSetsMadeOfPoints) {
  const Point a(Eigen::Vector2d(1, 2));
  const Point b(Eigen::Vector2d(3, 5));
  EXPECT_EQ(*MinkowskiSum(a, b).MaybeGetPoint(), Eigen::Vector2d(4, 7));
  EXPECT_EQ(*CartesianProduct(a, b).MaybeGetPoint(), Eigen::Vector4d(1, 2, 3, 5));
  EXPECT_EQ(*VPolytope(Eigen::Vector2d(1, 2)).MaybeGetPoint(), Eigen::Vector2d(1, 2));
  EXPECT_EQ(*ConvexHull(MakeConvexSets(a, a)).MaybeGetPoint(), Eigen::Vector2d(1, 2));
  EXPECT_FALSE(ConvexHull(MakeConvexSets(a, b)).MaybeGetPoint().has_value());
  EXPECT_EQ(*AffineBall(Eigen::MatrixXd::Zero(2, 1), Eigen::Vector2d(1, 2)).MaybeGetPoint(),
            Eigen::Vector2d(1, 2));
}

TEST(MakeConvexSets, TakesValuesAndPointers) {
  std::unique_ptr<ConvexSet> owned = Point(Eigen::Vector2d(1, 2)).Clone();
  const Hyperrectangle box(Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 1));
  const ConvexSets sets = MakeConvexSets(box, std::move(owned), Point(Eigen::Vector2d(0, 0)));
  ASSERT_EQ(sets.size(), 3U);
  EXPECT_EQ(sets[0]->Kind(), "hyperrectangle");
  EXPECT_EQ(sets[1]->Kind(), "point");
}

TEST(Hyperrectangle, SamplesAreInside) {
  RandomGenerator generator(3);
  const Hyperrectangle box(Eigen::Vector2d(0, 2), Eigen::Vector2d(1, 2));
  for (int k = 0; k < 100; ++k) EXPECT_TRUE(box.PointInSet(box.UniformSample(&generator)));
  EXPECT_THROW((void)Hyperrectangle(Eigen::Vector2d(0, 0), Eigen::Vector2d(1, kInfinity))
                   .UniformSample(&generator),
               InvalidArgument);
}

}  // namespace
}  // namespace switchyard::testing
