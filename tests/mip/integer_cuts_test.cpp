#include "solvers/mip/integer_cuts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "solvers/mip/perspectives.hpp"
#include "solvers/mip/propagation.hpp"
#include "tests/shared_headers/random_problem.hpp"

namespace switchyard::testing {
namespace {

using mip::AffineColumns;
using mip::IntegerCuts;
using mip::NodeBoxes;
using mip::Propagator;
using mip::Row;
using mip::TakePerspectives;

std::size_t At(std::int32_t i) { return static_cast<std::size_t>(i); }

Csc Sparse(const std::vector<Vector>& rows, std::int32_t columns) {
  Csc m(static_cast<std::int32_t>(rows.size()), columns);
  for (std::int32_t j = 0; j < columns; ++j) {
    for (std::int32_t i = 0; i < m.rows; ++i) {
      if (rows[At(i)][At(j)] == 0) continue;
      m.row.push_back(i);
      m.value.push_back(rows[At(i)][At(j)]);
    }
    m.start[At(j) + 1] = static_cast<std::int32_t>(m.row.size());
  }
  return m;
}

/// One cone over F x + g, x in a box, and equations E x = e.
struct OneCone {
  std::vector<Vector> F, E;
  Vector g, e, lower, upper;
  std::vector<std::uint8_t> integer;

  [[nodiscard]] Problem Make(sy_cone_kind kind) const {
    ProblemData d;
    d.num_vars = static_cast<std::int32_t>(lower.size());
    d.flags = SY_PROBLEM_CONVEX;
    d.P = Csc(d.num_vars, d.num_vars);
    d.q.assign(lower.size(), 0.0);
    d.x_lower = lower;
    d.x_upper = upper;
    d.integer = integer;
    d.A = Sparse(E, d.num_vars);
    d.row_lower = d.row_upper = e;
    d.F = Sparse(F, d.num_vars);
    d.g = g;
    d.cones = {{kind, static_cast<std::int32_t>(F.size()), 0}};
    return Problem(std::move(d));
  }
};

NodeBoxes BoxesOf(const sy_problem& problem) {
  const Propagator propagator(problem);
  mip::Workspace workspace(propagator);
  NodeBoxes boxes = propagator.Bounds();
  EXPECT_TRUE(propagator.Propagate(boxes, workspace));
  NodeBoxes own(boxes.lower(), boxes.upper(), problem.integer);
  return own;
}

/// By how much x keeps a row, more exactly than the row's numbers are.
long double Slack(const Row& row, const std::vector<long double>& x) {
  long double sum = -static_cast<long double>(row.lower);
  for (const auto& e : row.entries) sum += static_cast<long double>(e.value) * x[At(e.variable)];
  return sum;
}

// x = (k, t, y): y = scale k by an equation, r = a y + b, members c_i k + d_i; t is the other head.
TEST(IntegerCuts, AChordIsBelowTheConeAtAllIntegersAndMeetsItAtTwo) {
  int rows_seen = 0;
  for (unsigned seed = 0; seed < 500; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const double scale = random.Uniform(0.5, 2), a = random.Uniform(0.1, 2);
    const double b = random.Chance(0.5) ? 0 : random.Uniform(0, 3);
    const double most = 2 + random.Below(20);
    OneCone cone{{{0, 0, a}, {0, 1, 0}},       {{scale, 0, -1}}, {b, 0}, {0}, {0, 0, -kInfinity},
                 {most, kInfinity, kInfinity}, {1, 0, 0}};
    const int members = 1 + random.Below(3);
    for (int i = 0; i < members; ++i) {
      const bool constant = i == 0 || random.Chance(0.5);
      cone.F.push_back({constant ? 0 : random.Normal(), 0, 0});
      cone.g.push_back(1 + random.Uniform(0, 5));
    }
    const Problem problem = cone.Make(SY_CONE_ROTATED);
    const IntegerCuts cuts(problem.view(), BoxesOf(problem.view()));
    ASSERT_FALSE(cuts.empty());
    const double k = random.Uniform(b > 0 ? 0 : 1, most);
    std::vector<Row> rows;
    cuts.Separate({k, 0, scale * k}, 1e-6, rows);
    ASSERT_EQ(rows.size(), 1U);
    ++rows_seen;
    int tight = 0;
    for (int j = b > 0 ? 0 : 1; j <= most; ++j) {
      long double size = 0;
      for (int i = 0; i < members; ++i) {
        const long double u =
            static_cast<long double>(cone.F[At(2 + i)][0]) * j + cone.g[At(2 + i)];
        size += u * u;
      }
      const long double r = static_cast<long double>(a) * scale * j + b, t = size / (2 * r);
      const long double slack = Slack(rows[0], {static_cast<long double>(j), t, 0});
      EXPECT_GE(slack, -1e-17L * t) << j;
      if (slack <= 1e-12L * t) ++tight;
    }
    EXPECT_GE(tight, 2);
  }
  EXPECT_EQ(rows_seen, 500);
}

TEST(IntegerCuts, AHeadThatIsZeroAtAnEndIsLeftOut) {
  // 2 k t >= 1: k = 0 is no point.
  const Problem problem =
      OneCone{{{1, 0}, {0, 1}, {0, 0}}, {}, {0, 0, 1}, {}, {0, 0}, {5, kInfinity}, {1, 0}}.Make(
          SY_CONE_ROTATED);
  const NodeBoxes wide({0, 0}, {5, kInfinity}, problem.view().integer);
  std::vector<Row> rows;
  IntegerCuts(problem.view(), wide).Separate({0.5, 1}, 1e-6, rows);
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].entries.size(), 1U);
  EXPECT_EQ(rows[0].lower, 1);
}

