// A program of which blocks are copied from the one before is the program written afresh.
#include <gtest/gtest.h>

#include "core/gcs/transcription.hpp"
#include "switchyard/gcs/graph_of_convex_sets.hpp"
#include "tests/gcs/random_graphs.hpp"

namespace switchyard::testing {
namespace {

using Transcription = GraphOfConvexSets::Transcription;

void ExpectSame(const Csc& a, const Csc& b) {
  EXPECT_EQ(a.rows, b.rows);
  EXPECT_EQ(a.cols, b.cols);
  EXPECT_EQ(a.start, b.start);
  EXPECT_EQ(a.row, b.row);
  EXPECT_EQ(a.value, b.value);
}

template <class Record>
const Record& Hint(const ProblemData& d, std::size_t at) {
  return *static_cast<const Record*>(d.hints[at].data);
}

void ExpectSame(const sy_csc* a, const sy_csc* b) { ExpectSame(Csc(*a), Csc(*b)); }

void ExpectSameHints(const ProblemData& a, const ProblemData& b, std::size_t arcs) {
  const auto list = [](const std::int32_t* first, std::size_t count) {
    return std::vector<std::int32_t>(first, first + count);
  };
  const auto &p = Hint<sy_blocks>(a, 0), &q = Hint<sy_blocks>(b, 0);
  ASSERT_EQ(p.num_blocks, q.num_blocks);
  const auto blocks = static_cast<std::size_t>(p.num_blocks);
  EXPECT_EQ(list(p.x, a.q.size()), list(q.x, b.q.size()));
  EXPECT_EQ(list(p.row, a.row_lower.size()), list(q.row, b.row_lower.size()));
  EXPECT_EQ(list(p.cone, a.cones.size()), list(q.cone, b.cones.size()));
  const auto &s = Hint<sy_paths>(a, 1), &t = Hint<sy_paths>(b, 1);
  EXPECT_EQ(list(s.flow, arcs), list(t.flow, arcs));
  EXPECT_EQ(list(s.scale, blocks), list(t.scale, blocks));
  EXPECT_EQ(list(s.arc_in, blocks), list(t.arc_in, blocks));
  EXPECT_EQ(list(s.arc_out, blocks), list(t.arc_out, blocks));
  ExpectSame(&s.tail_point, &t.tail_point);
  ExpectSame(&s.head_point, &t.head_point);
}

/// Writes the program of the graph as it is, with and without what was written before.
void CheckAgain(const RandomGraph& g, const GraphOfConvexSets::Vertex& source,
                const GraphOfConvexSets::Vertex& target, Transcription as,
                WrittenProgram& written) {
  const PrunedGraph pruned = Prune(g.graph, source, target, true);
  if (!pruned.why_no_path.empty() || &source == &target) return;
  const GcsTranscription again(pruned, as, true, &written), fresh(pruned, as);
  const ProblemData &a = again.problem().data(), &b = fresh.problem().data();
  EXPECT_EQ(a.q, b.q);
  EXPECT_EQ(a.x_lower, b.x_lower);
  EXPECT_EQ(a.x_upper, b.x_upper);
  EXPECT_EQ(a.integer, b.integer);
  ExpectSame(a.A, b.A);
  EXPECT_EQ(a.row_lower, b.row_lower);
  EXPECT_EQ(a.row_upper, b.row_upper);
  ExpectSame(a.F, b.F);
  EXPECT_EQ(a.g, b.g);
  ASSERT_EQ(a.cones.size(), b.cones.size());
  for (std::size_t c = 0; c < a.cones.size(); ++c) {
    EXPECT_EQ(a.cones[c].kind, b.cones[c].kind);
    EXPECT_EQ(a.cones[c].dim, b.cones[c].dim);
    EXPECT_EQ(a.cones[c].parameter, b.cones[c].parameter);
  }
  ExpectSameHints(a, b, pruned.edges.size());
  for (std::size_t e = 0; e < pruned.edges.size(); ++e) EXPECT_EQ(again.slack(e), fresh.slack(e));
}

void CheckChanges(unsigned seed, Transcription as) {
  SCOPED_TRACE("graph " + std::to_string(seed));
  RandomGraph g(seed);
  WrittenProgram written(as);
  const auto any = [&] {
    return g.vertices[static_cast<std::size_t>(
        g.draw.Integer(0, static_cast<int>(g.vertices.size()) - 1))];
  };
  const auto check = [&] {
    CheckAgain(g, g.source(), g.target(), as, written);
    CheckAgain(g, g.source(), *any(), as, written);
    CheckAgain(g, *any(), g.target(), as, written);
  };
  check();
  g.ChangeCosts();
  check();
  for (GraphOfConvexSets::Edge* edge : g.graph.Edges()) {
    if (g.draw.Chance(0.15)) edge->AddPhiConstraint(g.draw.Chance(0.2));
  }
  check();
  g.graph.ClearAllPhiConstraints();
  if (g.graph.num_edges() > 0) g.graph.RemoveEdge(g.graph.Edges().front());
  g.graph.AddEdge(g.vertices.front(), g.vertices[1]);
  any()->AddCost(2.5);
  check();
}

TEST(WrittenProgram, IsTheOneWrittenAfreshWhateverChanged) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    CheckChanges(seed, Transcription::kRelaxation);
    if (HasFailure()) return;
  }
}

TEST(WrittenProgram, IsTheOneWrittenAfreshForTheIntegerProgramToo) {
  for (unsigned seed = 300; seed < 400; ++seed) {
    CheckChanges(seed, Transcription::kMIP);
    if (HasFailure()) return;
  }
}

}  // namespace
}  // namespace switchyard::testing
