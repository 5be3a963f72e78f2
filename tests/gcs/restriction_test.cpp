// Paths that are given: their best points against closed forms.
#include "core/gcs/restriction.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "switchyard/gcs/shortest_path.hpp"
#include "tests/gcs/grid.hpp"

namespace switchyard::testing {
namespace {

using Vertex = GraphOfConvexSets::Vertex;
using Edge = GraphOfConvexSets::Edge;
using Transcription = GraphOfConvexSets::Transcription;
using Edges = std::vector<const Edge*>;
using Vertices = std::vector<const Vertex*>;

// Before the process's own host is made.
[[maybe_unused]] const int set_before_main =
    setenv("SWITCHYARD_PLUGIN_PATH", SWITCHYARD_PLUGIN_FOLDER, 1);

constexpr double kTolerance = 1e-6;

std::string Said(const std::function<void()>& call) {
  try {
    call();
  } catch (const InvalidArgument& e) {
    return e.what();
  }
  return "";
}

Hyperrectangle Interval(double lower, double upper) {
  return {Eigen::VectorXd::Constant(1, lower), Eigen::VectorXd::Constant(1, upper)};
}
Point At(double x) { return Point(Eigen::VectorXd::Constant(1, x)); }

bool AnyNotes(const MathematicalProgramResult& result, const std::string& part) {
  return std::any_of(result.notes.begin(), result.notes.end(),
                     [&](const std::string& note) { return note.find(part) != std::string::npos; });
}

class Restriction : public ::testing::Test {
 protected:
  void SetUp() override {
    if (Host::Default().Find("clarabel") == nullptr) GTEST_SKIP() << "clarabel is not built";
    options.solver = &clarabel;
  }
  Edge* Squared(Vertex* u, Vertex* v) {
    Edge* edge = graph.AddEdge(u, v);
    edge->AddCost((edge->xu() - edge->xv()).squaredNorm());
    return edge;
  }

