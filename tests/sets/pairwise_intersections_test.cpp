// Which sets meet, against every pair looked at alone.
#include "switchyard/sets/pairwise_intersections.hpp"

#include <cmath>
#include <numbers>
#include <set>

#include "switchyard/error.hpp"
#include "switchyard/sets/vpolytope.hpp"
#include "switchyard/solve/solve.hpp"
#include "tests/sets/random_sets.hpp"

namespace switchyard::testing {
namespace {

using std::numbers::pi;
using Pairs = std::vector<std::pair<int, int>>;

ConvexSets Scattered(RandomSets& random, int n, int groups, double spread) {
  ConvexSets sets;
  for (int k = 0; k < groups; ++k) {
    const ConvexSets some = random.OneOfEach(random.Vector(n, spread));
    sets.insert(sets.end(), some.begin(), some.end());
  }
  return sets;
}

ConvexSets Polytopes(RandomSets& random, int n, int count, double spread) {
  ConvexSets sets;
  for (int k = 0; k < count; ++k) {
    const Eigen::VectorXd center = random.Vector(n, spread);
    Eigen::MatrixXd A(4 * n, n);
    A << random.Matrix(2 * n, n), Eigen::MatrixXd::Identity(n, n) + 0.3 * random.Matrix(n, n),
        -Eigen::MatrixXd::Identity(n, n);
    sets.emplace_back(HPolyhedron(A, A * center + random.Vector(4 * n).cwiseAbs()));
  }
  return sets;
}

template <class Meet>
Pairs ByLooking(const ConvexSets& a, const ConvexSets& b, const Meet& meet) {
  Pairs pairs;
  for (int i = 0; i < int(a.size()); ++i) {
    for (int j = 0; j < int(b.size()); ++j) {
      if (meet(*a[std::size_t(i)], *b[std::size_t(j)])) pairs.emplace_back(i, j);
    }
  }
  return pairs;
}

Pairs WithoutTheDiagonal(Pairs pairs) {
  std::erase_if(pairs, [](const auto& pair) { return pair.first == pair.second; });
  return pairs;
}

TEST(PairwiseIntersections, OfAllKindsAreThoseThatMeet) {
  RandomSets random(21);
  for (int n = 1; n <= 3; ++n) {
    const ConvexSets a = Scattered(random, n, 4, 2);
    const ConvexSets b = Scattered(random, n, 3, 2);
    const auto meet = [](const ConvexSet& x, const ConvexSet& y) { return x.IntersectsWith(y); };
    const auto between = ComputePairwiseIntersections(a, b, {});
    EXPECT_EQ(between.first, ByLooking(a, b, meet));
    EXPECT_GT(between.first.size(), 0u);
    const auto within = ComputePairwiseIntersections(a, {});
    EXPECT_EQ(within.first, WithoutTheDiagonal(ByLooking(a, a, meet)));
    for (const Eigen::VectorXd& tau : within.second) EXPECT_EQ(tau, Eigen::VectorXd::Zero(n));
  }
}

TEST(PairwiseIntersections, OfPolytopesAreThoseThatABackendFinds) {
  RandomSets random(22);
  for (int n = 2; n <= 4; ++n) {
    const ConvexSets sets = Polytopes(random, n, 25, 0.4 * n);
    const auto meet = [](const ConvexSet& a, const ConvexSet& b) {
      MathematicalProgram program;
      const auto x = program.NewContinuousVariables(a.ambient_dimension());
      a.AddPointInSetConstraints(&program, x);
      b.AddPointInSetConstraints(&program, x);
      return Solve(program).termination == Termination::kOptimal;
    };
    const Pairs found = ComputePairwiseIntersections(sets, {}).first;
    EXPECT_EQ(found, WithoutTheDiagonal(ByLooking(sets, sets, meet)));
    EXPECT_GT(found.size(), 10u);
    EXPECT_LT(found.size(), 24u * 25u);
  }
}

TEST(PairwiseIntersections, AreTheSameHoweverTheyAreFound) {
  RandomSets random(23);
  const ConvexSets sets = Polytopes(random, 3, 120, 2.5);
  std::vector<Hyperrectangle> boxes;
  for (const ConvexSetPointer& set : sets) {
    boxes.push_back(*Hyperrectangle::MaybeCalcAxisAlignedBoundingBox(*set));
  }
  const auto one = ComputePairwiseIntersections(sets, {}, true, Parallelism::None());
  EXPECT_GT(one.first.size(), 100u);
  EXPECT_EQ(one, ComputePairwiseIntersections(sets, {}, true, Parallelism(4)));
  EXPECT_EQ(one, ComputePairwiseIntersections(sets, {}, false, Parallelism(3)));
  EXPECT_EQ(one, ComputePairwiseIntersections(sets, {}, boxes));
  const auto twice = ComputePairwiseIntersections(sets, sets, {}, boxes, boxes);
  EXPECT_EQ(one.first, WithoutTheDiagonal(twice.first));
  EXPECT_EQ(twice.first.size(), one.first.size() + sets.size());
}

TEST(PairwiseIntersections, SetsThatTouchMeet) {
  const auto box = [](double l, double u) {
    return Hyperrectangle(Eigen::Vector2d(l, 0), Eigen::Vector2d(u, 1));
  };
  const ConvexSets row = MakeConvexSets(box(0, 0.3), box(0.1 + 0.2, 1), box(1, 2).MakeHPolyhedron(),
                                        Hyperellipsoid::MakeHypersphere(1, Eigen::Vector2d(3, 0.5)),
                                        Point(Eigen::Vector2d(4, 0.5)), box(4.001, 5));
  const Pairs chain = {{0, 1}, {1, 0}, {1, 2}, {2, 1}, {2, 3}, {3, 2}, {3, 4}, {4, 3}};
  EXPECT_EQ(ComputePairwiseIntersections(row, {}).first, chain);
}

TEST(PairwiseIntersections, PolytopesThatShareAFaceMeetAndThoseWithAGapDoNot) {
  RandomSets random(25);
  for (int trial = 0; trial < 200; ++trial) {
    const int n = 2 + trial % 5;
    const double size = std::pow(10, random.Uniform(-3, 3));
    const Eigen::VectorXd center = random.Vector(n, size);
    const Eigen::RowVectorXd a = random.Vector(n).transpose();
    // One cell, cut by a plane through its center; the upper part begins `gap` above it.
    const auto cell = [&](double sign, double gap) {
      Eigen::MatrixXd A(2 * n + 1, n);
      A << Eigen::MatrixXd::Identity(n, n), -Eigen::MatrixXd::Identity(n, n), -sign * a;
      Eigen::VectorXd b = A * center;
      b.head(2 * n).array() += size;
      b[2 * n] -= gap * a.norm();
      return HPolyhedron(A, b);
    };
    EXPECT_EQ(
        ComputePairwiseIntersections(MakeConvexSets(cell(1, 0), cell(-1, 0)), {}).first.size(), 2u);
    EXPECT_EQ(ComputePairwiseIntersections(MakeConvexSets(cell(1, 1e-6 * size), cell(-1, 0)), {})
                  .first.size(),
              0u);
  }
}

TEST(PairwiseIntersections, KnowSetsWithVariablesOfTheirOwn) {
  Eigen::MatrixXd corners(2, 3);
  corners << 0, 1, 0, 0, 0, 1;
  const auto triangle = [&](double x, double y, double size) {
    return VPolytope((size * corners).colwise() + Eigen::Vector2d(x, y));
  };
  // The second lies in the corner of the first one's box that the first one's hypotenuse cuts off.
  const ConvexSets sets =
      MakeConvexSets(triangle(0, 0, 1), triangle(0.6, 0.6, 0.3), triangle(0.4, 0.4, 0.45));
  EXPECT_EQ(ComputePairwiseIntersections(sets, {}).first, (Pairs{{0, 2}, {1, 2}, {2, 0}, {2, 1}}));
}

TEST(PairwiseIntersections, AnEmptySetMeetsNone) {
  const Eigen::MatrixXd A = (Eigen::MatrixXd(3, 2) << 1, 0, 0, 1, -1, -1).finished();
  const HPolyhedron empty(A, Eigen::Vector3d(0, 0, -1));
  const ConvexSets sets =
      MakeConvexSets(empty, HPolyhedron::MakeUnitBox(2), empty, Hyperellipsoid::MakeUnitBall(2));
  EXPECT_EQ(ComputePairwiseIntersections(sets, {}).first, (Pairs{{1, 3}, {3, 1}}));
}

/// Do [a, b] + 2 pi k and [c, d] overlap for some k?
bool MeetOnACircle(double a, double b, double c, double d) {
  for (int k = -10; k <= 10; ++k) {
    if (a + 2 * pi * k <= d && b + 2 * pi * k >= c) return true;
  }
  return false;
}

TEST(PairwiseIntersections, OnACircleAreModuloTwoPi) {
  RandomSets random(24);
  // Angle first: a box, the same box by its halfspaces turned a little, and a ball.
  ConvexSets sets;
  for (int k = 0; k < 30; ++k) {
    const Eigen::Vector2d at(random.Uniform(-20, 20), random.Uniform(-1, 1));
    const Eigen::Vector2d half(random.Uniform(0.1, 1.5), random.Uniform(0.1, 1));
    const Hyperrectangle box(at - half, at + half);
    if (k % 3 == 0) sets.emplace_back(box);
    if (k % 3 == 1) sets.emplace_back(box.MakeHPolyhedron());
    if (k % 3 == 2) sets.emplace_back(Hyperellipsoid::MakeHypersphere(half[0], at));
  }
  const auto found = ComputePairwiseIntersections(sets, {0});
  ASSERT_EQ(found.first.size(), found.second.size());
  EXPECT_GT(found.first.size(), 20u);
  const std::set<std::pair<int, int>> pairs(found.first.begin(), found.first.end());
  for (std::size_t k = 0; k < found.first.size(); ++k) {
    const auto [i, j] = found.first[k];
    const Eigen::VectorXd& tau = found.second[k];
    EXPECT_EQ(tau[1], 0);
    EXPECT_NEAR(std::remainder(tau[0], 2 * pi), 0, 1e-12);
    const auto back = std::find(found.first.begin(), found.first.end(), std::pair(j, i));
    ASSERT_NE(back, found.first.end());
    EXPECT_EQ(found.second[std::size_t(back - found.first.begin())], -tau);
  }
  for (int i = 0; i < int(sets.size()); ++i) {
    for (int j = 0; j < int(sets.size()); ++j) {
      if (i == j || i % 3 == 2 || j % 3 == 2) continue;  // of balls the boxes say too little
      const SetBox& a = sets[std::size_t(i)]->bounding_box();
      const SetBox& b = sets[std::size_t(j)]->bounding_box();
      const bool meet = a.lower[1] <= b.upper[1] && b.lower[1] <= a.upper[1] &&
                        MeetOnACircle(a.lower[0], a.upper[0], b.lower[0], b.upper[0]);
      EXPECT_EQ(pairs.count({i, j}) == 1, meet) << i << ' ' << j;
    }
  }
}

TEST(PairwiseIntersections, OnACircleMoveSetsOfAnyKind) {
  // An ellipse, not a ball, and a triangle, met only by 2 pi: no closed form says so.
  const Hyperellipsoid ellipse =
      Hyperellipsoid::MakeAxisAligned(Eigen::Vector2d(0.5, 1), Eigen::Vector2d(0, 0));
  Eigen::MatrixXd corners(2, 3);
  corners << 2 * pi + 0.4, 2 * pi + 1.4, 2 * pi + 1.4, 0, 1, -1;
  const ConvexSets sets = MakeConvexSets(ellipse, VPolytope(corners), ellipse);
  const auto found = ComputePairwiseIntersections(sets, {0});
  EXPECT_EQ(found.first, (Pairs{{0, 1}, {0, 2}, {1, 0}, {1, 2}, {2, 0}, {2, 1}}));
  EXPECT_NEAR(found.second[0][0], 2 * pi, 1e-12);
  EXPECT_NEAR(found.second[2][0], -2 * pi, 1e-12);
  EXPECT_EQ(ComputePairwiseIntersections(sets, {}).first, (Pairs{{0, 2}, {2, 0}}));
}

template <class Mistake>
std::string Complaint(const Mistake& mistake) {
  try {
    mistake();
  } catch (const InvalidArgument& e) {
    return e.what();
  }
  return "";
}

TEST(PairwiseIntersections, NameTheMistake) {
  const Hyperrectangle wide(Eigen::Vector2d(0, 0), Eigen::Vector2d(4, 1));
  const ConvexSets sets = MakeConvexSets(wide, wide);
  EXPECT_EQ(Complaint([&] { ComputePairwiseIntersections(sets, {0}); }),
            "set 0 (hyperrectangle) is 4 wide along the continuous revolute joint 0: it must be "
            "narrower than pi, see PartitionConvexSet");
  EXPECT_EQ(Complaint([&] { ComputePairwiseIntersections(sets, {2}); }),
            "continuous revolute joints: index 2 is not one of 2 positions");
  EXPECT_EQ(Complaint([&] {
              ComputePairwiseIntersections(sets, MakeConvexSets(Point(Eigen::Vector3d::Zero())),
                                           {});
            }),
            "sets in R^2 and in R^3 have no intersections");
  EXPECT_EQ(Complaint([&] { ComputePairwiseIntersections(sets, {}, {wide}); }),
            "2 sets need as many bounding boxes, got 1");
  EXPECT_EQ(ComputePairwiseIntersections(ConvexSets(), {0}).first.size(), 0u);
}

}  // namespace
}  // namespace switchyard::testing
