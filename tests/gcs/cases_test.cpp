// Graphs whose answer is known by hand, each of a kind that is easily answered wrong.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <functional>

#include "switchyard/gcs/shortest_path.hpp"
#include "switchyard/model/function_terms.hpp"
#include "switchyard/sets/affine_subspace.hpp"
#include "switchyard/sets/convex_hull.hpp"
#include "switchyard/sets/hpolyhedron.hpp"
#include "switchyard/sets/hyperrectangle.hpp"
#include "switchyard/sets/point.hpp"
#include "switchyard/sets/vpolytope.hpp"

namespace switchyard::testing {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using Vertex = GraphOfConvexSets::Vertex;
using Edge = GraphOfConvexSets::Edge;
using Transcription = GraphOfConvexSets::Transcription;
using Path = std::vector<const Edge*>;

// Before the process's own host is made.
[[maybe_unused]] const int set_before_main =
    setenv("SWITCHYARD_PLUGIN_PATH", SWITCHYARD_PLUGIN_FOLDER, 1);

constexpr double kTolerance = 1e-6;

bool IsBuilt(const char* backend) { return Host::Default().Find(backend) != nullptr; }

std::string Said(const std::function<void()>& call) {
  try {
    call();
  } catch (const InvalidArgument& e) {
    return e.what();
  }
  return "";
}

Eigen::VectorXd One(double x) { return Eigen::VectorXd::Constant(1, x); }
Hyperrectangle Interval(double lower, double upper) { return {One(lower), One(upper)}; }
/// All of R.
AffineSubspace Line() { return AffineSubspace(Eigen::MatrixXd::Ones(1, 1), One(0)); }
/// No point: lower <= x <= upper, lower > upper.
HPolyhedron Nothing() { return {Eigen::Vector2d(1, -1), Eigen::Vector2d(-1, -1)}; }

class Cases : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!IsBuilt("relax-and-round")) GTEST_SKIP() << "relax-and-round is not built";
  }
  Edge* Connect(Vertex* u, Vertex* v, double fee) {
    Edge* edge = graph.AddEdge(u, v);
    edge->AddCost(fee);
    return edge;
  }
  [[nodiscard]] ShortestPath Rounded(const Vertex* s, const Vertex* t) const {
    return FindShortestPath(graph, *s, *t, options);
  }
  [[nodiscard]] ShortestPath Whole(const Vertex* s, const Vertex* t, const char* backend) const {
    const SolverInterface solver(backend);
    GraphOfConvexSetsOptions whole = options;
    whole.convex_relaxation = false;
    whole.solver = &solver;
    return FindShortestPath(graph, *s, *t, whole);
  }
  /// By relaxation and rounding, and whole by each backend that takes integers.
  void ExpectEverywhere(const Vertex* s, const Vertex* t, const Path& path, double cost) const {
    const auto expect = [&](const ShortestPath& found) {
      ASSERT_EQ(found.result.primal, PointKind::kFeasible)
          << to_string(found.result.termination) << ": " << found.result.message;
      EXPECT_EQ(found.edges, path);
      EXPECT_NEAR(found.result.objective, cost, kTolerance);
    };
    {
      SCOPED_TRACE("rounded");
      expect(Rounded(s, t));
    }
    for (const char* backend : {"highs", "cbc"}) {
      SCOPED_TRACE(backend);
      if (IsBuilt(backend)) expect(Whole(s, t, backend));
    }
  }
  void ExpectInfeasibleEverywhere(const Vertex* s, const Vertex* t) const {
    EXPECT_EQ(Rounded(s, t).result.termination, Termination::kInfeasible);
    for (const char* backend : {"highs", "cbc"}) {
      SCOPED_TRACE(backend);
      if (!IsBuilt(backend)) continue;
      EXPECT_EQ(Whole(s, t, backend).result.termination, Termination::kInfeasible);
    }
  }
  GraphOfConvexSets graph;
  GraphOfConvexSetsOptions options;
};

// ---- Sets that are not bounded ----

