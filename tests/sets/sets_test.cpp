// What a set says of itself agrees with its definition.
#include "tests/sets/random_sets.hpp"

#include <functional>

namespace switchyard::testing {
namespace {

TEST(ConvexSet, HoldsThePointItIsBuiltAround) {
  RandomSets random(1);
  for (int trial = 0; trial < 50; ++trial) {
    const Eigen::VectorXd inside = random.Vector(1 + trial % 4, 3);
    for (const ConvexSetPointer& set : random.OneOfEach(inside)) {
      EXPECT_TRUE(set->PointInSet(inside, 1e-12)) << set->Kind();
      EXPECT_FALSE(set->IsEmpty()) << set->Kind();
      EXPECT_TRUE(set->IsBounded()) << set->Kind();
      const auto found = set->MaybeGetFeasiblePoint();
      ASSERT_TRUE(found.has_value()) << set->Kind();
      EXPECT_LE(set->Violation(*found), 1e-8) << set->Kind();
    }
  }
}

TEST(ConvexSet, IsConvexAndInsideItsBox) {
  RandomSets random(2);
  for (int trial = 0; trial < 50; ++trial) {
    const int n = 1 + trial % 3;
    const Eigen::VectorXd inside = random.Vector(n, 3);
    for (const ConvexSetPointer& set : random.OneOfEach(inside)) {
      const SetBox& box = set->bounding_box();
      std::vector<Eigen::VectorXd> members = {inside};
      for (int k = 0; k < 200; ++k) {
        const Eigen::VectorXd x = inside + random.Vector(n, 2);
        if (!set->PointInSet(x)) continue;
        EXPECT_TRUE((x.array() >= box.lower.array()).all()) << set->Kind();
        EXPECT_TRUE((x.array() <= box.upper.array()).all()) << set->Kind();
        const Eigen::VectorXd between = 0.5 * (x + members.back());
        EXPECT_TRUE(set->PointInSet(between, 1e-12)) << set->Kind();
        members.push_back(x);
      }
    }
  }
}

TEST(ConvexSet, ViolationIsZeroInsideAndGrowsOutside) {
  const Hyperrectangle box(Eigen::Vector2d(0, 1), Eigen::Vector2d(2, 3));
  EXPECT_EQ(box.Violation(Eigen::Vector2d(1, 2)), 0);
  EXPECT_EQ(box.Violation(Eigen::Vector2d(2.5, 2)), 0.5);
  const Hyperellipsoid ball = Hyperellipsoid::MakeHypersphere(2, Eigen::Vector2d(1, 1));
  EXPECT_TRUE(ball.PointInSet(Eigen::Vector2d(3, 1), 1e-15));
  EXPECT_FALSE(ball.PointInSet(Eigen::Vector2d(3.001, 1)));
}

TEST(ConvexSet, TheBoxOfABallIsTight) {
  const Hyperellipsoid ball = Hyperellipsoid::MakeHypersphere(2, Eigen::Vector3d(1, -1, 5));
  const SetBox& box = ball.bounding_box();
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(box.lower[i], ball.center()[i] - 2, 1e-8);
    EXPECT_LE(box.lower[i], ball.center()[i] - 2);
    EXPECT_GE(box.upper[i], ball.center()[i] + 2);
  }
}

TEST(ConvexSet, SaysThatItIsEmpty) {
  const Eigen::MatrixXd A = (Eigen::MatrixXd(2, 1) << 1, -1).finished();
  EXPECT_TRUE(HPolyhedron(A, Eigen::Vector2d(0, -1)).IsEmpty());
  EXPECT_FALSE(HPolyhedron(A, Eigen::Vector2d(1, -1)).IsEmpty());
  const Hyperrectangle a(Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 1));
  const Hyperrectangle b(Eigen::Vector2d(2, 0), Eigen::Vector2d(3, 1));
  EXPECT_TRUE(Intersection(a, b).IsEmpty());
  EXPECT_FALSE(a.IntersectsWith(b));
  EXPECT_TRUE(a.IntersectsWith(Hyperrectangle(Eigen::Vector2d(1, 1), Eigen::Vector2d(3, 3))));
}

TEST(ConvexSet, AHalfspaceIsNotBounded) {
  const HPolyhedron half(Eigen::RowVector2d(1, 0), Eigen::VectorXd::Ones(1));
  EXPECT_FALSE(half.bounding_box().is_finite());
}

TEST(Point, IsItsOwnPoint) {
  EXPECT_EQ(*Point(Eigen::Vector2d(1, 2)).MaybeGetPoint(), Eigen::Vector2d(1, 2));
  EXPECT_EQ(*Hyperrectangle(Eigen::Vector2d(1, 2), Eigen::Vector2d(1, 2)).MaybeGetPoint(),
            Eigen::Vector2d(1, 2));
  Point moved(Eigen::Vector2d(1, 2));
  EXPECT_TRUE(moved.PointInSet(Eigen::Vector2d(1, 2)));
  moved.set_x(Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(moved.ambient_dimension(), 3);
  EXPECT_TRUE(moved.PointInSet(Eigen::Vector3d(1, 2, 3)));
}

std::string Complaint(const std::function<void()>& mistake) {
  try {
    mistake();
  } catch (const InvalidArgument& e) {
    return e.what();
  }
  return "";
}

TEST(ConvexSet, NamesTheMistake) {
  EXPECT_EQ(Complaint([] { Hyperrectangle(Eigen::Vector2d(0, 2), Eigen::Vector2d(1, 1)); }),
            "hyperrectangle: lb[1] = 2 must be at most ub[1] = 1");
  EXPECT_EQ(Complaint([] { (void)Hyperellipsoid::MakeHypersphere(-1, Eigen::Vector2d(0, 0)); }),
            "hyperellipsoid: radius[0] must be positive and finite, got -1");
  EXPECT_EQ(Complaint([] { HPolyhedron(Eigen::MatrixXd::Zero(2, 3), Eigen::VectorXd::Zero(3)); }),
            "hpolyhedron: A has 2 rows, b 3 entries");
  EXPECT_EQ(Complaint([] { Point(Eigen::Vector2d(0, kInfinity)); }),
            "point: x[1] must be a finite number, got inf");
}

}  // namespace
}  // namespace switchyard::testing