// t >= |(c, a_i z_i, what is continuous)|, as it is or as a rotated cone with 2 heads of t.
TEST(IntegerCuts, BinariesBelowARootKeepTheirRowsAndSomeMeetThem) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const int n = 2 + random.Below(6), columns = n + 2;  // z, t, w
    const bool rotated = random.Chance(0.5);
    const auto unit = [&](int j, double value) {
      Vector row(At(columns), 0.0);
      row[At(j)] = value;
      return row;
    };
    OneCone cone;
    const double p = random.Uniform(0.5, 2), q = random.Uniform(0.5, 2);
    cone.F = {unit(n, rotated ? p : 1)};
    if (rotated) cone.F.push_back(unit(n, q));
    Vector a;
    for (int i = 0; i < n; ++i) {
      a.push_back(random.Normal() + (random.Chance(0.5) ? 2 : -2));
      cone.F.push_back(unit(i, a.back()));
    }
    const double c = random.Chance(0.5) ? random.Normal() : 0;
    cone.F.push_back(Vector(At(columns), 0.0));
    cone.F.push_back(unit(n + 1, 1));
    cone.g.assign(cone.F.size(), 0.0);
    cone.g[cone.F.size() - 2] = c;
    cone.lower.assign(At(columns), 0.0);
    cone.upper.assign(At(columns), 1.0);
    cone.upper[At(n)] = kInfinity;
    cone.integer.assign(At(columns), 1);
    cone.integer[At(n)] = cone.integer[At(n + 1)] = 0;
    const Problem problem = cone.Make(rotated ? SY_CONE_ROTATED : SY_CONE_SECOND_ORDER);
    const IntegerCuts cuts(problem.view(), BoxesOf(problem.view()));
    ASSERT_FALSE(cuts.empty());
    Vector x(At(columns), 0.0);
    for (int i = 0; i < n; ++i) x[At(i)] = random.Uniform(0, 1);
    std::vector<Row> rows;
    cuts.Separate(x, 1e-6, rows);
    ASSERT_EQ(rows.size(), 1U);
    int tight = 0;
    for (int set = 0; set < 1 << n; ++set) {
      std::vector<long double> at(At(columns), 0.0L);
      long double size = static_cast<long double>(c) * c;
      for (int i = 0; i < n; ++i) {
        at[At(i)] = (set >> i) & 1;
        size += at[At(i)] * static_cast<long double>(a[At(i)]) * a[At(i)];
      }
      const long double factor = rotated ? std::sqrt(2 * static_cast<long double>(p) * q) : 1.0L;
      at[At(n)] = std::sqrt(size) / factor;
      const long double slack = Slack(rows[0], at);
      EXPECT_GE(slack, -1e-16L) << set;
      if (slack < 1e-12L) ++tight;
    }
    EXPECT_GE(tight, n + 1);
  }
}

