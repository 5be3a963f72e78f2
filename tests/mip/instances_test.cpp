// Public mixed-integer programs and graphs, where they stand beside the source tree: solved to the
// gap, with a point that holds in the user's program and a bound that no known optimum contradicts.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <sstream>
#include <string>

#include "switchyard/gcs/shortest_path.hpp"
#include "switchyard/io/graph.hpp"
#include "switchyard/io/read.hpp"
#include "switchyard/solve/solve.hpp"
#include "tests/nonlinear/backends.hpp"

namespace switchyard::testing {
namespace {

constexpr const char* kBackend = "branch-and-bound";
constexpr double kGap = 1e-4;
constexpr double kHolds = 1e-5;  // violation, absolute

const std::filesystem::path kRoot = SWITCHYARD_INSTANCES;

/// A table of comma-separated values: a key made of the first `keys` columns, to column `value`.
std::map<std::string, std::string> Table(const char* file, int keys, int value) {
  std::map<std::string, std::string> table;
  std::ifstream stream(kRoot / file);
  for (std::string line; std::getline(stream, line);) {
    std::istringstream row(line);
    std::string key;
    int column = 0;
    for (std::string cell; std::getline(row, cell, ','); ++column) {
      if (column < keys) key += (column > 0 ? "/" : "") + cell;
      if (column == value) table[key] = cell;
    }
  }
  return table;
}

SolverOptions ToTheGap() {
  SolverOptions options;
  options.relative_gap = kGap;
  options.time_limit = 60;
  options.threads = 2;
  return options;
}

/// Between a point and a bound that are `sign` times minimized: both are on their sides of what is
/// known, which is itself known to the gap, and within the gap of each other.
void ExpectEnclosed(const MathematicalProgramResult& result, double known, double sign) {
  ASSERT_EQ(result.termination, Termination::kOptimal)
      << result.message << (result.notes.empty() ? "" : "; " + result.notes.back());
  ASSERT_EQ(result.primal, PointKind::kFeasible);
  const double slack = kGap * std::abs(known) + 1e-6;
  EXPECT_LE(sign * result.bound, sign * known + slack);
  EXPECT_GE(sign * result.objective, sign * known - slack);
  EXPECT_LE(sign * (result.objective - result.bound), kGap * std::abs(result.objective) + 1e-6);
  EXPECT_LE(std::max({result.violation.bounds, result.violation.rows, result.violation.cones,
                      result.violation.integrality}),
            kHolds);
}

void Tell(const char* name, const MathematicalProgramResult& result) {
  std::cout << name << ": " << result.objective << ", bound " << result.bound << ", "
            << result.nodes << " nodes, " << result.seconds.total << " s\n";
}

std::string NameOfTest(const ::testing::TestParamInfo<const char*>& of) {
  std::string name = of.param;
  std::replace_if(
      name.begin(), name.end(),
      [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; }, '_');
  return name;
}

class Programs : public ::testing::TestWithParam<const char*> {};

TEST_P(Programs, AreSolvedToTheGap) {
  SKIP_WITHOUT(kBackend);
  const std::string name = GetParam();
  const std::filesystem::path path = kRoot / (name + ".gz");
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no " << path << " beside the source tree";
  const auto program = ReadProgram(path.string());
  const auto result = SolverInterface(kBackend, Built()).Solve(*program, std::nullopt, ToTheGap());
  Tell(GetParam(), result);
  const double known = std::stod(Table("reference.csv", 2, 2).at(name));
  ExpectEnclosed(result, known, program->objective_sense() == ObjectiveSense::kMaximize ? -1 : 1);
  // The user's own look at the point.
  EXPECT_TRUE(result.GetInfeasibleConstraintNames(*program, kHolds).empty());
}

INSTANTIATE_TEST_SUITE_P(Small, Programs,
                         ::testing::Values("milp/flugpl.mps", "milp/semicon1.mps", "milp/rgn.mps",
                                           "milp/gt2.mps", "misocp/estein4_A.cbf",
                                           "misocp/estein4_C.cbf", "misocp/classical_20_0.cbf",
                                           "misocp/pp-n10-d10.cbf", "misocp/clay0203h.cbf",
                                           "misocp/robust_30_0.cbf"),
                         NameOfTest);

class Graphs : public ::testing::TestWithParam<const char*> {};

TEST_P(Graphs, HaveAShortestPathThatIsProven) {
  SKIP_WITHOUT(kBackend);
  const std::string name = GetParam();
  const std::filesystem::path path = kRoot / "gcs" / (name + ".json.gz");
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no " << path << " beside the source tree";
  const GraphProblem problem = ReadGraph(path.string());
  const SolverInterface solver(kBackend, Built());
  GraphOfConvexSetsOptions options;
  options.convex_relaxation = false;
  options.solver = &solver;
  options.solver_options = ToTheGap();
  const ShortestPath found =
      FindShortestPath(*problem.graph, *problem.source, *problem.target, options, Built());
  Tell(GetParam(), found.result);
  const double known = std::stod(Table("gcs_reference.csv", 1, 2).at(name));
  ExpectEnclosed(found.result, known, 1);
  ASSERT_FALSE(found.edges.empty());
  ASSERT_EQ(found.points.size(), found.edges.size() + 1);
  const GraphOfConvexSets::Vertex* at = problem.source;
  double cost = at->GetSolutionCost(found.result).value_or(0);
  EXPECT_TRUE(at->set().PointInSet(found.points.front(), kHolds));
  for (std::size_t k = 0; k < found.edges.size(); ++k) {
    EXPECT_EQ(&found.edges[k]->u(), at);
    at = &found.edges[k]->v();
    EXPECT_TRUE(at->set().PointInSet(found.points[k + 1], kHolds)) << at->name();
    cost += found.edges[k]->GetSolutionCost(found.result).value_or(0) +
            at->GetSolutionCost(found.result).value_or(0);
  }
  EXPECT_EQ(at, problem.target);
  EXPECT_NEAR(cost, found.result.objective, 1e-6 * (1 + std::abs(cost)));
}

INSTANTIATE_TEST_SUITE_P(Small, Graphs,
                         ::testing::Values("circles_3x3", "helicopter_30", "random_nom_length_0",
                                           "random_nom_squared_0", "iiwa14_TS_CS"),
                         NameOfTest);

}  // namespace
}  // namespace switchyard::testing
