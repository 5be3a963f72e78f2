// Coordinates that no head needs: what is left out of the program changes nothing that it says.
#include "core/gcs/idle_heads.hpp"

#include <gtest/gtest.h>

#include "switchyard/sets/cartesian_product.hpp"
#include "switchyard/sets/hyperellipsoid.hpp"
#include "switchyard/sets/hyperrectangle.hpp"
#include "tests/gcs/path_points.hpp"
#include "tests/gcs/random_draw.hpp"

namespace switchyard::testing {
namespace {

using Vertex = GraphOfConvexSets::Vertex;
using Edge = GraphOfConvexSets::Edge;

/// Segments (first, middle, last point, duration), each point in a disc or a box of the vertex; an
/// edge joins the last point of its tail to the first of its head.
struct Segments {
  Segments(unsigned seed, bool corridor) : draw(seed) {
    const int n = corridor ? 6 : 8;
    for (int v = 0; v < n; ++v) AddVertex(v);
    for (int v = 0; v + 1 < n; ++v) Join(v, v + 1);
    for (int v = 0; v + 2 < n; ++v) {
      if (!corridor || draw.Chance(0.3)) Join(v, v + 2);
    }
    for (int more = corridor ? 1 : 6; more > 0; --more) {
      Join(draw.Integer(1, n - 2), draw.Integer(1, n - 2));
    }
  }
  [[nodiscard]] const Vertex& source() const { return *vertices.front(); }
  [[nodiscard]] const Vertex& target() const { return *vertices.back(); }

  /// Each edge says of all coordinates of its head what their sets say anyway.
  void SpeakOfHeads() {
    for (Edge* edge : graph.Edges()) {
      edge->AddConstraint(Binding<Constraint>(
          std::make_shared<BoundingBoxConstraint>(Eigen::VectorXd::Constant(7, -50),
                                                  Eigen::VectorXd::Constant(7, 50)),
          edge->xv()));
    }
  }

  Draw draw;
  GraphOfConvexSets graph;
  std::vector<Vertex*> vertices;

 private:
  void AddVertex(int v) {
    const Eigen::Vector2d at(v, draw.Uniform(-1, 1));
    const ConvexSetPointer point =
        draw.Chance(0.5) ? ConvexSetPointer(Hyperellipsoid::MakeHypersphere(0.9, at))
                         : ConvexSetPointer(Hyperrectangle(at.array() - 0.8, at.array() + 0.9));
    const Hyperrectangle duration(Eigen::VectorXd::Constant(1, 0.1),
                                  Eigen::VectorXd::Constant(1, 3));
    Vertex* vertex = graph.AddVertex(CartesianProduct({point, point, point, duration}));
    vertices.push_back(vertex);
    const auto x = vertex->x();
    vertex->AddCost((x.segment<2>(2) - x.head<2>()).norm());
    vertex->AddCost((x.segment<2>(4) - x.segment<2>(2)).norm());
    vertex->AddCost(draw.Uniform(0.1, 1) * x[6]);
    vertex->AddConstraint(x[2] - x[0] <= 0.7 * x[6]);
  }
  void Join(int u, int v) {
    if (u == v) return;
    Edge* edge =
        graph.AddEdge(vertices[static_cast<std::size_t>(u)], vertices[static_cast<std::size_t>(v)]);
    edge->AddConstraint(edge->xu()[4] - edge->xv()[0] == 0);
    edge->AddConstraint(edge->xu()[5] - edge->xv()[1] == 0);
    if (draw.Chance(0.3)) edge->AddCost(draw.Uniform(0, 1));
  }
};

int EmptyHeads(const Transcribed& t) {
  const sy_csc& heads = t.paths().head_point;
  int empty = 0;
  for (std::int32_t j = 0; j < heads.cols; ++j) {
    empty += heads.start[j] == heads.start[j + 1] ? 1 : 0;
  }
  return empty;
}

/// How many variables fewer.
int CheckSame(unsigned seed, bool corridor, bool transitions) {
  SCOPED_TRACE("graph " + std::to_string(seed));
  Host& host = Host::Default();
  Segments lean(seed, corridor), full(seed, corridor);
  full.SpeakOfHeads();
  const Transcribed without(lean, transitions), with(full, transitions);
  if (!transitions) {
    EXPECT_GT(EmptyHeads(without), 0);
  }
  EXPECT_EQ(EmptyHeads(with), 0);
  const Solved a = SolvedBy(host, without.view()), b = SolvedBy(host, with.view());
  EXPECT_EQ(a.termination, b.termination);
  if (a.termination == SY_OPTIMAL) {
    EXPECT_NEAR(a.objective, b.objective, 1e-6 * (1 + b.objective));
  }
  return with.data().num_vars - without.data().num_vars;
}

class IdleHeadsOf : public ::testing::TestWithParam<bool> {};

TEST_P(IdleHeadsOf, ChangeNoRelaxation) {
  if (Host::Default().Find("conic") == nullptr) GTEST_SKIP() << "conic is not built";
  int fewer = 0;
  for (unsigned seed = 0; seed < 30; ++seed) {
    const int here = CheckSame(seed, seed % 2 == 0, GetParam());
    EXPECT_GE(here, 0);
    fewer += here > 0 ? 1 : 0;
    if (HasFailure()) return;
  }
  EXPECT_GE(fewer, 15);
}

INSTANTIATE_TEST_SUITE_P(WithTransitions, IdleHeadsOf, ::testing::Bool());

TEST(IdleHeads, ArePhiTimesTheMeanOfWhatLeaves) {
  if (Host::Default().Find("conic") == nullptr) GTEST_SKIP() << "conic is not built";
  Segments segments(4, false);
  const Transcribed t(segments);
  const Solved solved = SolvedBy(Host::Default(), t.view());
  ASSERT_EQ(solved.termination, SY_OPTIMAL);
  const Leaving out(t.pruned.arcs()), in(Reversed(t.pruned.arcs()));
  for (std::int32_t v = 0; v < t.paths().num_vertices; ++v) {
    if (v == t.pruned.source || v == t.pruned.target) continue;
    Eigen::VectorXd balance = Eigen::VectorXd::Zero(7);
    for (const std::int32_t a : out.Of(v)) {
      balance += t.program.TailOf(static_cast<std::size_t>(a), solved.x);
    }
    for (const std::int32_t a : in.Of(v)) {
      balance -= t.program.HeadOf(static_cast<std::size_t>(a), solved.x);
    }
    EXPECT_LT(balance.cwiseAbs().maxCoeff(), 1e-6);
  }
}

}  // namespace
}  // namespace switchyard::testing
