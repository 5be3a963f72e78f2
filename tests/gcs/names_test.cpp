// What vertices, edges and variables are called, and what a mistake is told.
#include <gtest/gtest.h>

#include <functional>

#include "switchyard/symbolic/variable_names.hpp"
#include "tests/gcs/grid.hpp"

namespace switchyard::testing {
namespace {

using Vertex = GraphOfConvexSets::Vertex;
using Edge = GraphOfConvexSets::Edge;

/// The sentence of the InvalidArgument that a call throws; "" where it throws none.
std::string Said(const std::function<void()>& call) {
  try {
    call();
  } catch (const InvalidArgument& e) {
    return e.what();
  }
  return "";
}

Hyperrectangle UnitBox() { return {Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 1)}; }

/// a -> b, twice, and a vertex c.
struct Small {
  GraphOfConvexSets graph;
  Vertex* a = graph.AddVertex(UnitBox(), "a");
  Vertex* b = graph.AddVertex(UnitBox(), "b");
  Vertex* c = graph.AddVertex(Point(Eigen::VectorXd::Zero(3)), "c");
  Edge* first = graph.AddEdge(a, b);
  Edge* second = graph.AddEdge(a, b, "second");
};

TEST(Names, AreFoundAmongMany) {
  GraphOfConvexSets graph;
  std::vector<Vertex*> all;
  for (int i = 0; i < 2000; ++i) all.push_back(graph.AddVertex(Point(Eigen::VectorXd::Zero(1))));
  for (std::size_t i = 1; i < all.size(); ++i) graph.AddEdge(all[i - 1], all[i]);
  for (std::size_t i = 0; i < all.size(); ++i) {
    ASSERT_EQ(graph.GetVertexByName("v" + std::to_string(i)), all[i]);
  }
  for (const Edge* edge : graph.Edges()) {
    ASSERT_EQ(graph.GetEdgeByName(edge->name()), edge);
  }
  EXPECT_EQ(graph.GetVertexByName(""), nullptr);
  EXPECT_EQ(graph.GetEdgeByName("v1"), nullptr);
}

TEST(Names, AreThoseOfTheFirstOfAName) {
  Small s;
  Vertex* twin = s.graph.AddVertex(Point(Eigen::VectorXd::Zero(1)), "a");
  EXPECT_EQ(s.graph.GetVertexByName("a"), s.a);
  EXPECT_EQ(s.graph.GetMutableEdgeByName("(a, b)"), s.first);
  EXPECT_EQ(s.graph.GetMutableEdgeByName("second"), s.second);
  s.graph.RemoveVertex(s.a);
  EXPECT_EQ(s.graph.GetMutableVertexByName("a"), twin);
  EXPECT_EQ(s.graph.GetEdgeByName("(a, b)"), nullptr);
  Vertex* third = s.graph.AddVertex(Point(Eigen::VectorXd::Zero(1)), "a");
  EXPECT_EQ(s.graph.GetVertexByName("a"), twin);
  s.graph.RemoveVertex(twin);
  EXPECT_EQ(s.graph.GetVertexByName("a"), third);
}

TEST(Names, OfVariablesSayWhoseTheyAre) {
  Small s;
  EXPECT_EQ(NameOf(s.a->x()[1]), "a.x(1)");
  EXPECT_EQ(NameOf(s.second->NewSlackVariables(2, "length")[0]), "second.length(0)");
  EXPECT_EQ(NameOf(s.first->NewSlackVariables(1)[0]), "(a, b).s");
  const auto clone = s.graph.Clone();
  EXPECT_EQ(NameOf(clone->GetVertexByName("b")->x()[0]), "b.x(0)");
}

TEST(Mistakes, InTheVariablesOfATermNameThem) {
  Small s;
  EXPECT_EQ(Said([&] { s.a->AddCost(s.a->x()[0] + s.b->x()[1]); }),
            "linear cost at vertex a needs variables of its x, got b.x(1)");
  EXPECT_EQ(Said([&] { s.a->AddConstraint(s.b->x()[0] == 1); }),
            "linear equality constraint at vertex a needs variables of its x, got b.x(0)");
  EXPECT_EQ(Said([&] { s.first->AddCost(Expression(s.c->x()[2])); }),
            "linear cost at edge (a, b) needs variables of its xu, xv and slacks, got c.x(2)");
  EXPECT_EQ(Said([&] { s.first->AddConstraint(s.second->phi() <= s.first->xu()[0]); }),
            "linear constraint at edge (a, b) needs variables of its xu, xv and slacks, got phi of "
            "edge second");
  MathematicalProgram other;
  const auto y = other.NewContinuousVariables(1, "y");
  EXPECT_EQ(Said([&] { s.second->AddCost(y[0] * y[0]); }),
            "quadratic cost at edge second needs variables of its xu, xv and slacks, got y");
  EXPECT_TRUE(s.a->costs().empty() && s.first->costs().empty() && s.second->costs().empty());
}

TEST(Mistakes, InAFormulaAreThoseOfTheParserWithThePlace) {
  Small s;
  EXPECT_EQ(Said([&] { s.a->AddConstraint(s.a->x()[0] < 1); }).find("AddConstraint at vertex a: "),
            0u);
  EXPECT_EQ(
      Said([&] { s.first->AddConstraint(Formula(false)); }).find("AddConstraint at edge (a, b): "),
      0u);
}

TEST(Mistakes, WithWhatIsOfAnotherGraphNameIt) {
  Small s;
  const Small other;
  const MathematicalProgramResult none;
  EXPECT_EQ(Said([&] { s.graph.AddEdge(s.a, other.b); }), "AddEdge: vertex b is not of this graph");
  EXPECT_EQ(Said([&] { s.graph.RemoveVertex(other.a); }),
            "RemoveVertex: vertex a is not of this graph");
  EXPECT_EQ(Said([&] { s.graph.RemoveEdge(other.second); }),
            "RemoveEdge: edge second is not of this graph");
  EXPECT_EQ(Said([&] { (void)s.graph.GetSolutionPath(*other.a, *s.b, none); }),
            "GetSolutionPath: vertex a is not of this graph");
  EXPECT_EQ(Said([&] {
              (void)s.graph.SamplePaths(*s.a, *s.b, {{other.first, 1.0}}, {});
            }),
            "SamplePaths: edge (a, b) is not of this graph");
  EXPECT_EQ(
      Said([&] { (void)s.graph.SolveConvexRestriction(std::vector<const Edge*>{other.first}); }),
      "SolveConvexRestriction: edge (a, b) is not of this graph");
  EXPECT_EQ(Said([&] {
              (void)s.graph.SolveConvexRestriction(std::vector<const Vertex*>{s.a, other.b});
            }),
            "SolveConvexRestriction: vertex b is not of this graph");
}

TEST(Mistakes, WithWhatWasRemovedSaySo) {
  Small s;
  s.graph.RemoveVertex(s.a);
  const MathematicalProgramResult none;
  EXPECT_EQ(Said([&] { (void)s.a->x(); }), "Vertex::x: vertex a was removed from its graph");
  EXPECT_EQ(Said([&] { (void)s.a->AddCost(1.0); }),
            "Vertex::AddCost: vertex a was removed from its graph");
  for (const auto& call : std::vector<std::function<void()>>{
           [&] { (void)s.a->set(); }, [&] { (void)s.a->ambient_dimension(); },
           [&] { (void)s.a->shared_set(); }, [&] { (void)s.a->costs(); },
           [&] { (void)s.a->constraints(); }, [&] { (void)s.a->GetCosts(); },
           [&] { (void)s.a->GetConstraints(); }, [&] { (void)s.a->GetSolution(none); },
           [&] { (void)s.a->GetSolutionCost(none); }, [&] { (void)s.a->incoming_edges(); },
           [&] { (void)s.a->outgoing_edges(); },
           [&] { s.a->AddConstraint(Formula(s.b->x()[0] <= 1)); }}) {
    EXPECT_NE(Said(call).find("vertex a was removed from its graph"), std::string::npos);
  }
  for (const auto& call : std::vector<std::function<void()>>{
           [&] { (void)s.first->u(); }, [&] { (void)s.first->v(); }, [&] { (void)s.first->phi(); },
           [&] { (void)s.first->xu(); }, [&] { (void)s.first->xv(); },
           [&] { (void)s.first->slacks(); }, [&] { s.first->NewSlackVariables(1); },
           [&] { s.first->AddCost(1.0); }, [&] { s.first->AddPhiConstraint(true); },
           [&] { s.first->ClearPhiConstraints(); }, [&] { (void)s.first->phi_value(); },
           [&] { (void)s.first->costs(); }, [&] { (void)s.first->constraints(); },
           [&] { (void)s.first->GetCosts(); }, [&] { (void)s.first->GetConstraints(); },
           [&] { (void)s.first->GetSolutionCost(none); },
           [&] { (void)s.first->GetSolutionPhiXu(none); },
           [&] { (void)s.first->GetSolutionPhiXv(none); }}) {
    EXPECT_NE(Said(call).find("edge (a, b) was removed from its graph"), std::string::npos);
  }
  EXPECT_EQ(Said([&] { s.graph.RemoveVertex(s.a); }),
            "RemoveVertex: vertex a was removed from this graph");
  EXPECT_EQ(Said([&] { s.graph.RemoveEdge(s.first); }),
            "RemoveEdge: edge (a, b) was removed from this graph");
  EXPECT_EQ(Said([&] { s.graph.AddEdge(s.b, s.a); }),
            "AddEdge: vertex a was removed from this graph");
  EXPECT_NE(Said([&] { s.graph.AddVertexFromTemplate(*s.a); }), "");
  EXPECT_NE(Said([&] { s.graph.AddEdgeFromTemplate(s.b, s.b, *s.first); }), "");
}

TEST(Mistakes, OfOtherKindsAreSentencesToo) {
  Small s;
  EXPECT_EQ(Said([&] { s.graph.AddVertex(std::shared_ptr<const ConvexSet>(), "d"); }),
            "vertex d needs a set, got a null pointer");
  EXPECT_EQ(Said([&] { s.graph.AddEdge(nullptr, s.a); }),
            "AddEdge needs two vertices, got a null pointer");
  EXPECT_EQ(Said([&] { s.graph.RemoveVertex(nullptr); }),
            "RemoveVertex needs a vertex, got a null pointer");
  EXPECT_EQ(Said([&] { s.graph.RemoveEdge(nullptr); }),
            "RemoveEdge needs an edge, got a null pointer");
  EXPECT_EQ(Said([&] { s.second->NewSlackVariables(-1); }),
            "NewSlackVariables of edge second needs a number of rows, got -1");
  EXPECT_EQ(Said([&] { s.graph.AddEdgeFromTemplate(s.a, s.c, *s.second); }),
            "AddEdgeFromTemplate: xv of edge second has 2 entries, vertex c has 3");
  const Edge* loop = s.graph.AddEdge(s.a, s.a, "loop");
  EXPECT_EQ(
      Said([&] { s.graph.AddEdgeFromTemplate(s.a, s.b, *loop); }),
      "AddEdgeFromTemplate: edge loop is a loop, whose terms do not say which of a and b they "
      "mean");
}

}  // namespace
}  // namespace switchyard::testing