/// From s to t by a, whose point is 0 for one edge and 5 for the other; or by b and a, for 10. The
/// edge from b to a, of no flow, may have any z where a's set is a line, also 5.
class Unbounded : public Cases {
 protected:
  void Make(Vertex* at_a) {
    a = at_a;
    sa = Connect(s, a, 1);
    sa->AddConstraint(sa->xv()[0] == 0);
    sb = Connect(s, b, 8);
    ba = Connect(b, a, 1);
    at = Connect(a, t, 1);
    at->AddConstraint(at->xu()[0] == 5);
  }
  Vertex* s = graph.AddVertex(Point(One(0)), "s");
  Vertex* b = graph.AddVertex(Interval(-1, 1), "b");
  Vertex* t = graph.AddVertex(Point(One(0)), "t");
  Vertex* a = nullptr;
  Edge *sa = nullptr, *sb = nullptr, *ba = nullptr, *at = nullptr;
};

TEST_F(Unbounded, IntegersOfAPathWithoutPointsAreNoAnswerAndTheVertexIsNamed) {
  Make(graph.AddVertex(Line(), "a"));
  const auto check = [&](const ShortestPath& found) {
    EXPECT_THAT(found.result.notes, Contains(HasSubstr("vertex a: its set is not known to be")));
    EXPECT_NE(found.result.termination, Termination::kInfeasible);
    EXPECT_LE(found.result.bound, 10 + kTolerance);
    if (found.result.primal != PointKind::kFeasible) return;
    EXPECT_EQ(found.edges, (Path{sb, ba, at}));
    EXPECT_NEAR(found.result.objective, 10, kTolerance);
  };
  check(Rounded(s, t));
  if (IsBuilt("highs")) check(Whole(s, t, "highs"));
  if (IsBuilt("cbc")) check(Whole(s, t, "cbc"));
}

// The set is not bounded, but what its vertex asks of the point makes it so: the answer is exact.
TEST_F(Unbounded, ConstraintsOfAVertexBoundItWhereverAnEdgeEnters) {
  Make(graph.AddVertex(Line(), "a"));
  a->AddConstraint(a->x()[0] >= -7);
  a->AddConstraint(a->x()[0] <= 7);
  ExpectEverywhere(s, t, {sb, ba, at}, 10);
  EXPECT_TRUE(Rounded(s, t).result.notes.empty());
  options.max_rounded_paths = 0;  // its cost has a bound that proves it
  EXPECT_EQ(Rounded(s, t).result.termination, Termination::kOptimal);
}

TEST_F(Unbounded, BoundedSetsNeedNoConstraint) {
  Make(graph.AddVertex(VPolytope(Eigen::RowVector3d(-9, 9, 1)), "a"));
  ExpectEverywhere(s, t, {sb, ba, at}, 10);
}

// ---- Cycles beside the path ----

/// s -> t for 1; a ring of three for -3.003, dear to enter and to leave, least so at a and c.
class Ring : public Cases {
 protected:
  Vertex* s = graph.AddVertex(Point(One(0)), "s");
  Vertex* t = graph.AddVertex(Point(One(1)), "t");
  Vertex* a = graph.AddVertex(Interval(0, 1), "a");
  Vertex* b = graph.AddVertex(Interval(0, 1), "b");
  Vertex* c = graph.AddVertex(Interval(0, 1), "c");
  Edge* st = Connect(s, t, 1);
  Edge* sa = Connect(s, a, 5);
  Edge* ab = Connect(a, b, -1.001);
  Edge* bc = Connect(b, c, -1.001);
  Edge* ca = Connect(c, a, -1.001);
  Edge* ct = Connect(c, t, 5);
  Edge* others[4] = {Connect(s, b, 6), Connect(s, c, 6), Connect(a, t, 6), Connect(b, t, 6)};
};

TEST_F(Ring, OfNegativeCostIsNotFree) {
  for (const char* backend : {"highs", "cbc"}) {
    if (!IsBuilt(backend)) continue;
    const ShortestPath found = Whole(s, t, backend);
    EXPECT_EQ(found.result.termination, Termination::kOptimal) << found.result.message;
    EXPECT_NEAR(found.result.objective, 1, kTolerance);
    EXPECT_LE(found.result.bound, 1 + kTolerance);
    EXPECT_EQ(found.edges, Path{st});
    EXPECT_GE(found.cycle_rounds, 1);
    EXPECT_EQ(a->GetSolution(found.result), std::nullopt);
    EXPECT_EQ(found.result.GetSolution(ab->phi()), 0);
  }
  const ShortestPath rounded = Rounded(s, t);  // what leaves the ring has come into it
  EXPECT_EQ(rounded.result.termination, Termination::kOptimal) << rounded.result.message;
  EXPECT_EQ(rounded.edges, Path{st});
}

