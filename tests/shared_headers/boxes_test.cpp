#include "switchyard/boxes.hpp"

#include <gtest/gtest.h>

#include "tests/shared_headers/random_problem.hpp"

namespace switchyard::testing {
namespace {

/// A problem and points that are feasible by construction, by more than rounding.
struct Sampled {
  ProblemData data;
  std::vector<Vector> points;
  double worst = -kInfinity;  // the largest objective of the points
};

constexpr double kRoom = 1e-11;

Vector Times(const Csc& a, const Vector& x) {
  Vector ax(static_cast<std::size_t>(a.rows), 0.0);
  if (a.nonzeros() > 0) MultiplyAdd(a.View(), 1, x.data(), ax.data());
  return ax;
}

void AddRows(Random& random, Sampled& s) {
  ProblemData& d = s.data;
  d.A = random.Sparse(1 + random.Below(6), d.num_vars, 0.5);
  for (std::size_t i = 0; i < static_cast<std::size_t>(d.A.rows); ++i) {
    double least = kInfinity, most = -kInfinity;
    for (const Vector& x : s.points) {
      const double value = Times(d.A, x)[i];
      least = std::min(least, value);
      most = std::max(most, value);
    }
    d.row_lower.push_back(random.Chance(0.4) ? -kInfinity : least - kRoom);
    d.row_upper.push_back(random.Chance(0.4) ? kInfinity : most + kRoom);
  }
}

/// Cones that hold all points by the shift of their first coordinates.
void AddCones(Random& random, Sampled& s) {
  ProblemData& d = s.data;
  for (std::int32_t c = random.Below(4); c > 0; --c) {
    const bool rotated = random.Chance(0.5);
    d.cones.push_back({rotated ? SY_CONE_ROTATED : SY_CONE_SECOND_ORDER, 4, 0});
    for (int i = 0; i < 4; ++i) d.g.push_back(random.Normal());
  }
  d.F = random.Sparse(d.num_cone_rows(), d.num_vars, 0.4);
  for (std::size_t c = 0; c < d.cones.size(); ++c) {
    const auto violation = [&] {
      double largest = 0;
      for (const Vector& x : s.points) {
        Vector at = Times(d.F, x);
        for (std::size_t i = 0; i < at.size(); ++i) at[i] += d.g[i];
        largest = std::max(largest, FactsOf(d.cones[c].kind).violation(&at[4 * c], 4, 0));
      }
      return largest;
    };
    while (violation() > 0) {
      const double shift = violation() + kRoom;
      d.g[4 * c] += shift;
      if (d.cones[c].kind == SY_CONE_ROTATED) d.g[4 * c + 1] += shift;
    }
  }
}

Sampled RandomSampled(Random& random) {
  Sampled s;
  ProblemData& d = s.data;
  d.num_vars = 2 + random.Below(6);
  const auto n = static_cast<std::size_t>(d.num_vars);
  d.q = random.Normals(d.num_vars);
  d.offset = random.Normal();
  for (std::size_t j = 0; j < n; ++j) {
    d.x_lower.push_back(random.Chance(0.6) ? -kInfinity : random.Uniform(-4, -1));
    d.x_upper.push_back(random.Chance(0.6) ? kInfinity : random.Uniform(1, 4));
    d.integer.push_back(random.Chance(0.3));
  }
  for (int count = 0; count < 10; ++count) {
    Vector x;
    for (std::size_t j = 0; j < n; ++j) {
      const double v = random.Uniform(std::max(d.x_lower[j], -3.0), std::min(d.x_upper[j], 3.0));
      x.push_back(d.integer[j] != 0 ? std::trunc(v) : v);
    }
    s.points.push_back(x);
  }
  AddRows(random, s);
  AddCones(random, s);
  d.P = Csc(d.num_vars, d.num_vars);
  if (random.Chance(0.5)) {
    const Csc p = random.Sparse(d.num_vars, d.num_vars, 0.3);
    for (std::int32_t j = 0; j < d.num_vars; ++j) {
      const auto column = static_cast<std::size_t>(j);
      for (auto k = static_cast<std::size_t>(p.start[column]);
           k < static_cast<std::size_t>(p.start[column + 1]); ++k) {
        if (p.row[k] >= j) continue;
        d.P.row.push_back(p.row[k]);
        d.P.value.push_back(0.2 * p.value[k]);
      }
      d.P.row.push_back(j);
      d.P.value.push_back(random.Uniform(-0.5, 2));
      d.P.start[column + 1] = static_cast<std::int32_t>(d.P.row.size());
    }
  }
  for (const Vector& x : s.points) {
    s.worst = std::max(s.worst, Objective(Problem(d).view(), x.data()));
  }
  return s;
}

void ExpectHeld(const Boxes& boxes, const Vector& x) {
  for (std::size_t j = 0; j < x.size(); ++j) {
    EXPECT_LE(boxes.lower[j], x[j]) << "x[" << j << "]";
    EXPECT_GE(boxes.upper[j], x[j]) << "x[" << j << "]";
  }
}

TEST(Boxes, HoldEveryFeasiblePoint) {
  int narrowed = 0;
  for (unsigned seed = 0; seed < 3000; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Sampled s = RandomSampled(random);
    const Problem problem(s.data);
    const Boxes boxes = ProvenBoxes(problem.view());
    ASSERT_FALSE(boxes.infeasible);
    for (const Vector& x : s.points) ExpectHeld(boxes, x);
    if (boxes.lower != s.data.x_lower || boxes.upper != s.data.x_upper) ++narrowed;
  }
  EXPECT_GT(narrowed, 1500);
}

TEST(Boxes, HoldEveryFeasiblePointBelowTheCutoff) {
  for (unsigned seed = 0; seed < 3000; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Sampled s = RandomSampled(random);
    const Problem problem(s.data);
    const double cutoff = s.worst - random.Uniform(0, 2);
    const Boxes boxes = ProvenBoxes(problem.view(), cutoff);
    for (const Vector& x : s.points) {
      if (Objective(problem.view(), x.data()) > cutoff - kRoom) continue;
      EXPECT_FALSE(boxes.infeasible);
      ExpectHeld(boxes, x);
    }
  }
}

/// min q'x over n free variables, with rows given as dense lines.
ProblemData Free(std::int32_t n, const std::vector<Vector>& rows, const Vector& lower,
                 const Vector& upper) {
  ProblemData d;
  d.num_vars = n;
  d.q.assign(static_cast<std::size_t>(n), 0.0);
  d.x_lower.assign(static_cast<std::size_t>(n), -kInfinity);
  d.x_upper.assign(static_cast<std::size_t>(n), kInfinity);
  Csc by_rows(n, static_cast<std::int32_t>(rows.size()));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::int32_t j = 0; j < n; ++j) {
      by_rows.row.push_back(j);
      by_rows.value.push_back(rows[i][static_cast<std::size_t>(j)]);
    }
    by_rows.start[i + 1] = static_cast<std::int32_t>(by_rows.row.size());
  }
  d.A = Transpose(by_rows.View());
  d.row_lower = lower;
  d.row_upper = upper;
  return d;
}

