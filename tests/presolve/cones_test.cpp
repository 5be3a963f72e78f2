// Cones that presolve takes for rows, takes apart or finds switched off.
#include <cmath>

#include "tests/presolve/programs.hpp"

namespace switchyard::presolve {
namespace {

const Rows kUnit2 = {{1, 0}, {0, 1}};
const Rows kUnit3 = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
const double kRoot = std::sqrt(2.0);

TEST(PresolveCones, ZeroAndNonnegativeConesAreRows) {
  // x_0 + x_1 = 4, x_0 - x_1 >= 1 and x_0 >= -9
  const ProblemData d = WithCones(Nearest({0, 2}), {{1, 1}, {1, -1}, {1, 0}}, {-4, -1, 9},
                                  {{SY_CONE_ZERO, 1, 0}, {SY_CONE_NONNEGATIVE, 2, 0}});
  const Presolve presolve(d, {});
  EXPECT_EQ(SizesOf(presolve.reduced()), (Sizes{2, 2, 0}));
  EXPECT_EQ(presolve.rows(), (std::vector<Index>{~0, ~1}));
  // x = (2.5, 1.5): (2.5, -0.5) = y (1, 1) + z (1, -1)
  const Vectors at = Recovered(d, presolve, {{2.5, 1.5}, {0, 0}, {1, 1.5}, {}});
  EXPECT_EQ(at.cone_dual, (Vector{1, 1.5, 0}));
}

TEST(PresolveCones, RowsOfConesAreReducedAsOthersAre) {
  // x_0 >= 3 by a cone, which a row of A is parallel to; x_1 is fixed by one.
  const ProblemData d =
      WithCones(WithRows(Nearest({0, 0}), {{2, 0}}, {4}, {kInfinity}), {{1, 0}, {0, 2}}, {-3, -8},
                {{SY_CONE_SECOND_ORDER, 1, 0}, {SY_CONE_ZERO, 1, 0}});
  const Presolve presolve(d, {});
  EXPECT_EQ(SizesOf(presolve.reduced()), (Sizes{1, 0, 0}));
  const Vectors at = Recovered(d, presolve, {{3}, {3}, {}, {}});
  EXPECT_EQ(at.x, (Vector{3, 4}));
  EXPECT_EQ(at.cone_dual, (Vector{3, 2}));
  EXPECT_EQ(at.row_dual, (Vector{0}));
}

TEST(PresolveCones, OfOrderTwoTheyAreTwoRows) {
  // The nearest point of s_0 >= |s_1| to (0, 2), s = x + g, is (1, 1).
  const ProblemData d =
      WithCones(Nearest({-3, 6}), kUnit2, {3, -4}, {{SY_CONE_SECOND_ORDER, 2, 0}});
  const Presolve presolve(d, {});
  EXPECT_EQ(SizesOf(presolve.reduced()), (Sizes{2, 2, 0}));
  EXPECT_EQ(Recovered(d, presolve, {{-2, 5}, {0, 0}, {0, 1}, {}}).cone_dual, (Vector{1, -1}));
}

TEST(PresolveCones, WhatCancelsInSumAndDifferenceIsGone) {
  // s = (x_0, x_0 - 2): s_0 - s_1 = 2 always, s_0 + s_1 = 2 x_0 - 2 is a bound.
  const ProblemData d =
      WithCones(Nearest({0}), {{1}, {1}}, {0, -2}, {{SY_CONE_SECOND_ORDER, 2, 0}});
  const Presolve presolve(d, {});
  EXPECT_EQ(SizesOf(presolve.reduced()), (Sizes{1, 0, 0}));
  EXPECT_EQ(Recovered(d, presolve, {{1}, {1}, {}, {}}).cone_dual, (Vector{0.5, 0.5}));
}

TEST(PresolveCones, RotatedOnesOfOrderTwoAreTwoRows) {
  // x_0 + x_1 >= 2, x_0 - x_1 >= 0
  const ProblemData d =
      WithCones(Nearest({0, 0}), {{1, 1}, {1, -1}}, {-2, 1}, {{SY_CONE_ROTATED, 2, 0}});
  const Presolve presolve(d, {});
  EXPECT_EQ(SizesOf(presolve.reduced()), (Sizes{2, 2, 0}));
  EXPECT_EQ(Recovered(d, presolve, {{1, 1}, {0, 0}, {1, 0}, {}}).cone_dual, (Vector{1, 0}));
}

TEST(PresolveCones, SemidefiniteOnesOfOrderTwoAreRotated) {
  // [1 1; 1 1] and [1 -1; -1 1]; before it a cone that stays, behind it one of order 1.
  const Rows rows = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}};
  const ProblemData d =
      WithCones(Nearest({0, 2 * kRoot, 0}), rows, {5, 1, 1, 0, 0, 0, 100},
                {{SY_CONE_SECOND_ORDER, 3, 0}, {SY_CONE_PSD, 3, 0}, {SY_CONE_PSD, 1, 0}});
  const Presolve presolve(d, {});
  EXPECT_EQ(SizesOf(presolve.reduced()), (Sizes{3, 1, 2}));
  EXPECT_EQ(presolve.reduced().cones[1].kind, SY_CONE_ROTATED);
  const Vectors at =
      Recovered(d, presolve, {{1, kRoot, 1}, {0, 0, 0}, {0}, {0, 0, 0, 1, 1, -kRoot}}, 1e-12);
  EXPECT_EQ(at.cone_dual, (Vector{0, 0, 0, 1, -kRoot, 1, 0}));
}

