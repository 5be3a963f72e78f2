// What duals prove of a box whose columns have no ends: a bound that is safe, and near to the best
// where the duals are.
#include "solvers/mip/node_bound.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "switchyard/safe_bound.hpp"
#include "tests/shared_headers/random_problem.hpp"

namespace switchyard::testing {
namespace {

using mip::BoundFrom;
using rounding::Duals;

std::size_t At(std::int32_t i) { return static_cast<std::size_t>(i); }

/// Potentials v without ends, one more row than there are for a tree:
/// v_a - v_b + c x = b for each row, its own x in [-2, 2] and `extra` rows v_a + c x = b.
struct Network {
  ProblemData d;
  Vector point;  // is feasible
  Vector dual;   // of rows: leaves the potentials' columns nothing
};

class DrawNetwork {
 public:
  DrawNetwork(Random& random, std::int32_t potentials, std::int32_t grounds, bool grid)
      : random_(random), potentials_(potentials) {
    for (std::int32_t v = 0; v < potentials; ++v) {
      AddVariable(-kInfinity, kInfinity, 10 * random.Normal());
    }
    for (std::int32_t v = 1; v < potentials; ++v) AddRow(v, random.Below(v), grid);
    AddRow(0, potentials - 1, grid);  // a cycle
    for (std::int32_t k = 0; k < grounds; ++k) AddRow(random.Below(potentials), -1, grid);
  }
  Network Take() {
    ProblemData& d = network_.d;
    d.num_vars = static_cast<std::int32_t>(d.q.size());
    d.A = Csc(static_cast<std::int32_t>(rows_.size()), d.num_vars);
    for (std::int32_t j = 0; j < d.num_vars; ++j) {
      for (std::size_t i = 0; i < rows_.size(); ++i) {
        const double a = rows_[i].size() > At(j) ? rows_[i][At(j)] : 0;
        if (a == 0) continue;
        d.A.row.push_back(static_cast<std::int32_t>(i));
        d.A.value.push_back(a);
        if (j < potentials_) d.q[At(j)] += a * network_.dual[i];
      }
      d.A.start[At(j) + 1] = static_cast<std::int32_t>(d.A.row.size());
    }
    d.F = Csc(0, d.num_vars);
    return std::move(network_);
  }

 private:
  void AddVariable(double lower, double upper, double at) {
    network_.d.q.push_back(0);
    network_.d.x_lower.push_back(lower);
    network_.d.x_upper.push_back(upper);
    network_.point.push_back(at);
  }
  void AddRow(std::int32_t a, std::int32_t b, bool grid) {
    AddVariable(-2, 2, random_.Uniform(-2, 2));
    network_.d.q.back() = random_.Normal();
    Vector row(network_.point.size(), 0.0);
    row[At(a)] = 1;
    if (b >= 0) row[At(b)] = -1;
    row.back() = random_.Normal();
    double side = 0;
    for (std::size_t j = 0; j < row.size(); ++j) side += row[j] * network_.point[j];
    rows_.push_back(row);
    network_.d.row_lower.push_back(side);
    network_.d.row_upper.push_back(side);
    const double dual = random_.Normal();
    network_.dual.push_back(grid ? std::round(std::ldexp(dual, 20)) * 0x1p-20 : dual);
  }

