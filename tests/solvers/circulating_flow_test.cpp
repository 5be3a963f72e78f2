// Path problems that graphs transcribe: restrictions to their paths, and relax-and-round where the
// relaxed flow goes both ways between vertices.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <regex>

#include "core/solve/check.hpp"
#include "solvers/rounding/restriction.hpp"
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
using rounding::PathProblem;
using ::testing::HasSubstr;

class CirculatingFlow : public ::testing::Test {
 protected:
  void SetUp() override {
    if (host_->Find("clarabel") == nullptr) GTEST_SKIP() << "clarabel was not built";
  }
  [[nodiscard]] static SetGrid Graph(unsigned seed) {
    return {4,
            4,
            {SetKind::kBox, SetKind::kPolyhedron, SetKind::kEllipsoid, SetKind::kPoint},
            gcs::EdgeCost::kSquared,
            seed,
            1.4};
  }
  static double BestOf(const SetGrid& graph) {
    double best = kInfinity;
    for (const auto& path : graph.Paths()) {
      const auto alone = graph.graph.SolveConvexRestriction(path);
      if (alone.is_success()) best = std::min(best, alone.objective);
    }
    return best;
  }
  std::unique_ptr<Host> host_ = HostWith({"clarabel"});
};

TEST_F(CirculatingFlow, TheRestrictionToAPathIsThatOfTheGraph) {
  for (const bool transitions : {true, false}) {
    const SetGrid graph(3, 3, {SetKind::kBox, SetKind::kEllipsoid, SetKind::kPoint},
                        gcs::EdgeCost::kSquared, 2);
    const Transcribed t(graph, transitions);
    const PathProblem whole(t.view());
    for (const auto& path : graph.Paths()) {
      const auto restriction = rounding::Restrict(whole, t.ArcsOf(path));
      ASSERT_EQ(restriction.contradiction, "");
      const Problem small(restriction.problem);
      const Solved solved = gcs::SolvedBy(*host_, small.view());
      ASSERT_EQ(solved.termination, SY_OPTIMAL);
      const double alone = graph.graph.SolveConvexRestriction(path).objective;
      EXPECT_NEAR(solved.objective, alone, 1e-5 * (1 + std::abs(alone)));
      const auto x = rounding::InWhole(whole, restriction, solved.x);
      EXPECT_LE(RelativeViolation(t.view(), x), kSupported);
      EXPECT_NEAR(Objective(t.view(), x.data()), solved.objective, 1e-9 * (1 + std::abs(alone)));
    }
  }
}

/// What the text says of cuts and rounds; 0, 0 where it says nothing.
std::pair<int, int> CutsIn(const std::string& text) {
  std::smatch found;
  if (!std::regex_search(text, found, std::regex("with (\\d+) cuts in (\\d+) rounds"))) return {};
  return {std::stoi(found[1]), std::stoi(found[2])};
}

TEST_F(CirculatingFlow, EndsWithABoundThatCutsHaveRaised) {
  int raised = 0;
  for (unsigned seed = 1; seed <= 8; ++seed) {
    const SetGrid graph = Graph(seed);
    const Transcribed t(graph, false);
    if (!t.pruned.why_no_path.empty()) continue;
    const double best = BestOf(graph), tolerance = 1e-5 * (1 + std::abs(best));
    const StrategyAnswer plain = RelaxAndRoundOn(*host_, t.view(), {"cut_rounds=0"});
    EXPECT_EQ(CutsIn(plain.text).first, 0) << plain.text;
    const double before = plain.result.relaxed;
    for (const std::vector<std::string>& options : {std::vector<std::string>{"cut_rounds=1"},
                                                    {"cut_rounds=1000"},
                                                    {"cut_rounds=1000", "hulls=1"}}) {
      const StrategyAnswer cut = RelaxAndRoundOn(*host_, t.view(), options);
      ASSERT_EQ(cut.status, SY_OK) << cut.error;
      EXPECT_GE(cut.result.relaxed, before - tolerance) << cut.text;
      EXPECT_LE(cut.result.bound, best + tolerance);
      EXPECT_GE(cut.result.objective, best - tolerance);
      ASSERT_EQ(cut.result.primal, SY_FEASIBLE) << cut.text;
      const auto [cuts, rounds] = CutsIn(cut.text);
      EXPECT_EQ(cuts > 0, rounds > 0) << cut.text;
      if (cut.result.relaxed > before + 10 * tolerance) {
        EXPECT_GT(cuts, 0) << cut.text;
        ++raised;
      }
    }
  }
  EXPECT_GT(raised, 0);
}

