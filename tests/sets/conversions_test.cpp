// From vertices to halfspaces and back: what is held, what is tight, and the volume.
#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "switchyard/error.hpp"
#include "switchyard/sets/cartesian_product.hpp"
#include "switchyard/sets/vpolytope.hpp"
#include "tests/sets/random_sets.hpp"

namespace switchyard::testing {
namespace {

double Distance(const Eigen::VectorXd& x, const Eigen::MatrixXd& points) {
  return points.cols() == 0 ? kInfinity : (points.colwise() - x).colwise().norm().minCoeff();
}

/// Each vertex of one is a vertex of the other.
void ExpectSameVertices(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, double tol) {
  EXPECT_EQ(a.cols(), b.cols());
  for (Eigen::Index k = 0; k < a.cols(); ++k) EXPECT_LE(Distance(a.col(k), b), tol);
  for (Eigen::Index k = 0; k < b.cols(); ++k) EXPECT_LE(Distance(b.col(k), a), tol);
}

TEST(Conversions, GoThereAndBack) {
  RandomSets random(21);
  for (int trial = 0; trial < 40; ++trial) {
    const int n = 1 + trial % 4;
    const int rank = 1 + static_cast<int>(random.Uniform(0, n));  // flat where it is below n
    const Eigen::MatrixXd points =
        random.Matrix(n, std::min(rank, n)) * random.Matrix(std::min(rank, n), n + 5) +
        random.Vector(n, 3).replicate(1, n + 5);
    const VPolytope polytope(points);
    const HPolyhedron halfspaces(polytope);
    EXPECT_LE(((halfspaces.A() * points).colwise() - halfspaces.b()).maxCoeff(), 1e-12);
    const VPolytope minimal = polytope.GetMinimalRepresentation();
    const VPolytope back(halfspaces);
    ExpectSameVertices(back.vertices(), minimal.vertices(), 1e-7);
    for (int k = 0; k < 20; ++k) {
      const Eigen::VectorXd a = random.Vector(n);
      EXPECT_NEAR(halfspaces.SupportFunction(a), polytope.SupportFunction(a), 1e-8);
    }
  }
}

// Points of a lattice: many on one facet, many that are one, and mapped, so that all are so but for
// rounding.
TEST(Conversions, OfDegeneratePointsGoThereAndBack) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    RandomSets random(seed);
    const int n = 2 + static_cast<int>(seed % 4);
    const int count = 5 + static_cast<int>(random.Uniform(0, 60));
    Eigen::MatrixXd points = (1.5 * random.Matrix(n, count)).array().round();
    if (seed % 3 == 0) points = random.Matrix(n + static_cast<int>(seed % 2), n) * points;
    if (seed % 5 == 0) points *= 1e4;
    const double size = 1 + points.cwiseAbs().maxCoeff();
    const VPolytope polytope(points);
    const HPolyhedron halfspaces(polytope);
    EXPECT_LE(((halfspaces.A() * points).colwise() - halfspaces.b()).maxCoeff(), 1e-12 * size);
    ExpectSameVertices(VPolytope(halfspaces).vertices(),
                       polytope.GetMinimalRepresentation().vertices(), 1e-7 * size);
    const double volume = polytope.CalcVolume();
    EXPECT_NEAR(halfspaces.CalcVolume(), volume, 1e-8 * (1 + volume)) << seed;
  }
}

TEST(Conversions, KeepThinPolytopes) {
  Eigen::MatrixXd corners = VPolytope::MakeUnitBox(3).vertices();
  corners.row(1) *= 1e-6;
  const HPolyhedron halfspaces{VPolytope(corners)};
  EXPECT_EQ(halfspaces.b().size(), 6);
  EXPECT_NEAR(halfspaces.SupportFunction(Eigen::Vector3d(0, 1, 0)), 1e-6, 1e-15);
  ExpectSameVertices(VPolytope(halfspaces).vertices(), corners, 1e-10);
}

TEST(Conversions, AreThoseOfKnownBodies) {
  EXPECT_EQ(HPolyhedron(VPolytope::MakeUnitBox(3)).b().size(), 6);
  EXPECT_EQ(VPolytope(HPolyhedron::MakeUnitBox(4)).vertices().cols(), 16);
  EXPECT_EQ(VPolytope(HPolyhedron::MakeL1Ball(4)).vertices().cols(), 8);
  ExpectSameVertices(
      VPolytope(HPolyhedron::MakeBox(Eigen::Vector2d(1, 2), Eigen::Vector2d(1, 5))).vertices(),
      (Eigen::MatrixXd(2, 2) << 1, 1, 2, 5).finished(), 1e-9);
  ExpectSameVertices(
      VPolytope(HPolyhedron::MakeBox(Eigen::Vector2d(1, 2), Eigen::Vector2d(1, 2))).vertices(),
      Eigen::Vector2d(1, 2), 1e-9);
  const HPolyhedron point{VPolytope(Eigen::Vector3d(1, 2, 3))};
  EXPECT_TRUE(point.PointInSet(Eigen::Vector3d(1, 2, 3), 1e-12));
  EXPECT_FALSE(point.PointInSet(Eigen::Vector3d(1, 2, 3.001), 1e-6));
}