  Random& random_;
  std::int32_t potentials_;
  std::vector<Vector> rows_;
  Network network_;
};

TEST(NodeBound, OfColumnsWithoutEndsHasWhatTheirDualsMissProjectedOut) {
  Random random(1);
  for (int trial = 0; trial < 200; ++trial) {
    const Network network = DrawNetwork(random, 2 + random.Below(8), random.Below(3), true).Take();
    const Problem p(network.d);
    const auto& [lower, upper] = std::pair(network.d.x_lower, network.d.x_upper);
    const double best =
        SafeDualBound(p.view(), nullptr, network.dual.data(), nullptr, nullptr, nullptr).value;
    ASSERT_TRUE(std::isfinite(best));
    Duals off{network.dual, {}};
    for (double& y : off.row) y += 1e-9 * random.Normal();
    const double bound = BoundFrom(p.view(), off, lower, upper).value;
    EXPECT_NEAR(bound, best, 1e-7 * (1 + std::abs(best))) << trial;
  }
}

TEST(NodeBound, OfDefinedColumnsInAConeIsClosedByTheirRows) {
  Random random(2);
  for (int trial = 0; trial < 200; ++trial) {
    const std::int32_t count = 1 + random.Below(6);
    ProblemData d;  // min q'(v, x), v = C x - b, |v| <= 3: v without ends
    d.num_vars = 2 * count;
    d.q = random.Normals(2 * count);
    for (std::int32_t j = 0; j < count; ++j) d.q[At(j)] = random.Below(9) / 8.0;
    d.x_lower.assign(At(2 * count), -1);
    d.x_upper.assign(At(2 * count), 1);
    std::vector<Vector> rows;
    d.A = Csc(count, 2 * count);
    for (std::int32_t j = 0; j < 2 * count; ++j) {
      for (std::int32_t i = 0; i < count; ++i) {
        if (j < count && i != j) continue;
        d.A.row.push_back(i);
        d.A.value.push_back(j < count ? -1 : random.Normal());
      }
      d.A.start[At(j) + 1] = static_cast<std::int32_t>(d.A.row.size());
      if (j < count) d.x_lower[At(j)] = -(d.x_upper[At(j)] = kInfinity);
    }
    d.row_lower = d.row_upper = random.Normals(count);
    d.F = Csc(count + 1, 2 * count);
    for (std::int32_t j = 0; j < 2 * count; ++j) {
      if (j < count) d.F.row.push_back(j + 1);
      if (j < count) d.F.value.push_back(1);
      d.F.start[At(j) + 1] = static_cast<std::int32_t>(d.F.row.size());
    }
    d.g.assign(At(count + 1), 0.0);
    d.g[0] = 3;
    d.cones = {{SY_CONE_SECOND_ORDER, count + 1, 0}};
    const Problem p(d);
    Duals duals{{}, random.Normals(count + 1)};
    duals.cone[0] = 4 + std::abs(random.Normal());
    for (std::int32_t i = 0; i < count; ++i) {
      duals.row.push_back(duals.cone[At(i) + 1] - d.q[At(i)] + 1e-10 * random.Normal());
    }
    EXPECT_TRUE(std::isfinite(BoundFrom(p.view(), duals, d.x_lower, d.x_upper).value)) << trial;
  }
}

TEST(NodeBound, IsSafeWhateverTheDuals) {
  Random random(3);
  int finite = 0;
  for (int trial = 0; trial < 500; ++trial) {
    const Network network =
        DrawNetwork(random, 2 + random.Below(8), random.Below(3), random.Chance(0.5)).Take();
    const Problem p(network.d);
    Duals any{network.dual, {}};
    const double size = std::pow(10, random.Uniform(-12, 2));
    for (double& y : any.row) y += size * random.Normal();
    const double bound = BoundFrom(p.view(), any, network.d.x_lower, network.d.x_upper).value;
    const double cost = Objective(p.view(), network.point.data());
    EXPECT_LE(bound, cost + 1e-9 * (1 + std::abs(cost))) << trial;
    finite += std::isfinite(bound) ? 1 : 0;
  }
  EXPECT_GT(finite, 250);
}

// What no dual bears is not called bounded.
TEST(NodeBound, OfAnUnboundedColumnIsNone) {
  Random random(4);
  Network network = DrawNetwork(random, 4, 0, true).Take();
  network.d.q[0] += 0x1p-10;  // all potentials may move together
  const Problem p(network.d);
  EXPECT_EQ(BoundFrom(p.view(), {network.dual, {}}, network.d.x_lower, network.d.x_upper).value,
            -kInfinity);
}

}  // namespace
}  // namespace switchyard::testing
