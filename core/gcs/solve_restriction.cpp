// The best points of a path that is given.
#include <algorithm>

#include "core/gcs/path_point.hpp"
#include "core/gcs/restriction.hpp"
#include "switchyard/error.hpp"
#include "switchyard/solve/solve_in_parallel.hpp"

namespace switchyard {
namespace {

using Vertex = GraphOfConvexSets::Vertex;
using Edge = GraphOfConvexSets::Edge;

constexpr std::size_t kCombinations = 64;  // of parallel edges, at most

struct Path {
  std::vector<const Vertex*> vertices;
  std::vector<const Edge*> edges;
};

/// The edges from a vertex to the next, by id, without those that are excluded.
std::vector<const Edge*> Between(const Vertex& u, const Vertex& v) {
  std::vector<const Edge*> edges;
  bool excluded = false;
  for (const Edge* edge : u.outgoing_edges()) {
    if (&edge->v() != &v) continue;
    if (edge->phi_value() == false) {
      excluded = true;
    } else {
      edges.push_back(edge);
    }
  }
  Require(!edges.empty(), "SolveConvexRestriction: no edge leads from vertex ", u.name(),
          " to vertex ", v.name(), excluded ? " but such whose phi is fixed to 0" : "");
  return edges;
}

/// Each path through the vertices, the first edges of each pair first.
std::vector<Path> PathsThrough(std::span<const Vertex* const> vertices) {
  std::vector<std::vector<const Edge*>> choices;
  std::size_t count = 1;
  std::size_t widest = 0;
  for (std::size_t k = 0; k + 1 < vertices.size(); ++k) {
    choices.push_back(Between(*vertices[k], *vertices[k + 1]));
    count = std::min(count * choices[k].size(), std::size_t{1} << 32);
    if (choices[k].size() > choices[widest].size()) widest = k;
  }
  if (count > kCombinations) {
    Refuse("SolveConvexRestriction: which edge from vertex ", vertices[widest]->name(),
           " to vertex ", vertices[widest + 1]->name(), " is meant? There are ",
           choices[widest].size(), ", and with those of other pairs more than ", kCombinations,
           " paths, the most that are tried: give the edges");
  }
  std::vector<Path> paths;
  for (std::size_t k = 0; k < count; ++k) {
    Path& path = paths.emplace_back(Path{{vertices.begin(), vertices.end()}, {}});
    std::size_t left = k;
    for (const auto& edges : choices) {
      path.edges.push_back(edges[left % edges.size()]);
      left /= edges.size();
    }
  }
  return paths;
}

/// Several at once; one alone with all the threads.
class Restrictions {
 public:
  Restrictions(const std::vector<Path>& paths, const GraphOfConvexSetsOptions& options,
               const MathematicalProgramResult* initial_guess)
      : parallelism_(options.parallelism),
        options_(options.restriction_solver_options.value_or(options.solver_options)) {
    if (options_.threads == 0 && paths.size() == 1) {
      options_.threads = options.parallelism.num_threads();
    }
    for (const Path& path : paths) {
      programs_.push_back(RestrictionOf(path.vertices, path.edges));
      if (initial_guess == nullptr) continue;
      guesses_.push_back(StartFrom(*initial_guess, *programs_.back(), path.edges));
    }
  }

  [[nodiscard]] std::vector<MathematicalProgramResult> Solve(
      const GraphOfConvexSetsOptions& options) const {
    const SolverInterface* named =
        options.restriction_solver != nullptr ? options.restriction_solver : options.solver;
    std::vector<std::size_t> all(programs_.size());
    for (std::size_t k = 0; k < all.size(); ++k) all[k] = k;
    auto results =
        SolveSome(all, named == nullptr ? std::nullopt : std::optional(named->solver_id()));
    if (options.restriction_solver == nullptr && named != nullptr && named->available()) {
      SolveByOthers(named->solver_id(), results);
    }
    return results;
  }

 private:
  [[nodiscard]] std::vector<MathematicalProgramResult> SolveSome(
      const std::vector<std::size_t>& some, const std::optional<SolverId>& solver) const {
    std::vector<const MathematicalProgram*> programs;
    std::vector<const Eigen::VectorXd*> guesses;
    for (const std::size_t k : some) {
      programs.push_back(programs_[k].get());
      guesses.push_back(guesses_.empty() ? nullptr : &guesses_[k]);
    }
    return SolveInParallel(programs, &guesses, &options_, solver, parallelism_);
  }

