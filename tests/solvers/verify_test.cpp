// What a point violates: beside the terms that meet there, and named.
#include "solvers/rounding/verify.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "switchyard/problem.hpp"

namespace switchyard::test {
namespace {

using rounding::WhatIsViolated;
using testing::HasSubstr;

/// x_0 - x_1 in [-1, 1] times `unit`, (x_0, x_1) in the second-order cone, x_0 an integer <= 5
/// unit.
Problem InUnits(double unit) {
  ProblemData d;
  d.num_vars = 2;
  d.P = Csc(2, 2);
  d.q = {0, 0};
  d.x_lower = {-kInfinity, -kInfinity};
  d.x_upper = {5 * unit, kInfinity};
  d.integer = {1, 0};
  d.A = Csc(1, 2);
  d.A.start = {0, 1, 2};
  d.A.row = {0, 0};
  d.A.value = {1, -1};
  d.row_lower = {-unit};
  d.row_upper = {unit};
  d.F = Csc(2, 2);
  d.F.start = {0, 1, 2};
  d.F.row = {0, 1};
  d.F.value = {1, 1};
  d.g = {0, 0};
  d.cones = {{SY_CONE_SECOND_ORDER, 2, 0}};
  return Problem(d);
}

std::string At(const Problem& problem, double x0, double x1, double tolerance = 1e-6) {
  const double x[] = {x0, x1};
  return WhatIsViolated(problem.view(), x, tolerance);
}

TEST(Verify, NamesTheRowConeOrVariableThatIsViolatedMost) {
  const Problem one = InUnits(1);
  EXPECT_EQ(At(one, 3, 2.5), "");
  EXPECT_THAT(At(one, 3, 1), HasSubstr("row[0] is violated by"));
  EXPECT_THAT(At(one, 2, 2.5), HasSubstr("cone[0] is violated by"));
  EXPECT_THAT(At(one, 6, 5.5), HasSubstr("x[0] is violated by"));
  EXPECT_THAT(At(one, 2.5, 2.5), HasSubstr("x[0] is violated by 0.5"));
}

TEST(Verify, MeasuresBesideTheTermsOfARow) {
  // The row is off by 1e-3 of its unit; its terms are 1e6 units, so it holds to 1e-8.
  ProblemData d = InUnits(1).data();
  d.x_upper[0] = kInfinity;
  const Problem wide(d);
  EXPECT_EQ(At(wide, 1e6, 1e6 - 1.001, 1e-8), "");
  EXPECT_THAT(At(wide, 1e6, 1e6 - 1.001, 1e-10), HasSubstr("row[0]"));
  EXPECT_THAT(At(wide, 2, 2 - 1.001, 1e-8), HasSubstr("row[0]"));
}

TEST(Verify, LargeUnitsChangeNothing) {
  for (const double off : {1e-9, 1e-7, 1e-5, 1e-3}) {
    const bool holds = At(InUnits(1e6), 3e6, 2e6 - off * 1e6, 1e-6).empty();
    EXPECT_EQ(holds, At(InUnits(1e9), 3e9, 2e9 - off * 1e9, 1e-6).empty()) << off;
  }
}

TEST(Verify, WhatIsNotANumberIsViolatedAndNothingHidesIt) {
  const Problem one = InUnits(1);
  EXPECT_NE(At(one, std::nan(""), 2), "");
  EXPECT_NE(At(one, 3, std::nan("")), "");
  EXPECT_NE(At(one, 1e30, std::nan("")), "");
}

TEST(Verify, AProblemWithoutSectionsHoldsEverywhere) {
  ProblemData d;
  d.num_vars = 2;
  d.P = Csc(2, 2);
  EXPECT_EQ(At(Problem(d), -7, 1e9), "");
}

}  // namespace
}  // namespace switchyard::test
