// The graph as a container: names, removal, mistakes, copies.
#include <gtest/gtest.h>

#include "core/gcs/pruning.hpp"
#include "tests/gcs/grid.hpp"

namespace switchyard::testing {
namespace {

using Edge = GraphOfConvexSets::Edge;
using Transcription = GraphOfConvexSets::Transcription;

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
  EXPECT_EQ(grid.vertices[1]->outgoing_edges().size(), 2u);
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
  const auto clone = grid.graph.Clone();
  ASSERT_EQ(clone->num_edges(), grid.graph.num_edges());
  const Edge* edge = clone->Edges()[5];
  const Edge* original = grid.graph.Edges()[5];
  EXPECT_EQ(edge->name(), original->name());
  EXPECT_EQ(edge->costs()[0].binding.evaluator(), original->costs()[0].binding.evaluator());
  EXPECT_EQ(edge->costs()[0].binding.variables()[0], edge->xu()[0]);
  EXPECT_NE(edge->xu()[0], original->xu()[0]);
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
