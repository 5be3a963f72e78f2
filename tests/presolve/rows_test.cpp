// What presolve does with rows, and that points and duals come back whole.
#include "tests/presolve/programs.hpp"

namespace switchyard::presolve {
namespace {

using ::testing::Test;

void ExpectSizes(const Presolve& presolve, Sizes sizes) {
  EXPECT_EQ(SizesOf(presolve.reduced()), sizes);
}

// The nearest point to 0 of x_0 + 2 x_1 >= 5 is (1, 2), with the multiplier 1.
ProblemData Core(Rows rows, Vector lower, Vector upper) {
  rows.insert(rows.begin(), {1, 2});
  lower.insert(lower.begin(), 5);
  upper.insert(upper.begin(), kInfinity);
  return WithRows(Nearest({0, 0}), rows, lower, upper);
}
const Vectors kCoreAnswer = {{1, 2}, {0, 0}, {1}, {}};

TEST(PresolveRows, WhatCannotBeReducedStays) {
  const ProblemData d = Core({}, {}, {});
  const Presolve presolve(d, {});
  ExpectSizes(presolve, {2, 1, 0});
  EXPECT_EQ(presolve.variables(), (std::vector<Index>{0, 1}));
  EXPECT_EQ(presolve.rows(), (std::vector<Index>{0}));
  const Vectors at = Recovered(d, presolve, kCoreAnswer);
  EXPECT_EQ(at.x, kCoreAnswer.x);
  EXPECT_EQ(at.row_dual, kCoreAnswer.row_dual);
}

TEST(PresolveRows, EmptyRowsAndRowsWithoutSidesGo) {
  const ProblemData d = Core({{0, 0}, {3, 1}}, {-1, -kInfinity}, {1, kInfinity});
  const Presolve presolve(d, {});
  ExpectSizes(presolve, {2, 1, 0});
  EXPECT_EQ(Recovered(d, presolve, kCoreAnswer).row_dual, (Vector{1, 0, 0}));
}

TEST(PresolveRows, AnEntryOfZeroIsNone) {
  ProblemData d = Core({{1, 0}, {0, 1}}, {-7, 0}, {7, 0});
  d.A.value.back() = 0;  // 0 x_1 = 0
  d.A.value[1] = 0;      // -7 <= 0 x_0 <= 7
  const Presolve presolve(d, {});
  ExpectSizes(presolve, {2, 1, 0});
  Recovered(d, presolve, kCoreAnswer);
}

TEST(PresolveRows, ARowOfOneVariableIsABoundAndItsDualTheRows) {
  for (const double a : {2.0, -2.0}) {
    const double side = 3 * a;  // x_0 >= 3
    const ProblemData d = Bounded(
        WithRows(Nearest({0}), {{a}}, {a > 0 ? side : -kInfinity}, {a > 0 ? kInfinity : side}), {0},
        {10});
    const Presolve presolve(d, {});
    ExpectSizes(presolve, {1, 0, 0});
    EXPECT_EQ(presolve.reduced().x_lower, (Vector{3}));
    EXPECT_EQ(presolve.reduced().x_upper, (Vector{10}));
    const Vectors at = Recovered(d, presolve, {{3}, {3}, {}, {}});
    EXPECT_EQ(at.row_dual, (Vector{3 / a}));
    EXPECT_EQ(at.x_dual, (Vector{0}));
  }
}

TEST(PresolveRows, OfSeveralRowsOfOneVariableTheTightestHasTheDual) {
  const ProblemData d = WithRows(Nearest({0}), {{1}, {2}, {-1}, {4}}, {1, 6, -kInfinity, 4},
                                 {kInfinity, kInfinity, -2, kInfinity});
  const Presolve presolve(d, {});
  ExpectSizes(presolve, {1, 0, 0});
  EXPECT_EQ(Recovered(d, presolve, {{3}, {3}, {}, {}}).row_dual, (Vector{0, 1.5, 0, 0}));
}

TEST(PresolveRows, ABoundThatIsNotTheRowsKeepsItsDual) {
  const ProblemData d =
      Bounded(WithRows(Nearest({0}), {{1}}, {1}, {5}), {2}, {10});  // the row gives 5 alone
  const Presolve presolve(d, {});
  ExpectSizes(presolve, {1, 0, 0});
  const Vectors at = Recovered(d, presolve, {{2}, {2}, {}, {}});
  EXPECT_EQ(at.x_dual, (Vector{2}));
  EXPECT_EQ(at.row_dual, (Vector{0}));
}

TEST(PresolveRows, AnEquationOfOneVariableFixesIt) {
  const ProblemData d = WithRows(Nearest({0, 0}), {{2, 0}, {1, 2}}, {2, 5}, {2, kInfinity});
  const Presolve presolve(d, {});  // then x_1 >= 2
  ExpectSizes(presolve, {1, 0, 0});
  const Vectors at = Recovered(d, presolve, {{2}, {2}, {}, {}});
  EXPECT_EQ(at.x, (Vector{1, 2}));
  EXPECT_EQ(at.row_dual, (Vector{0, 1}));
}

// 0.1 x = 0.3 beside x <= 3: equal but for rounding.
TEST(PresolveRows, BoundsThatRoundingAloneTellsApartAreOne) {
  const ProblemData d = Bounded(WithRows(Costs({1}), {{0.1}}, {0.1 * 3}, {kInfinity}), {-kInfinity},
                                {3 * (1 + 1e-15)});
  const Vectors at = RecoveredFromNothing(d);
  EXPECT_EQ(at.row_dual, (Vector{10}));
}

TEST(PresolveRows, TheLooserOfParallelRowsGoes) {
  const ProblemData d = Core({{-2, -4}, {3, 6}, {1, 2}}, {-kInfinity, -3, 5}, {-8, 90, kInfinity});
  const Presolve presolve(d, {});
  ExpectSizes(presolve, {2, 1, 0});
  EXPECT_EQ(presolve.reduced().row_upper, (Vector{30}));
  EXPECT_EQ(Recovered(d, presolve, kCoreAnswer).row_dual, (Vector{1, 0, 0, 0}));
}

TEST(PresolveRows, TheTighterOfParallelRowsHasTheDual) {
  const ProblemData d = WithRows(Nearest({0, 0}), {{1, 2}, {-2, -4}, {3, 6}},
                                 {4, -kInfinity, -kInfinity}, {kInfinity, -10, 60});
  const Presolve presolve(d, {});
  ExpectSizes(presolve, {2, 1, 0});
  EXPECT_EQ(Recovered(d, presolve, kCoreAnswer).row_dual, (Vector{0, -0.5, 0}));
}

TEST(PresolveRows, ParallelRowsMayMeetInAnEquation) {
  const ProblemData d = WithRows(Nearest({0, 0}), {{1, 2}, {2, 4}}, {5, -kInfinity}, {7, 10});
  const Presolve presolve(d, {});
  ExpectSizes(presolve, {2, 1, 0});
  EXPECT_EQ(presolve.reduced().row_lower, presolve.reduced().row_upper);
  EXPECT_EQ(Recovered(d, presolve, kCoreAnswer).row_dual, (Vector{1, 0}));
  // From the other side the multiplier is the second row's.
  const ProblemData far = WithRows(Nearest({2, 4}), {{1, 2}, {2, 4}}, {5, -kInfinity}, {7, 10});
  EXPECT_EQ(Recovered(far, Presolve(far, {}), {{1, 2}, {0, 0}, {-1}, {}}).row_dual,
            (Vector{0, -0.5}));
}

TEST(PresolveRows, WhatBoundsImplyGoes) {
  ProblemData d = Core({{1, 1}, {1, -1}}, {-kInfinity, -100}, {30, 50});
  d = Bounded(d, {-10, -10}, {20, 10});
  const Presolve presolve(d, {});
  ExpectSizes(presolve, {2, 1, 0});
  EXPECT_EQ(Recovered(d, presolve, kCoreAnswer).row_dual, (Vector{1, 0, 0}));
}

TEST(PresolveRows, ASideThatBoundsImplyGoes) {
  const ProblemData d =
      Bounded(WithRows(Nearest({0, 0}), {{1, 2}}, {5}, {70}), {-10, -10}, {20, 10});
  const Presolve presolve(d, {});
  ExpectSizes(presolve, {2, 1, 0});
  EXPECT_EQ(presolve.reduced().row_upper, (Vector{kInfinity}));
  Recovered(d, presolve, kCoreAnswer);
}

TEST(PresolveRows, AForcingRowTakesTheLeastMultiplier) {
  // x_0 - x_1 <= -1 over x_0 >= 0, x_1 <= 1.
  const ProblemData d =
      Bounded(WithRows(Costs({-3, 1}), {{1, -1}}, {-kInfinity}, {-1}), {0, -kInfinity}, {9, 1});
  const Vectors at = RecoveredFromNothing(d);
  EXPECT_EQ(at.x, (Vector{0, 1}));
  EXPECT_EQ(at.row_dual, (Vector{-3}));
  EXPECT_EQ(at.x_dual, (Vector{0, -2}));
}

TEST(PresolveRows, AForcingRowForcesFromBelowToo) {
  for (const double cost : {5.0, -5.0}) {
    const ProblemData d =
        Bounded(WithRows(Costs({cost, -1}), {{2, -1}}, {2}, {2}), {-1, 0}, {1, kInfinity});
    const Vectors at = RecoveredFromNothing(d);
    EXPECT_EQ(at.x, (Vector{1, 0}));
  }
}

TEST(PresolveRows, AForcingRowInACurvedProblem) {
  ProblemData d = Nearest({9, 5, 6});
  d.P = Dense({{3, 1, 1}, {0, 3, 1}, {0, 0, 2}}, 3);
  d = Bounded(WithRows(d, {{1, 1, 0}, {1, 2, 1}}, {-kInfinity, -kInfinity}, {0, 1}), {0, 0, -5},
              {9, 9, 9});
  const Presolve presolve(d, {});
  ExpectSizes(presolve, {1, 0, 0});  // min x_2^2 - 6 x_2, x_2 <= 1
  const Vectors at = Recovered(d, presolve, {{1}, {-4}, {}, {}});
  EXPECT_EQ(at.x, (Vector{0, 0, 1}));
  EXPECT_EQ(at.row_dual, (Vector{-4, -4}));
  EXPECT_EQ(at.x_dual, (Vector{0, 8, 0}));
}

// The bounds that the forcing row needs are those of other rows: their duals follow.
TEST(PresolveRows, AForcingRowOverBoundsThatWereRows) {
  const ProblemData d = WithRows(Costs({-1, -2}), {{1, 0}, {0, -3}, {1, 1}},
                                 {0, -kInfinity, -kInfinity}, {kInfinity, 0, 0});
  const Vectors at = RecoveredFromNothing(d);
  EXPECT_EQ(at.x, (Vector{0, 0}));
  EXPECT_EQ(at.x_dual, (Vector{0, 0}));
  EXPECT_EQ(at.row_dual, (Vector{1, 0, -2}));
}

TEST(PresolveRows, RowsThatWereMergedChangeTogether) {
  // x_2 goes into both rows, which were one before.
  const ProblemData d = WithRows(Nearest({0, 0, 0}, {1, 1, 0}), {{1, 1, -1}, {2, 3, 1}, {4, 6, 2}},
                                 {-1, 0, 52}, {-1, kInfinity, kInfinity});
  const Presolve presolve(d, {});
  ExpectSizes(presolve, {2, 1, 0});
  const Vectors at = Recovered(d, presolve, {{3, 4}, {0, 0}, {1}, {}});
  EXPECT_EQ(at.x, (Vector{3, 4, 8}));
  EXPECT_EQ(at.row_dual[1], 0);
  EXPECT_EQ(at.row_dual[2], 0.5);
}

class Contradictions : public ::testing::TestWithParam<std::pair<const char*, ProblemData>> {};

TEST_P(Contradictions, LeaveTheWholeProblem) {
  const ProblemData& d = GetParam().second;
  const Presolve presolve(d, {});
  EXPECT_EQ(SizesOf(presolve.reduced()), SizesOf(d));
  EXPECT_EQ(presolve.reduced().row_lower, d.row_lower);
  EXPECT_EQ(presolve.reduced().row_upper, d.row_upper);
  EXPECT_EQ(presolve.reduced().x_lower, d.x_lower);
  EXPECT_EQ(presolve.reduced().x_upper, d.x_upper);
}

std::vector<std::pair<const char*, ProblemData>> AllContradictions() {
  const double inf = kInfinity;
  const ProblemData two = Nearest({0, 0});
  return {
      {"empty_row", WithRows(two, {{0, 0}}, {1}, {2})},
      {"row_beside_bound", Bounded(WithRows(two, {{2, 0}}, {5}, {inf}), {0, 0}, {2, 2})},
      {"rows_of_one_variable", WithRows(two, {{2, 0}, {-1, 0}}, {5, -2}, {inf, inf})},
      {"bounds_of_a_row", Bounded(WithRows(two, {{1, 1}}, {5}, {inf}), {0, 0}, {2, 2})},
      {"parallel_rows_above", WithRows(two, {{1, 1}, {1, 1}}, {5, -inf}, {inf, 3})},
      {"parallel_rows_below", WithRows(two, {{1, 1}, {1, 1}}, {-inf, 5}, {3, inf})},
      {"parallel_rows_turned", WithRows(two, {{1, 1}, {-2, -2}}, {-inf, -inf}, {3, -8})},
      {"beside_large_bounds",
       Bounded(WithRows(two, {{1, 1}}, {-inf}, {-500}), {0, 0}, {1e12, 1e12})},
      {"after_a_fixed_variable",
       Bounded(WithRows(two, {{1, 1}, {1, -1}}, {3, 1}, {inf, inf}), {1, -inf}, {1, inf})},
  };
}

INSTANTIATE_TEST_SUITE_P(PresolveRows, Contradictions, ::testing::ValuesIn(AllContradictions()),
                         [](const auto& of) { return std::string(of.param.first); });

// 1e7 - 0.3e7 - 0.7e7 is no contradiction, whatever rounding makes of it.
TEST(PresolveRows, RoundingOfLargeTermsIsNoContradiction) {
  const ProblemData d =
      Bounded(WithRows(Costs({1, 1, 1}), {{0.1e9, 0.3e9, 0.7e9}}, {1.1e9 / 3}, {1.1e9 / 3}),
              {1.0 / 3, 1.0 / 3, 1.0 / 3}, {1.0 / 3, 1.0 / 3, 1.0 / 3});
  const Presolve presolve(d, {});
  ExpectSizes(presolve, {0, 0, 0});
}

}  // namespace
}  // namespace switchyard::presolve