  GraphOfConvexSets graph;
  SolverInterface clarabel{"clarabel"};
  GraphOfConvexSetsOptions options;
};

// The sum of k squared steps from p to q is least where they are equal: |q - p|^2 / k.
TEST_F(Restriction, DividesAWayEvenly) {
  const Eigen::Vector3d p(1, 2, 3), q(5, -2, 0);
  constexpr int kSteps = 4;
  Edges path;
  Vertex* at = graph.AddVertex(Point(p));
  for (int k = 1; k <= kSteps; ++k) {
    Vertex* next = k == kSteps ? graph.AddVertex(Point(q))
                               : graph.AddVertex(Hyperrectangle(Eigen::Vector3d::Constant(-9),
                                                                Eigen::Vector3d::Constant(9)));
    path.push_back(Squared(at, next));
    at = next;
  }
  const Edge* off = graph.AddEdge(at, graph.AddVertex(Point(p)));
  const auto found = graph.SolveConvexRestriction(path, options);
  ASSERT_TRUE(found.is_success()) << found.message;
  EXPECT_NEAR(found.objective, (q - p).squaredNorm() / kSteps, kTolerance);
  double cost = 0;
  for (int k = 0; k < kSteps; ++k) {
    const Edge& edge = *path[static_cast<std::size_t>(k)];
    const Eigen::Vector3d expected = p + (q - p) * k / kSteps;
    EXPECT_LE((*edge.u().GetSolution(found) - expected).norm(), 1e-4);
    EXPECT_EQ(*edge.GetSolutionPhiXu(found), *edge.u().GetSolution(found));
    EXPECT_EQ(found.GetSolution(edge.phi()), 1);
    cost += *edge.GetSolutionCost(found);
  }
  EXPECT_NEAR(cost, found.objective, 1e-9);
  EXPECT_EQ(found.GetSolution(off->phi()), 0);
  EXPECT_EQ(*off->GetSolutionCost(found), 0);
  EXPECT_EQ(off->v().GetSolution(found), std::nullopt);
  EXPECT_EQ(graph.GetSolutionPath(path[0]->u(), *at, found), path);
}

TEST_F(Restriction, ThroughVerticesTakesTheBestOfParallelEdges) {
  Vertices way;
  Edges best;
  for (int k = 0; k < 4; ++k) way.push_back(graph.AddVertex(At(k)));
  for (int k = 0; k < 3; ++k) {
    for (int j = 0; j < 4; ++j) {  // 64 paths
      Edge* edge = graph.AddEdge(graph.Vertices()[static_cast<std::size_t>(k)],
                                 graph.Vertices()[static_cast<std::size_t>(k) + 1]);
      const int fee = (j + k) % 4 + 1;
      edge->AddCost(fee);
      if (fee == 1) best.push_back(edge);
    }
  }
  auto found = graph.SolveConvexRestriction(way, options);
  ASSERT_TRUE(found.is_success()) << found.message;
  EXPECT_NEAR(found.objective, 3, kTolerance);
  EXPECT_EQ(graph.GetSolutionPath(*way.front(), *way.back(), found), best);
  // An excluded one is not taken.
  graph.GetMutableEdgeByName(best[0]->name())->AddPhiConstraint(false);
  found = graph.SolveConvexRestriction(way, options);
  EXPECT_NEAR(found.objective, 4, kTolerance);
  // A fifth at one pair makes it 80.
  graph.ClearAllPhiConstraints();
  graph.AddEdge(graph.Vertices()[1], graph.Vertices()[2]);
  EXPECT_EQ(Said([&] { (void)graph.SolveConvexRestriction(way, options); }),
            "SolveConvexRestriction: which edge from vertex v1 to vertex v2 is meant? There are 5, "
            "and with those of other pairs more than 64 paths, the most that are tried: give the "
            "edges");
}

TEST_F(Restriction, HasOnePointWhereItPassesTwice) {
  Vertex* s = graph.AddVertex(At(0));
  Vertex* a = graph.AddVertex(Interval(-9, 9));
  Vertex* b = graph.AddVertex(At(1));
  Vertex* t = graph.AddVertex(At(0));
  a->AddCost(5);
  const auto found = graph.SolveConvexRestriction(
      {Squared(s, a), Squared(a, b), Squared(b, a), Squared(a, t)}, options);
  ASSERT_TRUE(found.is_success()) << found.message;
  EXPECT_NEAR(found.objective, 1 + 5, kTolerance);  // 2 a^2 + 2 (a - 1)^2 at a = 1/2, and the fee
  EXPECT_NEAR((*a->GetSolution(found))[0], 0.5, 1e-4);
  EXPECT_NEAR(*a->GetSolutionCost(found), 5, 1e-12);
}

TEST_F(Restriction, OfOneVertexHasItsCosts) {
  Vertex* v = graph.AddVertex(Interval(0, 1));
  v->AddCost((v->x()[0] - 5) * (v->x()[0] - 5));
  const auto found = graph.SolveConvexRestriction(Vertices{v}, options);
  ASSERT_TRUE(found.is_success()) << found.message;
  EXPECT_NEAR((*v->GetSolution(found))[0], 1, kTolerance);
  EXPECT_NEAR(found.objective, 16, 1e-5);
  EXPECT_NEAR(*v->GetSolutionCost(found), found.objective, 1e-9);
}

TEST_F(Restriction, OfNoDimensionHasConstantCosts) {
  Vertex* s = graph.AddVertex(Point(Eigen::VectorXd(0)), "s");
  Vertex* t = graph.AddVertex(Point(Eigen::VectorXd(0)), "t");
  const Edge* edge = graph.AddEdge(s, t);
  s->AddCost(2);
  graph.GetMutableEdgeByName("(s, t)")->AddCost(3);
  const auto found = graph.SolveConvexRestriction(Edges{edge}, options);
  ASSERT_TRUE(found.is_success()) << to_string(found.termination) << found.message;
  EXPECT_EQ(found.objective, 5);
  EXPECT_EQ(s->GetSolution(found)->size(), 0);
  EXPECT_EQ(*s->GetSolutionCost(found), 2);
  EXPECT_EQ(*edge->GetSolutionCost(found), 3);
}

TEST_F(Restriction, KnowsTheSlacksOfItsEdges) {
  Vertex* s = graph.AddVertex(At(1));
  Vertex* t = graph.AddVertex(Interval(4, 6));
  Edge* edge = graph.AddEdge(s, t);
  const VectorXDecisionVariable slack = edge->NewSlackVariables(1);
  edge->AddConstraint(slack[0] >= edge->xv()[0] - edge->xu()[0]);
  const auto cost = edge->AddCost(2 * slack[0]);
  const auto found = graph.SolveConvexRestriction(Edges{edge}, options);
  ASSERT_TRUE(found.is_success()) << found.message;
  EXPECT_NEAR(found.GetSolution(slack[0]), 3, 1e-5);
  EXPECT_NEAR(*edge->GetSolutionCost(found, cost), 6, 1e-5);
}

// Terms of other transcriptions say nothing here.
TEST_F(Restriction, HearsTheTermsThatAreTaggedForIt) {
  Vertex* s = graph.AddVertex(At(0));
  Vertex* t = graph.AddVertex(Interval(1, 3));
  Edge* edge = Squared(s, t);
  t->AddConstraint(t->x()[0] >= 2, {Transcription::kRestriction});
  t->AddConstraint(t->x()[0] >= 2.5, {Transcription::kMIP, Transcription::kRelaxation});
  t->AddCost(1000, {Transcription::kRelaxation});
  EXPECT_NEAR(graph.SolveConvexRestriction({edge}, options).objective, 4, 1e-5);
  EXPECT_NEAR(graph.SolveConvexRestriction(graph.Vertices(), options).objective, 4, 1e-5);
}

TEST_F(Restriction, ThatIsInfeasibleIsAValue) {
  Vertex* s = graph.AddVertex(At(0), "s");
  Vertex* t = graph.AddVertex(Interval(1, 3), "t");
  for (int k = 0; k < 2; ++k) {
    Edge* edge = graph.AddEdge(s, t, "e" + std::to_string(k));
    edge->AddConstraint(edge->xv()[0] <= edge->xu()[0]);
  }
  const auto one = graph.SolveConvexRestriction(Edges{s->outgoing_edges()[0]}, options);
  EXPECT_EQ(one.termination, Termination::kInfeasible) << one.message;
  EXPECT_EQ(t->GetSolution(one), std::nullopt);
  const auto both = graph.SolveConvexRestriction(Vertices{s, t}, options);
  EXPECT_EQ(both.termination, Termination::kInfeasible);
  EXPECT_TRUE(AnyNotes(both, "the path e0: infeasible"));
  EXPECT_TRUE(AnyNotes(both, "the path e1: infeasible"));
  graph.AddEdge(s, t, "open");
  const auto open = graph.SolveConvexRestriction(Vertices{s, t}, options);
  EXPECT_TRUE(open.is_success()) << open.message;
  EXPECT_EQ(open.GetSolution(s->outgoing_edges()[2]->phi()), 1);
}

TEST_F(Restriction, IsSolvedByWhomTheOptionsName) {
  Vertex* s = graph.AddVertex(At(0));
  Vertex* t = graph.AddVertex(Interval(1, 3));
  Edge* edge = graph.AddEdge(s, t);
  edge->AddCost(edge->xv()[0]);
  EXPECT_NE(graph.SolveConvexRestriction(Edges{edge}, options).solver.find("clarabel"),
            std::string::npos);
  if (Host::Default().Find("clp") != nullptr) {
    const SolverInterface clp("clp");
    options.restriction_solver = &clp;
    EXPECT_NE(graph.SolveConvexRestriction(Edges{edge}, options).solver.find("clp"),
              std::string::npos);
  }
  const SolverInterface nobody("nobody");
  options.restriction_solver = nullptr;
  options.solver = &nobody;
  EXPECT_EQ(graph.SolveConvexRestriction(Edges{edge}, options).termination,
            Termination::kNoBackend);
}

class NonconvexRestriction : public Restriction {
 protected:
  void SetUp() override {
    Restriction::SetUp();
    if (Host::Default().Find("ipopt") == nullptr) GTEST_SKIP() << "ipopt is not built";
    // |x| >= 1 in [-3, 3], near 0.1: minima at 1 and -1.
    t->AddConstraint(t->x()[0] * t->x()[0] >= 1, {Transcription::kRestriction});
    t->AddCost((t->x()[0] - 0.1) * (t->x()[0] - 0.1));
  }
  MathematicalProgramResult From(double x) const {
    MathematicalProgramResult guess;
    guess.SetPoint({t->x()[0]}, Eigen::VectorXd::Constant(1, x));
    return graph.SolveConvexRestriction(Edges{edge}, options, &guess);
  }
  Vertex* s = graph.AddVertex(At(0));
  Vertex* t = graph.AddVertex(Interval(-3, 3));
  Edge* edge = graph.AddEdge(s, t);
};

TEST_F(NonconvexRestriction, IsSolvedFromTheGuess) {
  const auto right = From(2);
  ASSERT_EQ(right.primal, PointKind::kFeasible) << right.message;
  EXPECT_NEAR((*t->GetSolution(right))[0], 1, 1e-5);
  EXPECT_NEAR(right.objective, 0.81, 1e-5);
  const auto left = From(-2);
  ASSERT_EQ(left.primal, PointKind::kFeasible) << left.message;
  EXPECT_NEAR((*t->GetSolution(left))[0], -1, 1e-5);
  EXPECT_NEAR(left.objective, 1.21, 1e-5);
}

TEST_F(NonconvexRestriction, GoesToAnotherBackendWhereTheRelaxationsTakesItNot) {
  const auto found = From(2);
  EXPECT_EQ(found.solver.find("clarabel"), std::string::npos);
  EXPECT_TRUE(AnyNotes(found, "the restriction was not solved by clarabel: "));
  options.restriction_solver = &clarabel;  // who is named for it alone is not replaced
  EXPECT_EQ(From(2).termination, Termination::kNoBackend);
}

TEST(RestrictionStart, TakesSlacksOverTheirFlow) {
  GraphOfConvexSets graph;
  Vertex* s = graph.AddVertex(At(0));
  Vertex* t = graph.AddVertex(Interval(1, 3));
  Edge* edge = graph.AddEdge(s, t);
  const VectorXDecisionVariable slack = edge->NewSlackVariables(1);
  const auto program = RestrictionOf({s, t}, {edge});
  MathematicalProgramResult relaxed;
  relaxed.SetPoint({t->x()[0], edge->phi(), slack[0]}, Eigen::Vector3d(2, 0.25, 1.5));
  const Eigen::VectorXd start = StartFrom(relaxed, *program, {edge});
  EXPECT_EQ(start[program->FindDecisionVariableIndex(t->x()[0])], 2);
  EXPECT_EQ(start[program->FindDecisionVariableIndex(slack[0])], 6);
  EXPECT_TRUE(std::isnan(start[program->FindDecisionVariableIndex(s->x()[0])]));
}

TEST(RestrictionMistakes, NameTheEdgeOrThePair) {
  GraphOfConvexSets graph;
  Vertex* a = graph.AddVertex(At(0), "a");
  Vertex* b = graph.AddVertex(At(1), "b");
  Vertex* c = graph.AddVertex(At(2), "c");
  const Edge* ab = graph.AddEdge(a, b);
  Edge* bc = graph.AddEdge(b, c);
  EXPECT_EQ(Said([&] {
              (void)graph.SolveConvexRestriction(Edges{bc, ab});
            }),
            "the edges are no path: edge (a, b) does not begin at vertex c");
  EXPECT_EQ(Said([&] { (void)graph.SolveConvexRestriction(Edges{}); }),
            "a path needs an edge, got none");
  EXPECT_EQ(Said([&] { (void)graph.SolveConvexRestriction(Edges{nullptr}); }),
            "SolveConvexRestriction needs edges, got a null pointer");
  EXPECT_EQ(Said([&] { (void)graph.SolveConvexRestriction(Vertices{}); }),
            "SolveConvexRestriction needs a vertex, got none");
  EXPECT_EQ(Said([&] {
              (void)graph.SolveConvexRestriction(Vertices{a, nullptr});
            }),
            "SolveConvexRestriction needs vertices, got a null pointer");
  EXPECT_EQ(Said([&] {
              (void)graph.SolveConvexRestriction(Vertices{a, c});
            }),
            "SolveConvexRestriction: no edge leads from vertex a to vertex c");
  bc->AddPhiConstraint(false);
  EXPECT_EQ(Said([&] {
              (void)graph.SolveConvexRestriction(Vertices{a, b, c});
            }),
            "SolveConvexRestriction: no edge leads from vertex b to vertex c but such whose phi is "
            "fixed to 0");
}

/// Nothing, and where it was asked for.
class Visits final : public Cost {
 public:
  Visits() : Cost(1) {}
  [[nodiscard]] std::string Kind() const override { return "visits"; }
  [[nodiscard]] std::vector<double> at() const {
    const std::lock_guard lock(mutex_);
    return at_;
  }

