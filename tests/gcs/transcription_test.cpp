// The lean program: what it has, what it leaves out, and that its hints say the truth.
#include "core/gcs/transcription.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/solve/check.hpp"
#include "tests/gcs/grid.hpp"

namespace switchyard::testing {
namespace {

using Transcription = GraphOfConvexSets::Transcription;

struct Written {
  explicit Written(const Grid& grid, Transcription as = Transcription::kRelaxation,
                   bool transitions = true)
      : pruned(Prune(grid.graph, grid.source(), grid.target(), true)),
        program(pruned, as, transitions) {}
  [[nodiscard]] const ProblemData& data() const { return program.problem().data(); }

  PrunedGraph pruned;
  GcsTranscription program;
};

template <class Record>
const Record& HintOf(const ProblemData& d, const std::string& id) {
  const sy_hint* hint = d.hints;
  while (hint->id != nullptr && hint->id != id) ++hint;
  return *static_cast<const Record*>(hint->data);
}

TEST(Transcription, HasNoRowsThatItDoesNotNeed) {
  const Grid grid(3, EdgeCost::kLinear, 1);
  const Written w(grid, Transcription::kRelaxation, false);
  // 20 useful edges, 7 boxes: a linear cost has neither variables nor rows.
  std::int32_t ends = 0;
  for (std::size_t a = 0; a < w.pruned.edges.size(); ++a) {
    ends += (w.pruned.tail[a] != w.pruned.source ? 1 : 0);
    ends += (w.pruned.head[a] != w.pruned.target ? 1 : 0);
  }
  EXPECT_EQ(w.data().num_vars, 20 + 2 * ends);
  EXPECT_EQ(w.data().num_rows(), 4 * ends + 9 + 7 + 2 * 7);  // sets, flow, degree, spatial
  EXPECT_EQ(w.data().num_cones(), 0);
}

TEST(Transcription, WritesTheSquaresOfAnEdgeInOneCone) {
  Grid grid(2, EdgeCost::kSquared, 1);
  for (GraphOfConvexSets::Edge* edge : grid.graph.Edges()) {
    VectorXDecisionVariable x(4);
    x << edge->xu(), edge->xv();
    edge->AddCost(Binding<Cost>(grid.CostOf(EdgeCost::kSquared), x));
  }
  const Written w(grid);
  EXPECT_EQ(w.data().num_cones(), static_cast<std::int32_t>(w.pruned.edges.size()));
  for (const sy_cone& cone : w.data().cones) {
    EXPECT_EQ(cone.kind, SY_CONE_ROTATED);
    EXPECT_EQ(cone.dim, 2 + 2 + 2);
  }
}

TEST(Transcription, SaysTheTruthInItsBlocks) {
  for (const EdgeCost kind : {EdgeCost::kL1, EdgeCost::kL2, EdgeCost::kSquared}) {
    const Grid grid(3, kind, 2, true);
    const Written w(grid, Transcription::kRelaxation, false);
    const ProblemData& d = w.data();
    const auto& blocks = HintOf<sy_blocks>(d, "sy.blocks/1");
    const auto& paths = HintOf<sy_paths>(d, "sy.paths/1");
    ASSERT_EQ(blocks.num_blocks, static_cast<std::int32_t>(w.pruned.edges.size()));
    std::vector<std::int32_t> cone_of_row;
    for (std::int32_t c = 0; c < d.num_cones(); ++c) {
      cone_of_row.insert(cone_of_row.end(),
                         static_cast<std::size_t>(d.cones[static_cast<std::size_t>(c)].dim), c);
    }
    for (std::int32_t j = 0; j < d.num_vars; ++j) {
      const auto column = static_cast<std::size_t>(j);
      const std::int32_t own = blocks.x[j];
      EXPECT_GE(own, 0);
      for (auto k = static_cast<std::size_t>(d.A.start[column]);
           k < static_cast<std::size_t>(d.A.start[column + 1]); ++k) {
        const std::int32_t of_row = blocks.row[d.A.row[k]];
        EXPECT_TRUE(of_row == -1 || of_row == own);
        if (of_row == -1) continue;
        for (const double side : {d.row_lower[static_cast<std::size_t>(d.A.row[k])],
                                  d.row_upper[static_cast<std::size_t>(d.A.row[k])]}) {
          EXPECT_TRUE(side == 0 || std::isinf(side));  // a scaled block is a cone
        }
      }
      for (auto k = static_cast<std::size_t>(d.F.start[column]);
           k < static_cast<std::size_t>(d.F.start[column + 1]); ++k) {
        EXPECT_EQ(blocks.cone[cone_of_row[static_cast<std::size_t>(d.F.row[k])]], own);
      }
    }
    for (const double g : d.g) EXPECT_EQ(g, 0);
    EXPECT_EQ(d.P.nonzeros(), 0);
    EXPECT_EQ(paths.tail_point.rows, d.num_vars);
    for (std::int32_t a = 0; a < paths.num_arcs; ++a) {
      EXPECT_EQ(blocks.x[paths.flow[a]], a);
      EXPECT_EQ(d.integer[static_cast<std::size_t>(paths.flow[a])], 1);
    }
  }
}

/// The point of a path: phi = 1 on it, ends at `points`, epigraphs at `epigraph` of each edge.
std::vector<double> PointOf(const Written& w,
                            const std::vector<const GraphOfConvexSets::Edge*>& path,
                            const std::vector<Eigen::VectorXd>& points, double epigraph) {
  std::vector<double> x(w.data().q.size(), 0.0);
  const auto& blocks = HintOf<sy_blocks>(w.data(), "sy.blocks/1");
  for (std::size_t k = 0; k < path.size(); ++k) {
    const auto place = std::find(w.pruned.edges.begin(), w.pruned.edges.end(), path[k]);
    const auto a = static_cast<std::size_t>(place - w.pruned.edges.begin());
    for (std::size_t j = 0; j < x.size(); ++j) {
      if (blocks.x[j] == static_cast<std::int32_t>(a)) x[j] = epigraph;
    }
    const auto& paths = HintOf<sy_paths>(w.data(), "sy.paths/1");
    const std::int32_t flow = w.program.flow(a);
    const auto put = [&](const sy_csc& of, const Eigen::VectorXd& point) {
      for (int i = 0; i < 2; ++i) {
        const std::int32_t j = of.row[of.start[2 * a + static_cast<std::size_t>(i)]];
        if (j != flow) x[static_cast<std::size_t>(j)] = point[i];
      }
    };
    put(paths.tail_point, points[k]);
    put(paths.head_point, points[k + 1]);
    x[static_cast<std::size_t>(flow)] = 1;
  }
  return x;
}

TEST(Transcription, HoldsAtAPathWithPointsInItsSetsAndNowhereElse) {
  const Grid grid(3, EdgeCost::kL2, 3);
  const Written w(grid, Transcription::kMIP, false);
  for (const auto& path : SimplePaths(grid.source(), grid.target())) {
    std::vector<Eigen::VectorXd> points = {*grid.source().set().MaybeGetPoint()};
    for (const auto* edge : path) points.push_back(*edge->v().set().MaybeGetFeasiblePoint());
    std::vector<double> x = PointOf(w, path, points, 10);
    EXPECT_LE(RelativeViolation(w.program.problem().view(), x), 1e-9);
    points[1] += Eigen::Vector2d(0, 3);  // leaves its set
    x = PointOf(w, path, points, 10);
    EXPECT_GT(RelativeViolation(w.program.problem().view(), x), 0.01);
  }
}

TEST(Transcription, BoxesHoldWhatTheRowsImply) {
  const Grid grid(3, EdgeCost::kL2, 3, true);
  const Written w(grid, Transcription::kRelaxation, false);
  const ProblemData& d = w.data();
  for (std::size_t a = 0; a < w.pruned.edges.size(); ++a) {
    const auto& paths = HintOf<sy_paths>(d, "sy.paths/1");
    const SetBox& box = w.pruned.edges[a]->u().set().bounding_box();
    for (int i = 0; i < 2; ++i) {
      const std::int32_t j =
          paths.tail_point.row[paths.tail_point.start[2 * a + static_cast<std::size_t>(i)]];
      if (j == w.program.flow(a)) continue;  // phi times the only value
      EXPECT_LE(d.x_lower[static_cast<std::size_t>(j)], std::min(0.0, box.lower[i]));
      EXPECT_GE(d.x_upper[static_cast<std::size_t>(j)], std::max(0.0, box.upper[i]));
    }
  }
}

TEST(Transcription, CountsOnlyTermsOfItsOwn) {
  Grid grid(2, EdgeCost::kLinear, 1);
  for (GraphOfConvexSets::Edge* edge : grid.graph.Edges()) {
    VectorXDecisionVariable x(4);
    x << edge->xu(), edge->xv();
    edge->AddCost(Binding<Cost>(grid.CostOf(EdgeCost::kL2), x), {Transcription::kRestriction});
  }
  EXPECT_EQ(Written(grid, Transcription::kRelaxation).data().num_cones(), 0);
}

}  // namespace
}  // namespace switchyard::testing
