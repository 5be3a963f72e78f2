// Boxes of polyhedra that propagation alone leaves open: proven, and as tight as vertices say.
#include <Eigen/LU>
#include <cmath>

#include "switchyard/sets/vpolytope.hpp"
#include "tests/sets/random_sets.hpp"

namespace switchyard::testing {
namespace {

/// A simplex around a point, turned, and cuts.
HPolyhedron CutSimplex(RandomSets& random, const Eigen::Vector3d& center, double size) {
  const int cuts = 8;
  Eigen::MatrixXd A(4 + cuts, 3);
  A.topRows(3) = random.Matrix(3, 3) + 2 * Eigen::MatrixXd::Identity(3, 3);
  A.row(3) = -A.topRows(3).colwise().sum();
  A.bottomRows(cuts) = random.Matrix(cuts, 3);
  return {A, A * center + size * (random.Vector(4 + cuts).cwiseAbs().array() + 0.1).matrix()};
}

/// By all triples of halfspaces.
std::vector<Eigen::Vector3d> Vertices(const HPolyhedron& set) {
  std::vector<Eigen::Vector3d> vertices;
  const Eigen::MatrixXd A = set.A();
  const auto m = A.rows();
  for (Eigen::Index i = 0; i < m; ++i) {
    for (Eigen::Index j = 0; j < i; ++j) {
      for (Eigen::Index k = 0; k < j; ++k) {
        Eigen::Matrix3d B;
        B << A.row(i), A.row(j), A.row(k);
        const Eigen::FullPivLU<Eigen::Matrix3d> lu(B);
        if (!lu.isInvertible()) continue;
        const Eigen::Vector3d x = lu.solve(Eigen::Vector3d(set.b()[i], set.b()[j], set.b()[k]));
        const double slack = 1e-11 * (1 + set.b().cwiseAbs().maxCoeff());
        if (((A * x - set.b()).array() <= slack).all()) vertices.push_back(x);
      }
    }
  }
  return vertices;
}

TEST(BoundingBox, OfAPolytopeIsThatOfItsVertices) {
  RandomSets random(41);
  for (int trial = 0; trial < 100; ++trial) {
    const double size = std::pow(10, random.Uniform(-3, 3));
    const HPolyhedron set = CutSimplex(random, random.Vector(3, size), size);
    const SetBox& box = set.bounding_box();
    ASSERT_TRUE(box.is_finite());
    Eigen::Vector3d lower = Eigen::Vector3d::Constant(kInfinity);
    Eigen::Vector3d upper = -lower;
    for (const Eigen::Vector3d& x : Vertices(set)) {
      lower = lower.cwiseMin(x);
      upper = upper.cwiseMax(x);
    }
    for (int i = 0; i < 3; ++i) {
      EXPECT_LE(box.lower[i], lower[i] + 1e-10 * size);
      EXPECT_NEAR(box.lower[i], lower[i], 1e-9 * size);
      EXPECT_GE(box.upper[i], upper[i] - 1e-10 * size);
      EXPECT_NEAR(box.upper[i], upper[i], 1e-9 * size);
    }
  }
}

// Data whose box is known exactly: no end may be on the wrong side of it, by however little.
TEST(BoundingBox, IsNeverTighterThanTheTruth) {
  // |x + y| <= size, |x - y| <= size: |x| <= size, |y| <= size.
  const Eigen::MatrixXd A = (Eigen::MatrixXd(4, 2) << 1, 1, -1, -1, 1, -1, -1, 1).finished();
  for (const double size : {0x1p-20, 1.0, 0x1p20}) {
    const HPolyhedron diamond(A, size * Eigen::Vector4d::Ones());
    const SetBox& box = diamond.bounding_box();
    for (int i = 0; i < 2; ++i) {
      EXPECT_LE(box.lower[i], -size);
      EXPECT_GE(box.lower[i], -size * (1 + 1e-12));
      EXPECT_GE(box.upper[i], size);
      EXPECT_LE(box.upper[i], size * (1 + 1e-12));
    }
  }
}

TEST(BoundingBox, HasTheEndsOfAnUnboundedSetThatThereAre) {
  // The strip |x + y| <= 1, |x - y| <= 1, z >= x: bounded in x and y, and below in z.
  const Eigen::MatrixXd A =
      (Eigen::MatrixXd(5, 3) << 1, 1, 0, -1, -1, 0, 1, -1, 0, -1, 1, 0, 1, 0, -1).finished();
  Eigen::VectorXd b = Eigen::VectorXd::Ones(5);
  b[4] = 0;
  const HPolyhedron set(A, b);
  const SetBox& box = set.bounding_box();
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(box.lower[i], -1, 1e-12);
  EXPECT_NEAR(box.upper[0], 1, 1e-12);
  EXPECT_NEAR(box.upper[1], 1, 1e-12);
  EXPECT_EQ(box.upper[2], kInfinity);
  EXPECT_FALSE(set.IsBounded());
}

TEST(BoundingBox, SaysThatAPolyhedronIsEmptyWherePropagationDoesNot) {
  const Eigen::MatrixXd A = (Eigen::MatrixXd(3, 2) << 1, 1, -1, 1, 0, -1).finished();
  const HPolyhedron set(A, Eigen::Vector3d(0, 0, -1));  // y <= -|x|, y >= 1
  EXPECT_TRUE(set.bounding_box().empty);
  EXPECT_FALSE(set.MaybeGetFeasiblePoint().has_value());
}

TEST(FeasiblePoint, OfAPolyhedronIsFoundAtAnySize) {
  RandomSets random(42);
  for (int trial = 0; trial < 200; ++trial) {
    const double size = std::pow(10, random.Uniform(-6, 6));
    const HPolyhedron set = CutSimplex(random, random.Vector(3, 10 * size), size);
    const auto x = set.MaybeGetFeasiblePoint();
    ASSERT_TRUE(x.has_value());
    EXPECT_LE(set.Violation(*x), 1e-8 * size);
  }
}

}  // namespace
}  // namespace switchyard::testing