  // The solver was named for the relaxation: a restriction may be of a class that it does not take.
  void SolveByOthers(const SolverId& named, std::vector<MathematicalProgramResult>& results) const {
    std::vector<std::size_t> refused;
    for (std::size_t k = 0; k < results.size(); ++k) {
      if (results[k].termination == Termination::kNoBackend) refused.push_back(k);
    }
    if (refused.empty()) return;
    auto others = SolveSome(refused, std::nullopt);
    for (std::size_t i = 0; i < refused.size(); ++i) {
      MathematicalProgramResult& result = results[refused[i]];
      others[i].notes.push_back("the restriction was not solved by " + named.name() + ": " +
                                result.message);
      result = std::move(others[i]);
    }
  }

  Parallelism parallelism_;
  SolverOptions options_;
  std::vector<std::unique_ptr<MathematicalProgram>> programs_;
  std::vector<Eigen::VectorXd> guesses_;
};

bool HasPoint(const MathematicalProgramResult& result) {
  return result.primal == PointKind::kFeasible || result.primal == PointKind::kNearlyFeasible;
}

/// The feasible one of the least cost; without any, one that is not known to be infeasible, so that
/// "infeasible" means all.
std::size_t Best(const std::vector<MathematicalProgramResult>& results) {
  const auto rank = [](const MathematicalProgramResult& r) {
    if (r.primal == PointKind::kFeasible) return 0;
    if (r.primal == PointKind::kNearlyFeasible) return 1;
    return r.termination == Termination::kInfeasible ? 3 : 2;
  };
  std::size_t best = 0;
  for (std::size_t k = 1; k < results.size(); ++k) {
    const int rank_k = rank(results[k]);
    const int rank_best = rank(results[best]);
    const bool cheaper = HasPoint(results[k]) && results[k].objective < results[best].objective;
    if (rank_k < rank_best || (rank_k == rank_best && cheaper)) best = k;
  }
  return best;
}

std::string WhyNot(const Path& path, const MathematicalProgramResult& result) {
  std::string edges;
  for (const Edge* edge : path.edges) edges += (edges.empty() ? "" : ", ") + edge->name();
  return Text("the path ", edges, ": ", to_string(result.termination),
              result.message.empty() ? "" : ": ", result.message);
}

MathematicalProgramResult SolveBest(const GraphOfConvexSets& graph, const std::vector<Path>& paths,
                                    const GraphOfConvexSetsOptions& options,
                                    const MathematicalProgramResult* initial_guess) {
  std::vector<MathematicalProgramResult> results =
      Restrictions(paths, options, initial_guess).Solve(options);
  const std::size_t best = Best(results);
  std::vector<std::string> why_not;
  for (std::size_t k = 0; k < paths.size() && paths.size() > 1; ++k) {
    if (!HasPoint(results[k])) why_not.push_back(WhyNot(paths[k], results[k]));
  }
  MathematicalProgramResult result = std::move(results[best]);
  result.notes.insert(result.notes.end(), why_not.begin(), why_not.end());
  const Path& path = paths[best];
  if (!HasPoint(result) || path.edges.empty()) return result;
  PathPoints points{path.edges, {}, {}};
  for (const Vertex* v : path.vertices) points.points.emplace_back(result.GetSolution(v->x()));
  for (const Edge* edge : path.edges) {
    points.slacks.emplace_back(result.GetSolution(edge->slacks()));
  }
  SetPathPoint(graph, points, result);
  return result;
}

}  // namespace

MathematicalProgramResult GraphOfConvexSets::SolveConvexRestriction(
    const std::vector<const Edge*>& active_edges, const GraphOfConvexSetsOptions& options,
    const MathematicalProgramResult* initial_guess) const {
  for (const Edge* edge : active_edges) {
    Require(edge != nullptr, "SolveConvexRestriction needs edges, got a null pointer");
    RequireValid(*edge, "SolveConvexRestriction");
  }
  return SolveBest(*this, {{VerticesOf(active_edges), active_edges}}, options, initial_guess);
}

MathematicalProgramResult GraphOfConvexSets::SolveConvexRestriction(
    std::span<const Vertex* const> active_vertices, const GraphOfConvexSetsOptions& options,
    const MathematicalProgramResult* initial_guess) const {
  Require(!active_vertices.empty(), "SolveConvexRestriction needs a vertex, got none");
  for (const Vertex* vertex : active_vertices) {
    Require(vertex != nullptr, "SolveConvexRestriction needs vertices, got a null pointer");
    RequireValid(*vertex, "SolveConvexRestriction");
  }
  return SolveBest(*this, PathsThrough(active_vertices), options, initial_guess);
}

}  // namespace switchyard