/// 2 r t >= u^2 with 2 r = 1 by an equation, over x = (z, t, r, u), u in [lower, 3], u <= 3 z.
Problem Switched(double lower, double at_zero) {
  ProblemData d = OneCone{{{0, 0, 1, 0}, {0, 1, 0, 0}, {0, 0, 0, 1}},
                          {{0, 0, 2, 0}, {-3, 0, 0, 1}},
                          {0, 0, at_zero},
                          {1, 0},
                          {0, 0, -kInfinity, lower},
                          {1, kInfinity, kInfinity, 3},
                          {1, 0, 0, 0}}
                      .Make(SY_CONE_ROTATED)
                      .data();
  d.row_lower[1] = -kInfinity;
  return Problem(std::move(d));
}

TEST(Perspectives, AConstantHeadOfASwitchedConeBecomesTheBinary) {
  Problem problem = Switched(0, 0);
  ASSERT_EQ(TakePerspectives(problem, BoxesOf(problem.view())), 1);
  // The head's row has the binary alone, times the constant or a rounding more.
  const Csc rows = Transpose(*problem.view().F);
  ASSERT_EQ(rows.start[1], 1);
  EXPECT_EQ(rows.row[0], 0);
  EXPECT_GE(rows.value[0], 0.5);
  EXPECT_LE(rows.value[0], 0.5 * (1 + 1e-14));
  EXPECT_EQ(problem.data().g[0], 0);
}

TEST(Perspectives, AMemberThatIsNotSwitchedOffKeepsTheHead) {
  for (Problem problem : {Switched(-1, 0), Switched(0, 0.5)}) {
    const Csc before = problem.data().F;
    EXPECT_EQ(TakePerspectives(problem, BoxesOf(problem.view())), 0);
    EXPECT_EQ(problem.data().F.row, before.row);
  }
}

TEST(AffineColumns, FollowsEquationsOfTwoVariables) {
  // x1 = 3 x0, x2 = 2 - x1 / 4, x3 + x4 = 1, x5 fixed.
  const Problem problem = OneCone{
      {{0, 0, 0, 0, 0, 1}},
      {{3, -1, 0, 0, 0, 0}, {0, 1, 4, 0, 0, 0}, {0, 0, 0, 1, 1, 1}},
      {0},
      {0, 8, 5},
      {0, -9, -9, -9, -9, 4},
      {2, 9, 9, 9, 9, 4},
      {1, 0, 0, 0, 0, 0}}.Make(SY_CONE_NONNEGATIVE);
  const auto columns = AffineColumns(problem.view(), BoxesOf(problem.view()));
  const auto expect = [&](int j, int variable, double factor, double constant) {
    EXPECT_EQ(columns[At(j)].variable, variable) << j;
    EXPECT_LE(columns[At(j)].factor.lower, factor);
    EXPECT_GE(columns[At(j)].factor.upper, factor);
    EXPECT_LE(columns[At(j)].constant.lower, constant);
    EXPECT_GE(columns[At(j)].constant.upper, constant);
    EXPECT_LE(columns[At(j)].factor.upper - columns[At(j)].factor.lower, 1e-14);
    EXPECT_LE(columns[At(j)].constant.upper - columns[At(j)].constant.lower, 1e-14);
  };
  expect(0, 0, 1, 0);
  expect(1, 0, 3, 0);
  expect(2, 0, -0.75, 2);
  expect(3, 3, 1, 0);
  expect(4, 3, -1, 1);
  expect(5, -1, 0, 4);
}

}  // namespace
}  // namespace switchyard::testing
