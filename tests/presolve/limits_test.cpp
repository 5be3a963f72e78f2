// Numbers that will change are not looked at: whatever they are, the same is left, in the same
// places.
#include "tests/presolve/programs.hpp"
#include "tests/presolve/solved.hpp"

namespace switchyard::presolve {
namespace {

using testing::Random;

/// Something for every reduction.
ProblemData Reducible() {
  ProblemData d = Nearest({0, 0, 0, 0, 0, 0}, {0, 1, 1, 0, 0, 0});
  d.x_lower = {-kInfinity, -20, -20, 2, 0, -kInfinity};
  d.x_upper = {kInfinity, 20, 20, 2, 9, kInfinity};
  d = WithRows(d,
               {{1, -1, -1, 1, 0, 0},  // an equation with a free column
                {1, 2, 3, 0, 0, 0},    // what it is put into
                {2, 4, 6, 0, 0, 0},    // parallel
                {0, 3, 0, 0, 0, 0},    // a bound
                {0, 1, 1, 1, 0, 0},    // implied
                {0, 0, 0, 1, 2, 0},    // forcing
                {0, 1, 0, 0, 0, 2},    // of a free column
                {0, 0, 0, 0, 0, 0},    // empty
                {1, 1, 1, 1, 1, 1}},   // without sides
               {3, 26, 50, -9, -900, -kInfinity, 1, -1, -kInfinity},
               {3, kInfinity, kInfinity, 90, 900, 2, 1, 1, kInfinity});
  return WithCones(
      d,
      {{0, 0, 1, 0, 0, 0},
       {0, 1, 1, 0, 0, 0},
       {0, 1, 1, 0, 0, 0},
       {0, 1, 1, 0, 0, 0},
       {0, 0, 0, 0, 0, 0},
       {0, 1, 0, 0, 0, 0},
       {0, 0, 1, 0, 0, 0}},
      {8, 30, 2, 0, 50, 0, 0},
      {{SY_CONE_NONNEGATIVE, 2, 0}, {SY_CONE_SECOND_ORDER, 2, 0}, {SY_CONE_SECOND_ORDER, 3, 0}});
}

bool SamePlaces(const Csc& a, const Csc& b) {
  return a.rows == b.rows && a.cols == b.cols && a.start == b.start && a.row == b.row;
}

void ExpectSameShape(const Presolve& a, const Presolve& b) {
  EXPECT_EQ(a.variables(), b.variables());
  EXPECT_EQ(a.rows(), b.rows());
  EXPECT_EQ(SizesOf(a.reduced()), SizesOf(b.reduced()));
  EXPECT_TRUE(SamePlaces(a.reduced().P, b.reduced().P));
  EXPECT_TRUE(SamePlaces(a.reduced().A, b.reduced().A));
  EXPECT_TRUE(SamePlaces(a.reduced().F, b.reduced().F));
}

void ChangeBounds(ProblemData& d, Random& random) {
  const auto change = [&](Vector& lower, Vector& upper) {
    for (std::size_t i = 0; i < lower.size(); ++i) {
      const std::int32_t sort = random.Below(5);
      const double middle = random.Normal();
      lower[i] = sort == 0 || sort == 3 ? -kInfinity : middle;
      upper[i] = sort == 1 || sort == 3 ? kInfinity : sort == 4 ? middle : middle + 1;
    }
  };
  change(d.x_lower, d.x_upper);
  change(d.row_lower, d.row_upper);
}

void ChangeVectors(ProblemData& d, Random& random) {
  for (Vector* v : {&d.q, &d.g}) {
    for (double& e : *v) e = random.Chance(0.3) ? 0 : random.Normal();
  }
}

void ChangeValues(ProblemData& d, Random& random) {
  for (Csc* m : {&d.A, &d.F}) {
    for (double& e : m->value)
      e = random.Chance(0.2) ? 0 : random.Chance(0.3) ? 1 : random.Normal();
  }
}

TEST(PresolveLimits, WithoutAnyEverythingIsReduced) {
  const ProblemData d = Reducible();
  const Presolve presolve(d, {});
  EXPECT_EQ(SizesOf(presolve.reduced()), (Sizes{2, 2, 1}));
}

class Changing : public ::testing::TestWithParam<int> {
 protected:
  [[nodiscard]] Limits limits() const {
    return {(GetParam() & 1) != 0, (GetParam() & 2) != 0, (GetParam() & 4) != 0};
  }
};

TEST_P(Changing, NumbersChangeNothingOfTheShape) {
  Random random(5);
  const ProblemData first = Reducible();
  const Presolve of_first(first, limits());
  for (int trial = 0; trial < 50; ++trial) {
    ProblemData d = first;
    if (!limits().bounds_stay) ChangeBounds(d, random);
    if (!limits().vectors_stay) ChangeVectors(d, random);
    if (!limits().values_stay) ChangeValues(d, random);
    ExpectSameShape(of_first, Presolve(d, limits()));
  }
}

TEST_P(Changing, WhatIsReducedComesBack) {
  const ProblemData d = Reducible();
  const Presolve presolve(d, limits());
  const Solved solved = Solve(presolve.reduced());
  ASSERT_EQ(solved.ending, conic::Ending::kOptimal);
  Recovered(d, presolve, VectorsOf(solved.answer), 1e-6);
}

INSTANTIATE_TEST_SUITE_P(PresolveLimits, Changing, ::testing::Range(0, 8), [](const auto& of) {
  return std::string(of.param & 1 ? "bounds" : "no_bounds") +
         (of.param & 2 ? "_vectors" : "_no_vectors") + (of.param & 4 ? "_values" : "_no_values");
});

TEST(PresolveLimits, WhereCostsChangeBoundsAreReducedStill) {
  const ProblemData d = Reducible();
  const Presolve presolve(d, {true, false, true});
  EXPECT_EQ(SizesOf(presolve.reduced()).vars, 4);  // the fixed and the forced one are gone
  EXPECT_LT(SizesOf(presolve.reduced()).rows, 9);
}

TEST(PresolveLimits, WhereNothingStaysConesAloneAreTakenApart) {
  const ProblemData d = Reducible();
  const Presolve presolve(d, {false, false, false});
  EXPECT_EQ(SizesOf(presolve.reduced()), (Sizes{6, 9 + 4, 1}));
  EXPECT_EQ(presolve.reduced().A.nonzeros(), d.A.nonzeros() + 3 + 4);
}

}  // namespace
}  // namespace switchyard::presolve
