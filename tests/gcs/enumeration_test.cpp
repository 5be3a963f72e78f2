// Shortest paths through random graphs against every simple path. SWITCHYARD_RANDOM_GRAPHS=N makes
// it N graphs; N@k those from seed k on.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <iostream>

#include "switchyard/gcs/shortest_path.hpp"
#include "tests/gcs/every_path.hpp"
#include "tests/gcs/random_graphs.hpp"

namespace switchyard::testing {
namespace {

using Vertex = GraphOfConvexSets::Vertex;
using Edge = GraphOfConvexSets::Edge;
using Transcription = GraphOfConvexSets::Transcription;

// Before the process's own host is made.
[[maybe_unused]] const int set_before_main =
    setenv("SWITCHYARD_PLUGIN_PATH", SWITCHYARD_PLUGIN_FOLDER, 1);

constexpr std::size_t kMostPaths = 100;  // of a graph; those with more are not looked at

/// Of a cost or bound, relative where it is above 1.
double Within(double tolerance, double cost) { return tolerance * (1 + std::abs(cost)); }

struct Counts {
  int graphs = 0, without_path = 0, paths = 0, undecided = 0;
  int searches = 0, cut = 0, optimal = 0;  // of relaxations: those with cuts
  int whole = 0, cycles = 0;               // of integer programs: solved again for a cycle
};

/// Is a term of `as` always one of `other`?
bool Counted(const GraphOfConvexSets& graph, Transcription as, Transcription other) {
  const auto all = [&](const auto& terms) {
    return std::all_of(terms.begin(), terms.end(), [&](const auto& term) {
      return !term.in.contains(as) || term.in.contains(other);
    });
  };
  const auto vertices = graph.Vertices();
  const auto edges = graph.Edges();
  return std::all_of(vertices.begin(), vertices.end(),
                     [&](const Vertex* v) { return all(v->costs()) && all(v->constraints()); }) &&
         std::all_of(edges.begin(), edges.end(),
                     [&](const Edge* e) { return all(e->costs()) && all(e->constraints()); });
}

bool SameTerms(const GraphOfConvexSets& graph, Transcription as) {
  return Counted(graph, as, Transcription::kRestriction) &&
         Counted(graph, Transcription::kRestriction, as);
}

/// What all of a result's costs add up to.
double SumOfCosts(const GraphOfConvexSets& graph, const MathematicalProgramResult& result) {
  double sum = 0;
  for (const Vertex* v : graph.Vertices()) sum += v->GetSolutionCost(result).value_or(0);
  for (const Edge* e : graph.Edges()) sum += e->GetSolutionCost(result).value_or(0);
  return sum;
}

/// The largest violation, by the path's points, of its sets and the constraints of its restriction.
double ViolationOf(const ShortestPath& found) {
  double worst = 0;
  const auto see = [&](const auto& element) {
    for (const auto& c : element.GetConstraints({Transcription::kRestriction})) {
      const Eigen::VectorXd x = found.result.GetSolution(c.variables());
      worst = std::max(worst, c.evaluator()->Violation(x));
    }
  };
  std::vector<const Vertex*> vertices = {&found.edges.front()->u()};
  for (const Edge* edge : found.edges) vertices.push_back(&edge->v());
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    worst = std::max(worst, vertices[k]->set().Violation(found.points[k]));
    see(*vertices[k]);
  }
  for (const Edge* edge : found.edges) see(*edge);
  return worst;
}

/// What holds of every answer with a path.
void CheckPath(const RandomGraph& g, const EveryPath& every, const ShortestPath& found) {
  ASSERT_FALSE(found.edges.empty());
  const double cost = every.CostOf(found.edges);
  ASSERT_FALSE(std::isnan(cost)) << "its restriction has no point";
  EXPECT_NEAR(found.result.objective, cost, Within(1e-6, cost));
  EXPECT_GE(found.result.objective, every.best() - Within(1e-6, every.best()));
  EXPECT_NEAR(SumOfCosts(g.graph, found.result), found.result.objective, Within(1e-7, cost));
  EXPECT_LE(ViolationOf(found), 1e-5);
  EXPECT_EQ(
      g.graph.GetSolutionPath(found.edges.front()->u(), found.edges.back()->v(), found.result),
      found.edges);
}

void CheckSearch(const RandomGraph& g, const EveryPath& every, const ShortestPath& found) {
  SCOPED_TRACE(std::string(to_string(found.result.termination)) + ": " + found.result.message);
  if (std::isfinite(found.result.bound)) {
    EXPECT_LE(found.result.bound, every.best() + Within(1e-6, every.best()));
  }
  switch (found.result.termination) {
    case Termination::kOptimal:
      EXPECT_LE(found.result.objective, every.best() + 2e-4 * std::abs(every.best()) + 1e-6);
      break;
    case Termination::kInfeasible:
      EXPECT_FALSE(every.any());
      break;
    case Termination::kLocallyOptimal:
    case Termination::kRestrictionsFailed:
    case Termination::kNoPath:
      break;
    default:
      ADD_FAILURE() << "no such end";
  }
  if (found.result.primal == PointKind::kFeasible) CheckPath(g, every, found);
}

void CheckRelaxation(const RandomGraph& g, const EveryPath& every, const ShortestPath& found) {
  SCOPED_TRACE(std::string(to_string(found.result.termination)) + ": " + found.result.message);
  const bool relaxes = Counted(g.graph, Transcription::kRelaxation, Transcription::kRestriction);
  if (found.result.termination == Termination::kInfeasible) {
    EXPECT_FALSE(relaxes && every.any());
    return;
  }
  EXPECT_EQ(found.result.termination, Termination::kOptimal);
  if (std::isfinite(found.result.bound)) {
    EXPECT_LE(found.result.bound, every.best() + Within(1e-6, every.best()));
  }
  if (SameTerms(g.graph, Transcription::kRelaxation)) {
    EXPECT_LE(found.relaxation_cost, every.best() + Within(1e-5, every.best()));
  }
  if (!SameTerms(g.graph, Transcription::kRelaxation)) return;
  // A vertex's cost is of the mean of what comes by its transitions: not more than their sum.
  EXPECT_LE(SumOfCosts(g.graph, found.result),
            found.relaxation_cost + Within(1e-4, found.relaxation_cost));
}

std::vector<std::pair<std::string, GraphOfConvexSetsOptions>> Ways() {
  const SolverId strategy("org.switchyard.relax-and-round");
  std::vector<std::pair<std::string, GraphOfConvexSetsOptions>> ways(5);
  ways[0].first = "as it comes";
  ways[1].first = "hulls";
  ways[1].second.solver_options.SetOption(strategy, "hulls", 1);
  ways[2].first = "no cuts";
  ways[2].second.solver_options.SetOption(strategy, "cut_rounds", 0);
  ways[2].second.rounding_seed = 7;
  static const SolverInterface clarabel("clarabel");
  if (clarabel.available()) ways[2].second.solver = &clarabel;
  ways[3].first = "all edges";
  ways[3].second.preprocessing = false;
  ways[3].second.max_rounded_paths = 3;
  ways[3].second.rounding_seed = 11;
  ways[4].first = "the relaxation alone";
  ways[4].second.max_rounded_paths = 0;
  for (auto& way : ways) way.second.parallelism = Parallelism::None();
  return ways;
}

void CheckWhole(const RandomGraph& g, const EveryPath& every, const char* backend, Counts& counts) {
  if (Host::Default().Find(backend) == nullptr) return;
  SCOPED_TRACE(backend);
  const SolverInterface solver(backend);
  GraphOfConvexSetsOptions options;
  options.convex_relaxation = false;
  options.solver = &solver;
  options.parallelism = Parallelism::None();
  options.solver_options.relative_gap = 0;
  const ShortestPath found = FindShortestPath(g.graph, g.source(), g.target(), options);
  ++counts.whole;
  counts.cycles += found.cycle_rounds > 0 ? 1 : 0;
  CheckSearch(g, every, found);
  if (!SameTerms(g.graph, Transcription::kMIP)) return;
  const bool optimal = found.result.termination == Termination::kOptimal;
  EXPECT_EQ(optimal, every.any()) << to_string(found.result.termination) << found.result.message;
  if (!optimal) return;
  EXPECT_NEAR(found.result.objective, every.best(), Within(1e-6, every.best()));
}

/// A search that was made before says what a new one does.
void CheckSame(ShortestPathSearch& search, const RandomGraph& g, const Vertex& source,
               const Vertex& target, const GraphOfConvexSetsOptions& options) {
  const ShortestPath again = search.Find(source, target, options);
  const ShortestPath fresh = FindShortestPath(g.graph, source, target, options);
  EXPECT_EQ(again.result.termination, fresh.result.termination);
  EXPECT_EQ(again.result.message.empty(), fresh.result.message.empty());
  EXPECT_EQ(again.edges, fresh.edges);
  EXPECT_EQ(again.edges_after, fresh.edges_after);
  ASSERT_EQ(std::isnan(again.result.objective), std::isnan(fresh.result.objective));
  if (!std::isnan(fresh.result.objective)) {
    EXPECT_NEAR(again.result.objective, fresh.result.objective,
                Within(1e-9, fresh.result.objective));
  }
  if (std::isfinite(fresh.result.bound)) {
    EXPECT_NEAR(again.result.bound, fresh.result.bound, Within(1e-9, fresh.result.bound));
  }
}

void CheckSearchesAgain(RandomGraph& g, const GraphOfConvexSetsOptions& options) {
  ShortestPathSearch search(g.graph);
  CheckSame(search, g, g.source(), g.target(), options);
  g.ChangeCosts();
  CheckSame(search, g, g.source(), g.target(), options);
  const auto any = [&] {
    return g.vertices[static_cast<std::size_t>(
        g.draw.Integer(0, static_cast<int>(g.vertices.size()) - 1))];
  };
  CheckSame(search, g, *any(), *any(), options);
  for (Edge* edge : g.graph.Edges()) {
    if (g.draw.Chance(0.15)) edge->AddPhiConstraint(false);
  }
  CheckSame(search, g, g.source(), g.target(), options);
  g.graph.ClearAllPhiConstraints();
  CheckSame(search, g, g.source(), *any(), options);
  if (g.graph.num_edges() > 0) g.graph.RemoveEdge(g.graph.Edges().front());
  CheckSame(search, g, g.source(), g.target(), options);
}

void CheckGraph(unsigned seed, Counts& counts) {
  SCOPED_TRACE("graph " + std::to_string(seed));
  RandomGraph g(seed);
  EveryPath every(g.graph, g.source(), g.target());
  if (every.size() > kMostPaths) return;
  every.Solve();
  ++counts.graphs;
  counts.paths += static_cast<int>(every.size());
  counts.undecided += every.undecided();
  counts.without_path += every.any() ? 0 : 1;
  for (const auto& [name, options] : Ways()) {
    SCOPED_TRACE(name);
    const ShortestPath found = FindShortestPath(g.graph, g.source(), g.target(), options);
    ++counts.searches;
    counts.cut += found.result.message.find(" cuts in ") != std::string::npos ? 1 : 0;
    if (options.max_rounded_paths == 0) {
      CheckRelaxation(g, every, found);
      continue;
    }
    counts.optimal += found.result.termination == Termination::kOptimal ? 1 : 0;
    CheckSearch(g, every, found);
  }
  if (g.kind.polyhedral) {
    CheckWhole(g, every, "highs", counts);
    if (seed % 4 == 0) CheckWhole(g, every, "cbc", counts);
  }
  GraphOfConvexSetsOptions again;
  again.parallelism = Parallelism::None();
  if (seed % 4 == 1) CheckSearchesAgain(g, again);
  if (g.kind.polyhedral && seed % 8 == 2) {
    again.convex_relaxation = false;
    CheckSearchesAgain(g, again);
  }
}

TEST(RandomGraphs, HaveNoPathThatIsBetterThanTheOneFoundNorABoundAboveAny) {
  unsigned count = 500, first = 1;
  if (const char* asked = std::getenv("SWITCHYARD_RANDOM_GRAPHS")) {
    char* rest = nullptr;
    count = static_cast<unsigned>(std::strtoul(asked, &rest, 10));
    if (*rest == '@') first = static_cast<unsigned>(std::strtoul(rest + 1, nullptr, 10));
  }
  Counts counts;
  for (unsigned seed = first; seed < first + count; ++seed) CheckGraph(seed, counts);
  std::cout << counts.graphs << " graphs (" << counts.without_path << " without a path), "
            << counts.paths << " paths (" << counts.undecided << " undecided), " << counts.searches
            << " searches (" << counts.cut << " with cuts, " << counts.optimal
            << " proven optimal), " << counts.whole << " as a mixed-integer program ("
            << counts.cycles << " with a cycle that was forbidden)\n";
  EXPECT_LE(counts.undecided, counts.paths / 100);
}

}  // namespace
}  // namespace switchyard::testing
