// What presolve does with columns, and that points and duals come back whole.
#include "tests/presolve/programs.hpp"

namespace switchyard::presolve {
namespace {

constexpr double kInf = kInfinity;

TEST(PresolveColumns, FixedVariablesBecomeConstants) {
  // min 1/2 x'Px - x_1 over x_0 = 2, with a row and a cone that both stand in.
  ProblemData d = Costs({3, -1, 0});
  d.P = Dense({{2, 1, 0}, {0, 1, 0}, {0, 0, 1}}, 3);
  d = Bounded(d, {2, -kInf, -kInf}, {2, kInf, kInf});
  d = WithRows(d, {{1, 1, 1}}, {5}, {kInf});
  d = WithCones(d, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {100, 0, 0}, {{SY_CONE_SECOND_ORDER, 3, 0}});
  const Presolve presolve(d, {});
  // min 1/2 (x_1^2 + x_2^2) + x_1 + 10 over x_1 + x_2 >= 3.
  EXPECT_EQ(SizesOf(presolve.reduced()), (Sizes{2, 1, 1}));
  EXPECT_EQ(presolve.reduced().g, (Vector{102, 0, 0}));
  EXPECT_EQ(presolve.variables(), (std::vector<Index>{1, 2}));
  const Vectors at = Recovered(d, presolve, {{1, 2}, {0, 0}, {2}, {0, 0, 0}});
  EXPECT_EQ(at.x, (Vector{2, 1, 2}));
  EXPECT_EQ(at.x_dual, (Vector{6, 0, 0}));
}

TEST(PresolveColumns, WhatStandsNowhereGoesWhereItsCostSendsIt) {
  const ProblemData d =
      Bounded(Costs({2, -2, 0, 0, 0}), {-1, -1, 3, -8, -kInf}, {5, 5, 4, -7, kInf});
  const Vectors at = RecoveredFromNothing(d);
  EXPECT_EQ(at.x, (Vector{-1, 5, 3, -7, 0}));
  EXPECT_EQ(at.x_dual, (Vector{2, -2, 0, 0, 0}));
}

TEST(PresolveColumns, WhatHasNoEndThereStays) {
  const ProblemData d = Bounded(Costs({-1}), {0}, {kInf});
  const Presolve presolve(d, {});
  EXPECT_EQ(SizesOf(presolve.reduced()), (Sizes{1, 0, 0}));
}

// x_2 is free, stands in one row and has the cost c; x_0 and x_1 are curved.
ProblemData WithFreeColumn(double cost, double lower, double upper) {
  ProblemData d = Nearest({0, 0, 0}, {1, 1, 0});
  d.q[2] = cost;
  return WithRows(d, {{1, 2, 0}, {1, -1, 2}}, {5, lower}, {kInf, upper});
}

TEST(PresolveColumns, AFreeColumnOfAnEquationTakesTheRowAlong) {
  const ProblemData d = WithFreeColumn(-4, 7, 7);  // the row's multiplier is -2
  const Presolve presolve(d, {});
  EXPECT_EQ(SizesOf(presolve.reduced()), (Sizes{2, 1, 0}));
  EXPECT_EQ(presolve.rows(), (std::vector<Index>{0}));
  // min 1/2 |x|^2 + 2 (x_0 - x_1) - 14 over x_0 + 2 x_1 >= 5
  EXPECT_EQ(presolve.reduced().q, (Vector{2, -2}));
  const double y = 3.0 / 5;
  const Vectors at = Recovered(d, presolve, {{-2 + y, 2 + 2 * y}, {0, 0}, {y}, {}});
  EXPECT_EQ(at.row_dual[1], -2);
  EXPECT_EQ(at.x_dual[2], 0);
}

TEST(PresolveColumns, AFreeColumnWithoutCostKeepsItsRowWithinItsSides) {
  for (const auto& [lower, upper] :
       {std::pair(3.0, 4.0), std::pair(-3.0, 4.0), std::pair(-9.0, -4.0), std::pair(-kInf, -3.0),
        std::pair(-kInf, 3.0), std::pair(3.0, kInf), std::pair(-3.0, kInf)}) {
    const ProblemData d = WithFreeColumn(0, lower, upper);
    const Presolve presolve(d, {});
    EXPECT_EQ(SizesOf(presolve.reduced()), (Sizes{2, 1, 0}));
    EXPECT_EQ(Recovered(d, presolve, {{1, 2}, {0, 0}, {1}, {}}).row_dual[1], 0);
  }
}

TEST(PresolveColumns, AFreeColumnsCostSaysWhichSideOfItsRowIsTight) {
  for (const double cost : {4.0, -4.0}) {
    const double side = cost > 0 ? 3 : 8;
    for (const bool one_sided : {false, true}) {
      const double lower = one_sided && cost < 0 ? -kInf : 3;
      const double upper = one_sided && cost > 0 ? kInf : 8;
      const ProblemData d = WithFreeColumn(cost, lower, upper);
      const Presolve presolve(d, {});
      EXPECT_EQ(SizesOf(presolve.reduced()), (Sizes{2, 1, 0}));
      const double m = cost / 2, y = (5 + m) / 5;  // x = y (1, 2) + m (1, -1)
      const Vectors at = Recovered(d, presolve, {{y + m, 2 * y - m}, {0, 0}, {y}, {}});
      EXPECT_NEAR(at.x[0] - at.x[1] + 2 * at.x[2], side, 1e-12);
      EXPECT_EQ(at.row_dual[1], m);
    }
  }
}

TEST(PresolveColumns, AFreeColumnThatItsRowLetsGoForeverStays) {
  for (const double cost : {4.0, -4.0}) {
    const ProblemData d = WithFreeColumn(cost, cost > 0 ? -kInf : 3, cost > 0 ? 8 : kInf);
    EXPECT_EQ(SizesOf(Presolve(d, {}).reduced()), (Sizes{3, 2, 0}));
  }
}

TEST(PresolveColumns, ASmallCoefficientIsNotDividedBy) {
  ProblemData d = WithFreeColumn(0, 3, 3);
  d.A.value.back() = 1e-6;
  EXPECT_EQ(SizesOf(Presolve(d, {}).reduced()), (Sizes{3, 2, 0}));
}

// 2 x_2 = 7 - x_0 + x_1 within [0, 20] by x_0 and x_1 within [-3, 3].
TEST(PresolveColumns, BoundsThatAnEquationImpliesAreNone) {
  for (const double sign : {1.0, -1.0}) {
    ProblemData d = WithFreeColumn(sign, 7, 7);
    d.A.value.back() *= sign;
    d.x_lower = {-3, -3, sign > 0 ? 0.5 : -20};
    d.x_upper = {3, 3, sign > 0 ? 20 : -0.5};
    const Presolve presolve(d, {});
    EXPECT_EQ(SizesOf(presolve.reduced()), (Sizes{2, 1, 0}));
    const double m = 0.5, y = (5 + m) / 5;
    const Vectors at = Recovered(d, presolve, {{y + m, 2 * y - m}, {0, 0}, {y}, {}});
    EXPECT_EQ(at.x_dual[2], 0);
  }
}

TEST(PresolveColumns, BoundsThatNothingImpliesStay) {
  ProblemData d = WithFreeColumn(1, 7, 7);
  d.x_lower = {-3, -3, 0.6};
  d.x_upper = {3, 3, 20};
  EXPECT_EQ(SizesOf(Presolve(d, {}).reduced()), (Sizes{3, 2, 0}));
  d.x_lower = {-3, -kInf, 0.5};
  EXPECT_EQ(SizesOf(Presolve(d, {}).reduced()), (Sizes{3, 2, 0}));
}

// A column that the reductions give a cost and take it again has none, whatever rounding leaves.
TEST(PresolveColumns, CostsThatCancelAreGone) {
  ProblemData d = Costs({0.1 * 3, 1, 0});
  d = WithRows(d, {{0.3, 1, 0}, {1, 0, 1}}, {1, -kInf}, {1, 4});  // x_1 = 1 - 0.3 x_0
  d.q[0] = 0.3;
  d.A.value[0] = 0.1 * 3;
  const Vectors at = RecoveredFromNothing(d);
  EXPECT_EQ(at.row_dual, (Vector{1, 0}));
}

// x_0 - x_1 - x_2 = 1; all meet in x_0 + 2 x_1 + 3 x_2 >= 26.
ProblemData WithEquation() {
  return WithRows(Nearest({0, 0, 0}, {0, 1, 1}), {{1, -1, -1}, {1, 2, 3}}, {1, 26}, {1, kInf});
}
const Vectors kOfEquation = {{3, 4}, {0, 0}, {1}, {}};

TEST(PresolveColumns, AFreeColumnIsReplacedByTheRestOfItsEquation) {
  const ProblemData d = WithEquation();
  const Presolve presolve(d, {});
  EXPECT_EQ(SizesOf(presolve.reduced()), (Sizes{2, 1, 0}));
  EXPECT_EQ(presolve.reduced().row_lower, (Vector{25}));
  const Vectors at = Recovered(d, presolve, kOfEquation);
  EXPECT_EQ(at.x, (Vector{8, 3, 4}));
  EXPECT_EQ(at.row_dual, (Vector{-1, 1}));
}

TEST(PresolveColumns, InTheObjectiveToo) {
  ProblemData d = WithEquation();
  d.q = {2, -2, -2};  // what the reduced objective has not
  const Presolve presolve(d, {});
  EXPECT_EQ(SizesOf(presolve.reduced()), (Sizes{2, 1, 0}));
  EXPECT_EQ(presolve.reduced().q, (Vector{0, 0}));
  EXPECT_EQ(Recovered(d, presolve, kOfEquation).row_dual, (Vector{1, 1}));
}

TEST(PresolveColumns, AndInCones) {
  // |(x_1, x_2)| <= x_0 / 7, 2 x_0 + x_1 + x_2 = 38.5. With (x_1, x_2) = (2, 1.5) x_0 / 7 is 2.5,
  // its length, and z = 2 (1, -0.8, -0.6) is complementary; the center is where this is an optimum.
  const Vector z = {2, -1.6, -1.2};
  const double multiplier = -z[0] / 14;  // of the equation, by stationarity in x_0
  ProblemData d = Nearest({0, 2 - multiplier - z[1], 1.5 - multiplier - z[2]}, {0, 1, 1});
  d = WithRows(d, {{2, 1, 1}, {1, 1, 1}}, {38.5, -100}, {38.5, kInf});  // the second: all meet
  d = WithCones(d, {{1.0 / 7, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0, 0, 0},
                {{SY_CONE_SECOND_ORDER, 3, 0}});
  const Presolve presolve(d, {});
  EXPECT_EQ(SizesOf(presolve.reduced()), (Sizes{2, 1, 1}));
  const Vectors at = Recovered(d, presolve, {{2, 1.5}, {0, 0}, {0}, z});
  EXPECT_NEAR(at.x[0], 17.5, 1e-12);
  EXPECT_NEAR(at.row_dual[0], multiplier, 1e-12);
}

TEST(PresolveColumns, ASmallPivotIsNotTaken) {
  ProblemData d = WithEquation();
  d.A.value[0] = 0.01;
  EXPECT_EQ(SizesOf(Presolve(d, {}).reduced()), (Sizes{3, 2, 0}));
}

TEST(PresolveColumns, ReductionsOpenTheWayToOthers) {
  // x_3 = 2 by a row; then x_4 = 0 = x_5 by force; then x_6 stands in one row, then x_0 in two.
  ProblemData d = WithEquation();
  d.num_vars = 7;
  d.F = Csc(0, 7);
  d.q = {0, 0, 0, 1, -1, -2, 3};
  d.x_lower = {-kInf, -kInf, -kInf, 0, 0, 0, -kInf};
  d.x_upper = {kInf, kInf, kInf, 9, 9, kInf, kInf};
  d.P = Nearest(Vector(7, 0.0), {0, 1, 1, 0, 0, 0, 0}).P;
  d = WithRows(d,
               {{1, -1, -1, 1, 2, 1, 0},
                {1, 2, 3, -1, 0, 1, 0},
                {0, 0, 0, 3, 0, 0, 0},
                {0, 0, 0, 1, 1, 1, 0},
                {0, 0, 0, 0, 1, 1, 2},
                {2, 4, 6, -2, 0, 2, 0}},
               {3, 20, 6, -kInf, 8, 48}, {3, kInf, 6, 2, kInf, kInf});
  const Presolve presolve(d, {});
  EXPECT_EQ(SizesOf(presolve.reduced()), (Sizes{2, 1, 0}));
  const Vectors at = Recovered(d, presolve, kOfEquation);
  EXPECT_EQ(at.x, (Vector{8, 3, 4, 2, 0, 0, 4}));
}

}  // namespace
}  // namespace switchyard::presolve
