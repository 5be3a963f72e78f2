#include "solvers/mip/probing.hpp"

#include <gtest/gtest.h>

#include "tests/mip/random_mixed_problem.hpp"

namespace switchyard::testing {
namespace {

using mip::BinariesByConstraints;
using mip::Implication;
using mip::NodeBoxes;
using mip::Probe;
using mip::ProbingResult;
using mip::Propagator;
using mip::Workspace;

std::size_t At(std::int32_t i) { return static_cast<std::size_t>(i); }

/// Probing of a problem as it is.
struct Probed {
  explicit Probed(const sy_problem& problem, mip::ProbingOptions options = {})
      : propagator(problem), workspace(propagator), boxes(propagator.Bounds()) {
    options.record_implications = true;
    candidates = BinariesByConstraints(propagator, boxes);
    result = Probe(propagator, candidates, options, boxes, workspace);
  }

  Propagator propagator;
  Workspace workspace;
  NodeBoxes boxes;
  std::vector<std::int32_t> candidates;
  ProbingResult result;
};

TEST(Probing, KeepsEveryFeasiblePoint) {
  std::int32_t fixed = 0, tightened = 0, infeasible = 0;
  std::size_t implications = 0;
  for (unsigned seed = 0; seed < 2000; ++seed) {
    SCOPED_TRACE(seed);
    const RandomMixedProblem p(seed, true);
    const Probed probed(p.view(), {.cutoff = p.cutoff()});
    Random random(seed);
    const std::vector<Vector> points = p.Points(random);
    EXPECT_TRUE(probed.result.complete);
    EXPECT_EQ(probed.result.infeasible, bool(probed.boxes.contradiction()));
    if (probed.result.infeasible) {
      ++infeasible;
      EXPECT_TRUE(points.empty()) << probed.boxes.contradiction().Name();
      continue;
    }
    for (const Vector& x : points) {
      for (std::size_t j = 0; j < x.size(); ++j) {
        EXPECT_GE(x[j], probed.boxes.lower()[j]);
        EXPECT_LE(x[j], probed.boxes.upper()[j]);
      }
      for (const Implication& i : probed.result.implications) {
        EXPECT_TRUE(x[At(i.from)] != i.from_value || x[At(i.to)] == i.to_value);
      }
    }
    fixed += probed.result.fixed;
    tightened += probed.result.tightened;
    implications += probed.result.implications.size();
  }
  EXPECT_GT(fixed, 500);
  EXPECT_GT(tightened, 500);
  EXPECT_GT(infeasible, 50);
  EXPECT_GT(implications, 500U);
}

/// Rows as dense lines, each at least its side, over variables in [0, 1] of which the first
/// `binaries` are integers.
ProblemData AtLeast(const std::vector<Vector>& rows, const Vector& side, std::int32_t binaries) {
  ProblemData d;
  d.num_vars = static_cast<std::int32_t>(rows[0].size());
  Csc by_rows(d.num_vars, static_cast<std::int32_t>(rows.size()));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::int32_t j = 0; j < d.num_vars; ++j) {
      if (rows[i][At(j)] == 0) continue;
      by_rows.row.push_back(j);
      by_rows.value.push_back(rows[i][At(j)]);
    }
    by_rows.start[i + 1] = static_cast<std::int32_t>(by_rows.row.size());
  }
  d.A = Transpose(by_rows.View());
  d.row_lower = side;
  d.row_upper.assign(side.size(), kInfinity);
  d.q.assign(At(d.num_vars), 0.0);
  d.x_lower.assign(At(d.num_vars), 0.0);
  d.x_upper.assign(At(d.num_vars), 1.0);
  for (std::int32_t j = 0; j < d.num_vars; ++j) d.integer.push_back(j < binaries);
  return d;
}

TEST(Probing, TightensByWhatBothCasesSay) {  // y >= x/2 and y >= (1 - x)/2
  const Problem p(AtLeast({{-0.5, 1}, {0.5, 1}}, {0, 0.5}, 1));
  const Probed probed(p.view());
  EXPECT_NEAR(probed.boxes.lower(1), 0.5, 1e-12);
  EXPECT_LE(probed.boxes.lower(1), 0.5);
  EXPECT_EQ(probed.result.tightened, 1);
  EXPECT_EQ(probed.result.fixed, 0);
  EXPECT_FALSE(probed.boxes.IsFixed(0));
}

TEST(Probing, FixesByTheCaseThatIsLeft) {  // x = 1 calls for y >= 0.6 and y <= 0.4
  const Problem p(AtLeast({{-0.6, 1}, {-0.6, -1}}, {0, -1}, 1));
  const Probed probed(p.view());
  EXPECT_EQ(probed.boxes.upper(0), 0);
  EXPECT_EQ(probed.result.fixed, 1);
}

/// x = 0 calls for y > z and z > y, x = 1 for y = z = 1, which the last row forbids.
TEST(Probing, FindsThatNothingIsLeft) {
  const Problem p(
      AtLeast({{-1, 1, 1}, {1, 1, -1}, {1, -1, 1}, {-1, -1, -1}}, {0.5, 0.5, 0.5, -1.5}, 3));
  const Probed probed(p.view());
  EXPECT_TRUE(probed.result.infeasible);
  EXPECT_TRUE(probed.result.complete);
}

TEST(Probing, RecordsImplications) {  // x_0 <= x_1
  const Problem p(AtLeast({{-1, 1}}, {0}, 2));
  const Probed probed(p.view());
  ASSERT_EQ(probed.result.implications.size(), 2U);
  for (const Implication& i : probed.result.implications) {
    EXPECT_EQ(i.from_value, i.from == 0);
    EXPECT_EQ(i.to_value, i.from_value);
    EXPECT_EQ(i.from + i.to, 1);
  }
}

TEST(Probing, StopsWhereItsWorkIsDoneAndIsTheSameInEveryRun) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    const RandomMixedProblem p(seed, true);
    for (const std::int64_t work : {0, 60, 200}) {
      const Probed first(p.view(), {.work = work}), second(p.view(), {.work = work});
      EXPECT_EQ(first.boxes.lower(), second.boxes.lower());
      EXPECT_EQ(first.boxes.upper(), second.boxes.upper());
      EXPECT_EQ(first.result.probed, second.result.probed);
      EXPECT_EQ(first.workspace.work(), second.workspace.work());
      if (work == 0) {
        EXPECT_EQ(first.result.probed, 0);
        EXPECT_EQ(first.result.complete, first.candidates.empty() || first.result.infeasible);
      }
    }
    const Probed late(p.view(), {.seconds = 0});
    EXPECT_EQ(late.result.probed, 0);
  }
}

}  // namespace
}  // namespace switchyard::testing
