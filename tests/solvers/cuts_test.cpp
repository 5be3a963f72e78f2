// Cuts of path problems: every path keeps them, flows that are no mixture of paths do not.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>
#include <set>

#include "core/solve/check.hpp"
#include "solvers/rounding/tightened.hpp"
#include "solvers/rounding/vertex_hull.hpp"
#include "tests/gcs/path_points.hpp"
#include "tests/gcs/set_grid.hpp"
#include "tests/solvers/grid_graph.hpp"

namespace switchyard::test {
namespace {

namespace gcs = switchyard::testing;

// Before the process's own host, which restrictions ask, is made.
[[maybe_unused]] const int set_before_main =
    setenv("SWITCHYARD_PLUGIN_PATH", SWITCHYARD_PLUGIN_FOLDER, 1);

using gcs::SetGrid;
using gcs::SetKind;
using gcs::Solved;
using gcs::Transcribed;
using rounding::Budget;
using rounding::Options;
using rounding::PathProblem;
using rounding::Tightened;
using rounding::VertexHull;

constexpr std::int32_t kAnyDim = 1000;

std::size_t At(std::int32_t i) { return static_cast<std::size_t>(i); }

/// A point with flow on all arcs and anything elsewhere.
std::vector<double> AnyPoint(const sy_problem& p, const sy_paths& paths, std::mt19937_64& engine) {
  std::uniform_real_distribution<double> flow(0.2, 0.8), any(-5, 5);
  std::vector<double> x;
  for (std::int32_t j = 0; j < p.num_vars; ++j) x.push_back(any(engine));
  for (std::int32_t a = 0; a < paths.num_arcs; ++a) x[At(paths.flow[a])] = flow(engine);
  return x;
}

struct Case {
  const char* name;
  std::vector<SetKind> kinds;
  gcs::EdgeCost cost;
  bool transitions;
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

class Cuts : public ::testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    for (const char* name : {"highs", "clarabel"}) {
      if (host_->Find(name) == nullptr) GTEST_SKIP() << name << " was not built";
    }
  }
  [[nodiscard]] SetGrid Graph(unsigned seed) const {
    return {3, 3, GetParam().kinds, GetParam().cost, seed, 1.4};
  }
  std::unique_ptr<Host> host_ = HostWith({"highs", "clarabel"});
};
INSTANTIATE_TEST_SUITE_P(
    Sets, Cuts,
    ::testing::Values(Case{"boxes", {SetKind::kBox}, gcs::EdgeCost::kL1, false},
                      Case{"polyhedra", {SetKind::kPolyhedron}, gcs::EdgeCost::kSquared, false},
                      Case{"ellipsoids", {SetKind::kEllipsoid}, gcs::EdgeCost::kSquared, false},
                      Case{"vpolytopes", {SetKind::kVPolytope}, gcs::EdgeCost::kL1, false},
                      Case{"points",
                           {SetKind::kPoint, SetKind::kNothing, SetKind::kBox},
                           gcs::EdgeCost::kL1,
                           false},
                      Case{"all",
                           {SetKind::kBox, SetKind::kPolyhedron, SetKind::kEllipsoid,
                            SetKind::kPoint, SetKind::kNothing},
                           gcs::EdgeCost::kSquared,
                           true}));

TEST_P(Cuts, EveryPathKeepsEveryTwoCycleRowAndBlock) {
  std::mt19937_64 engine(9);
  int num_cuts = 0;
  for (unsigned seed = 1; seed <= 4; ++seed) {
    SetGrid graph = Graph(seed);
    const Transcribed t(graph, GetParam().transitions);
    if (!t.pruned.why_no_path.empty()) continue;
    const PathProblem whole(t.view());
    Tightened tightened(whole);
    ASSERT_TRUE(Tightened::Serves(whole));
    for (int k = 0; k < 100; ++k) {
      tightened.AddTwoCycles(AnyPoint(t.view(), t.paths(), engine), 1e-9, kAnyDim);
    }
    num_cuts += tightened.num_cuts();
    tightened.Rebuild();
    for (const auto& path : graph.Paths()) {
      const auto arcs = t.ArcsOf(path);
      std::vector<double> x = gcs::PointOfPath(*host_, t, arcs, graph.PointsOn(path));
      ASSERT_LE(RelativeViolation(t.view(), x), 1e-9);
      x.resize(At(tightened.problem().num_vars), std::nan(""));
      x = gcs::Completed(*host_, tightened.problem(), x);
      ASSERT_LE(RelativeViolation(tightened.problem(), x), 1e-9) << "seed " << seed;
    }
  }
  EXPECT_GT(num_cuts, 10);
}

TEST_P(Cuts, TheTightenedRelaxationLiesBetweenTheRelaxationAndTheBestPath) {
  int cut_off = 0;
  for (unsigned seed = 1; seed <= 8; ++seed) {
    const SetGrid graph = Graph(seed);
    const Transcribed t(graph, GetParam().transitions);
    if (!t.pruned.why_no_path.empty()) continue;
    const PathProblem whole(t.view());
    const Solved relaxed = gcs::SolvedBy(*host_, t.view());
    ASSERT_EQ(relaxed.termination, SY_OPTIMAL);
    double best = kInfinity;
    for (const auto& path : graph.Paths()) {
      const auto alone = graph.graph.SolveConvexRestriction(path);
      if (alone.is_success()) best = std::min(best, alone.objective);
    }
    const double tolerance = 1e-5 * (1 + std::abs(best));
    Tightened tightened(whole);
    std::vector<double> x = relaxed.x;
    double value = relaxed.objective;
    int rounds = 0;
    for (; rounds < 30 && tightened.AddTwoCycles(x, 1e-5, kAnyDim) > 0; ++rounds) {
      tightened.Rebuild();
      const Solved again = gcs::SolvedBy(*host_, tightened.relaxation());
      ASSERT_EQ(again.termination, SY_OPTIMAL) << "seed " << seed;
      EXPECT_GE(again.objective, value - tolerance);
      EXPECT_LE(again.objective, best + tolerance);
      value = again.objective;
      x = again.x;
      const Solved bounded = gcs::SolvedBy(*host_, tightened.problem());
      EXPECT_NEAR(bounded.objective, value, tolerance) << "bounds that were not implied";
    }
    EXPECT_LT(rounds, 30);
    if (value > relaxed.objective + 10 * tolerance) ++cut_off;
  }
  if (GetParam().cost == gcs::EdgeCost::kSquared && !GetParam().transitions) {
    EXPECT_GT(cut_off, 0);
  }
}

TEST_P(Cuts, EveryPathKeepsTheRowOfAHull) {
  std::mt19937_64 engine(4);
  const Options options;
  int num_rows = 0;
  for (unsigned seed = 1; seed <= 6; ++seed) {
    SetGrid graph = Graph(seed);
    const Transcribed t(graph, false);
    if (!t.pruned.why_no_path.empty()) continue;
    const PathProblem whole(t.view());
    Budget budget(Unlimited());
    const VertexHull hull(whole, *host_->table(), options, budget);
    std::vector<double> x = AnyPoint(t.view(), t.paths(), engine);
    for (std::int32_t a = 0; a < t.paths().num_arcs; ++a) {  // paths may use arcs without flow
      if (engine() % 4 == 0) x[At(t.paths().flow[a])] = 0;
    }
    std::vector<std::vector<Tightened::Entry>> rows;
    for (std::int32_t v = 0; v < t.paths().num_vertices; ++v) {
      if (!hull.Asks(v, x)) continue;
      rows.push_back(hull.Cut(v, x, 1e-5));
      double value = 0;
      for (const auto& e : rows.back()) value += e.value * x[At(e.variable)];
      EXPECT_TRUE(rows.back().empty() || value < 0);
      num_rows += rows.back().empty() ? 0 : 1;
    }
    for (const auto& path : graph.Paths()) {
      for (int draw = 0; draw < 5; ++draw) {
        const auto point = gcs::PointOfPath(*host_, t, t.ArcsOf(path), graph.PointsOn(path));
        for (const auto& row : rows) {
          double value = 0;
          for (const auto& e : row) value += e.value * point[At(e.variable)];
          EXPECT_GE(value, -1e-9) << "seed " << seed;
        }
      }
    }
  }
  EXPECT_GT(num_rows, 3);
}

/// From the source by one of two points to a square, from there by one of two points to the target.
struct Crossing {
  /// `speaks`: do the edges into the square say something of its points?
  explicit Crossing(bool speaks = true) {
    const Eigen::Vector2d at[] = {{-1, 0.5}, {0, 0}, {0, 1}, {0, 0}, {2, 0}, {2, 1}, {3, 0.5}};
    for (int k = 0; k < 7; ++k) {
      vertices.push_back(
          k == 3 ? graph.AddVertex(Hyperrectangle(Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 1)))
                 : graph.AddVertex(Point(at[k])));
    }
    for (const int k : {1, 2}) {
      graph.AddEdge(vertices[0], vertices[At(k)]);
      auto* in = graph.AddEdge(vertices[At(k)], vertices[3]);
      for (int i = 0; speaks && i < 2; ++i) in->AddConstraint(in->xv()[i] <= 5);
    }
    for (const int k : {4, 5}) {
      graph.AddEdge(vertices[3], vertices[At(k)]);
      graph.AddEdge(vertices[At(k)], vertices[6]);
    }
  }
  [[nodiscard]] const GraphOfConvexSets::Vertex& source() const { return *vertices.front(); }
  [[nodiscard]] const GraphOfConvexSets::Vertex& target() const { return *vertices.back(); }
  /// Half a unit of flow on each arc; it comes to the square at p and q and leaves it from r and s.
  [[nodiscard]] std::vector<double> Half(const Transcribed& t, const Eigen::Vector2d& p,
                                         const Eigen::Vector2d& q, const Eigen::Vector2d& r,
                                         const Eigen::Vector2d& s) const {
    std::vector<double> x(t.data().q.size(), 0.0);
    const sy_paths& paths = t.paths();
    std::int32_t ins = 0, outs = 0;
    for (std::int32_t a = 0; a < paths.num_arcs; ++a) {
      x[At(paths.flow[a])] = 0.5;
      const auto put = [&](const sy_csc& of, const Eigen::Vector2d& point) {
        for (int i = 0; i < 2; ++i) x[At(of.row[of.start[2 * a + i]])] = point[i] / 2;
      };
      if (paths.head[a] == 3) put(paths.head_point, ins++ == 0 ? p : q);
      if (paths.tail[a] == 3) put(paths.tail_point, outs++ == 0 ? r : s);
    }
    return x;
  }
  GraphOfConvexSets graph;
  std::vector<GraphOfConvexSets::Vertex*> vertices;
};

