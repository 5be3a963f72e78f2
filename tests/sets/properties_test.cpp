// Every class of sets has the properties of a set, a user's own too; and who has not is found out.
#include "switchyard/sets/check_set.hpp"

#include <functional>

#include "switchyard/error.hpp"
#include "switchyard/sets/affine_ball.hpp"
#include "switchyard/sets/affine_subspace.hpp"
#include "switchyard/sets/cartesian_product.hpp"
#include "switchyard/sets/convex_hull.hpp"
#include "switchyard/sets/minkowski_sum.hpp"
#include "switchyard/sets/scaled_rows.hpp"
#include "switchyard/sets/spectrahedron.hpp"
#include "switchyard/sets/vpolytope.hpp"
#include "tests/sets/random_sets.hpp"

namespace switchyard::testing {
namespace {

void ExpectNothingWrong(const ConvexSet& set, unsigned seed = 1) {
  for (const std::string& sentence : CheckConvexSet(set, {.seed = seed, .num_points = 8})) {
    ADD_FAILURE() << sentence;
  }
}

HPolyhedron EmptyPolyhedron() {  // 1 <= x_0 <= 0, x_1 <= 0
  return {(Eigen::MatrixXd(3, 2) << 1, 0, -1, 0, 0, 1).finished(), Eigen::Vector3d(0, -1, 0)};
}
HPolyhedron Quadrant() { return {-Eigen::MatrixXd::Identity(2, 2), Eigen::Vector2d(1, 2)}; }

/// {x in R^2 : [1 + x_0, x_1; x_1, 1 - x_0] >= 0}, a disc, with a row finite on one side.
Spectrahedron Disc() {
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(2);
  program.AddLinearMatrixInequalityConstraint(
      {Eigen::Matrix2d::Identity(), (Eigen::Matrix2d() << 1, 0, 0, -1).finished(),
       (Eigen::Matrix2d() << 0, 1, 1, 0).finished()},
      x);
  program.AddLinearConstraint(Eigen::RowVector2d(1, 2), -kInfinity, 1, x);
  return Spectrahedron(program);
}

TEST(Properties, HoldForSetsWithoutOwnVariables) {
  RandomSets random(5);
  for (unsigned trial = 0; trial < 6; ++trial) {
    const Eigen::VectorXd inside = random.Vector(1 + static_cast<int>(trial % 3), 3);
    for (const ConvexSetPointer& set : random.OneOfEach(inside)) ExpectNothingWrong(*set, trial);
  }
}

TEST(Properties, HoldForBalls) {
  RandomSets random(6);
  for (unsigned trial = 0; trial < 4; ++trial) {
    const int n = 1 + static_cast<int>(trial % 3);
    const Eigen::VectorXd center = random.Vector(n, 2);
    ExpectNothingWrong(AffineBall(random.Matrix(n, n), center), trial);
    ExpectNothingWrong(AffineBall(random.Matrix(n, n + 2), center), trial);
    ExpectNothingWrong(AffineBall(random.Matrix(n, 1), center), trial);
  }
  ExpectNothingWrong(AffineBall(Eigen::MatrixXd::Zero(2, 2), Eigen::Vector2d(1, 2)));
}

TEST(Properties, HoldForSubspaces) {
  RandomSets random(7);
  for (int k = 0; k <= 3; ++k) {
    ExpectNothingWrong(AffineSubspace(random.Matrix(3, k), random.Vector(3, 2)));
  }
}

TEST(Properties, HoldForPolytopes) {
  RandomSets random(8);
  for (unsigned trial = 0; trial < 4; ++trial) {
    const int n = 1 + static_cast<int>(trial % 3);
    ExpectNothingWrong(VPolytope(random.Matrix(n, n + 4)), trial);
    ExpectNothingWrong(VPolytope(random.Matrix(n, 2)), trial);
  }
  ExpectNothingWrong(VPolytope(Eigen::Vector3d(1, 2, 3)));
  ExpectNothingWrong(VPolytope(Eigen::MatrixXd(2, 0)));
}

TEST(Properties, HoldForProducts) {
  RandomSets random(9);
  const ConvexSets factors = MakeConvexSets(
      random.Ellipsoid(random.Vector(2)), VPolytope(random.Matrix(1, 3)), Point(random.Vector(1)));
  ExpectNothingWrong(CartesianProduct(factors));
  Eigen::MatrixXd A = random.Matrix(4, 4);
  A.row(3).setZero();
  A(3, 0) = 1;
  ExpectNothingWrong(CartesianProduct(factors, A, random.Vector(4)));
  const Eigen::Vector2d into_quadrant(-1, 1);
  ExpectNothingWrong(
      CartesianProduct(MakeConvexSets(Quadrant()), random.Matrix(2, 3), into_quadrant));
  ExpectNothingWrong(CartesianProduct(EmptyPolyhedron(), random.Box(random.Vector(1))));
  ExpectNothingWrong(CartesianProduct());
}

TEST(Properties, HoldForSums) {
  RandomSets random(10);
  for (unsigned trial = 0; trial < 3; ++trial) {
    const int n = 1 + static_cast<int>(trial);
    const Eigen::VectorXd at = random.Vector(n, 2);
    ExpectNothingWrong(MinkowskiSum(random.Box(at), VPolytope(random.Matrix(n, 4))), trial);
    ExpectNothingWrong(MinkowskiSum(random.Ellipsoid(at), random.Polyhedron(at)), trial);
    ExpectNothingWrong(MinkowskiSum(MakeConvexSets(Point(at), AffineBall(random.Matrix(n, n), at),
                                                   random.Box(at))),
                       trial);
  }
  ExpectNothingWrong(MinkowskiSum(Quadrant(), random.Ellipsoid(random.Vector(2))));
  ExpectNothingWrong(MinkowskiSum(Quadrant(), EmptyPolyhedron()));
}

TEST(Properties, HoldForHulls) {
  RandomSets random(11);
  for (unsigned trial = 0; trial < 3; ++trial) {
    const int n = 1 + static_cast<int>(trial);
    const ConvexSets members =
        MakeConvexSets(random.Box(random.Vector(n, 2)), Point(random.Vector(n, 3)),
                       random.Ellipsoid(random.Vector(n, 2)));
    ExpectNothingWrong(ConvexHull(members), trial);
  }
  ExpectNothingWrong(ConvexHull(MakeConvexSets(Quadrant(), Point(Eigen::Vector2d(-3, 0)))));
  const ConvexSets with_empty = MakeConvexSets(
      EmptyPolyhedron(), Hyperrectangle(Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 2)));
  ExpectNothingWrong(ConvexHull(with_empty));
  ExpectNothingWrong(ConvexHull(with_empty, false));
  ExpectNothingWrong(ConvexHull(MakeConvexSets(EmptyPolyhedron())));
}

TEST(Properties, HoldForIntersectionsOfSetsWithOwnVariables) {
  RandomSets random(12);
  const Eigen::VectorXd at = random.Vector(2, 2);
  ExpectNothingWrong(Intersection(MinkowskiSum(random.Box(at), Point(Eigen::Vector2d(0, 0))),
                                  AffineBall::MakeHypersphere(0.5, at)));
}

TEST(Properties, HoldForSpectrahedra) { ExpectNothingWrong(Disc()); }

TEST(Properties, HoldForUnboundedSets) {
  ExpectNothingWrong(Quadrant());
  ExpectNothingWrong(Hyperrectangle(Eigen::Vector2d(0, -kInfinity), Eigen::Vector2d(1, 2)));
  ExpectNothingWrong(Hyperellipsoid(Eigen::RowVector2d(1, 2), Eigen::Vector2d(1, 1)));
  ExpectNothingWrong(EmptyPolyhedron());
}

// ---- A user's own set: only what a set must say ----

/// {x in R^2 : x_1 >= x_0^2}, not bounded: x_1 t >= x_0^2.
class Parabola : public ConvexSet {
 public:
  Parabola() : ConvexSet(2) {}
  [[nodiscard]] std::string Kind() const override { return "parabola"; }

