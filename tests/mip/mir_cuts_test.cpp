#include "solvers/mip/mir_cuts.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "solvers/mip/propagation.hpp"
#include "tests/mip/random_mixed_problem.hpp"

namespace switchyard::testing {
namespace {

using mip::MirCuts;
using mip::NodeBoxes;
using mip::Propagator;
using mip::Row;

std::size_t At(std::int32_t i) { return static_cast<std::size_t>(i); }

/// By how much x keeps a row.
long double Slack(const Row& row, const Vector& x) {
  long double sum = -static_cast<long double>(row.lower);
  for (const auto& e : row.entries) sum += static_cast<long double>(e.value) * x[At(e.variable)];
  return sum;
}

double Drawn(Random& random, double lower, double upper) {
  return random.Uniform(std::max(lower, -5.0), std::min(upper, 5.0) + 1e-9);
}

TEST(MirCuts, HoldAtEveryFeasiblePointOfAnyProblem) {
  std::size_t rows_seen = 0, points_seen = 0;
  for (unsigned seed = 0; seed < 1000; ++seed) {
    SCOPED_TRACE(seed);
    const RandomMixedProblem p(seed);
    const Propagator propagator(p.view());
    mip::Workspace workspace(propagator);
    NodeBoxes boxes = propagator.Bounds();
    if (!propagator.Propagate(boxes, workspace)) continue;
    const MirCuts cuts(p.view(), boxes);
    if (cuts.empty()) continue;
    Random random(seed);
    std::vector<Row> rows;
    for (int k = 0; k < 20; ++k) {
      Vector x;
      for (std::size_t j = 0; j < boxes.lower().size(); ++j) {
        x.push_back(Drawn(random, boxes.lower()[j], boxes.upper()[j]));
      }
      cuts.Separate(x, 1e-6, rows);
    }
    rows_seen += rows.size();
    for (const Vector& x : p.Points(random)) {
      ++points_seen;
      for (const Row& row : rows) EXPECT_GE(Slack(row, x), -1e-15L);
    }
  }
  EXPECT_GT(rows_seen, 300U);
  EXPECT_GT(points_seen, 1000U);
}

/// A row over binaries z, continuous y <= M z and t, at most a side; t >= root'z + 1/4.
struct Knapsack {
  explicit Knapsack(Random& random) : n(3 + random.Below(3)), m(1 + random.Below(2)) {
    for (int i = 0; i < n; ++i) {
      a.push_back(random.Uniform(1, 9));
      root.push_back(random.Uniform(0, 2));
    }
    for (int i = 0; i < m; ++i) {
      c.push_back(random.Uniform(-3, 3));
      factor.push_back(random.Uniform(0.5, 3));
    }
    omega = random.Uniform(0.5, 3);
    side = random.Uniform(0.3, 0.8) * 5 * n;
  }

  // Rows: the knapsack, y <= M z of each, t's.
  [[nodiscard]] Problem Make() const {
    const int columns = n + m + 1;
    std::vector<Vector> dense(At(m) + 2, Vector(At(columns), 0.0));
    ProblemData d;
    for (int j = 0; j < n; ++j) dense[0][At(j)] = a[At(j)];
    for (int i = 0; i < m; ++i) {
      dense[0][At(n + i)] = c[At(i)];
      dense[At(1 + i)][At(i)] = -factor[At(i)];
      dense[At(1 + i)][At(n + i)] = 1;
    }
    dense[0][At(n + m)] = omega;
    for (int j = 0; j < n; ++j) dense[At(m) + 1][At(j)] = -root[At(j)];
    dense[At(m) + 1][At(n + m)] = 1;
    d.num_vars = columns;
    d.P = Csc(columns, columns);
    d.A = Csc(m + 2, columns);
    for (int j = 0; j < columns; ++j) {
      for (int i = 0; i < m + 2; ++i) {
        if (dense[At(i)][At(j)] == 0) continue;
        d.A.row.push_back(i);
        d.A.value.push_back(dense[At(i)][At(j)]);
      }
      d.A.start[At(j) + 1] = static_cast<std::int32_t>(d.A.row.size());
      d.q.push_back(0);
      d.x_lower.push_back(0);
      d.x_upper.push_back(j < n ? 1 : j < n + m ? 2 : 50);
      d.integer.push_back(j < n ? 1 : 0);
    }
    d.F = Csc(0, columns);
    d.row_lower.assign(At(m) + 2, -kInfinity);
    d.row_upper.assign(At(m) + 2, 0.0);
    d.row_upper[0] = side;
    d.row_lower.back() = 0.25;
    d.row_upper.back() = kInfinity;
    return Problem(std::move(d));
  }

  /// x with these binaries, y at an end or drawn, t at the least; empty: it is none.
  [[nodiscard]] Vector Point(int set, Random& random) const {
    Vector x;
    double sum = 0, t = 0.25;
    for (int j = 0; j < n; ++j) {
      x.push_back((set >> j) & 1);
      sum += a[At(j)] * x.back();
      t += root[At(j)] * x.back();
    }
    for (int i = 0; i < m; ++i) {
      const double most = std::min(2.0, factor[At(i)]) * x[At(i)];
      x.push_back(random.Chance(0.4) ? most : random.Chance(0.5) ? 0 : random.Uniform(0, most));
      sum += c[At(i)] * x.back();
    }
    x.push_back(t * (1 + 1e-14));
    if (sum + omega * x.back() > side * (1 - 1e-14)) x.clear();
    return x;
  }

  int n, m;
  Vector a, c, root, factor;
  double omega, side;
};

TEST(MirCuts, OfSumsOfRowsCutOffWhatNoIntegerPointIsNear) {
  int cut_off = 0, nearly_met = 0;
  for (unsigned seed = 0; seed < 400; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Knapsack knapsack(random);
    const Problem problem = knapsack.Make();
    const Propagator propagator(problem.view());
    mip::Workspace workspace(propagator);
    NodeBoxes boxes = propagator.Bounds();
    if (!propagator.Propagate(boxes, workspace)) continue;
    const MirCuts cuts(problem.view(), boxes);
    // t tight at fractional binaries: what a relaxation leaves.
    Vector x;
    double t = 0.25;
    for (int j = 0; j < knapsack.n; ++j) {
      x.push_back(random.Chance(0.4) ? 1 : random.Uniform(0, 1));
      t += knapsack.root[At(j)] * x.back();
    }
    for (int i = 0; i < knapsack.m; ++i) {
      x.push_back(std::min(2.0, knapsack.factor[At(i)] * x[At(i)]));
    }
    x.push_back(t);
    std::vector<Row> rows;
    cuts.Separate(x, 1e-6, rows);
    long double least = kInfinity;
    for (const Row& row : rows) {
      ++cut_off;
      EXPECT_LT(Slack(row, x), 0);
      for (int k = 0; k < 20 << knapsack.n; ++k) {
        const Vector point = knapsack.Point(k >> 4, random);
        if (point.empty() || (k >> 4) >= 1 << knapsack.n) continue;
        const long double slack = Slack(row, point);
        EXPECT_GE(slack, 0) << k;
        least = std::min(least, slack);
      }
    }
    if (least < 1e-9L) ++nearly_met;
  }
  EXPECT_GT(cut_off, 200);
  EXPECT_GT(nearly_met, 20);
}

}  // namespace
}  // namespace switchyard::testing