class Hull : public ::testing::Test {
 protected:
  void SetUp() override {
    if (host_->Find("highs") == nullptr) GTEST_SKIP() << "highs was not built";
  }
  std::unique_ptr<Host> host_ = HostWith({"highs"});
  const Options options_;
  Budget budget_{Unlimited()};
  const Crossing crossing_;
  Transcribed t_{crossing_, false};
};

TEST_F(Hull, CutsOffAFlowThatLacksTransitionsAndNoMixtureOfPaths) {
  const PathProblem whole(t_.view());
  const VertexHull hull(whole, *host_->table(), options_, budget_);
  const Eigen::Vector2d a(0, 0), b(1, 1), c(0, 1), d(1, 0), middle(0.5, 0.5);
  EXPECT_FALSE(hull.Cut(3, crossing_.Half(t_, a, b, c, d), 1e-5).empty());
  EXPECT_TRUE(hull.Cut(3, crossing_.Half(t_, a, b, a, b), 1e-5).empty());
  EXPECT_TRUE(hull.Cut(3, crossing_.Half(t_, a, b, b, a), 1e-5).empty());
  EXPECT_TRUE(hull.Cut(3, crossing_.Half(t_, a, b, middle, middle), 1e-5).empty());
}

TEST_F(Hull, DoesNotAskWhereArcsSayNothingOfTheirHeads) {
  const Crossing crossing(false);
  const Transcribed t(crossing, false);
  const PathProblem whole(t.view());
  const VertexHull hull(whole, *host_->table(), options_, budget_);
  std::vector<double> x(t.data().q.size(), 0.0);
  for (std::int32_t a = 0; a < t.paths().num_arcs; ++a) x[At(t.paths().flow[a])] = 0.5;
  EXPECT_FALSE(hull.Asks(3, x));
}

