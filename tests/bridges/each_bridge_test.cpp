// What one bridge alone does: where rows, sides and cones go.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "core/bridges/bridges.hpp"
#include "core/problem/builder.hpp"
#include "switchyard/error.hpp"
#include "tests/support/known_answers.hpp"

namespace switchyard::testing {
namespace {

/// min 1/2 x'Px over n free variables.
ProblemData Quadratic(const std::vector<std::vector<double>>& upper) {
  const auto n = static_cast<std::int32_t>(upper.size());
  TripletMatrix P;
  for (std::size_t i = 0; i < upper.size(); ++i) {
    for (std::size_t j = i; j < upper.size(); ++j) {
      if (upper[i][j] != 0) {
        P.Add(static_cast<std::int32_t>(i), static_cast<std::int32_t>(j), upper[i][j]);
      }
    }
  }
  ProblemData d;
  d.num_vars = n;
  d.flags = SY_PROBLEM_CONVEX;
  d.P = P.Seal(n, n);
  d.A = d.F = Csc(0, n);
  d.q.assign(upper.size(), 0.0);
  return d;
}

/// Two variables, one row x + y, the given sides.
ProblemData OneRow(double lower, double upper) {
  TripletMatrix A;
  A.Add(0, 0, 1);
  A.Add(0, 1, 1);
  ProblemData d = Quadratic({{0, 0}, {0, 0}});
  d.A = A.Seal(1, 2);
  d.row_lower = {lower};
  d.row_upper = {upper};
  return d;
}

Bridged Apply(const BridgeKind& kind, const ProblemData& d) { return kind.apply(d); }

TEST(BoundsToRows, MakesARowForEachVariableWithAFiniteSide) {
  ProblemData d = OneRow(1, 2);
  d.x_lower = {-kInfinity, 0};
  d.x_upper = {kInfinity, kInfinity};
  const auto bridge = Apply(BoundsToRows(), d);
  const ProblemData& image = bridge.image;
  EXPECT_EQ(image.row_lower, (Vector{1, 0}));
  EXPECT_EQ(image.row_upper, (Vector{2, kInfinity}));
  EXPECT_EQ(Product(image.A, {3, 5}), (Vector{8, 5}));
  EXPECT_EQ(Problem(bridge.image).view().x_lower, nullptr);
}

TEST(RowsToCones, PutsEqualitiesInAZeroConeAndSidesInANonnegativeOne) {
  const auto cones_of = [](double lower, double upper) {
    std::string text;
    const auto bridge = Apply(RowsToCones(), OneRow(lower, upper));
    for (const sy_cone& cone : bridge.image.cones) {
      text += FactsOf(cone.kind).name + std::string(" ") + std::to_string(cone.dim) + ";";
    }
    return text;
  };
  EXPECT_EQ(cones_of(1, 1), "zero 1;");
  EXPECT_EQ(cones_of(1, 2), "nonnegative 2;");
  EXPECT_EQ(cones_of(-kInfinity, 2), "nonnegative 1;");
  EXPECT_EQ(cones_of(-kInfinity, kInfinity), "");
}

TEST(RowsToCones, GivesADualOfARowToTheSideItsSignNames) {
  const auto bridge = Apply(RowsToCones(), OneRow(1, 2));
  Vectors v;
  v.row_dual = {3};
  bridge.maps->Forward(v);
  EXPECT_EQ(v.cone_dual, (Vector{3, 0}));
  v = {};
  v.row_dual = {-3};
  bridge.maps->Forward(v);
  EXPECT_EQ(v.cone_dual, (Vector{0, 3}));
  v = {};
  v.row_dual = {std::nan("")};
  bridge.maps->Forward(v);
  EXPECT_TRUE(std::isnan(v.cone_dual[0]) && std::isnan(v.cone_dual[1]));
}

TEST(RotateCones, ASecondOrderConeOfOneRowIsNonnegative) {
  ProblemData d = Quadratic({{0, 0}, {0, 0}});
  TripletMatrix F;
  F.Add(0, 1, 2);
  d.F = F.Seal(1, 2);
  d.g = {3};
  d.cones = {{SY_CONE_SECOND_ORDER, 1, 0}};
  const auto bridge = Apply(SecondOrderToRotated(), d);
  const ProblemData& image = bridge.image;
  ASSERT_EQ(image.num_cones(), 1);
  EXPECT_EQ(image.cones[0].kind, SY_CONE_NONNEGATIVE);
  EXPECT_EQ(Product(image.F, {0, 1}), (Vector{2}));
  EXPECT_EQ(image.g, (Vector{3}));
}

TEST(RotateCones, ThereAndBackIsTheSameProblem) {
  Random random(6);
  const KnownAnswer known = KnownOptimum({.cones = {{SY_CONE_ROTATED, 4, 0}}}, random);
  const auto there = Apply(RotatedToSecondOrder(), known.problem);
  const auto back = SecondOrderToRotated().apply(there.image);
  EXPECT_EQ(back.image.cones[0].kind, SY_CONE_ROTATED);
  const Vector expected = Product(known.problem.F, known.at.x);
  const Vector s = Product(back.image.F, known.at.x);
  for (std::size_t i = 0; i < s.size(); ++i) {
    EXPECT_NEAR(s[i], expected[i], 1e-12);
    EXPECT_NEAR(back.image.g[i], known.problem.g[i], 1e-12);
  }
}

TEST(QuadraticObjectiveToCone, GivesEachComponentAFactorOfItsRank) {
  // Rank 1 on (0, 2), rank 2 on (1, 3), nothing on 4.
  const ProblemData d = Quadratic(
      {{1, 0, 2, 0, 0}, {0, 2, 0, 1, 0}, {0, 0, 4, 0, 0}, {0, 0, 0, 2, 0}, {0, 0, 0, 0, 0}});
  const auto bridge = Apply(QuadraticObjectiveToCone(), d);
  const ProblemData& image = bridge.image;
  ASSERT_EQ(image.cones.size(), 1u);
  EXPECT_EQ(image.cones[0].kind, SY_CONE_ROTATED);
  EXPECT_EQ(image.cones[0].dim, 2 + 3);
  Random random(7);
  for (int k = 0; k < 10; ++k) {
    const Vector x = random.Normals(6);
    const Vector s = Product(image.F, x);
    EXPECT_EQ(s[0] + image.g[0], x[5]);
    EXPECT_EQ(s[1] + image.g[1], 1);
    double squares = 0;
    for (std::size_t i = 2; i < s.size(); ++i) squares += s[i] * s[i];
    EXPECT_NEAR(squares, QuadraticForm(d.P.View(), x.data()), 1e-12);
  }
}

TEST(QuadraticObjectiveToCone, KnowsTheConesDualOnlyWhereItKnowsX) {
  const auto bridge = Apply(QuadraticObjectiveToCone(), Quadratic({{1, 0}, {0, 4}}));
  Vectors v;
  v.x = {1, 0.5};
  v.x_dual = {0, 0};
  v.cone_dual = {};
  bridge.maps->Forward(v);
  EXPECT_EQ(v.x, (Vector{1, 0.5, 1}));
  EXPECT_EQ(v.x_dual, (Vector{0, 0, 0}));
}

std::string Refusal(const ProblemData& d) {
  try {
    Apply(QuadraticObjectiveToCone(), d);
  } catch (const InvalidArgument& e) {
    return e.what();
  }
  return "(nothing was thrown)";
}

TEST(QuadraticObjectiveToCone, RefusesWhatIsNotConvex) {
  EXPECT_EQ(Refusal(Quadratic({{1, 0, 0}, {0, 0, 2}, {0, 0, 0}})),
            "the quadratic objective is not convex: a pivot of its matrix is 0 in the component of "
            "x[1]");
  EXPECT_EQ(Refusal(Quadratic({{1, 0}, {0, -2}})),
            "the quadratic objective is not convex: a pivot of its matrix is -2 in the component "
            "of x[1]");
  ProblemData unknown = Quadratic({{1, 0}, {0, 1}});
  unknown.flags = 0;
  EXPECT_EQ(Refusal(unknown), "a nonconvex quadratic objective has no form as a cone");
}

TEST(LeaveOutSwitchedOff, LeavesOutTheConesThatAreOffAndGivesThemADualOf0) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    Random random(seed);
    Shape shape = {.cones = AllCones()};
    KnownAnswer known = KnownOptimum(shape, random);
    ProblemData& d = known.problem;
    d.cone_on.assign(d.cones.size(), 1);
    // What is off must not hold anything: the optimum of the rest is that with its dual at 0.
    std::size_t at = 0;
    for (std::size_t c = 0; c < d.cones.size(); ++c) {
      if (random.Chance(0.5)) {
        d.cone_on[c] = 0;
        std::fill_n(known.at.cone_dual.begin() + static_cast<std::ptrdiff_t>(at), d.cones[c].dim,
                    0.0);
      }
      at += static_cast<std::size_t>(d.cones[c].dim);
    }
    d.q = Combined(d, known.at);
    const auto bridge = LeaveOutSwitchedOff(d);
    Vectors v = known.at;
    bridge.maps->Forward(v);
    EXPECT_LT(OptimumError(bridge.image, v), 1e-9);
    EXPECT_FALSE(AnyOff(bridge.image));
    bridge.maps->Back(v);
    EXPECT_EQ(v.cone_dual, known.at.cone_dual);
  }
}

}  // namespace
}  // namespace switchyard::testing
