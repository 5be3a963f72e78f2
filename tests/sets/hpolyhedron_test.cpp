// Polyhedra made of polyhedra, by their definitions at random points.
#include <Eigen/LU>
#include <cmath>

#include "switchyard/error.hpp"
#include "switchyard/sets/affine_ball.hpp"
#include "switchyard/sets/vpolytope.hpp"
#include "tests/sets/random_sets.hpp"

namespace switchyard::testing {
namespace {

TEST(HPolyhedron, WithoutRedundantRowsIsTheSameSetAndMinimal) {
  RandomSets random(31);
  for (int trial = 0; trial < 30; ++trial) {
    const int n = 1 + trial % 3;
    const HPolyhedron polyhedron = random.Polyhedron(random.Vector(n, 2));
    const HPolyhedron reduced = polyhedron.ReduceInequalities();
    EXPECT_EQ(reduced.b().size() + static_cast<int>(polyhedron.FindRedundant().size()),
              polyhedron.b().size());
    EXPECT_TRUE(reduced.ContainedIn(polyhedron, 1e-7));
    EXPECT_TRUE(polyhedron.ContainedIn(reduced, 1e-12));
    EXPECT_TRUE(reduced.FindRedundant().empty());
    // A full-dimensional polytope has one row for each facet.
    EXPECT_EQ(reduced.b().size(), HPolyhedron(VPolytope(polyhedron)).b().size());
  }
}

TEST(HPolyhedron, OfTwoEqualRowsOneIsRedundant) {
  const HPolyhedron twice = HPolyhedron::MakeUnitBox(2).Intersection(HPolyhedron::MakeUnitBox(2));
  EXPECT_EQ(twice.FindRedundant().size(), 4U);
  EXPECT_EQ(twice.ReduceInequalities().b().size(), 4);
  EXPECT_EQ(HPolyhedron::MakeUnitBox(2).Intersection(HPolyhedron::MakeL1Ball(2), true).b().size(),
            4);
}

TEST(HPolyhedron, IsContainedInALargerOne) {
  EXPECT_TRUE(HPolyhedron::MakeL1Ball(3).ContainedIn(HPolyhedron::MakeUnitBox(3)));
  EXPECT_FALSE(HPolyhedron::MakeUnitBox(3).ContainedIn(HPolyhedron::MakeL1Ball(3)));
  const HPolyhedron empty((Eigen::MatrixXd(2, 1) << 1, -1).finished(), Eigen::Vector2d(0, -1));
  EXPECT_TRUE(empty.ContainedIn(HPolyhedron::MakeUnitBox(1)));
  EXPECT_FALSE(HPolyhedron::MakeUnitBox(1).ContainedIn(empty));
}

TEST(HPolyhedron, ScaledHasScaleTimesTheVolume) {
  RandomSets random(32);
  for (int n = 1; n <= 3; ++n) {
    const HPolyhedron polyhedron = random.Polyhedron(random.Vector(n, 2));
    for (const double scale : {0.25, 2.0}) {
      EXPECT_NEAR(polyhedron.Scale(scale).CalcVolume(), scale * polyhedron.CalcVolume(), 1e-8);
    }
    const Eigen::VectorXd center = polyhedron.ChebyshevCenter();
    EXPECT_TRUE(polyhedron.Scale(0).PointInSet(center, 1e-9));
    EXPECT_NEAR(polyhedron.Scale(0).bounding_box().upper[0], center[0], 1e-7);
  }
}

TEST(HPolyhedron, ChebyshevCenterIsFarthestFromTheRows) {
  RandomSets random(33);
  for (int trial = 0; trial < 20; ++trial) {
    const int n = 1 + trial % 3;
    const HPolyhedron polyhedron = random.Polyhedron(random.Vector(n, 2));
    const Eigen::MatrixXd A = polyhedron.A();
    const Eigen::VectorXd norms = A.rowwise().norm();
    const auto radius = [&](const Eigen::VectorXd& x) {
      return (polyhedron.b() - A * x).cwiseQuotient(norms).minCoeff();
    };
    const Eigen::VectorXd center = polyhedron.ChebyshevCenter();
    EXPECT_GT(radius(center), 0);
    for (int k = 0; k < 50; ++k) {
      EXPECT_LE(radius(center + random.Vector(n, 0.1)), radius(center) + 1e-9);
    }
  }
  EXPECT_THROW(
      (void)HPolyhedron(Eigen::RowVector2d(1, 0), Eigen::VectorXd::Ones(1)).ChebyshevCenter(),
      InvalidArgument);
  EXPECT_THROW(
      (void)HPolyhedron((Eigen::MatrixXd(2, 1) << 1, -1).finished(), Eigen::Vector2d(0, -1))
          .ChebyshevCenter(),
      InvalidArgument);
}

// In a parallelepiped M [-1, 1]^n + c it is M times the unit ball, by the symmetry of the cube.
TEST(HPolyhedron, HoldsALargestEllipsoid) {
  RandomSets random(37);
  for (int n = 1; n <= 3; ++n) {
    const Eigen::MatrixXd map = random.Matrix(n, n) + 2 * Eigen::MatrixXd::Identity(n, n);
    const Eigen::VectorXd center = random.Vector(n, 5);
    const Eigen::MatrixXd A = HPolyhedron::MakeUnitBox(n).A() * map.inverse();
    const HPolyhedron body(A, A * center + Eigen::VectorXd::Ones(2 * n));
    const Hyperellipsoid largest = body.MaximumVolumeInscribedEllipsoid();
    const double expected = AffineBall(map, center).CalcVolume();
    EXPECT_NEAR(largest.Volume(), expected, 1e-5 * expected);
    for (Eigen::Index i = 0; i < A.rows(); ++i) {
      EXPECT_LE(largest.SupportFunction(A.row(i).transpose()), body.b()[i] + 1e-9);
    }
  }
  EXPECT_THROW((void)HPolyhedron::MakeBox(Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 0))
                   .MaximumVolumeInscribedEllipsoid(),
               InvalidArgument);
}

TEST(HPolyhedron, ProductsHoldPairs) {
  RandomSets random(34);
  const HPolyhedron a = random.Polyhedron(random.Vector(2));
  const HPolyhedron b = random.Polyhedron(random.Vector(1));
  const HPolyhedron product = a.CartesianProduct(b);
  const HPolyhedron power = b.CartesianPower(3);
  EXPECT_EQ(product.ambient_dimension(), 3);
  EXPECT_EQ(power.ambient_dimension(), 3);
  EXPECT_EQ(b.CartesianPower(0).ambient_dimension(), 0);
  for (int k = 0; k < 200; ++k) {
    const Eigen::VectorXd x = random.Vector(3, 2);
    EXPECT_EQ(product.PointInSet(x), a.PointInSet(x.head(2)) && b.PointInSet(x.tail(1)));
    EXPECT_EQ(power.PointInSet(x),
              b.PointInSet(x.head(1)) && b.PointInSet(x.segment(1, 1)) && b.PointInSet(x.tail(1)));
  }
}

TEST(HPolyhedron, PontryaginDifferenceHoldsWhatStaysInside) {
  RandomSets random(35);
  const HPolyhedron a = random.Polyhedron(random.Vector(2));
  const VPolytope b(0.2 * random.Matrix(2, 4));
  const HPolyhedron difference = a.PontryaginDifference(HPolyhedron(b));
  for (int k = 0; k < 500; ++k) {
    const Eigen::VectorXd x = random.Vector(2, 2);
    bool stays = true;
    for (Eigen::Index j = 0; j < b.vertices().cols(); ++j) {
      stays = stays && a.PointInSet(x + b.vertices().col(j));
    }
    EXPECT_EQ(difference.PointInSet(x), stays);
  }
}

TEST(HPolyhedron, SamplesAreInsideAndTheirMeanIsTheCenterOfABox) {
  RandomGenerator generator(7);
  const HPolyhedron box = HPolyhedron::MakeBox(Eigen::Vector2d(0, -1), Eigen::Vector2d(4, 3));
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(2);
  Eigen::VectorXd x = box.ChebyshevCenter();
  for (int k = 0; k < 4000; ++k) {
    x = box.UniformSample(&generator, x, 3);
    ASSERT_TRUE(box.PointInSet(x, 1e-9));
    mean += x / 4000;
  }
  EXPECT_LE((mean - Eigen::Vector2d(2, 1)).norm(), 0.2);
  Eigen::MatrixXd line(2, 1);
  line << 1, 0;
  const Eigen::VectorXd along = box.UniformSample(&generator, Eigen::Vector2d(1, 2), 5, line);
  EXPECT_EQ(along[1], 2);
  EXPECT_THROW((void)box.UniformSample(&generator, Eigen::Vector2d(9, 9)), InvalidArgument);
}

TEST(HPolyhedron, OfAProgramHasItsLinearConstraints) {
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(2);
  program.AddLinearConstraint(Eigen::RowVector2d(1, 1), -1, 2, x);
  program.AddBoundingBoxConstraint(0, kInfinity, x);
  const HPolyhedron polyhedron(program);
  RandomSets random(36);
  for (int k = 0; k < 100; ++k) {
    const Eigen::VectorXd at = random.Vector(2, 3);
    EXPECT_EQ(polyhedron.PointInSet(at), at.sum() <= 2 && at.sum() >= -1 && at.minCoeff() >= 0);
  }
  program.AddLorentzConeConstraint(x);
  EXPECT_THROW(HPolyhedron{program}, InvalidArgument);
}

}  // namespace
}  // namespace switchyard::testing