TEST(Conversions, OfAnEmptyPolyhedronHaveNoVertex) {
  const HPolyhedron empty((Eigen::MatrixXd(2, 1) << 1, -1).finished(), Eigen::Vector2d(0, -1));
  EXPECT_EQ(VPolytope(empty).vertices().cols(), 0);
  EXPECT_TRUE(VPolytope(empty).IsEmpty());
}

TEST(Conversions, RefuseWhatHasNone) {
  const HPolyhedron half(Eigen::RowVector2d(1, 0), Eigen::VectorXd::Ones(1));
  EXPECT_THROW(VPolytope{half}, InvalidArgument);
  EXPECT_THROW(HPolyhedron(VPolytope(Eigen::MatrixXd(2, 0))), InvalidArgument);
}

TEST(Conversions, DropPointsThatAreInTheHullOfOthers) {
  RandomSets random(22);
  for (int n = 1; n <= 4; ++n) {
    const Eigen::MatrixXd corners = VPolytope::MakeUnitBox(n).vertices();
    Eigen::MatrixXd more(n, corners.cols() + 10);
    more << 0.9 * random.Matrix(n, 9), corners, corners.col(0);
    ExpectSameVertices(VPolytope(more).GetMinimalRepresentation().vertices(), corners, 0);
  }
}

TEST(Volume, IsThatOfKnownBodies) {
  double factorial = 1;
  for (int n = 1; n <= 5; ++n) {
    factorial *= n;
    EXPECT_NEAR(HPolyhedron::MakeL1Ball(n).CalcVolume(), std::pow(2, n) / factorial, 1e-9);
    EXPECT_NEAR(VPolytope::MakeUnitBox(n).CalcVolume(), std::pow(2, n), 1e-9);
    EXPECT_NEAR(HPolyhedron::MakeUnitBox(n).CalcVolume(), std::pow(2, n), 1e-9);
  }
  EXPECT_NEAR(Hyperellipsoid::MakeUnitBall(3).CalcVolume(), 4 * std::numbers::pi / 3, 1e-12);
  EXPECT_EQ(Point(Eigen::Vector2d(1, 2)).CalcVolume(), 0);
  EXPECT_EQ(VPolytope((Eigen::MatrixXd(2, 3) << 0, 1, 2, 0, 1, 2).finished()).CalcVolume(), 0);
}

TEST(Volume, GrowsByTheDeterminantOfAMap) {
  RandomSets random(23);
  for (int n = 1; n <= 4; ++n) {
    const Eigen::MatrixXd points = random.Matrix(n, 2 * n + 2);
    const Eigen::MatrixXd map = random.Matrix(n, n);
    const double before = VPolytope(points).CalcVolume();
    const double after =
        VPolytope(map * points + random.Vector(n).replicate(1, 2 * n + 2)).CalcVolume();
    EXPECT_NEAR(after, std::abs(map.determinant()) * before, 1e-9 * (1 + before));
  }
}

TEST(Volume, BySamplingIsNearTheExactOne) {
  RandomGenerator generator(1234);
  const HPolyhedron ball = HPolyhedron::MakeL1Ball(2);
  const SampledVolume sampled = ball.CalcVolumeViaSampling(&generator, 1e-2, 100000);
  EXPECT_LE(sampled.rel_accuracy, 1e-2);
  EXPECT_NEAR(sampled.volume, 2, 2 * 5 * sampled.rel_accuracy);
  EXPECT_LT(sampled.num_samples, 100000);
}

TEST(Volume, SaysWhatElseToAsk) {
  EXPECT_FALSE(
      Intersection(HPolyhedron::MakeUnitBox(2), HPolyhedron::MakeL1Ball(2)).has_exact_volume());
  try {
    (void)Intersection(HPolyhedron::MakeUnitBox(2), HPolyhedron::MakeL1Ball(2)).CalcVolume();
    FAIL();
  } catch (const InvalidArgument& e) {
    EXPECT_NE(std::string(e.what()).find("CalcVolumeViaSampling"), std::string::npos);
  }
  EXPECT_TRUE(CartesianProduct(HPolyhedron::MakeUnitBox(2), Point(Eigen::VectorXd::Ones(1)))
                  .has_exact_volume());
}

}  // namespace
}  // namespace switchyard::testing
