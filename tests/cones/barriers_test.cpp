// What every cone's barrier, scaling and steps must satisfy, whatever the cone.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/cones/groups.hpp"

namespace switchyard::cones {
namespace {

constexpr int kTrials = 20;

class Barriers : public ::testing::TestWithParam<Case> {
 protected:
  Barriers() : group_(Make(GetParam())), rows_(static_cast<std::size_t>(group_->layout().rows())) {}

  [[nodiscard]] Points Random_() {
    Points v(rows_);
    for (double& e : v) e = random_.Normal();
    return v;
  }
  [[nodiscard]] Points Times(const Points& v) const {
    Points out(rows_);
    group_->Multiply(v.data(), out.data());
    return out;
  }
  /// Scales at a random point, `share` of the way to the boundary; returns (s, z).
  std::pair<Points, Points> ScaleAtRandom(double share) {
    Points s = Inside(GetParam(), *group_, random_, false, share);
    Points z = Inside(GetParam(), *group_, random_, true, share);
    for (double& v : s) v *= 3;
    for (double& v : z) v *= 0.2;
    EXPECT_TRUE(group_->Scale(s.data(), z.data(), Product(s, z) / group_->degree()));
    return {s, z};
  }
  static double Size(const Points& v) {
    double largest = 0;
    for (const double e : v) largest = std::max(largest, std::abs(e));
    return largest;
  }
  static void ExpectNear(const Points& a, const Points& b, double tolerance) {
    const double size = std::max(Size(a), Size(b));
    for (std::size_t i = 0; i < a.size(); ++i) {
      ASSERT_NEAR(a[i], b[i], tolerance * size) << "coordinate " << i;
    }
  }

  Random random_{7};
  std::unique_ptr<Group> group_;
  std::size_t rows_;
};

TEST_P(Barriers, CenterIsInsideTheConeAndItsDualAndHasTheDegreesComplementarity) {
  Points center(rows_);
  group_->Center(center.data());
  EXPECT_EQ(Violation(GetParam(), group_->layout(), center, false), 0);
  EXPECT_EQ(Violation(GetParam(), group_->layout(), center, true), 0);
  EXPECT_NEAR(Product(center, center), group_->degree(), 1e-9 * group_->degree());
}

TEST_P(Barriers, ScalingTakesTheDualPointToThePrimalOne) {
  for (const double share : {0.3, 0.9, 0.999}) {
    for (int trial = 0; trial < kTrials; ++trial) {
      const auto [s, z] = ScaleAtRandom(share);
      ExpectNear(Times(z), s, 1e-8);
    }
  }
}

TEST_P(Barriers, ScalingIsSymmetricAndPositiveDefinite) {
  for (int trial = 0; trial < kTrials; ++trial) {
    ScaleAtRandom(0.9);
    const Points u = Random_(), v = Random_();
    const double size = Size(Times(u)) * Size(v) * static_cast<double>(rows_);
    EXPECT_NEAR(Product(u, Times(v)), Product(v, Times(u)), 1e-10 * size);
    EXPECT_GT(Product(u, Times(u)), 0);
  }
}

TEST_P(Barriers, DivisionUndoesMultiplication) {
  for (const double r : {0.0, 1e-6, 0.5}) {
    for (int trial = 0; trial < kTrials; ++trial) {
      ScaleAtRandom(0.9);
      const Points v = Random_();
      Points product = Times(v), back(rows_);
      for (std::size_t i = 0; i < rows_; ++i) product[i] += r * v[i];
      group_->Divide(product.data(), r, back.data());
      ExpectNear(back, v, 1e-7);
    }
  }
}

TEST_P(Barriers, TheInversesTermsAddUpToDivision) {
  const Layout& layout = group_->layout();
  for (const double r : {1e-9, 0.1}) {
    ScaleAtRandom(0.9);
    const Index rank = group_->rank();
    EXPECT_EQ(rank, FindKind(GetParam().cone.kind)->rank(layout.dim));
    Points d(rows_), v(rows_ * rank), w(static_cast<std::size_t>(layout.count) * rank);
    group_->Inverse(r, d.data(), v.data(), w.data());
    const Points u = Random_();
    Points divided(rows_), sum(rows_);
    group_->Divide(u.data(), r, divided.data());
    for (Index c = 0; c < layout.count; ++c) {
      for (Index i = 0; i < layout.dim; ++i)
        sum[layout.Row(c, i)] = d[layout.Row(c, i)] * u[layout.Row(c, i)];
      for (Index k = 0; k < rank; ++k) {
        double along = 0;
        for (Index i = 0; i < layout.dim; ++i)
          along += v[k * rows_ + layout.Row(c, i)] * u[layout.Row(c, i)];
        along *= w[k * layout.count + c];
        for (Index i = 0; i < layout.dim; ++i)
          sum[layout.Row(c, i)] += along * v[k * rows_ + layout.Row(c, i)];
      }
    }
    ExpectNear(sum, divided, 1e-8);
  }
}

// To the boundary, on whichever side of it the start is.
TEST_P(Barriers, StepsEndAtTheBoundary) {
  const Case& c = GetParam();
  // Steps of a cone that is no symmetric one are found by going back.
  const double slack = group_->symmetric() ? 1e-7 : 0.12;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Points s = Inside(c, *group_, random_, false, 0.5);
    const Points z = Inside(c, *group_, random_, true, 0.5);
    const Points ds = Random_(), dz = Random_();
    const auto inside = [&](double step) {
      Points at_s = s, at_z = z;
      for (std::size_t i = 0; i < rows_; ++i) {
        at_s[i] += step * ds[i];
        at_z[i] += step * dz[i];
      }
      return Violation(c, group_->layout(), at_s, false) == 0 &&
             Violation(c, group_->layout(), at_z, true) == 0;
    };
    double low = 0, high = 50;
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (low + high);
      (inside(middle) ? low : high) = middle;
    }
    const double step = group_->Step(s.data(), z.data(), ds.data(), dz.data(), 50);
    EXPECT_LE(step, low * (1 + 1e-7));
    EXPECT_GE(step, low * (1 - slack));
    EXPECT_EQ(group_->Step(s.data(), z.data(), ds.data(), dz.data(), 0.5 * step), 0.5 * step);
  }
}