TEST_F(Ring, WithAnEdgeThatMustBeOnThePathIsEntered) {
  constexpr double kCost = 5 - 2.002 + 5;
  bc->AddPhiConstraint(true);
  for (const char* backend : {"highs", "cbc"}) {
    if (!IsBuilt(backend)) continue;
    const ShortestPath found = Whole(s, t, backend);
    EXPECT_EQ(found.result.termination, Termination::kOptimal) << found.result.message;
    EXPECT_NEAR(found.result.objective, kCost, kTolerance);
    EXPECT_EQ(found.edges, (Path{sa, ab, bc, ct}));
  }
  const ShortestPath rounded = Rounded(s, t);
  EXPECT_LE(rounded.result.bound, kCost + kTolerance);
  EXPECT_NEAR(rounded.result.objective, kCost, kTolerance) << rounded.result.message;
  EXPECT_EQ(rounded.edges, (Path{sa, ab, bc, ct}));
}

TEST_F(Ring, ThatMustBeTakenWholeIsOnNoPath) {
  for (Edge* edge : {ab, bc, ca}) edge->AddPhiConstraint(true);
  ExpectInfeasibleEverywhere(s, t);
}

// ---- Ends ----

TEST_F(Cases, AnEdgeThatMustBeOnThePathLeadsFromTheSourceToTheTarget) {
  Vertex* s = graph.AddVertex(Point(One(0)), "s");
  Vertex* a = graph.AddVertex(Interval(0, 1), "a");
  Vertex* t = graph.AddVertex(Point(One(1)), "t");
  Connect(s, a, 1);
  Connect(a, t, 1);
  Connect(s, t, 1);
  for (Edge* edge : {Connect(a, s, -5), Connect(t, a, -5)}) {
    edge->AddPhiConstraint(true);
    ExpectInfeasibleEverywhere(s, t);
    EXPECT_EQ(Rounded(s, t).result.message,
              "an edge that must be on the path is on no path from s to t");
    edge->ClearPhiConstraints();
  }
}

TEST_F(Cases, APathOfOneVertexHasItsCosts) {
  Vertex* s = graph.AddVertex(Interval(2, 3), "s");
  Vertex* a = graph.AddVertex(Interval(0, 1), "a");
  s->AddCost(4 * s->x()[0] - 1);
  Edge* out = Connect(s, a, -100);
  Connect(a, s, -100);
  const auto check = [&](const ShortestPath& found) {
    ASSERT_EQ(found.result.primal, PointKind::kFeasible) << found.result.message;
    EXPECT_NEAR(found.result.objective, 7, kTolerance);
    EXPECT_TRUE(found.edges.empty());
    ASSERT_EQ(found.points.size(), 1u);
    EXPECT_NEAR(found.points[0][0], 2, kTolerance);
    EXPECT_NEAR(*s->GetSolutionCost(found.result), 7, kTolerance);
  };
  check(Rounded(s, s));
  if (IsBuilt("highs")) check(Whole(s, s, "highs"));
  out->AddPhiConstraint(true);
  const ShortestPath found = Rounded(s, s);
  EXPECT_EQ(found.result.termination, Termination::kInfeasible);
  EXPECT_EQ(found.result.message,
            "the path of vertex s alone has no edges, and edge (s, a) must be on it");
}

TEST_F(Cases, ATargetWithoutAWayInNeedsNoSolver) {
  Vertex* s = graph.AddVertex(Point(One(0)), "s");
  Vertex* t = graph.AddVertex(Point(One(1)), "t");
  Connect(s, t, 1)->AddPhiConstraint(false);
  Host nobody(HostOptions{{}, std::vector<std::string>{}, nullptr});
  for (const bool relaxation : {true, false}) {
    options.convex_relaxation = relaxation;
    const ShortestPath found = FindShortestPath(graph, *s, *t, options, nobody);
    EXPECT_EQ(found.result.termination, Termination::kInfeasible);
    EXPECT_EQ(found.result.message, "no path of edges leads from s to t");
  }
}

// ---- Edges and vertices of little ----

