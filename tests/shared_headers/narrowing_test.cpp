// What the table of cones says about ranges: the column `narrow`.
#include <gtest/gtest.h>

#include "switchyard/cones.hpp"
#include "tests/shared_headers/random_problem.hpp"

namespace switchyard::testing {
namespace {

void Narrow(const sy_cone& cone, std::vector<Interval>& ranges) {
  FactsOf(cone.kind).narrow(ranges.data(), cone.dim, cone.parameter);
}

TEST(Narrowing, KeepsEveryPointOfTheConeInTheRanges) {
  Random random(1);
  for (const sy_cone& cone : AllCones()) {
    for (int trial = 0; trial < 2000; ++trial) {
      const Vector s = PointOf(cone, random, random.Chance(0.5) ? 0 : random.Uniform(0, 1));
      std::vector<Interval> ranges;
      for (const double v : s) {
        const double room = random.Chance(0.3) ? 0 : random.Uniform(0, 2);
        ranges.push_back({random.Chance(0.3) ? -kInfinity : v - room,
                          random.Chance(0.3) ? kInfinity : v + room});
      }
      Narrow(cone, ranges);
      for (std::size_t i = 0; i < s.size(); ++i) {
        // A point on the boundary is off it by its own rounding.
        EXPECT_LE(ranges[i].lower, s[i] + 1e-14 * (1 + std::abs(s[i]))) << FactsOf(cone.kind).name;
        EXPECT_GE(ranges[i].upper, s[i] - 1e-14 * (1 + std::abs(s[i]))) << FactsOf(cone.kind).name;
      }
    }
  }
}

TEST(Narrowing, NeverWidens) {
  Random random(2);
  for (const sy_cone& cone : AllCones()) {
    for (int trial = 0; trial < 500; ++trial) {
      std::vector<Interval> ranges;
      for (int i = 0; i < cone.dim; ++i) {
        const double v = random.Normal();
        ranges.push_back({v, random.Chance(0.3) ? kInfinity : v + random.Uniform(0, 2)});
      }
      std::vector<Interval> narrowed = ranges;
      Narrow(cone, narrowed);
      for (std::size_t i = 0; i < ranges.size(); ++i) {
        EXPECT_GE(narrowed[i].lower, ranges[i].lower);
        EXPECT_LE(narrowed[i].upper, ranges[i].upper);
      }
    }
  }
}

constexpr Interval kAll = {-kInfinity, kInfinity};

TEST(Narrowing, BoundsTheNormedPartOfASecondOrderCone) {
  std::vector<Interval> s = {{-kInfinity, 2}, kAll, {1, kInfinity}};
  Narrow({SY_CONE_SECOND_ORDER, 3, 0}, s);
  EXPECT_NEAR(s[0].lower, 1, 1e-12);
  EXPECT_NEAR(s[1].lower, -2, 1e-12);
  EXPECT_NEAR(s[2].upper, 2, 1e-12);
}

TEST(Narrowing, BoundsTheRotatedPart) {
  std::vector<Interval> s = {{-kInfinity, 2}, {-kInfinity, 1}, {1, kInfinity}};
  Narrow({SY_CONE_ROTATED, 3, 0}, s);
  EXPECT_NEAR(s[2].upper, 2, 1e-12);
  EXPECT_NEAR(s[0].lower, 0.5, 1e-12);
  EXPECT_NEAR(s[1].lower, 0.25, 1e-12);
}

TEST(Narrowing, BoundsOffDiagonalsByTheDiagonal) {
  std::vector<Interval> s = {{-1, 4}, kAll, {-1, 9}};
  Narrow({SY_CONE_PSD, 3, 0}, s);
  EXPECT_EQ(s[0].lower, 0);
  EXPECT_NEAR(s[1].upper, 6 * std::sqrt(2.0), 1e-12);
}

TEST(Narrowing, InvertsTheExponential) {
  std::vector<Interval> s = {kAll, {1, 1}, {-kInfinity, std::exp(2.0)}};
  Narrow({SY_CONE_EXPONENTIAL, 3, 0}, s);
  EXPECT_NEAR(s[0].upper, 2, 1e-12);
  s = {{3, kInfinity}, {1, 1}, kAll};
  Narrow({SY_CONE_EXPONENTIAL, 3, 0}, s);
  EXPECT_NEAR(s[2].lower, std::exp(3.0), 1e-10);
}

TEST(Narrowing, BoundsThePowerByTheMean) {
  std::vector<Interval> s = {{-kInfinity, 16}, {-kInfinity, 1}, kAll};
  Narrow({SY_CONE_POWER, 3, 0.25}, s);
  EXPECT_NEAR(s[2].upper, 2, 1e-12);
  EXPECT_NEAR(s[2].lower, -2, 1e-12);
}

// Exactly, and whatever the other head may be.
TEST(Narrowing, LeavesOfAConeWhoseHeadIsZeroItsFace) {
  std::vector<Interval> s = {kAll, {-1, 0}, kAll};
  Narrow({SY_CONE_EXPONENTIAL, 3, 0}, s);
  EXPECT_EQ(s[0].upper, 0);
  EXPECT_EQ(s[0].lower, -kInfinity);
  EXPECT_EQ(s[2].upper, kInfinity);
  s = {{-4, 4}, kAll, {0, 0}};
  Narrow({SY_CONE_EXPONENTIAL, 3, 0}, s);
  EXPECT_EQ(s[1].upper, 0);
  EXPECT_EQ(s[0].upper, 0);
  EXPECT_EQ(s[0].lower, -4);
  for (const sy_cone& cone : {sy_cone{SY_CONE_ROTATED, 3, 0}, sy_cone{SY_CONE_POWER, 3, 0.3}}) {
    s = {kAll, {0, 0}, kAll};
    Narrow(cone, s);
    EXPECT_EQ(s[2].lower, 0);
    EXPECT_EQ(s[2].upper, 0);
    EXPECT_EQ(s[0].upper, kInfinity);
  }
  s = {{0, 0}, kAll, kAll};
  Narrow({SY_CONE_PSD, 3, 0}, s);
  EXPECT_EQ(s[1].lower, 0);
  EXPECT_EQ(s[1].upper, 0);
}

}  // namespace
}  // namespace switchyard::testing
