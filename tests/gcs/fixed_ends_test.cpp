// Coordinates that the rows of an edge leave one value: those of touching faces and no others.
#include "core/gcs/fixed_ends.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/gcs/path_points.hpp"
#include "tests/gcs/set_grid.hpp"

namespace switchyard::testing {
namespace {

// Before the process's own host is made.
[[maybe_unused]] const int set_before_main =
    setenv("SWITCHYARD_PLUGIN_PATH", SWITCHYARD_PLUGIN_FOLDER, 1);

SetBox BoxOf(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) {
  return {lower, upper, false};
}
SetBox Interval(double lower, double upper) {
  return BoxOf(Eigen::VectorXd::Constant(1, lower), Eigen::VectorXd::Constant(1, upper));
}

/// Rows lower <= A x <= upper as those of a block over t, x: lower - side at t.
struct Rows {
  explicit Rows(int dim) { block.num_places = 1 + dim; }
  Rows& Add(const std::vector<double>& a, double lower, double upper) {
    for (const double side : {lower, upper}) {
      if (std::isinf(side) || (lower == upper && side == upper && side_done)) continue;
      side_done = lower == upper;
      if (side != 0) Put(0, -side);
      for (std::size_t j = 0; j < a.size(); ++j) {
        if (a[j] != 0) Put(1 + static_cast<std::int32_t>(j), a[j]);
      }
      block.rows.start.push_back(static_cast<std::int32_t>(block.rows.place.size()));
      block.lower.push_back(side == lower ? 0 : -kInfinity);
      block.upper.push_back(side == upper ? 0 : kInfinity);
    }
    side_done = false;
    return *this;
  }
  void Put(std::int32_t place, double value) {
    block.rows.place.push_back(place);
    block.rows.value.push_back(value);
  }
  TermBlock block;
  bool side_done = false;
};

std::vector<FixedCoordinate> Fixed(const SetBox& u, const SetBox& v, const Rows& rows) {
  const PlacedBlock placed[] = {{&rows.block, 0}};
  return FixedEnds(u, v, placed);
}

TEST(FixedEnds, AreTheTouchingFacesOfEqualEnds) {
  // Boxes [0, 1]^2 and [1, 2] x [0, 1] that share a point: x_1 = 1 in both, x_2 free.
  const auto fixed = Fixed(BoxOf(Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 1)),
                           BoxOf(Eigen::Vector2d(1, 0), Eigen::Vector2d(2, 1)),
                           Rows(4).Add({1, 0, -1, 0}, 0, 0).Add({0, 1, 0, -1}, 0, 0));
  ASSERT_EQ(fixed.size(), 2u);
  EXPECT_EQ(fixed[0].place, 0);
  EXPECT_EQ(fixed[0].value, 1);
  EXPECT_EQ(fixed[1].place, 2);
  EXPECT_EQ(fixed[1].value, 1);
}

TEST(FixedEnds, MeetWhereSumsOfFloatsDo) {
  for (const double face : {0.1 * 3, 0.3, 1e6 * 0.1 * 3, 1e-6 * 3}) {
    for (const double other : {face, std::nextafter(face, kInfinity), std::nextafter(face, 0.0)}) {
      const auto fixed =
          Fixed(Interval(face - 1, face), Interval(other, other + 1), Rows(2).Add({1, -1}, 0, 0));
      ASSERT_EQ(fixed.size(), 2u) << face << " and " << other;
      EXPECT_NEAR(fixed[0].value, face, 1e-12 * (1 + face));
      EXPECT_NEAR(fixed[1].value, face, 1e-12 * (1 + face));
    }
  }
}

TEST(FixedEnds, NeedMoreThanNearness) {
  const Rows equal = Rows(2).Add({1, -1}, 0, 0);
  EXPECT_TRUE(Fixed(Interval(0, 1 + 1e-9), Interval(1, 2), equal).empty());
  EXPECT_TRUE(Fixed(Interval(0, 1), Interval(1 - 1e-9, 2), equal).empty());
}

TEST(FixedEnds, OfAContradictionAreNone) {
  EXPECT_TRUE(Fixed(Interval(0, 1), Interval(2, 3), Rows(2).Add({1, -1}, 0, 0)).empty());
  // Nor where another coordinate is fixed.
  EXPECT_TRUE(Fixed(BoxOf(Eigen::Vector2d(0, 5), Eigen::Vector2d(1, 5)), Interval(2, 3),
                    Rows(3).Add({1, 0, -1}, 0, 0))
                  .empty());
}

TEST(FixedEnds, OfOpenBoxesFollowFromRowsWithOneOpenEnd) {
  const SetBox open = Interval(-kInfinity, kInfinity);
  EXPECT_TRUE(Fixed(open, open, Rows(2).Add({1, -1}, 0, 0)).empty());
  // x = 2 y + 1, y = 3.
  const auto fixed = Fixed(open, Interval(3, 3), Rows(2).Add({1, -2}, 1, 1));
  ASSERT_EQ(fixed.size(), 2u);
  EXPECT_NEAR(fixed[0].value, 7, 1e-12);
  // One side only.
  EXPECT_TRUE(Fixed(open, Interval(0, 1), Rows(2).Add({1, 1}, -kInfinity, 0)).empty());
}

TEST(FixedEnds, GoAlongAChainOfEquations) {
  // x_1 = x_2 = x_3 in u, the last one is v's, which is 0.7.
  const auto fixed =
      Fixed(BoxOf(Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones()), Interval(0.7, 0.7),
            Rows(4).Add({0, 0, 1, -1}, 0, 0).Add({0, 1, -1, 0}, 0, 0).Add({1, -1, 0, 0}, 0, 0));
  ASSERT_EQ(fixed.size(), 4u);
  for (const FixedCoordinate& c : fixed) EXPECT_NEAR(c.value, 0.7, 1e-12);
}

TEST(FixedEnds, HearNothingFromRowsOfSlacksAndOfTheBlocksOwn) {
  Rows rows(3);  // the third place is a slack's
  rows.Add({1, 0, 1}, 0, 0);
  EXPECT_TRUE(Fixed(Interval(0, 1), Interval(0, 1), rows).empty());
  Rows own(2);
  own.Add({1, 0, 1}, 0, 0);  // place 3 is the block's own
  EXPECT_TRUE(Fixed(Interval(0, 1), Interval(0, 1), own).empty());
}

TEST(FixedEnds, StandWhereTheBlockIsPlaced) {
  Rows at_v(1);
  at_v.Add({1}, -kInfinity, 2);
  const PlacedBlock placed[] = {{&at_v.block, 1}};
  const auto fixed = FixedEnds(Interval(2, 3), Interval(2, 3), placed);
  ASSERT_EQ(fixed.size(), 1u);
  EXPECT_EQ(fixed[0].place, 1);
  EXPECT_EQ(fixed[0].value, 2);
}

// A coefficient next to nothing leaves its coordinate a width that rounding of the row is small
// beside.
TEST(FixedEnds, ATinyCoefficientFixesNothing) {
  const auto fixed =
      Fixed(Interval(0, 10), Interval(1, 1), Rows(2).Add({1e-12, 1}, -kInfinity, 1 + 1e-13));
  for (const FixedCoordinate& c : fixed) EXPECT_NE(c.place, 0);
}

/// The least and the greatest value of a coordinate over boxes and rows.
std::pair<double, double> Range(const ProblemData& d, std::size_t j) {
  double end[2] = {};
  for (const int sign : {1, -1}) {
    ProblemData one = d;
    one.q[j] = sign;
    const Solved solved = SolvedBy(Host::Default(), Problem(one).view());
    if (solved.termination != SY_OPTIMAL) return {-kInfinity, kInfinity};
    end[sign > 0 ? 0 : 1] = solved.x[j];
  }
  return {end[0], end[1]};
}

TEST(FixedEnds, HaveNoWidthAndTheValueThatALinearProgramGives) {
  if (Host::Default().Find("highs") == nullptr) GTEST_SKIP() << "highs is not built";
  std::mt19937_64 engine(5);
  const auto draw = [&](int n) { return static_cast<int>(engine() % static_cast<unsigned>(n)); };
  int num_fixed = 0, num_free = 0;
  for (int round = 0; round < 300; ++round) {
    ProblemData d;
    d.num_vars = 4;
    d.flags = SY_PROBLEM_CONVEX;
    d.P = Csc(4, 4);
    d.q.assign(4, 0.0);
    d.F = Csc(0, 4);
    for (int j = 0; j < 4; ++j) {
      d.x_lower.push_back(0.1 * draw(4));
      d.x_upper.push_back(d.x_lower.back() + 0.1 * draw(4));
    }
    Rows rows(4);
    Eigen::MatrixXd A(3, 4);
    for (int i = 0; i < 3; ++i) {
      std::vector<double> a(4);
      for (int j = 0; j < 4; ++j) A(i, j) = a[static_cast<std::size_t>(j)] = draw(3) - 1;
      const double side = 0.1 * (draw(9) - 4);
      rows.Add(a, draw(2) > 0 ? side : -kInfinity, side);
      d.row_lower.push_back(rows.block.lower.back() == 0 ? side : -kInfinity);
      d.row_upper.push_back(side);
    }
    d.A = Csc(3, 4);
    for (int j = 0; j < 4; ++j) {
      for (int i = 0; i < 3; ++i) {
        if (A(i, j) == 0) continue;
        d.A.row.push_back(i);
        d.A.value.push_back(A(i, j));
      }
      d.A.start[static_cast<std::size_t>(j) + 1] = static_cast<std::int32_t>(d.A.row.size());
    }
    const auto at = [&](const std::vector<double>& v, int i) {
      return Eigen::Vector2d(v[static_cast<std::size_t>(i)], v[static_cast<std::size_t>(i) + 1]);
    };
    const auto fixed = Fixed(BoxOf(at(d.x_lower, 0), at(d.x_upper, 0)),
                             BoxOf(at(d.x_lower, 2), at(d.x_upper, 2)), rows);
    for (const FixedCoordinate& c : fixed) {
      const auto [least, most] = Range(d, static_cast<std::size_t>(c.place));
      if (std::isinf(most)) continue;  // no point at all
      EXPECT_NEAR(least, c.value, 1e-7);
      EXPECT_NEAR(most, c.value, 1e-7);
      ++num_fixed;
    }
    num_free += 4 - static_cast<int>(fixed.size());
  }
  EXPECT_GT(num_fixed, 20);
  EXPECT_GT(num_free, 50);
}

/// Boxes in a row of cells, given as polyhedra, that touch in faces; consecutive points on a path
/// share the face, by an equation at the edge.
struct TouchingCells {
  explicit TouchingCells(unsigned seed, bool shared_faces) : engine(seed) {
    const auto uniform = [&](double a, double b) {
      return std::uniform_real_distribution<double>(a, b)(engine);
    };
    constexpr int kSize = 3;
    for (int k = 0; k < kSize * kSize; ++k) {
      const Eigen::Vector2d low(0.1 * 3 * (k % kSize), 0.1 * 3 * (k / kSize));
      const Eigen::Vector2d high(0.1 * 3 * (k % kSize + 1), 0.1 * 3 * (k / kSize + 1));
      Eigen::MatrixXd A(5, 2);
      A << Eigen::Matrix2d::Identity(), -Eigen::Matrix2d::Identity(), uniform(-1, 1),
          uniform(-1, 1);
      Eigen::VectorXd b(5);
      b << high, -low, A.row(4).dot(0.5 * (low + high)) + 0.25;
      vertices.push_back(graph.AddVertex(HPolyhedron(A, b)));
    }
    const auto connect = [&](int a, int b, int face) {
      for (const auto& [u, v] : {std::pair(a, b), std::pair(b, a)}) {
        auto* e = graph.AddEdge(vertices[static_cast<std::size_t>(u)],
                                vertices[static_cast<std::size_t>(v)]);
        VectorXDecisionVariable x(4);
        x << e->xu(), e->xv();
        Eigen::MatrixXd step(2, 4);
        step << -1, 0, 1, 0, 0, -1, 0, 1;
        e->AddCost(
            Binding<Cost>(std::make_shared<L1NormCost>(step, Eigen::Vector2d(0.05, 0.02)), x));
        VectorXDecisionVariable ends(2);
        ends << e->xu()[face], e->xv()[face];
        const double slack = shared_faces ? 0 : 1e-6;  // with a width nothing is fixed
        e->AddConstraint(Binding<Constraint>(
            std::make_shared<LinearConstraint>(Eigen::RowVector2d(1, -1),
                                               Eigen::VectorXd::Constant(1, -slack),
                                               Eigen::VectorXd::Constant(1, slack)),
            ends));
      }
    };
    for (int k = 0; k < kSize * kSize; ++k) {
      if (k % kSize + 1 < kSize) connect(k, k + 1, 0);
      if (k / kSize + 1 < kSize) connect(k, k + kSize, 1);
    }
  }
  [[nodiscard]] const GraphOfConvexSets::Vertex& source() const { return *vertices.front(); }
  [[nodiscard]] const GraphOfConvexSets::Vertex& target() const { return *vertices.back(); }
  std::mt19937_64 engine;
  GraphOfConvexSets graph;
  std::vector<GraphOfConvexSets::Vertex*> vertices;
};

TEST(FixedEnds, LeaveTheProgramItsOptimum) {
  Host& host = Host::Default();
  if (host.Find("highs") == nullptr) GTEST_SKIP() << "highs is not built";
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const TouchingCells touching(seed, true), with_width(seed, false);
    const Transcribed fixed(touching), free(with_width);
    EXPECT_LT(fixed.data().num_vars, free.data().num_vars);
    const double relaxed = SolvedBy(host, fixed.view()).objective;
    ASSERT_TRUE(std::isfinite(relaxed));
    EXPECT_NEAR(relaxed, SolvedBy(host, free.view()).objective, 1e-4);
    for (const auto& path : SimplePaths(touching.source(), touching.target())) {
      const auto arcs = fixed.ArcsOf(path);
      if (arcs.empty()) continue;
      Problem one = fixed.program.problem();
      one.Change([&](ProblemData& d) {
        for (std::int32_t a = 0; a < fixed.paths().num_arcs; ++a) {
          const auto phi = static_cast<std::size_t>(fixed.paths().flow[a]);
          const bool on = std::find(arcs.begin(), arcs.end(), a) != arcs.end();
          d.x_lower[phi] = d.x_upper[phi] = on ? 1 : 0;
        }
      });
      const auto alone = touching.graph.SolveConvexRestriction(path);
      const Solved whole = SolvedBy(host, one.view());
      ASSERT_EQ(alone.is_success(), whole.termination == SY_OPTIMAL) << alone.message;
      if (alone.is_success()) {
        EXPECT_NEAR(whole.objective, alone.objective, 1e-7);
      }
    }
  }
}

}  // namespace
}  // namespace switchyard::testing