TEST_P(Barriers, APointOutsideHasNoScaling) {
  Points s = Inside(GetParam(), *group_, random_, false, 0.5);
  Points z = Inside(GetParam(), *group_, random_, true, 0.5);
  Points out = s;
  for (double& v : out) v = -v;
  EXPECT_FALSE(group_->Scale(out.data(), z.data(), 1));
  out = z;
  for (double& v : out) v = -v;
  EXPECT_FALSE(group_->Scale(s.data(), out.data(), 1));
}

TEST_P(Barriers, ACorrectionWithoutAPredictorAimsAtTheTarget) {
  for (int trial = 0; trial < kTrials; ++trial) {
    const auto [s, z] = ScaleAtRandom(0.5);
    const Points zero(rows_, 0.0);
    Points xi(rows_);
    group_->Correct(s.data(), z.data(), zero.data(), zero.data(), 0, xi.data());
    ExpectNear(xi, s, 1e-12);
    // s'z + s'dz + z'ds = target degree, as ds + H dz = -xi: z'xi = s'z - target degree.
    const double target = 0.3;
    group_->Correct(s.data(), z.data(), zero.data(), zero.data(), target, xi.data());
    EXPECT_NEAR(Product(z, xi), Product(s, z) - target * group_->degree(),
                1e-8 * (1 + Product(s, z)));
  }
}

TEST_P(Barriers, TheCorrectionIsOfSecondOrder) {
  // Along the path of exact complementarity the error of a corrected step is of third order: s and
  // z that move to a target by steps from the equations ds + H dz = -xi, with ds chosen.
  const auto [s, z] = ScaleAtRandom(0.2);
  const double mu = Product(s, z) / group_->degree();
  if (!group_->symmetric()) return;  // see TheThirdDerivativeIsThatOfTheSecond
  const Points direction = Random_();
  double before = 0;
  for (const double size : {1e-2, 1e-3}) {
    Points ds(rows_), dz(rows_), xi(rows_), again(rows_);
    for (std::size_t i = 0; i < rows_; ++i) ds[i] = size * direction[i];
    group_->Divide(ds.data(), 0, dz.data());
    for (double& v : dz) v = -v;  // ds + H dz = 0: the affine direction to (s, z) itself
    group_->Correct(s.data(), z.data(), ds.data(), dz.data(), 0, xi.data());
    for (std::size_t i = 0; i < rows_; ++i) again[i] = xi[i] - s[i];
    const double second = Size(again);
    if (before > 0) {
      EXPECT_NEAR(second / before, 1e-2, 1e-4);
    }
    before = second;
  }
  EXPECT_GT(mu, 0);
}

TEST_P(Barriers, DepthIsHowFarInsideInUnitsOfTheCenter) {
  if (!group_->symmetric()) return;
  Points center(rows_);
  group_->Center(center.data());
  for (int trial = 0; trial < kTrials; ++trial) {
    Points v = Random_();
    const double depth = group_->Depth(v.data());
    Points in = v, out = v;
    for (std::size_t i = 0; i < rows_; ++i) {
      in[i] += (1e-6 - depth) * center[i];
      out[i] -= (1e-6 + depth) * center[i];
    }
    EXPECT_EQ(Violation(GetParam(), group_->layout(), in, false), 0);
    EXPECT_GT(Violation(GetParam(), group_->layout(), out, false), 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Every, Barriers, ::testing::ValuesIn(Cases()),
                         [](const auto& of) { return std::string(of.param.name); });

}  // namespace
}  // namespace switchyard::cones
