#include "switchyard/cones.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numeric>

#include "tests/shared_headers/random_problem.hpp"

namespace switchyard::testing {
namespace {

constexpr int kTrials = 500;

double Violation(const sy_cone& cone, const Vector& s) {
  return FactsOf(cone.kind).violation(s.data(), cone.dim, cone.parameter);
}

Vector IntoDual(const sy_cone& cone, Vector y) {
  FactsOf(cone.kind).into_dual(y.data(), cone.dim, cone.parameter);
  return y;
}

double Dot(const Vector& a, const Vector& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

/// A point of the dual cone: the cone itself where it is self-dual, else its dual's description.
Vector DualPointOf(const sy_cone& cone, Random& random, double slack) {
  if (cone.kind == SY_CONE_ZERO) return random.Normals(cone.dim);
  if (cone.kind == SY_CONE_EXPONENTIAL) {
    const double y0 = -std::abs(random.Normal()) - 0.05, y1 = y0 * random.Uniform(-4, 5);
    return {y0, y1, -y0 * std::exp(y1 / y0 - 1) + slack};
  }
  Vector y = PointOf(cone, random, slack);
  if (cone.kind == SY_CONE_POWER) {
    y[0] *= cone.parameter;
    y[1] *= 1 - cone.parameter;
  }
  return y;
}

TEST(Cones, NameTheirNeeds) {
  EXPECT_EQ(FactsOf(SY_CONE_ZERO).need(0, 0), nullptr);
  EXPECT_STREQ(FactsOf(SY_CONE_NONNEGATIVE).need(-1, 0), "a dimension of 0 or more");
  EXPECT_STREQ(FactsOf(SY_CONE_SECOND_ORDER).need(0, 0), "a dimension of 1 or more");
  EXPECT_STREQ(FactsOf(SY_CONE_ROTATED).need(1, 0), "a dimension of 2 or more");
  EXPECT_STREQ(FactsOf(SY_CONE_EXPONENTIAL).need(4, 0), "a dimension of 3");
  EXPECT_STREQ(FactsOf(SY_CONE_POWER).need(3, 1), "a parameter between 0 and 1");
  EXPECT_EQ(FactsOf(SY_CONE_POWER).need(3, 0.5), nullptr);
  for (int order = 0, dim = 0; order < 300; ++order, dim += order) {
    EXPECT_EQ(FactsOf(SY_CONE_PSD).need(dim, 0), nullptr) << dim;
    if (order > 1) {
      EXPECT_STREQ(FactsOf(SY_CONE_PSD).need(dim - 1, 0), "a dimension of k(k+1)/2");
    }
  }
}

TEST(Cones, SayWhichKindsThereAre) {
  try {
    FactsOf(7);
    FAIL() << "kind 7 was accepted";
  } catch (const std::invalid_argument& e) {
    EXPECT_STREQ(e.what(), "cone: the kind must be 0 to 6, and is 7");
  }
  EXPECT_THROW(FactsOf(-1), std::invalid_argument);
}

TEST(Cones, HoldThePointsInsideThem) {
  Random random(1);
  for (const sy_cone& cone : AllCones()) {
    for (int trial = 0; trial < kTrials; ++trial) {
      EXPECT_EQ(Violation(cone, PointOf(cone, random, 1e-9)), 0) << FactsOf(cone.kind).name;
      EXPECT_LT(Violation(cone, PointOf(cone, random, 0)), 1e-13) << FactsOf(cone.kind).name;
    }
  }
}

TEST(Cones, AreLeftOnTheOtherSideOfTheBoundary) {
  Random random(2);
  for (const sy_cone& cone : AllCones()) {
    if (cone.kind == SY_CONE_ZERO) continue;
    for (int trial = 0; trial < kTrials; ++trial) {
      Vector s = PointOf(cone, random, 0);
      const double step = random.Uniform(1e-6, 1e-2);
      if (cone.kind == SY_CONE_PSD) {
        for (const std::size_t diagonal : {0u, 2u, 5u}) s[diagonal] -= step;
      } else if (cone.kind == SY_CONE_EXPONENTIAL) {
        s[2] -= step;
      } else if (cone.kind == SY_CONE_POWER) {
        s[2] *= 1 + step;
      } else {
        s[0] -= step;
      }
      EXPECT_GT(Violation(cone, s), 0) << FactsOf(cone.kind).name;
      EXPECT_LE(Violation(cone, s), 10 * step) << FactsOf(cone.kind).name;
    }
  }
}

TEST(Cones, MeasureAViolationOfTheDegreeOfAPoint) {
  Random random(3);
  for (const sy_cone& cone : AllCones()) {
    for (int trial = 0; trial < kTrials; ++trial) {
      const Vector s = random.Normals(cone.dim);
      const double violation = Violation(cone, s);
      for (const double unit : {1e-8, 0.5, 3.0, 1e12}) {
        Vector scaled = s;
        for (double& e : scaled) e *= unit;
        EXPECT_NEAR(Violation(cone, scaled), unit * violation, 1e-13 * unit * (1 + violation))
            << FactsOf(cone.kind).name;
      }
    }
  }
}

// A move of every coordinate by no more than the violation (and its rounding) leads inside.
TEST(Cones, AreAsNearAsTheViolationSays) {
  Random random(4);
  const auto moved = [](Vector s, const std::vector<std::size_t>& up, double by) {
    for (const std::size_t i : up) s[i] += by;
    return s;
  };
  for (int trial = 0; trial < kTrials; ++trial) {
    const sy_cone second_order{SY_CONE_SECOND_ORDER, 4, 0}, rotated{SY_CONE_ROTATED, 4, 0};
    const sy_cone semidefinite{SY_CONE_PSD, 6, 0};
    Vector s = random.Normals(4);
    EXPECT_LT(Violation(second_order, moved(s, {0}, Violation(second_order, s))), 1e-14);
    EXPECT_LT(Violation(rotated, moved(s, {0, 1}, Violation(rotated, s) / std::sqrt(2.0))), 1e-14);
    s = random.Normals(6);
    EXPECT_LT(Violation(semidefinite, moved(s, {0, 2, 5}, Violation(semidefinite, s))), 1e-14);
  }
}

TEST(Cones, AreFarWhereEveryPointOfThemIsFar) {
  Random random(14);
  for (const sy_cone& cone : AllCones()) {
    for (int trial = 0; trial < kTrials; ++trial) {
      const Vector outside = random.Normals(cone.dim), inside = PointOf(cone, random, 0);
      double distance = 0;
      for (std::size_t i = 0; i < outside.size(); ++i) {
        distance = std::max(distance, std::abs(outside[i] - inside[i]));
      }
      const double violation = Violation(cone, outside);
      // Each measure is within sqrt(dim) + 1 of the least move in the largest-entry norm, but that
      // of the exponential and the power cone, whose moves are along the axes.
      if (cone.kind == SY_CONE_EXPONENTIAL || cone.kind == SY_CONE_POWER) continue;
      EXPECT_LE(violation, (std::sqrt(cone.dim) + 1) * distance + 1e-14) << FactsOf(cone.kind).name;
    }
  }
}

TEST(Cones, DoNotOverflowOrCancel) {
  EXPECT_EQ(Violation({SY_CONE_SECOND_ORDER, 3, 0}, {5e200, 3e200, 4e200}), 0);
  EXPECT_EQ(Violation({SY_CONE_SECOND_ORDER, 3, 0}, {5e-200, 3e-200, 4e-200}), 0);
  EXPECT_NEAR(Violation({SY_CONE_SECOND_ORDER, 3, 0}, {0, 3e200, 4e200}), 5e200, 1e187);
  EXPECT_EQ(Violation({SY_CONE_EXPONENTIAL, 3, 0}, {1000, 1e-3, 1}),
            1000 - 1e-3 * (std::log(1.0) - std::log(1e-3)));
  EXPECT_EQ(Violation({SY_CONE_EXPONENTIAL, 3, 0}, {-1, 0, 2}), 0);
  EXPECT_EQ(Violation({SY_CONE_EXPONENTIAL, 3, 0}, {-1, -1e-9, 2}), 1e-9);
  EXPECT_LT(Violation({SY_CONE_ROTATED, 3, 0}, {1e8, 1e-8, std::sqrt(2.0)}), 1e-22);
  EXPECT_EQ(Violation({SY_CONE_POWER, 3, 0.5}, {0, 0, 0}), 0);
  EXPECT_EQ(Violation({SY_CONE_POWER, 3, 0.5}, {-2, 1, 0}), 2);
}

TEST(Cones, HoldNoPointThatIsNotANumber) {
  Random random(5);
  for (const sy_cone& cone : AllCones()) {
    for (int i = 0; i < cone.dim; ++i) {
      Vector s = PointOf(cone, random, 1);
      s[static_cast<std::size_t>(i)] = std::numeric_limits<double>::quiet_NaN();
      EXPECT_TRUE(std::isnan(Violation(cone, s))) << FactsOf(cone.kind).name;
    }
  }
}

TEST(IntoDual, LandsInTheDualCone) {
  Random random(6);
  for (const sy_cone& cone : AllCones()) {
    for (int trial = 0; trial < kTrials; ++trial) {
      const Vector y = IntoDual(cone, random.Normals(cone.dim));
      const Vector s = PointOf(cone, random, random.Chance(0.5) ? 0 : random.Uniform(0, 1));
      const double size = std::sqrt(Dot(y, y) * Dot(s, s));
      EXPECT_GE(Dot(y, s), -1e-12 * (1 + size)) << FactsOf(cone.kind).name;
    }
  }
}

TEST(IntoDual, KeepsWhatIsInTheDualCone) {
  Random random(7);
  for (const sy_cone& cone : AllCones()) {
    for (int trial = 0; trial < kTrials; ++trial) {
      const Vector y = DualPointOf(cone, random, 1e-9);
      EXPECT_EQ(IntoDual(cone, y), y) << FactsOf(cone.kind).name;
      EXPECT_EQ(DualViolation(cone, y.data()), 0);
      EXPECT_LT(DualViolation(cone, DualPointOf(cone, random, 0).data()), 1e-13)
          << FactsOf(cone.kind).name;
    }
  }
  EXPECT_EQ(IntoDual({SY_CONE_SECOND_ORDER, 3, 0}, {5, 3, 4}), Vector({5, 3, 4}));
  EXPECT_EQ(IntoDual({SY_CONE_ROTATED, 3, 0}, {1, 2, 2}), Vector({1, 2, 2}));
}

TEST(IntoDual, IsDoneOnce) {
  Random random(8);
  for (const sy_cone& cone : AllCones()) {
    for (int trial = 0; trial < kTrials; ++trial) {
      const Vector once = IntoDual(cone, random.Normals(cone.dim));
      const Vector twice = IntoDual(cone, once);
      for (std::size_t i = 0; i < once.size(); ++i) EXPECT_NEAR(twice[i], once[i], 1e-13);
    }
  }
}

// So that a dual that a free variable of the diagonal makes 0 stays 0.
TEST(IntoDual, RaisesOfAMatrixOnlyTheBlockThatIsWrong) {
  const Vector y = IntoDual({SY_CONE_PSD, 6, 0}, {3, 0, 0, 4, 0, 1});  // entries 0 and 2 connected
  EXPECT_EQ(y[2], 0);
  EXPECT_GT(y[0] * y[5], 8);
  EXPECT_EQ(IntoDual({SY_CONE_PSD, 3, 0}, {0, 0, 2}), Vector({0, 0, 2}));
}

TEST(IntoDual, TakesWhatIsExtreme) {
  EXPECT_EQ(IntoDual({SY_CONE_EXPONENTIAL, 3, 0}, {-1e-9, -1, 2}), Vector({0, 0, 2}));
  EXPECT_EQ(IntoDual({SY_CONE_ROTATED, 3, 0}, {1, 0, 2}), Vector({1, 0, 0}));
  EXPECT_EQ(IntoDual({SY_CONE_ROTATED, 3, 0}, {1, 1e-320, 2}), Vector({1, 1e-320, 0}));
  EXPECT_EQ(IntoDual({SY_CONE_POWER, 3, 0.5}, {-1, 2, 3}), Vector({0, 2, 0}));
  EXPECT_EQ(IntoDual({SY_CONE_PSD, 1, 0}, {-2}), Vector({0}));
  EXPECT_EQ(IntoDual({SY_CONE_SECOND_ORDER, 1, 0}, {-2}), Vector({0}));
}

}  // namespace
}  // namespace switchyard::testing