Boxes Of(const ProblemData& d, double cutoff = kInfinity) {
  return ProvenBoxes(Problem(d).view(), cutoff);
}

TEST(Boxes, FollowAChainOfRows) {
  ProblemData d = Free(3, {{-2, 1, 0}, {0, -2, 1}}, {0, 0}, {0, 0});
  d.x_lower[0] = -1;
  d.x_upper[0] = 1;
  const Boxes boxes = Of(d);
  EXPECT_NEAR(boxes.lower[2], -4, 1e-13);
  EXPECT_NEAR(boxes.upper[2], 4, 1e-13);
}

TEST(Boxes, FollowTheConeOfANorm) {
  ProblemData d = Free(3, {}, {}, {});
  d.x_upper[0] = 3;
  d.F = Csc(3, 3);
  d.F.row = {0, 1, 2};
  d.F.value = {1, 2, 1};
  d.F.start = {0, 1, 2, 3};
  d.g = {0, 0, 1};
  d.cones = {{SY_CONE_SECOND_ORDER, 3, 0}};
  const Boxes boxes = Of(d);
  EXPECT_NEAR(boxes.lower[1], -1.5, 1e-13);
  EXPECT_NEAR(boxes.upper[2], 2, 1e-13);
  EXPECT_NEAR(boxes.lower[2], -4, 1e-13);
}

TEST(Boxes, FollowAQuadraticCutoff) {  // x^2/2 - x <= 4: between -2 and 4
  ProblemData d = Free(1, {}, {}, {});
  d.q = {-1};
  d.P = Csc(1, 1);
  d.P.row = {0};
  d.P.value = {1};
  d.P.start = {0, 1};
  const Boxes boxes = Of(d, 4);
  EXPECT_NEAR(boxes.lower[0], -2, 1e-13);
  EXPECT_NEAR(boxes.upper[0], 4, 1e-13);
  EXPECT_LE(boxes.lower[0], -2);
  EXPECT_GE(boxes.upper[0], 4);
  const Boxes none = Of(d, -1);
  EXPECT_TRUE(none.infeasible);
  EXPECT_EQ(none.source, BoxSource::kCutoff);
  EXPECT_FALSE(Of(d, -0.5).infeasible);
}

TEST(Boxes, RoundTheBoundsOfIntegers) {
  ProblemData d = Free(1, {{3}}, {-7}, {10});
  d.integer = {1};
  EXPECT_EQ(Of(d).lower[0], -2);
  EXPECT_EQ(Of(d).upper[0], 3);
  d.row_upper = {std::nextafter(9.0, 0.0)};
  EXPECT_EQ(Of(d).upper[0], 3) << "the last digit of the data is not worth an integer";
}

TEST(Boxes, SayWhatLeavesNoPoint) {
  ProblemData d = Free(2, {{1, -1}, {1, 1}}, {-1, 5}, {1, kInfinity});
  d.x_lower = {0, 0};
  d.x_upper = {1, 1};
  const Boxes rows = Of(d);
  EXPECT_TRUE(rows.infeasible);
  EXPECT_EQ(rows.source, BoxSource::kRow);
  EXPECT_EQ(rows.index, 1);
  d = Free(2, {}, {}, {});
  d.x_lower[1] = 0.3;
  d.x_upper[1] = 0.7;
  d.integer = {0, 1};
  EXPECT_TRUE(Of(d).infeasible);
  EXPECT_EQ(Of(d).source, BoxSource::kVariable);
  EXPECT_EQ(Of(d).index, 1);
}

TEST(Boxes, AreNotEmptyByTheLastDigitOfTheData) {
  ProblemData d = Free(1, {{1}, {1}}, {0.1 + 0.2, -kInfinity}, {kInfinity, 0.3});
  const Boxes boxes = Of(d);
  EXPECT_FALSE(boxes.infeasible);
  EXPECT_LE(boxes.lower[0], boxes.upper[0]);
  EXPECT_EQ(boxes.source, BoxSource::kNone);
}

}  // namespace
}  // namespace switchyard::testing