 private:
  [[nodiscard]] std::unique_ptr<ConvexSet> DoClone() const override {
    return std::make_unique<Parabola>(*this);
  }
  [[nodiscard]] ScaledSet DoScaled() const override {
    ScaledRows rows(2);
    const int cone = rows.AddCone({SY_CONE_ROTATED, 3, 0});  // 2 s_0 s_1 >= s_2^2
    rows.SetCone(cone, 0, 1);
    rows.SetCone(cone + 1, 2, 0.5);
    rows.SetCone(cone + 2, 1, 1);
    return rows.Finish();
  }
};

TEST(Properties, HoldForAUsersOwnSet) {
  const Parabola parabola;
  ExpectNothingWrong(parabola);
  EXPECT_FALSE(parabola.IsBounded());
  EXPECT_EQ(parabola.SupportFunction(Eigen::Vector2d(0, 1)), kInfinity);
  // x_0 - x_1 <= x_0 - x_0^2 <= 1/4.
  EXPECT_NEAR(parabola.SupportFunction(Eigen::Vector2d(1, -1)), 0.25, 1e-6);
  const auto [distances, nearest] = *parabola.Projection(Eigen::Vector2d(0, -2));
  EXPECT_NEAR(distances[0], 2, 1e-5);
  EXPECT_LE(nearest.col(0).norm(), 1e-3);
}

// ---- Sets that are wrong in one thing ----

/// A box [-1, 1]^2 that can be told to lie.
class Liar : public ConvexSet {
 public:
  enum class About { kNothing, kScale, kSupport, kNearest, kBounded, kPoint, kClone };
  explicit Liar(About about) : ConvexSet(2), about_(about) {}
  [[nodiscard]] std::string Kind() const override { return "liar"; }

