// The graph as a container: names, removal, mistakes, copies.
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "core/gcs/pruning.hpp"
#include "tests/gcs/grid.hpp"

namespace switchyard::testing {
namespace {

using Vertex = GraphOfConvexSets::Vertex;
using Edge = GraphOfConvexSets::Edge;
using Transcription = GraphOfConvexSets::Transcription;

Hyperrectangle UnitBox() { return {Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 1)}; }

TEST(Graph, KeepsVerticesAndEdgesInTheirOrder) {
  Grid grid(3, EdgeCost::kL2, 1);
  EXPECT_EQ(grid.graph.num_vertices(), 9);
  EXPECT_EQ(grid.graph.num_edges(), 24);
  EXPECT_EQ(grid.graph.Vertices()[4], grid.vertices[4]);
  EXPECT_EQ(grid.graph.GetVertexByName("v4"), grid.vertices[4]);
  EXPECT_EQ(grid.graph.GetVertexByName("nobody"), nullptr);
  EXPECT_EQ(grid.vertices[4]->incoming_edges().size(), 4u);
  EXPECT_EQ(grid.graph.Edges()[0]->name(), "(v0, v1)");
}

TEST(Graph, RemovesAVertexWithItsEdges) {
  Grid grid(3, EdgeCost::kL2, 1);
  grid.graph.RemoveVertex(grid.vertices[4]);
  EXPECT_EQ(grid.graph.num_vertices(), 8);
  EXPECT_EQ(grid.graph.num_edges(), 16);
  EXPECT_EQ(grid.graph.Vertices().size(), 8u);
  EXPECT_EQ(grid.graph.Edges().size(), 16u);
  EXPECT_EQ(grid.vertices[1]->outgoing_edges().size(), 2u);
}

TEST(Graph, RemovesLoopsAndParallelEdgesOnce) {
  GraphOfConvexSets graph;
  Vertex* a = graph.AddVertex(Point(Eigen::Vector2d(0, 0)), "a");
  Vertex* b = graph.AddVertex(Point(Eigen::Vector2d(1, 0)), "b");
  graph.AddEdge(a, a);
  Edge* first = graph.AddEdge(a, b);
  Edge* second = graph.AddEdge(a, b);
  graph.AddEdge(b, b);
  graph.RemoveEdge(first);
  EXPECT_EQ(a->outgoing_edges().size(), 2u);
  EXPECT_EQ(a->outgoing_edges()[1], second);
  EXPECT_EQ(b->incoming_edges(), (std::vector<Edge*>{second, graph.Edges().back()}));
  graph.RemoveVertex(a);
  EXPECT_EQ(graph.num_edges(), 1);
  EXPECT_EQ(b->incoming_edges().size(), 1u);
  EXPECT_EQ(b->outgoing_edges().size(), 1u);
}

// Whatever is removed in whatever order, each vertex lists the edges that the graph lists.
TEST(Graph, KeepsItsListsInStepUnderRandomChanges) {
  std::mt19937_64 engine(3);
  GraphOfConvexSets graph;
  const auto some = [&](const auto& of) {
    return of[std::uniform_int_distribution<std::size_t>(0, of.size() - 1)(engine)];
  };
  for (int i = 0; i < 8; ++i) graph.AddVertex(Point(Eigen::VectorXd::Zero(1)));
  for (int k = 0; k < 400; ++k) {
    const int what = std::uniform_int_distribution<int>(0, 9)(engine);
    if (what == 0) {
      graph.RemoveVertex(some(graph.Vertices()));
      graph.AddVertex(Point(Eigen::VectorXd::Zero(1)));
    } else if (what < 4 && graph.num_edges() > 0) {
      graph.RemoveEdge(some(graph.Edges()));
    } else {
      graph.AddEdge(some(graph.Vertices()), some(graph.Vertices()));
    }
    std::vector<const Edge*> out, in;
    for (const Vertex* v : std::as_const(graph).Vertices()) {
      for (const Edge* e : v->outgoing_edges()) EXPECT_EQ(&e->u(), v);
      for (const Edge* e : v->incoming_edges()) EXPECT_EQ(&e->v(), v);
      out.insert(out.end(), v->outgoing_edges().begin(), v->outgoing_edges().end());
      in.insert(in.end(), v->incoming_edges().begin(), v->incoming_edges().end());
    }
    const auto by_id = [](const Edge* e, const Edge* f) { return e->id() < f->id(); };
    std::sort(out.begin(), out.end(), by_id);
    std::sort(in.begin(), in.end(), by_id);
    ASSERT_EQ(out, std::as_const(graph).Edges());
    ASSERT_EQ(in, std::as_const(graph).Edges());
    ASSERT_EQ(graph.num_edges(), static_cast<int>(out.size()));
  }
}

TEST(Graph, UsesNoIdTwice) {
  Grid grid(2, EdgeCost::kL2, 1);
  const auto last = grid.graph.Edges().back()->id();
  grid.graph.RemoveEdge(grid.graph.Edges().back());
  EXPECT_GT(grid.graph.AddEdge(grid.vertices[0], grid.vertices[1])->id(), last);
  grid.graph.RemoveVertex(grid.vertices[3]);
  EXPECT_EQ(grid.graph.AddVertex(Point(Eigen::Vector2d(0, 0)))->id().value, 4);
}

TEST(Graph, KnowsWhatItRemoved) {
  Grid grid(2, EdgeCost::kL2, 1);
  const Grid other(2, EdgeCost::kL2, 1);
  Vertex* gone = grid.vertices[3];
  Edge* edge = gone->incoming_edges()[0];
  EXPECT_TRUE(grid.graph.IsValid(*gone));
  EXPECT_FALSE(other.graph.IsValid(*gone));
  EXPECT_FALSE(other.graph.IsValid(*edge));
  grid.graph.RemoveVertex(gone);
  EXPECT_FALSE(grid.graph.IsValid(*gone));
  EXPECT_FALSE(grid.graph.IsValid(*edge));
  EXPECT_EQ(gone->name(), "v3");
  EXPECT_EQ(edge->name(), "(v1, v3)");
}

TEST(Graph, RefusesVariablesOfOthers) {
  Grid grid(2, EdgeCost::kL2, 1);
  const auto cost = std::make_shared<LinearCost>(Eigen::Vector2d(1, 1));
  EXPECT_THROW(grid.vertices[1]->AddCost(Binding<Cost>(cost, grid.vertices[2]->x())),
               InvalidArgument);
  Edge* edge = grid.graph.Edges()[0];  // from 0 to 1
  EXPECT_THROW(edge->AddCost(Binding<Cost>(cost, grid.vertices[2]->x())), InvalidArgument);
  EXPECT_NO_THROW(edge->AddCost(Binding<Cost>(cost, edge->NewSlackVariables(2))));
  Grid other(2, EdgeCost::kL2, 2);
  EXPECT_THROW(grid.graph.AddEdge(grid.vertices[0], other.vertices[1]), InvalidArgument);
}

TEST(Graph, GivesTermsByTheirTranscription) {
  Grid grid(2, EdgeCost::kL2, 1);
  const auto cost = std::make_shared<LinearCost>(Eigen::Vector2d(1, 1));
  GraphOfConvexSets::Vertex& v = *grid.vertices[1];
  v.AddCost(Binding<Cost>(cost, v.x()), {Transcription::kRestriction});
  EXPECT_EQ(v.GetCosts().size(), 1u);
  EXPECT_EQ(v.GetCosts({Transcription::kMIP}).size(), 0u);
  EXPECT_EQ(v.GetCosts({Transcription::kMIP, Transcription::kRestriction}).size(), 1u);
}

TEST(Graph, ClonesWithVariablesOfItsOwn) {
  Grid grid(3, EdgeCost::kL2, 1);
  grid.graph.RemoveVertex(grid.vertices[4]);
  Edge* slacked = grid.graph.Edges()[5];
  slacked->AddPhiConstraint(true);
  const VectorXDecisionVariable s = slacked->NewSlackVariables(2);
  slacked->AddConstraint(s[0] + 2 * s[1] <= slacked->xu()[0], {Transcription::kMIP});
  const auto clone = grid.graph.Clone();
  ASSERT_EQ(clone->num_edges(), grid.graph.num_edges());
  ASSERT_EQ(clone->num_vertices(), grid.graph.num_vertices());
  for (int k = 0; k < clone->num_vertices(); ++k) {
    const Vertex* copy = clone->Vertices()[static_cast<std::size_t>(k)];
    const Vertex* original = grid.graph.Vertices()[static_cast<std::size_t>(k)];
    EXPECT_EQ(copy->id(), original->id());
    EXPECT_EQ(copy->name(), original->name());
    EXPECT_EQ(&copy->set(), &original->set());
    EXPECT_NE(copy->x()[0], original->x()[0]);
  }
  const Edge* edge = clone->Edges()[5];
  EXPECT_EQ(edge->id(), slacked->id());
  EXPECT_EQ(edge->name(), slacked->name());
  EXPECT_EQ(edge->phi_value(), true);
  EXPECT_EQ(edge->costs()[0].binding.evaluator(), slacked->costs()[0].binding.evaluator());
  EXPECT_EQ(edge->costs()[0].binding.variables()[0], edge->xu()[0]);
  EXPECT_NE(edge->xu()[0], slacked->xu()[0]);
  const auto& rows = edge->constraints()[0];
  EXPECT_EQ(rows.in, GraphOfConvexSets::TranscriptionSet({Transcription::kMIP}));
  for (const Variable v : rows.binding.variables()) {
    EXPECT_TRUE(v == edge->slacks()[0] || v == edge->slacks()[1] || v == edge->xu()[0]);
  }
  EXPECT_EQ(clone->AddVertex(Point(Eigen::Vector2d(0, 0)))->id().value, 9);
}

// The cost of the copy at its own point is that of the template at the same point.
TEST(Graph, CopiesTemplatesWithTheirTerms) {
  Grid grid(2, EdgeCost::kSquared, 1);
  Vertex* v = grid.vertices[1];
  v->AddCost(3 * v->x()[1] + 1);
  v->AddConstraint(v->x()[0] <= v->x()[1], {Transcription::kRestriction});
  Vertex* copy = grid.graph.AddVertexFromTemplate(*v);
  EXPECT_EQ(copy->name(), v->name());
  EXPECT_NE(copy->id(), v->id());
  EXPECT_EQ(&copy->set(), &v->set());
  ASSERT_EQ(copy->GetCosts().size(), 1u);
  EXPECT_EQ(copy->GetCosts()[0].variables()[0], copy->x()[1]);
  EXPECT_TRUE(copy->GetConstraints({Transcription::kMIP}).empty());
  EXPECT_EQ(copy->GetConstraints().size(), 1u);
  const Edge* edge = v->outgoing_edges()[0];
  GraphOfConvexSets other;
  Vertex* a = other.AddVertexFromTemplate(*v);
  Vertex* b = other.AddVertexFromTemplate(*grid.vertices[3]);
  const Edge* twin = other.AddEdgeFromTemplate(a, b, *edge);
  EXPECT_EQ(twin->name(), "(v1, v3)");
  ASSERT_EQ(twin->GetCosts().size(), 1u);
  EXPECT_EQ(twin->GetCosts()[0].variables()[0], a->x()[0]);
  EXPECT_EQ(twin->GetCosts()[0].variables()[3], b->x()[1]);
}

TEST(Graph, TakesExpressionsAndFormulas) {
  GraphOfConvexSets graph;
  Vertex* a = graph.AddVertex(UnitBox(), "a");
  Vertex* b = graph.AddVertex(UnitBox(), "b");
  Edge* e = graph.AddEdge(a, b);
  const VectorXDecisionVariable s = e->NewSlackVariables(1);
  const auto is = [](const auto& binding, const auto* type) {
    return dynamic_cast<decltype(type)>(binding.evaluator().get()) != nullptr;
  };
  EXPECT_TRUE(is(a->AddCost(a->x()[0] + 2), static_cast<const LinearCost*>(nullptr)));
  EXPECT_TRUE(is(a->AddCost(4), static_cast<const LinearCost*>(nullptr)));
  EXPECT_TRUE(is(e->AddCost((e->xu() - e->xv()).squaredNorm()),
                 static_cast<const QuadraticCost*>(nullptr)));
  EXPECT_TRUE(is(e->AddCost((e->xu() - e->xv()).norm()), static_cast<const L2NormCost*>(nullptr)));
  EXPECT_TRUE(is(e->AddCost(exp(s[0])), static_cast<const FunctionCost*>(nullptr)));
  EXPECT_TRUE(is(e->AddConstraint(e->xu()[0] == e->xv()[0]),
                 static_cast<const LinearEqualityConstraint*>(nullptr)));
  EXPECT_TRUE(is(e->AddConstraint((e->xu() - e->xv()).norm() <= s[0]),
                 static_cast<const LorentzConeConstraint*>(nullptr)));
  EXPECT_EQ(e->GetCosts().size(), 3u);
  EXPECT_EQ(e->GetConstraints().size(), 2u);
  Eigen::VectorXd value;
  a->GetCosts()[1].evaluator()->Eval(Eigen::VectorXd(), &value);
  EXPECT_EQ(value[0], 4);
}

TEST(Graph, HearsTheLastPhiConstraint) {
  Grid grid(2, EdgeCost::kL2, 1);
  Edge* edge = grid.graph.Edges()[0];
  EXPECT_EQ(edge->phi_value(), std::nullopt);
  edge->AddPhiConstraint(true);
  edge->AddPhiConstraint(false);
  EXPECT_EQ(edge->phi_value(), false);
  edge->ClearPhiConstraints();
  EXPECT_EQ(edge->phi_value(), std::nullopt);
  for (Edge* e : grid.graph.Edges()) e->AddPhiConstraint(false);
  grid.graph.ClearAllPhiConstraints();
  for (const Edge* e : grid.graph.Edges()) EXPECT_EQ(e->phi_value(), std::nullopt);
}

TEST(Pruning, LeavesOutWhatNoPathUses) {
  Grid grid(3, EdgeCost::kL2, 1);
  const PrunedGraph pruned = Prune(grid.graph, grid.source(), grid.target(), true);
  EXPECT_EQ(pruned.edges.size(), 24u - 4u);  // two into the source, two out of the target
  const auto paths = SimplePaths(grid.source(), grid.target());
  for (const auto& path : paths) {
    for (const Edge* edge : path) {
      EXPECT_NE(std::find(pruned.edges.begin(), pruned.edges.end(), edge), pruned.edges.end());
    }
  }
}

TEST(Pruning, HearsTheFlowsThatAreFixed) {
  Grid grid(3, EdgeCost::kL2, 1);
  Edge* forced = grid.graph.Edges()[0];
  forced->AddPhiConstraint(true);
  const PrunedGraph pruned = Prune(grid.graph, grid.source(), grid.target(), true);
  for (const Edge* edge : pruned.edges) {
    EXPECT_TRUE(edge == forced || &edge->u() != &grid.source()) << edge->name();
  }
  forced->AddPhiConstraint(false);
  for (const Edge* edge : Prune(grid.graph, grid.source(), grid.target(), true).edges) {
    EXPECT_NE(edge, forced);
  }
  forced->ClearPhiConstraints();
  for (Edge* edge : grid.graph.Edges()) {
    if (&edge->u() == &grid.target()) edge->AddPhiConstraint(true);
  }
  EXPECT_NE(Prune(grid.graph, grid.source(), grid.target(), true).why_no_path, "");
}

}  // namespace
}  // namespace switchyard::testing
