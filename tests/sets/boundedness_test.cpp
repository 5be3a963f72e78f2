// IsBounded by the directions of recession, of sets whose boxes propagation does not close.
#include "switchyard/sets/affine_subspace.hpp"
#include "switchyard/sets/cartesian_product.hpp"
#include "switchyard/sets/convex_hull.hpp"
#include "switchyard/sets/minkowski_sum.hpp"
#include "switchyard/sets/spectrahedron.hpp"
#include "switchyard/sets/vpolytope.hpp"
#include "tests/sets/random_sets.hpp"

namespace switchyard::testing {
namespace {

// Bounded exactly where the rows positively span the space: n + 1 rows, their sum weighted to 0,
// do; without the last one of them there is a direction that all leave open.
TEST(IsBounded, OfASimplexTurnedAnyWayAndOpened) {
  RandomSets random(51);
  for (int trial = 0; trial < 30; ++trial) {
    const int n = 2 + trial % 4;
    Eigen::MatrixXd A(n + 1, n);
    A.topRows(n) = random.Matrix(n, n) + 2 * Eigen::MatrixXd::Identity(n, n);
    A.row(n) = -A.topRows(n).colwise().sum();
    const Eigen::VectorXd b = A * random.Vector(n, 3) + Eigen::VectorXd::Ones(n + 1);
    EXPECT_TRUE(HPolyhedron(A, b).IsBounded());
    EXPECT_FALSE(HPolyhedron(A.topRows(n), b.head(n)).IsBounded());
  }
}

TEST(IsBounded, IsSoForAnEmptySetWhoseRowsAreOpen) {
  const Eigen::MatrixXd A = (Eigen::MatrixXd(2, 2) << 1, 0, -1, 0).finished();
  EXPECT_TRUE(HPolyhedron(A, Eigen::Vector2d(0, -1)).IsBounded());
  EXPECT_FALSE(HPolyhedron(A, Eigen::Vector2d(1, 0)).IsBounded());
}

TEST(IsBounded, OfAStripTurnedAgainstTheAxes) {
  const Eigen::MatrixXd A = (Eigen::MatrixXd(2, 2) << 1, 1, -1, -1).finished();
  EXPECT_FALSE(HPolyhedron(A, Eigen::Vector2d(1, 1)).IsBounded());
  EXPECT_FALSE(Hyperellipsoid(Eigen::RowVector2d(1, 1), Eigen::Vector2d(0, 0)).IsBounded());
}

TEST(IsBounded, OfConesByTheirDirections) {
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(3);
  program.AddLorentzConeConstraint(x);
  EXPECT_FALSE(Spectrahedron(program).IsBounded());
  program.AddLinearConstraint(Eigen::RowVector3d(2, 1, 1), -kInfinity, 1, x);
  EXPECT_TRUE(Spectrahedron(program).IsBounded());  // 2 x_0 - |(1, 1)| x_0 <= 1
  // |(x, y)| <= z, z - x <= 1 goes to infinity along (1, 0, 1) alone.
  MathematicalProgram cut;
  const auto y = cut.NewContinuousVariables(3);
  cut.AddLorentzConeConstraint(y);
  cut.AddLinearConstraint(Eigen::RowVector3d(1, -1, 0), -kInfinity, 1, y);
  EXPECT_FALSE(Spectrahedron(cut).IsBounded());
}

TEST(IsBounded, OfSetsMadeOfSets) {
  RandomSets random(52);
  const HPolyhedron quadrant(-Eigen::MatrixXd::Identity(2, 2), Eigen::Vector2d(0, 0));
  const Hyperellipsoid disc = Hyperellipsoid::MakeUnitBall(2);
  EXPECT_FALSE(MinkowskiSum(quadrant, disc).IsBounded());
  EXPECT_FALSE(CartesianProduct(disc, quadrant).IsBounded());
  EXPECT_FALSE(ConvexHull(MakeConvexSets(disc, quadrant)).IsBounded());
  EXPECT_TRUE(ConvexHull(MakeConvexSets(disc, Point(Eigen::Vector2d(9, 9)))).IsBounded());
  // {x : Ax in a bounded set} is bounded exactly where A has no kernel.
  const ConvexSets bounded = MakeConvexSets(VPolytope(random.Matrix(3, 6)));
  EXPECT_TRUE(CartesianProduct(bounded, random.Matrix(3, 3), random.Vector(3)).IsBounded());
  EXPECT_FALSE(CartesianProduct(bounded, random.Matrix(3, 1) * random.Matrix(1, 2),
                                Eigen::VectorXd(bounded[0]->MaybeGetFeasiblePoint().value()))
                   .IsBounded());
  EXPECT_FALSE(AffineSubspace(random.Matrix(3, 1), random.Vector(3)).IsBounded());
}

TEST(IsBounded, IsTheSameForAnyNumberOfThreads) {
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(4);
  program.AddLorentzConeConstraint(x);
  EXPECT_FALSE(Spectrahedron(program).IsBounded(Parallelism(2)));
  program.AddLinearConstraint(Eigen::RowVector4d(3, 1, 1, 1), -kInfinity, 1, x);
  EXPECT_TRUE(Spectrahedron(program).IsBounded(Parallelism(2)));
}

}  // namespace
}  // namespace switchyard::testing