TEST_F(Cases, ParallelEdgesArePathsOfTheirOwn) {
  Vertex* s = graph.AddVertex(Point(One(0)), "s");
  Vertex* a = graph.AddVertex(Interval(0, 4), "a");
  Vertex* t = graph.AddVertex(Point(One(9)), "t");
  Edge* low = Connect(s, a, 1);
  low->AddConstraint(low->xv()[0] <= 1);
  Edge* high = Connect(s, a, 2);
  high->AddConstraint(high->xv()[0] >= 3);
  Edge* by_a = graph.AddEdge(a, t);
  by_a->AddCost(by_a->xv()[0] - by_a->xu()[0]);
  ExpectEverywhere(s, t, {high, by_a}, 2 + 9 - 4);
  low->AddCost(-5);
  ExpectEverywhere(s, t, {low, by_a}, -4 + 9 - 1);
}

TEST_F(Cases, VerticesWithoutDimensionsAreThoseOfAGraphOfNumbers) {
  std::vector<Vertex*> v;
  for (int k = 0; k < 5; ++k) v.push_back(graph.AddVertex(Point(Eigen::VectorXd(0))));
  v[3] = graph.AddVertex(Hyperrectangle());
  v[2]->AddCost(0.25);
  Connect(v[0], v[1], 1);
  Connect(v[1], v[4], 4);
  Edge* first = Connect(v[0], v[2], 2);
  Connect(v[2], v[1], 0.5);
  Edge* second = Connect(v[2], v[3], 1);
  Edge* third = Connect(v[3], v[4], 1);
  ExpectEverywhere(v[0], v[4], {first, second, third}, 4.25);
  const ShortestPath found = Rounded(v[0], v[4]);
  EXPECT_EQ(v[2]->GetSolution(found.result)->size(), 0);
  EXPECT_EQ(v[1]->GetSolution(found.result), std::nullopt);
  EXPECT_EQ(*v[2]->GetSolutionCost(found.result), 0.25);
  options.max_rounded_paths = 0;
  EXPECT_NEAR(Rounded(v[0], v[4]).result.objective, 4.25, kTolerance);
  EXPECT_NEAR(graph.SolveConvexRestriction({first, second, third}).objective, 4.25, kTolerance);
}

TEST_F(Cases, AHullHasNothingOfAMemberWithoutPoints) {
  Vertex* s = graph.AddVertex(Point(One(0)), "s");
  Vertex* a = graph.AddVertex(ConvexHull(MakeConvexSets(Interval(1, 2), Nothing())), "a");
  Vertex* t = graph.AddVertex(Point(One(0)), "t");
  a->AddCost(a->x()[0]);
  Edge *in = graph.AddEdge(s, a), *out = graph.AddEdge(a, t);
  ExpectEverywhere(s, t, {in, out}, 1);
}

TEST_F(Cases, AVertexWithoutPointsIsOnNoPath) {
  Vertex* s = graph.AddVertex(Point(One(0)), "s");
  Vertex* a = graph.AddVertex(Nothing(), "a");
  Vertex* t = graph.AddVertex(Point(One(0)), "t");
  Connect(s, a, 1);
  Connect(a, t, 1);
  ExpectInfeasibleEverywhere(s, t);
  Edge* st = Connect(s, t, 50);
  ExpectEverywhere(s, t, {st}, 50);
}

// ---- Mistakes ----

TEST_F(Cases, ATermTakesTheVariablesOfItsOwner) {
  Vertex* u = graph.AddVertex(Interval(0, 1), "u");
  Vertex* v =
      graph.AddVertex(Hyperrectangle(Eigen::Vector2d::Zero(), Eigen::Vector2d::Ones()), "v");
  Edge* edge = graph.AddEdge(u, v);
  const auto cost = std::make_shared<LinearCost>(Eigen::Vector2d(1, 1));
  EXPECT_THAT(Said([&] { u->AddCost(Binding<Cost>(cost, v->x())); }), HasSubstr("u"));
  EXPECT_THAT(Said([&] { (void)Binding<Cost>(cost, u->x()); }),
              HasSubstr("takes 2 variables, got 1"));
  EXPECT_TRUE(u->costs().empty());
  EXPECT_TRUE(edge->costs().empty());
}