/// Diamonds in a row, every arc of cost 1: 2^count paths, all alike.
struct Diamonds {
  explicit Diamonds(int count) {
    const auto add = [&] {
      vertices.push_back(graph.AddVertex(
          Point(Eigen::VectorXd::Constant(1, static_cast<double>(vertices.size())))));
      return vertices.back();
    };
    const auto connect = [&](auto* u, auto* v) {
      graph.AddEdge(u, v)->AddCost(Binding<Cost>(
          std::make_shared<LinearCost>(Eigen::VectorXd(), 1.0), VectorXDecisionVariable()));
    };
    auto* at = add();
    for (int k = 0; k < count; ++k) {
      auto *up = add(), *down = add(), *next = add();
      for (auto* between : {up, down}) {
        connect(at, between);
        connect(between, next);
      }
      at = next;
    }
  }
  [[nodiscard]] const GraphOfConvexSets::Vertex& source() const { return *vertices.front(); }
  [[nodiscard]] const GraphOfConvexSets::Vertex& target() const { return *vertices.back(); }
  GraphOfConvexSets graph;
  std::vector<GraphOfConvexSets::Vertex*> vertices;
};

/// A front end that has no point on the first paths that it is asked for.
struct FrontEnd {
  int refuses, asked = 0;
  static sy_status Solve(void* context, const std::int32_t*, std::int32_t, const sy_control*,
                         sy_result* r, sy_error*) noexcept {
    auto& self = *static_cast<FrontEnd*>(context);
    const bool none = self.asked++ < self.refuses;
    r->termination = none ? SY_INFEASIBLE : SY_OPTIMAL;
    r->primal = none ? SY_NO_POINT : SY_FEASIBLE;
    r->objective = 1000;
    return SY_OK;
  }
};

TEST_F(CirculatingFlow, PathsWithoutAPointDoNotCountAmongThoseAskedFor) {
  const Diamonds diamonds(4);  // 16 paths; an interior point has flow on each
  for (const int refuses : {0, 3, 7}) {
    Transcribed t(diamonds);
    FrontEnd front_end{refuses};
    t.program.paths().context = &front_end;
    t.program.paths().solve_path = FrontEnd::Solve;
    const StrategyAnswer answer =
        RelaxAndRoundOn(*host_, t.view(), {"paths=4", "trials=1000", "flow_tolerance=0"});
    ASSERT_EQ(answer.status, SY_OK) << answer.error;
    std::smatch found;
    ASSERT_TRUE(
        std::regex_search(answer.text, found, std::regex("; (\\d+) of (\\d+) paths feasible")))
        << answer.text;
    const int feasible = std::stoi(found[1]), tried = std::stoi(found[2]);
    EXPECT_EQ(tried, front_end.asked);
    EXPECT_EQ(tried, feasible + refuses) << answer.text;
    EXPECT_GE(feasible, 4);
    EXPECT_LE(feasible, 8);  // detours of those
  }
}

TEST_F(CirculatingFlow, WhereNoPathHasAPointAllAreTriedOnce) {
  const Diamonds diamonds(3);
  Transcribed t(diamonds);
  FrontEnd front_end{1000000};
  t.program.paths().context = &front_end;
  t.program.paths().solve_path = FrontEnd::Solve;
  const StrategyAnswer answer =
      RelaxAndRoundOn(*host_, t.view(), {"paths=4", "trials=1000", "flow_tolerance=0"});
  EXPECT_EQ(answer.result.termination, SY_RESTRICTIONS_FAILED);
  EXPECT_THAT(answer.text, HasSubstr("; 0 of 8 paths feasible"));
  EXPECT_EQ(front_end.asked, 8);
}

}  // namespace
}  // namespace switchyard::test