TEST(PresolveCones, OthersStay) {
  const std::vector<sy_cone> cones = {{SY_CONE_SECOND_ORDER, 3, 0},
                                      {SY_CONE_EXPONENTIAL, 3, 0},
                                      {SY_CONE_POWER, 3, 0.3},
                                      {SY_CONE_PSD, 6, 0},
                                      {SY_CONE_ROTATED, 3, 0}};
  const ProblemData d =
      WithCones(Nearest({0, 0, 0}), Rows(18, Vector{1, 2, 3}), Vector(18, 1.0), cones);
  const Presolve presolve(d, {});
  EXPECT_EQ(SizesOf(presolve.reduced()), (Sizes{3, 0, 5}));
  for (std::size_t c = 0; c < cones.size(); ++c) {
    EXPECT_EQ(presolve.reduced().cones[c].kind, cones[c].kind);
    EXPECT_EQ(presolve.reduced().cones[c].parameter, cones[c].parameter);
  }
}

TEST(PresolveCones, ConesThatAreOffAreNotThere) {
  // As OfOrderTwoTheyAreTwoRows, among others that would change the answer.
  Rows rows = {{1, 0}, {1, 0}, {0, 1}, {1, 1}, {1, 0}, {0, 1}, {0, 1}};
  ProblemData d = WithCones(Nearest({-3, 6}), rows, {-9, 3, -4, -9, 0, 0, -9},
                            {{SY_CONE_ZERO, 1, 0},
                             {SY_CONE_SECOND_ORDER, 2, 0},
                             {SY_CONE_SECOND_ORDER, 3, 0},
                             {SY_CONE_NONNEGATIVE, 1, 0}});
  d.cone_on = {0, 1, 0, 0};
  for (const Limits& limits : {Limits(), Limits{false, false, false}}) {
    const Presolve presolve(d, limits);
    EXPECT_EQ(SizesOf(presolve.reduced()), (Sizes{2, 2, 0}));
    const Vectors at = Recovered(d, presolve, {{-2, 5}, {0, 0}, {0, 1}, {}});
    EXPECT_EQ(at.cone_dual, (Vector{0, 1, -1, 0, 0, 0, 0}));
  }
  d.cone_on = {0, 0, 0, 0};
  const Presolve presolve(d, {});
  EXPECT_EQ(SizesOf(presolve.reduced()), (Sizes{2, 0, 0}));
  Recovered(d, presolve, {{-3, 6}, {0, 0}, {}, {}});
}

TEST(PresolveCones, ThatStayMayBeOffToo) {
  ProblemData d = WithCones(Nearest({0, 1, 1}), kUnit3, {0, 0, 0}, {{SY_CONE_SECOND_ORDER, 3, 0}});
  d.cone_on = {0};
  const Presolve presolve(d, {});
  EXPECT_EQ(SizesOf(presolve.reduced()), (Sizes{3, 0, 0}));
  EXPECT_EQ(presolve.reduced().F.rows, 0);
  Recovered(d, presolve, {{0, 1, 1}, {0, 0, 0}, {}, {}});
}

}  // namespace
}  // namespace switchyard::presolve