TEST_F(Cases, ATermWithoutAPerspectiveIsNamedWithItsOwner) {
  Vertex* s = graph.AddVertex(Point(One(0)), "s");
  Vertex* a = graph.AddVertex(Interval(-1, 1), "alpha");
  Vertex* t = graph.AddVertex(Point(One(0)), "t");
  graph.AddEdge(s, a);
  graph.AddEdge(a, t);
  const auto cost = std::make_shared<QuadraticCost>(-Eigen::MatrixXd::Ones(1, 1), One(0));
  cost->set_description("reward");
  a->AddCost(Binding<Cost>(cost, a->x()), {Transcription::kRelaxation});
  EXPECT_THAT(Said([&] { (void)Rounded(s, t); }),
              ::testing::AllOf(HasSubstr("at alpha: reward is not convex"),
                               HasSubstr("a term for the restriction alone may be any")));
  EXPECT_EQ(Said([&] { (void)Whole(s, t, "highs"); }), "");
}

TEST_F(Cases, NumbersThatAreNoneAreRefusedWhereTheyCome) {
  Vertex* v = graph.AddVertex(Interval(0, 1), "v");
  const double nan = std::nan("");
  EXPECT_NE(Said([&] { (void)LinearCost(One(nan)); }), "");
  EXPECT_NE(Said([&] { v->AddCost(nan * v->x()[0]); }), "");
  EXPECT_NE(Said([&] { v->AddConstraint(v->x()[0] <= nan); }), "");
  EXPECT_NE(Said([&] { graph.AddVertex(Point(One(nan))); }), "");
  EXPECT_TRUE(v->costs().empty());
  EXPECT_TRUE(v->constraints().empty());
}

// ---- Terms of one transcription ----

/// From (0, 0) by a box to (4, 0), squared lengths: at least 8, 2 |a - (2, 0)|^2 + 8 in all. A disc
/// around (2, -0.3) of radius 1 is forbidden: the nearest point outside is (2, 0.7).
class Obstacle : public Cases {
 protected:
  Obstacle() {
    for (Edge* edge : {first, second}) {
      edge->AddCost((edge->xv() - edge->xu()).cast<Expression>().squaredNorm());
    }
    const Expression x = a->x()[0] - 2, y = a->x()[1] + 0.3;
    a->AddConstraint(x * x + y * y >= 1, {Transcription::kRestriction});
  }
  Vertex* s = graph.AddVertex(Point(Eigen::Vector2d(0, 0)), "s");
  Vertex* a = graph.AddVertex(Hyperrectangle(Eigen::Vector2d(0, -4), Eigen::Vector2d(4, 4)), "a");
  Vertex* t = graph.AddVertex(Point(Eigen::Vector2d(4, 0)), "t");
  Edge *first = graph.AddEdge(s, a), *second = graph.AddEdge(a, t);
};

TEST_F(Obstacle, IsPassedByWhomTheOptionsName) {
  for (const char* backend : {"ipopt", "nlopt"}) {
    if (!IsBuilt(backend)) continue;
    SCOPED_TRACE(backend);
    const SolverInterface solver(backend);
    options.restriction_solver = &solver;
    const ShortestPath found = Rounded(s, t);
    ASSERT_EQ(found.result.primal, PointKind::kFeasible) << found.result.message;
    EXPECT_NEAR(found.result.objective, 8 + 2 * 0.49, 1e-5);
    EXPECT_LE((found.points[1] - Eigen::Vector2d(2, 0.7)).norm(), 1e-3);
    EXPECT_NEAR(found.result.bound, 8, 1e-4);  // of the relaxation, which knows no disc
    EXPECT_LE(found.result.bound, 8 + kTolerance);
    EXPECT_EQ(found.result.termination, Termination::kLocallyOptimal);
  }
}

TEST_F(Obstacle, MakesTheSameAnswerForAnyNumberOfThreads) {
  if (!IsBuilt("ipopt")) GTEST_SKIP() << "ipopt is not built";
  // Parallel edges, alike but for a fee that the relaxation does not know: it uses all.
  first->AddCost(0.5, {Transcription::kRestriction});
  for (int k = 6; k > 0; --k) {
    graph.AddEdgeFromTemplate(s, a, *first)->AddCost(0.01 * k - 0.5, {Transcription::kRestriction});
  }
  std::vector<double> objective;
  std::vector<Path> path;
  for (const int threads : {1, 4}) {
    options.parallelism = Parallelism(threads);
    const ShortestPath found = Rounded(s, t);
    ASSERT_EQ(found.result.primal, PointKind::kFeasible) << found.result.message;
    EXPECT_EQ(found.rounded.size(), 7u);
    EXPECT_NEAR(found.result.objective, 8.98 + 0.01, 1e-5);
    objective.push_back(found.result.objective);
    path.push_back(found.edges);
  }
  EXPECT_EQ(objective[0], objective[1]);
  EXPECT_EQ(path[0], path[1]);
}