 private:
  [[nodiscard]] std::unique_ptr<ConvexSet> DoClone() const override {
    if (about_ == About::kClone) return std::make_unique<Point>(Eigen::Vector2d(0, 0));
    return std::make_unique<Liar>(about_);
  }
  [[nodiscard]] ScaledSet DoScaled() const override {
    ScaledRows rows(2);
    for (int i = 0; i < 2; ++i) {
      for (const double sign : {1.0, -1.0}) {
        const int row = rows.AddRow(-kInfinity, 0);
        rows.Set(row, 1 + i, sign);
        if (about_ != About::kScale) rows.Set(row, 0, -1);
      }
    }
    return rows.Finish();
  }
  [[nodiscard]] double DoViolation(const Eigen::VectorXd& x) const override {
    if (about_ == About::kPoint) return 0;
    return std::max(0.0, x.lpNorm<Eigen::Infinity>() - 1);
  }
  [[nodiscard]] double DoSupport(const Eigen::VectorXd& a) const override {
    return (about_ == About::kSupport ? 0.5 : 1.0) * a.lpNorm<1>();
  }
  [[nodiscard]] Eigen::VectorXd DoNearestPoint(const Eigen::VectorXd& x) const override {
    if (about_ == About::kNearest) return x / std::max(1.0, x.lpNorm<Eigen::Infinity>());
    return x.cwiseMin(1).cwiseMax(-1);
  }
  [[nodiscard]] bool DoIsBounded(Parallelism /*parallelism*/) const override {
    return about_ != About::kBounded;
  }
  About about_;
};

TEST(Properties, AreFoundNotToHoldWhereTheyDoNot) {
  using About = Liar::About;
  ExpectNothingWrong(Liar(About::kNothing));
  for (const About about : {About::kScale, About::kSupport, About::kNearest, About::kBounded,
                            About::kPoint, About::kClone}) {
    EXPECT_FALSE(CheckConvexSet(Liar(about)).empty()) << static_cast<int>(about);
  }
}

}  // namespace
}  // namespace switchyard::testing
