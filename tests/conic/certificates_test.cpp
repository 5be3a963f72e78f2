// Contradictions and rays that are known by construction: found, with certificates that hold by the
// formulas of abi.h in the problem as it was given.
#include <gtest/gtest.h>

#include "tests/conic/programs.hpp"

namespace switchyard::conic {
namespace {

constexpr int kSeeds = 15;

class Certificates : public ::testing::TestWithParam<Sort> {
 protected:
  template <class Check>
  void ForSeeds(Check&& check) {
    for (int seed = 0; seed < kSeeds; ++seed) {
      SCOPED_TRACE(seed);
      Random random(static_cast<unsigned>(300 + seed));
      check(random);
    }
  }
  /// With presolve, without, and with all updates to come.
  template <class Check>
  static void EachWay(const ProblemData& d, Check&& check) {
    for (const int presolve : {0, 1}) {
      for (const std::uint64_t updates : {std::uint64_t{0}, Conic::Describe().updates}) {
        SCOPED_TRACE("presolve " + std::to_string(presolve) + ", updates " +
                     std::to_string(updates));
        check(Solver().Set("presolve", presolve).Load(d, updates).Solve());
      }
    }
  }
};

TEST_P(Certificates, OfContradictionsWithoutCosts) {
  ForSeeds([](Random& random) {
    ProblemData d = testing::KnownContradiction(GetParam().shape, random).problem;
    d.P = Csc(d.num_vars, d.num_vars);
    d.q.assign(d.q.size(), 0.0);
    EachWay(d, [&](const Found& found) { ExpectContradiction(d, found); });
  });
}

// With costs there may be a ray besides: either is an answer.
TEST_P(Certificates, OfContradictionsWithCosts) {
  int contradictions = 0;
  ForSeeds([&](Random& random) {
    const ProblemData d = testing::KnownContradiction(GetParam().shape, random).problem;
    EachWay(d, [&](const Found& found) {
      if (found.result.termination == SY_UNBOUNDED) return ExpectRay(d, found);
      ExpectContradiction(d, found);
      ++contradictions;
    });
  });
  EXPECT_GT(contradictions, kSeeds);
}

testing::Shape WithPointsOfOrder3(testing::Shape shape) {
  for (sy_cone& cone : shape.cones) {
    if (cone.kind == SY_CONE_PSD) cone = Semidefinite(3);
  }
  return shape;
}

TEST_P(Certificates, OfRaysInsideTheCones) {
  ForSeeds([](Random& random) {
    const KnownAnswer known =
        WithRayInside(testing::KnownRay(WithPointsOfOrder3(GetParam().shape), random), random);
    ASSERT_LE(testing::RayError(known.problem, known.at.x), 1e-9);
    const ProblemData d = WithAPoint(known.problem, random);
    EachWay(d, [&](const Found& found) { ExpectRay(d, found); });
  });
}

// A change of the last digit may leave no ray: to give up is an answer, an optimum is none.
TEST_P(Certificates, OfRaysOnTheBoundaryOfAllCones) {
  int rays = 0, tries = 0;
  ForSeeds([&](Random& random) {
    const ProblemData d =
        WithAPoint(testing::KnownRay(WithPointsOfOrder3(GetParam().shape), random).problem, random);
    EachWay(d, [&](const Found& found) {
      ++tries;
      if (found.result.termination == SY_NUMERICAL_TROUBLE) return;
      ExpectRay(d, found);
      ++rays;
    });
  });
  EXPECT_GE(rays, 0.8 * tries);
}

TEST_P(Certificates, AreNotGivenForProgramsWithAnOptimum) {
  ForSeeds([](Random& random) {
    const KnownAnswer known = testing::KnownOptimum(GetParam().shape, random);
    for (const double tolerance : {1e-2, 1e-4, 1e-6}) {
      const Found found = Solver(known.problem).Solve(WithTolerance(tolerance));
      EXPECT_EQ(found.result.termination, SY_OPTIMAL) << "at " << tolerance;
    }
  });
}

INSTANTIATE_TEST_SUITE_P(Every, Certificates, ::testing::ValuesIn(Sorts()),
                         [](const auto& of) { return of.param.name; });

TEST(Contradictions, AreOfTheUsersScale) {
  Random random(1);
  const ProblemData d = testing::KnownContradiction({10, 6, {SecondOrder(4)}}, random).problem;
  const Found found = Solver(d).Solve();
  ExpectContradiction(d, found);
  EXPECT_NEAR(testing::SideSum(d, found.at), 1, 1e-9) << "scaled to a sum of 1";
}

TEST(Contradictions, LeaveThePointBufferAlone) {
  Random random(2);
  const ProblemData d = testing::KnownContradiction({8, 5, {}}, random).problem;
  const Found found = Solver(d).Solve();
  ASSERT_EQ(found.result.termination, SY_INFEASIBLE);
  for (const double x : found.at.x) EXPECT_TRUE(std::isnan(x));
  EXPECT_TRUE(std::isnan(found.result.objective));
}

TEST(Contradictions, OfABoundByACone) {
  // x_0 <= 1, |(x_1, x_2)| <= x_0, x_1 + x_2 >= 1.42 > sqrt 2.
  ProblemData d;
  d.num_vars = 3;
  d.P = Csc(3, 3);
  d.q = {0, 0, 0};
  d.x_lower = {-kInfinity, -kInfinity, -kInfinity};
  d.x_upper = {1, kInfinity, kInfinity};
  d.A = Csc(1, 3);
  d.A.start = {0, 0, 1, 2};
  d.A.row = {0, 0};
  d.A.value = {1, 1};
  d.row_upper = {kInfinity};
  d.F = Csc(3, 3);
  d.F.start = {0, 1, 2, 3};
  d.F.row = {0, 1, 2};
  d.F.value = {1, 1, 1};
  d.g = {0, 0, 0};
  d.cones = {SecondOrder(3)};
  for (const double side : {1.42, 1.4143, 1.41422}) {
    d.row_lower = {side};
    ExpectContradiction(d, Solver(d).Solve());
  }
  for (const double side : {1.4, 1.4142}) {
    d.row_lower = {side};
    ExpectOptimal(d, Solver(d).Solve());
  }
}

}  // namespace
}  // namespace switchyard::conic