/// s -> a -> t, a in [1, 3], at the cost of a: 1.
class Tagged : public Cases {
 protected:
  Tagged() { a->AddCost(a->x()[0]); }
  Vertex* s = graph.AddVertex(Point(One(0)), "s");
  Vertex* a = graph.AddVertex(Interval(1, 3), "a");
  Vertex* t = graph.AddVertex(Point(One(0)), "t");
  Edge *first = graph.AddEdge(s, a), *second = graph.AddEdge(a, t);
};

TEST_F(Tagged, ConstraintsAndFeesOfTheRestrictionLeaveTheBound) {
  a->AddConstraint(a->x()[0] >= 2, {Transcription::kRestriction});
  first->AddCost(0.5, {Transcription::kRestriction});
  second->AddCost(second->xu()[0] - 1, {Transcription::kRestriction});  // at least 0 on [1, 3]
  const ShortestPath found = Rounded(s, t);
  EXPECT_NEAR(found.result.objective, 2 + 0.5 + 1, kTolerance);
  EXPECT_NEAR(found.result.bound, 1, 1e-5);
  EXPECT_EQ(found.result.termination, Termination::kLocallyOptimal);
}

TEST_F(Tagged, ARewardOfTheRestrictionLeavesNone) {
  first->AddCost(-7, {Transcription::kRestriction});
  const ShortestPath found = Rounded(s, t);
  EXPECT_NEAR(found.result.objective, 1 - 7, kTolerance);
  EXPECT_TRUE(std::isnan(found.result.bound));
  EXPECT_THAT(found.result.notes, Contains("no bound: a cost of the restriction that is not one of "
                                           "the relaxation may be negative"));
  EXPECT_NE(found.result.termination, Termination::kOptimal);
}

TEST_F(Tagged, ASurrogateLeavesNone) {
  a->AddConstraint(a->x()[0] >= 2, {Transcription::kRelaxation, Transcription::kMIP});
  const auto check = [](const ShortestPath& found) {
    EXPECT_NEAR(found.result.objective, 1, kTolerance);  // of the restriction, which lacks it
    EXPECT_TRUE(std::isnan(found.result.bound));
    EXPECT_TRUE(std::isnan(found.result.gap()));
    EXPECT_THAT(found.result.notes, Contains(HasSubstr("is not one of the restriction")));
    EXPECT_NE(found.result.termination, Termination::kOptimal);
  };
  check(Rounded(s, t));
  if (IsBuilt("highs")) check(Whole(s, t, "highs"));
}

// That a surrogate has no point says nothing of paths.
TEST_F(Tagged, ASurrogateIsNoProofThatThereIsNoPath) {
  a->AddConstraint(a->x()[0] >= 4, {Transcription::kRelaxation, Transcription::kMIP});
  const auto check = [](const ShortestPath& found) {
    EXPECT_EQ(found.result.termination, Termination::kNoPath);
    EXPECT_THAT(found.result.message, HasSubstr("is infeasible, by terms that no path has"));
  };
  check(Rounded(s, t));
  if (IsBuilt("highs")) check(Whole(s, t, "highs"));
}

TEST_F(Tagged, APathOfIntegersMustHaveItsEdgesInTheRestrictionToo) {
  Edge* shortcut = Connect(s, t, 5);
  a->AddConstraint(a->x()[0] >= 4, {Transcription::kRestriction});
  if (!IsBuilt("highs")) GTEST_SKIP() << "highs is not built";
  const ShortestPath found = Whole(s, t, "highs");
  EXPECT_EQ(found.result.termination, Termination::kRestrictionsFailed);
  EXPECT_LE(found.result.bound, 5);
  shortcut->AddPhiConstraint(true);
  EXPECT_NEAR(Whole(s, t, "highs").result.objective, 5, kTolerance);
}

}  // namespace
}  // namespace switchyard::testing