 private:
  [[nodiscard]] Eigen::VectorXd DoEval(const VectorRef& x) const override {
    const std::lock_guard lock(mutex_);
    at_.push_back(x[0]);
    return Eigen::VectorXd::Zero(1);
  }
  mutable std::mutex mutex_;
  mutable std::vector<double> at_;
};

// Half of the flow takes each of two edges, one of which needs -1 of a and the other 1: 0 on
// average, where no path has a point.
TEST_F(Restriction, OfAPathThatWasRoundedStartsAtThePathsOwnPoint) {
  for (const char* backend : {"ipopt", "relax-and-round"}) {
    if (Host::Default().Find(backend) == nullptr) GTEST_SKIP() << backend << " is not built";
  }
  Vertex* s = graph.AddVertex(At(0), "s");
  Vertex* a = graph.AddVertex(Interval(-2, 2), "a");
  Vertex* t = graph.AddVertex(At(0), "t");
  for (const double side : {-1.0, 1.0}) {
    Edge* edge = graph.AddEdge(s, a);
    edge->AddConstraint(edge->xv()[0] == side);
  }
  graph.AddEdge(a, t);
  const auto visits = std::make_shared<Visits>();
  a->AddCost(Binding<Cost>(visits, a->x()), {Transcription::kRestriction});
  const ShortestPath found = FindShortestPath(graph, *s, *t, options);
  ASSERT_EQ(found.result.primal, PointKind::kFeasible) << found.result.message;
  EXPECT_EQ(found.rounded.size(), 2u);
  ASSERT_FALSE(visits->at().empty());
  EXPECT_NEAR(std::abs(visits->at().front()), 1, 0.1);
}

}  // namespace
}  // namespace switchyard::testing
