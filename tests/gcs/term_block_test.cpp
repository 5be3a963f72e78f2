// What vertices and edges ask for: written once for equal terms, anew where anything changes.
#include "core/gcs/term_block.hpp"

#include <gtest/gtest.h>

#include <string>

#include "switchyard/error.hpp"
#include "switchyard/sets/hyperrectangle.hpp"
#include "switchyard/sets/vpolytope.hpp"

namespace switchyard::testing {
namespace {

using Graph = GraphOfConvexSets;
using Transcription = Graph::Transcription;

VectorXDecisionVariable EndsOf(const Graph::Edge& edge) {
  VectorXDecisionVariable x(edge.xu().size() + edge.xv().size());
  x << edge.xu(), edge.xv();
  return x;
}

std::shared_ptr<LinearConstraint> Equal() {
  return std::make_shared<LinearConstraint>(Eigen::RowVector2d(1, -1), Eigen::VectorXd::Zero(1),
                                            Eigen::VectorXd::Zero(1));
}

/// Three intervals in a row, [0, 1], [1, 2], [2, 3], and edges from each to the next.
struct Row {
  Row() {
    for (int k = 0; k < 3; ++k) {
      v[k] = graph.AddVertex(
          Hyperrectangle(Eigen::VectorXd::Constant(1, k), Eigen::VectorXd::Constant(1, k + 1)));
    }
    for (int k = 0; k < 2; ++k) e[k] = graph.AddEdge(v[k], v[k + 1]);
  }
  Graph graph;
  Graph::Vertex* v[3];
  Graph::Edge* e[2];
  TermBlocks blocks{Transcription::kRelaxation};
};

TEST(TermBlock, SumsCostsAndStacksRowsOfItsTerms) {
  TermBlock block;
  block.num_places = 4;
  Perspective linear;
  linear.cone.dim = 2;
  linear.cone.A = Csc(0, 3);
  linear.cone.F = Csc(0, 3);
  linear.cost = {7, 1, 2};  // of t, x
  block.Add(linear, {1, 3});
  block.Add(linear, {3, 2});
  EXPECT_EQ(block.cost, (std::vector<double>{14, 1, 2, 3}));
  EXPECT_EQ(block.rows.count(), 0);
  const Perspective norm =
      PerspectiveOf(L1NormCost(Eigen::Matrix2d::Identity(), Eigen::Vector2d(1, 0)));
  for (int k = 1; k <= 2; ++k) {
    block.Add(norm, {1, 2});
    EXPECT_EQ(block.num_own, k * norm.cone.num_aux);
    EXPECT_EQ(block.rows.count(), k * norm.cone.A.rows);
    EXPECT_EQ(block.lower.size(), static_cast<std::size_t>(block.rows.count()));
  }
  for (const std::int32_t place : block.rows.place) {
    EXPECT_TRUE(place == 0 || place == 1 || place == 2 || place >= 4);
    EXPECT_LT(place, 4 + block.num_own);
  }
}

TEST(TermBlock, RowsOfAMatrixLoseTheirZeros) {
  Csc by_columns(2, 2);
  by_columns.start = {0, 2, 3};
  by_columns.row = {0, 1, 1};
  by_columns.value = {5, 0, 6};
  PlacedRows rows;
  rows.Append(by_columns, {9, 4});
  rows.Append(by_columns, {9, 4});
  EXPECT_EQ(rows.count(), 4);
  EXPECT_EQ(rows.place, (std::vector<std::int32_t>{9, 4, 9, 4}));
  EXPECT_EQ(rows.value, (std::vector<double>{5, 6, 5, 6}));
}

TEST(TermBlocks, AreOneForEqualTermsAtEqualPlaces) {
  Row row;
  const auto cost =
      std::make_shared<L1NormCost>(Eigen::RowVector2d(-1, 1), Eigen::VectorXd::Zero(1));
  const auto backward = Binding<Cost>(
      cost, (VectorXDecisionVariable(2) << row.e[1]->xv(), row.e[1]->xu()).finished());
  row.e[0]->AddCost(Binding<Cost>(cost, EndsOf(*row.e[0])));
  row.e[1]->AddCost(Binding<Cost>(cost, EndsOf(*row.e[1])));
  const TermBlock* first = row.blocks.Of(*row.e[0], false).terms;
  EXPECT_EQ(row.blocks.Of(*row.e[1], false).terms, first);
  row.e[1]->AddCost(backward);
  EXPECT_NE(row.blocks.Of(*row.e[1], false).terms, first);
  EXPECT_EQ(row.blocks.Of(*row.e[0], false).terms, first);
}

TEST(TermBlocks, AreOthersAfterACoefficientOrATermHasChanged) {
  Row row;
  const auto cost = std::make_shared<LinearCost>(Eigen::Vector2d(1, 2), 3);
  row.e[0]->AddCost(Binding<Cost>(cost, EndsOf(*row.e[0])));
  EXPECT_EQ(row.blocks.Of(*row.e[0], false).terms->cost, (std::vector<double>{3, 1, 2}));
  cost->UpdateCoefficients(Eigen::Vector2d(4, 5), 6);
  EXPECT_EQ(row.blocks.Of(*row.e[0], false).terms->cost, (std::vector<double>{6, 4, 5}));
  row.v[0]->AddConstraint(Binding<Constraint>(
      std::make_shared<LinearConstraint>(Eigen::VectorXd::Ones(1).transpose(),
                                         Eigen::VectorXd::Constant(1, -kInfinity),
                                         Eigen::VectorXd::Constant(1, 0.5)),
      row.v[0]->x()));
  EXPECT_EQ(row.blocks.Of(*row.v[0]).terms->rows.count(), 1);
}

TEST(TermBlocks, FixedCoordinatesFollowTheBoundsOfARow) {
  Row row;
  const auto equal = Equal();
  for (Graph::Edge* edge : row.e) edge->AddConstraint(Binding<Constraint>(equal, EndsOf(*edge)));
  const auto values = [&](int k) {
    std::vector<double> all;
    for (const FixedCoordinate& c : *row.blocks.Of(*row.e[k], false).fixed[0]) {
      all.push_back(c.value);
    }
    return all;
  };
  EXPECT_EQ(values(0), (std::vector<double>{1, 1}));
  EXPECT_EQ(values(1), (std::vector<double>{2, 2}));
  equal->UpdateCoefficients(Eigen::RowVector2d(1, -1), Eigen::VectorXd::Constant(1, -1),
                            Eigen::VectorXd::Constant(1, 1));
  EXPECT_TRUE(values(0).empty());
  EXPECT_TRUE(values(1).empty());
}

TEST(TermBlocks, AHeadsRowsFixItsPointOnlyWhereThePathEndsThere) {
  Row row;
  row.v[1]->AddConstraint(Binding<Constraint>(
      std::make_shared<LinearConstraint>(Eigen::VectorXd::Ones(1).transpose(),
                                         Eigen::VectorXd::Constant(1, -kInfinity),
                                         Eigen::VectorXd::Constant(1, 1.0)),
      row.v[1]->x()));
  row.e[0]->AddConstraint(Binding<Constraint>(
      std::make_shared<LinearConstraint>(Eigen::RowVector2d(1, 1), Eigen::VectorXd::Zero(1),
                                         Eigen::VectorXd::Constant(1, kInfinity)),
      EndsOf(*row.e[0])));
  EXPECT_TRUE(row.blocks.Of(*row.e[0], false).fixed[0]->empty());
  ASSERT_EQ(row.blocks.Of(*row.e[0], true).fixed[1]->size(), 1u);
  EXPECT_EQ(row.blocks.Of(*row.e[0], true).fixed[1]->front().place, 1);
  EXPECT_TRUE(row.blocks.Of(*row.e[0], false).fixed[0]->empty());
}

TEST(TermBlocks, CountOnlyTermsOfTheirTranscription) {
  Row row;
  const auto cost = std::make_shared<LinearCost>(Eigen::Vector2d(1, 2), 3);
  row.e[0]->AddCost(Binding<Cost>(cost, EndsOf(*row.e[0])), {Transcription::kMIP});
  EXPECT_TRUE(row.blocks.Of(*row.e[0], false).terms->cost.empty());
  TermBlocks whole(Transcription::kMIP);
  EXPECT_FALSE(whole.Of(*row.e[0], false).terms->cost.empty());
}

TEST(TermBlocks, ShareTheConeOfASharedSetWithBoxesOfItsOwnVariables) {
  Graph graph;
  const auto set = std::make_shared<const VPolytope>(
      VPolytope((Eigen::MatrixXd(2, 3) << 0, 2, 0, 0, 0, 1).finished()));
  const Graph::Vertex* u = graph.AddVertex(std::shared_ptr<const ConvexSet>(set));
  const Graph::Vertex* v = graph.AddVertex(std::shared_ptr<const ConvexSet>(set));
  TermBlocks blocks(Transcription::kRelaxation);
  const TermBlock* membership = blocks.Of(*u).set;
  EXPECT_EQ(blocks.Of(*v).set, membership);
  EXPECT_EQ(membership->num_places, 3);
  ASSERT_EQ(membership->own_lower.size(), static_cast<std::size_t>(membership->num_own));
  for (std::size_t k = 0; k < membership->own_lower.size(); ++k) {
    EXPECT_LE(membership->own_lower[k], 0);
    EXPECT_GE(membership->own_upper[k], 0);
    EXPECT_LE(membership->own_upper[k] - membership->own_lower[k], 2.001);  // weights, or sums
  }
}

TEST(TermBlocks, NameTheOwnerOfATermWithoutAPerspective) {
  Row row;
  const auto concave =
      std::make_shared<QuadraticCost>(-Eigen::Matrix2d::Identity(), Eigen::Vector2d::Zero());
  row.e[1]->AddCost(Binding<Cost>(concave, EndsOf(*row.e[1])));
  try {
    row.blocks.Of(*row.e[1], false);
    FAIL() << "a concave cost was taken";
  } catch (const InvalidArgument& why) {
    EXPECT_NE(std::string(why.what()).find(row.e[1]->name()), std::string::npos) << why.what();
  }
  // The refusal leaves nothing behind: it is refused again, and the others are not.
  EXPECT_THROW(row.blocks.Of(*row.e[1], false), InvalidArgument);
  EXPECT_EQ(row.blocks.Of(*row.e[0], false).terms->cost.size(), 0u);
}

}  // namespace
}  // namespace switchyard::testing
