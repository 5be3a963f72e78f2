// A dual of a cone with one entry as it is wanted: it is a dual, and near to what it was.
#include "solvers/rounding/kept_entry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "solvers/rounding/exact_duals.hpp"
#include "switchyard/cones.hpp"
#include "switchyard/safe_bound.hpp"
#include "tests/shared_headers/random_problem.hpp"

namespace switchyard::test {
namespace {

using rounding::IsHead;
using rounding::KeepEntry;
using switchyard::testing::AllCones;
using switchyard::testing::PointOf;
using switchyard::testing::Random;

using Vector = std::vector<double>;

/// In the dual cone, `slack` inside.
Vector DualOf(const sy_cone& cone, Random& random, double slack) {
  Vector y = PointOf(cone, random, slack);
  if (cone.kind == SY_CONE_EXPONENTIAL) {
    y[0] = -std::abs(random.Normal()) - 0.05;
    y[1] = random.Normal();
    y[2] = -y[0] * std::exp(y[1] / y[0] - 1) + slack;
  } else if (cone.kind == SY_CONE_POWER) {
    y[0] *= cone.parameter;
    y[1] *= 1 - cone.parameter;
  }
  return y;
}

Vector IntoDual(const sy_cone& cone, Vector y) {
  FactsOf(cone.kind).into_dual(y.data(), cone.dim, cone.parameter);
  return y;
}

TEST(KeptEntry, OfAHeadIsAnyNumberThatIsNotNegative) {
  Random random(1);
  for (const sy_cone& cone : AllCones()) {
    for (std::int32_t place = 0; place < cone.dim; ++place) {
      if (!IsHead(cone, place)) continue;
      for (int trial = 0; trial < 200; ++trial) {
        Vector y = DualOf(cone, random, random.Chance(0.5) ? 0 : 1e-9);
        const double kept = random.Chance(0.2) ? 0 : std::exp(4 * random.Normal());
        ASSERT_TRUE(KeepEntry(cone, place, kept, y.data())) << FactsOf(cone.kind).name << place;
        EXPECT_EQ(y[static_cast<std::size_t>(place)], kept);
        EXPECT_EQ(IntoDual(cone, y)[static_cast<std::size_t>(place)], kept);
      }
    }
  }
}

// A backend's dual is inside by its accuracy: a head that is off by a rounding moves nothing far.
TEST(KeptEntry, MovesOthersByNoMoreThanItIsOffItself) {
  Random random(2);
  for (const sy_cone& cone : AllCones()) {
    for (std::int32_t place = 0; place < cone.dim; ++place) {
      if (!IsHead(cone, place)) continue;
      for (int trial = 0; trial < 200; ++trial) {
        const Vector before = DualOf(cone, random, 1e-3);
        Vector y = before;
        const double kept = y[static_cast<std::size_t>(place)] * (1 - 1e-10);
        ASSERT_TRUE(KeepEntry(cone, place, kept, y.data()));
        for (std::size_t i = 0; i < y.size(); ++i) {
          EXPECT_NEAR(y[i], before[i], 1e-8 * (1 + std::abs(before[i]))) << FactsOf(cone.kind).name;
        }
      }
    }
  }
}

TEST(KeptEntry, ThatNoMemberHasIsRefused) {
  for (const sy_cone& cone : AllCones()) {
    if (cone.kind == SY_CONE_EXPONENTIAL) continue;  // its dual has any entry in the middle
    for (std::int32_t place = 0; place < cone.dim; ++place) {
      if (!IsHead(cone, place)) continue;
      Random random(3);
      const Vector before = DualOf(cone, random, 1);
      Vector y = before;
      EXPECT_FALSE(KeepEntry(cone, place, -1, y.data())) << FactsOf(cone.kind).name;
      EXPECT_EQ(y, before);
    }
  }
}

// min q t, the head of a cone of t without ends and others in [-1, 1]: any duals at all leave a
// bound, and one that is safe.
TEST(ExactDuals, CloseAColumnWithoutEndsThatIsAHeadOfACone) {
  Random random(4);
  for (const sy_cone& cone : AllCones()) {
    for (std::int32_t place = 0; place < cone.dim; ++place) {
      if (!IsHead(cone, place) || (cone.kind == SY_CONE_EXPONENTIAL && place == 1)) continue;
      ProblemData d;
      d.num_vars = cone.dim;
      d.q.assign(static_cast<std::size_t>(cone.dim), 0.0);
      d.x_lower.assign(d.q.size(), -1);
      d.x_upper.assign(d.q.size(), 1);
      d.q[static_cast<std::size_t>(place)] = 1.3;
      d.x_lower[static_cast<std::size_t>(place)] = -kInfinity;
      d.x_upper[static_cast<std::size_t>(place)] = kInfinity;
      d.A = Csc(0, cone.dim);
      d.F = Csc(cone.dim, cone.dim);
      for (std::int32_t j = 0; j < cone.dim; ++j) {
        d.F.row.push_back(j);
        d.F.value.push_back(j == place ? 2 : 1);
        d.F.start[static_cast<std::size_t>(j) + 1] = j + 1;
      }
      d.g.assign(d.q.size(), 0.25);
      d.cones = {cone};
      const Problem p(d);
      const double least = 1.3 * -0.125;  // the head is 2 t + 1/4 >= 0
      for (int trial = 0; trial < 100; ++trial) {
        rounding::Duals duals{{}, random.Normals(cone.dim)};
        rounding::MakeExact(p.view(), d.x_lower.data(), d.x_upper.data(), duals);
        const double bound =
            SafeDualBound(p.view(), nullptr, nullptr, duals.cone.data(), nullptr, nullptr).value;
        EXPECT_TRUE(std::isfinite(bound)) << FactsOf(cone.kind).name << place;
      }
      rounding::Duals none{{}, Vector(d.q.size(), 0.0)};
      rounding::MakeExact(p.view(), d.x_lower.data(), d.x_upper.data(), none);
      EXPECT_LE(SafeDualBound(p.view(), nullptr, nullptr, none.cone.data(), nullptr, nullptr).value,
                least);
    }
  }
}

}  // namespace
}  // namespace switchyard::test