TEST_F(Hull, AsksWhereBothSidesAreUsedAndTheSetIsKnown) {
  const Eigen::Vector2d a(0, 0), b(1, 1);
  std::vector<double> x = crossing_.Half(t_, a, b, a, b);
  const PathProblem whole(t_.view());
  const VertexHull hull(whole, *host_->table(), options_, budget_);
  for (std::int32_t v = 0; v < 7; ++v) EXPECT_EQ(hull.Asks(v, x), v == 3) << v;
  for (std::int32_t arc = 0; arc < t_.paths().num_arcs; ++arc) {
    if (t_.paths().head[arc] != 3) continue;
    std::vector<double> less = x;
    less[At(t_.paths().flow[arc])] = 0;
    EXPECT_FALSE(hull.Asks(3, less));
  }
  std::vector<const sy_set*> sets(t_.paths().set, t_.paths().set + 7);
  sets[3] = nullptr;
  t_.program.paths().set = sets.data();
  const PathProblem unknown(t_.view());
  EXPECT_FALSE(VertexHull(unknown, *host_->table(), options_, budget_).Asks(3, x));
}

TEST_F(Hull, OfAnUnboundedSetGivesNoRow) {
  Crossing open;
  // Vertex 3 in another set: x_1 <= 1 alone.
  GraphOfConvexSets graph;
  std::vector<GraphOfConvexSets::Vertex*> vertices;
  for (int k = 0; k < 7; ++k) {
    vertices.push_back(k == 3
                           ? graph.AddVertex(HPolyhedron(Eigen::MatrixXd(Eigen::RowVector2d(1, 0)),
                                                         Eigen::VectorXd::Ones(1)))
                           : graph.AddVertexFromTemplate(*open.vertices[At(k)]));
  }
  for (const auto* e : open.graph.Edges()) {
    graph.AddEdge(vertices[At(e->u().id().value)], vertices[At(e->v().id().value)]);
  }
  PrunedGraph pruned = Prune(graph, *vertices.front(), *vertices.back(), true);
  const GcsTranscription program(pruned, GraphOfConvexSets::Transcription::kRelaxation, false);
  const PathProblem whole(program.problem().view());
  const VertexHull hull(whole, *host_->table(), options_, budget_);
  std::mt19937_64 engine(1);
  const auto x = AnyPoint(program.problem().view(), whole.paths(), engine);
  EXPECT_TRUE(hull.Asks(3, x));
  EXPECT_TRUE(hull.Cut(3, x, 1e-5).empty());
}

TEST_F(Hull, AVertexOfMoreCoordinatesThanAllowedGetsNoTwoCycleRow) {
  const SetGrid graph(3, 3, {SetKind::kBox}, gcs::EdgeCost::kL1, 2, 1.4);
  const Transcribed t(graph, false);
  const PathProblem whole(t.view());
  Tightened tightened(whole);
  std::mt19937_64 engine(1);
  const auto x = AnyPoint(t.view(), t.paths(), engine);
  EXPECT_EQ(tightened.AddTwoCycles(x, 1e-9, 1), 0);
  EXPECT_GT(tightened.AddTwoCycles(x, 1e-9, 2), 0);
}

TEST(Tightened, ServesOnlyWhereTheHintTellsOfPointsAndSets) {
  GridGraph without(3, 3, EdgeCost::kOneNorm, 1);
  EXPECT_FALSE(Tightened::Serves(PathProblem(without.view())));
}

}  // namespace
}  // namespace switchyard::test
