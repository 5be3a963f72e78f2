// Contracts of sets that are easily got wrong by a sign or a forgotten term.
#include "switchyard/sets/affine_ball.hpp"
#include "switchyard/sets/convex_hull.hpp"
#include "switchyard/sets/minkowski_sum.hpp"
#include "switchyard/sets/spectrahedron.hpp"
#include "switchyard/solve/solve.hpp"
#include "tests/sets/random_sets.hpp"

namespace switchyard::testing {
namespace {

/// max and min of a'x over Ax + b in (c't + d) S at fixed t.
struct Range {
  double low;
  double high;
};

Range RangeOfScaled(const ConvexSet& set, const Eigen::MatrixXd& A, const Eigen::VectorXd& b,
                    const Eigen::VectorXd& c, double d, const Eigen::VectorXd& t,
                    const Eigen::VectorXd& a) {
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(static_cast<int>(A.cols()), "x");
  const auto scale = program.NewContinuousVariables(static_cast<int>(t.size()), "t");
  set.AddPointInNonnegativeScalingConstraints(&program, A, b, c, d, x, scale);
  program.AddBoundingBoxConstraint(t, t, scale);
  const auto cost = program.AddLinearCost(a, x);
  const MathematicalProgramResult least = Solve(program);
  program.set_objective_sense(ObjectiveSense::kMaximize);
  const MathematicalProgramResult most = Solve(program);
  EXPECT_TRUE(least.is_success()) << set.Kind() << ": " << least.message;
  EXPECT_TRUE(most.is_success()) << set.Kind() << ": " << most.message;
  return {least.objective, most.objective};
}

// Ax + b in s S is x in (s S - b) for A = I: a'x is between -s h(-a) - a'b and s h(a) - a'b, for
// points, balls and sums alike.
TEST(GeneralScaling, MovesAndScalesByEveryArgument) {
  RandomSets random(61);
  for (int trial = 0; trial < 10; ++trial) {
    const int n = 1 + trial % 3;
    const Eigen::VectorXd at = random.Vector(n, 2);
    const Eigen::VectorXd b = random.Vector(n, 2);
    const Eigen::VectorXd c = random.Vector(2);
    const Eigen::VectorXd t = random.Vector(2);
    const double d = 0.5 - c.dot(t) + random.Uniform(0, 1);
    const double s = c.dot(t) + d;
    ConvexSets sets = MakeConvexSets(
        Point(at), AffineBall(random.Matrix(n, n), at), MinkowskiSum(random.Box(at), Point(at)),
        MinkowskiSum(MakeConvexSets(random.Ellipsoid(at), random.Box(at), Point(at))));
    for (const ConvexSetPointer& set : sets) {
      const Eigen::VectorXd a = random.Vector(n);
      const Range range = RangeOfScaled(*set, Eigen::MatrixXd::Identity(n, n), b, c, d, t, a);
      EXPECT_NEAR(range.high, s * set->SupportFunction(a) - a.dot(b), 1e-5) << set->Kind();
      EXPECT_NEAR(range.low, -s * set->SupportFunction(-a) - a.dot(b), 1e-5) << set->Kind();
    }
  }
}

// As in a two-cycle row: x are the points of several edges, A sums them.
TEST(GeneralScaling, TakesMoreVariablesThanTheHullHasDimensions) {
  RandomSets random(62);
  const ConvexHull hull(
      MakeConvexSets(random.Box(random.Vector(2, 2)), Point(random.Vector(2, 3))));
  Eigen::MatrixXd sum(2, 6);
  sum << Eigen::Matrix2d::Identity(), -Eigen::Matrix2d::Identity(), -Eigen::Matrix2d::Identity();
  const Eigen::Vector2d direction(1, -2);
  const Range range = RangeOfScaled(hull, sum, Eigen::Vector2d(0, 0), Eigen::Vector3d(1, -1, -1), 0,
                                    Eigen::Vector3d(1, 0.2, 0.3), sum.transpose() * direction);
  EXPECT_NEAR(range.high, 0.5 * hull.SupportFunction(direction), 1e-6);
}

TEST(Spectrahedron, HasRowsThatAreFiniteOnOneSide) {
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(2);
  program.AddBoundingBoxConstraint(Eigen::Vector2d(0, -kInfinity), Eigen::Vector2d(kInfinity, 1),
                                   x);
  program.AddLinearConstraint(Eigen::RowVector2d(1, -1), -kInfinity, 2, x);
  const Spectrahedron set(program);
  for (const double scale : {0.0, 0.5, 2.0}) {
    const Range range = RangeOfScaled(set, Eigen::Matrix2d::Identity(), Eigen::Vector2d(0, 0),
                                      Eigen::VectorXd::Ones(1), 0,
                                      Eigen::VectorXd::Constant(1, scale), Eigen::Vector2d(0, 1));
    EXPECT_NEAR(range.low, -2 * scale, 1e-6);
    EXPECT_NEAR(range.high, scale, 1e-6);
  }
}

TEST(Spectrahedron, RefusesByName) {
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(2);
  program.AddQuadraticConstraint(-Eigen::Matrix2d::Identity(), Eigen::Vector2d(0, 0), -kInfinity,
                                 -1, x);
  try {
    const Spectrahedron set(program);
    FAIL();
  } catch (const InvalidArgument& e) {
    EXPECT_NE(std::string(e.what()).find("has no perspective"), std::string::npos) << e.what();
  }
  MathematicalProgram integers;
  integers.NewBinaryVariables(1, "switch");
  try {
    const Spectrahedron set(integers);
    FAIL();
  } catch (const InvalidArgument& e) {
    EXPECT_NE(std::string(e.what()).find("switch"), std::string::npos) << e.what();
  }
}

// The rows of the empty member are open along x_1: kept, it would add that direction to the hull.
TEST(ConvexHull, IsNotEnlargedByAMemberWithoutPoints) {
  const HPolyhedron empty((Eigen::MatrixXd(3, 2) << 1, 0, -1, 0, 0, -1).finished(),
                          Eigen::Vector3d(0, -1, 0));
  const Hyperrectangle box(Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 1));
  for (const bool remove : {true, false}) {
    const ConvexHull hull(MakeConvexSets(empty, box), remove);
    EXPECT_EQ(hull.empty_sets_removed(), remove);
    EXPECT_EQ(hull.participating_sets().size(), remove ? 1U : 2U);
    EXPECT_EQ(hull.num_elements(), 2);
    MathematicalProgram program;
    const auto x = program.NewContinuousVariables(2);
    hull.AddPointInSetConstraints(&program, x);
    program.AddBoundingBoxConstraint(-100, 100, x);
    program.AddLinearCost(Eigen::Vector2d(0, -1), x);
    EXPECT_NEAR(Solve(program).objective, -1, 1e-7);
    EXPECT_TRUE(hull.IsBounded());
    EXPECT_EQ(hull.SupportFunction(Eigen::Vector2d(0, 1)), 1);
    EXPECT_FALSE(hull.PointInSet(Eigen::Vector2d(0.5, 50), 1e-3));
  }
  EXPECT_TRUE(ConvexHull(MakeConvexSets(empty, empty)).IsEmpty());
  EXPECT_TRUE(ConvexHull(MakeConvexSets(empty), false).IsEmpty());
}

}  // namespace
}  // namespace switchyard::testing
