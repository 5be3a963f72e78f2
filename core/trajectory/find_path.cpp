// The shortest path between two subgraphs, in the problem's own graph where both have one region;
// else with a vertex of dimension 0 from which edges lead to all regions of the source, or to which
// they lead from all of the target.
#include <algorithm>
#include <chrono>
#include <map>
#include <span>

#include "core/trajectory/trajectory_problem.hpp"
#include "switchyard/sets/point.hpp"

namespace switchyard {
namespace {

using Vertex = GraphOfConvexSets::Vertex;
using Edge = GraphOfConvexSets::Edge;
using Subgraph = GcsTrajectoryOptimization::Subgraph;
using Clock = std::chrono::steady_clock;

constexpr double kFollowed = 1e-5;  // flows below that are none

bool IsHub(const Vertex& vertex) { return vertex.ambient_dimension() == 0; }

enum class End { kSource, kTarget };

Vertex* AddHub(GraphOfConvexSets& graph, const std::vector<Vertex*>& regions, End end,
               const std::string& name) {
  Vertex* const hub = graph.AddVertex(Point(), Text("a region of ", name));
  for (Vertex* region : regions) {
    end == End::kSource ? graph.AddEdge(hub, region) : graph.AddEdge(region, hub);
  }
  return hub;
}

bool TouchesHub(const Edge* edge) { return IsHub(edge->u()) || IsHub(edge->v()); }

void RequireOurs(const std::vector<std::unique_ptr<Subgraph>>& all, const Subgraph& subgraph,
                 const char* what) {
  const bool ours =
      std::any_of(all.begin(), all.end(), [&](const auto& one) { return one.get() == &subgraph; });
  Require(ours, "FindPath: the ", what, " is no subgraph of this problem");
}

/// The path that was found, of segments alone.
SegmentPath Found(const ShortestPath& search, const Vertex& source) {
  SegmentPath path;
  if (search.points.empty()) return path;
  std::vector<const Vertex*> vertices = {&source};
  for (const Edge* edge : search.edges) vertices.push_back(&edge->v());
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    if (IsHub(*vertices[k])) continue;
    path.vertices.push_back(vertices[k]);
    path.points.push_back(search.points[k]);
  }
  for (const Edge* edge : search.edges) {
    if (!TouchesHub(edge)) path.edges.push_back(edge);
  }
  return path;
}

/// Where a relaxation that is not rounded sends most of its flow.
SegmentPath Followed(const GraphOfConvexSets& graph, const Vertex& source, const Vertex& target,
                     const MathematicalProgramResult& result) {
  SegmentPath path;
  std::vector<const Edge*> edges;
  try {
    edges = graph.GetSolutionPath(source, target, result, 1 - kFollowed);
  } catch (const InvalidArgument&) {
    return path;  // no flow leads there
  }
  std::vector<const Vertex*> vertices = {&source};
  for (const Edge* edge : edges) {
    path.flow = std::min(path.flow, result.GetSolution(edge->phi()));
    vertices.push_back(&edge->v());
    if (!TouchesHub(edge)) path.edges.push_back(edge);
  }
  for (const Vertex* vertex : vertices) {
    if (IsHub(*vertex)) continue;
    const auto x = vertex->GetSolution(result);
    if (!x) return {};
    path.vertices.push_back(vertex);
    path.points.push_back(*x);
  }
  return path;
}

SegmentPath PathOf(const GraphOfConvexSets& graph, const Vertex& source, const Vertex& target,
                   const GraphOfConvexSetsOptions& options, ShortestPath& search) {
  SegmentPath path = Found(search, source);
  const bool alone = options.convex_relaxation != false && options.max_rounded_paths == 0;
  if (search.points.empty() && alone && search.result.get_x_val().size() > 0) {
    path = Followed(graph, source, target, search.result);
  }
  if (search.points.empty()) return path;
  search.points = path.points;
  search.edges = path.edges;
  return path;
}

void DropHubs(ShortestPath& search) {
  for (RoundedPath& rounded : search.rounded) std::erase_if(rounded.edges, TouchesHub);
}

/// A graph and its clone: what is found in the clone, in terms of the graph.
class Twins {
 public:
  /// `clone` as it was made, of the graph as it is.
  Twins(const GraphOfConvexSets& graph, const GraphOfConvexSets& clone)
      : vertices_(graph.Vertices()),
        edges_(graph.Edges()),
        twin_vertices_(clone.Vertices()),
        twin_edges_(clone.Edges()) {
    for (std::size_t k = 0; k < edges_.size(); ++k) edge_of_.emplace(twin_edges_[k], edges_[k]);
    for (std::size_t k = 0; k < vertices_.size(); ++k) {
      vertex_of_.emplace(twin_vertices_[k], vertices_[k]);
    }
  }

  void Translate(SegmentPath& path) const {
    for (const Vertex*& vertex : path.vertices) vertex = vertex_of_.at(vertex);
    Translate(path.edges);
  }
  void Translate(ShortestPath& search) const {
    Translate(search.edges);
    for (RoundedPath& rounded : search.rounded) Translate(rounded.edges);
    if (!search.relaxed_flow.empty()) search.relaxed_flow.resize(edges_.size());
    if (search.result.get_x_val().size() > 0) Translate(search.result);
  }

 private:
  using Values = std::vector<std::pair<Variable::Id, double>>;

  void Translate(std::vector<const Edge*>& edges) const {
    for (const Edge*& edge : edges) edge = edge_of_.at(edge);
  }
  void Translate(MathematicalProgramResult& result) const {
    Values values;
    const auto take = [&](const auto& here, const auto& there) {
      for (Eigen::Index i = 0; i < here.size(); ++i) {
        if (result.Knows(there[i])) {
          values.emplace_back(here[i].get_id(), result.GetSolution(there[i]));
        }
      }
    };
    for (std::size_t k = 0; k < vertices_.size(); ++k) {
      take(vertices_[k]->x(), twin_vertices_[k]->x());
    }
    for (std::size_t k = 0; k < edges_.size(); ++k) {
      // phi, phi x_u and phi x_v have consecutive ids.
      const Edge &here = *edges_[k], &there = *twin_edges_[k];
      const Eigen::Index count = 1 + here.xu().size() + here.xv().size();
      const auto all = [count](const Edge& edge) {
        VectorXDecisionVariable variables(count);
        for (Eigen::Index i = 0; i < count; ++i) {
          variables[i] = Variable(edge.phi().get_id() + i);
        }
        return variables;
      };
      take(all(here), all(there));
      take(here.slacks(), there.slacks());
    }
    std::sort(values.begin(), values.end());
    std::vector<Variable> variables;
    Eigen::VectorXd x(static_cast<Eigen::Index>(values.size()));
    for (const auto& [id, value] : values) {
      x[static_cast<Eigen::Index>(variables.size())] = value;
      variables.emplace_back(id);
    }
    result.SetPoint(std::move(variables), std::move(x));
  }

  std::vector<const Vertex*> vertices_;
  std::vector<const Edge*> edges_;
  std::vector<const Vertex*> twin_vertices_;
  std::vector<const Edge*> twin_edges_;
  std::map<const Vertex*, const Vertex*> vertex_of_;
  std::map<const Edge*, const Edge*> edge_of_;
};

/// The twins of some vertices: their ids are the same.
std::vector<Vertex*> InClone(const GraphOfConvexSets& graph, GraphOfConvexSets& clone,
                             const std::vector<const Vertex*>& some) {
  const std::vector<const Vertex*> all = graph.Vertices();
  const std::vector<Vertex*> twins = clone.Vertices();
  std::vector<Vertex*> found;
  for (const Vertex* vertex : some) {
    const auto place =
        std::lower_bound(all.begin(), all.end(), vertex,
                         [](const Vertex* a, const Vertex* b) { return a->id() < b->id(); });
    found.push_back(twins[static_cast<std::size_t>(place - all.begin())]);
  }
  return found;
}

Vertex* OneOf(GraphOfConvexSets& graph, const std::vector<Vertex*>& regions, End end,
              const std::string& name) {
  return regions.size() == 1 ? regions[0] : AddHub(graph, regions, end, name);
}

}  // namespace

GcsTrajectory GcsTrajectoryOptimization::FindPath(const Subgraph& source, const Subgraph& target,
                                                  const GraphOfConvexSetsOptions& options) const {
  const auto start = Clock::now();
  RequireOurs(problem_->subgraphs, source, "source");
  RequireOurs(problem_->subgraphs, target, "target");
  const GraphOfConvexSets& graph = problem_->graph;
  GcsTrajectory found;
  if (source.size() == 1 && target.size() == 1) {
    const Vertex &s = *source.Vertices()[0], &t = *target.Vertices()[0];
    found.search = FindShortestPath(graph, s, t, options);
    const SegmentPath path = PathOf(graph, s, t, options, found.search);
    RecoverTrajectory(*problem_, path, found);
    return found;
  }
  const auto clone = graph.Clone();
  const Twins twins(graph, *clone);
  const Vertex& s =
      *OneOf(*clone, InClone(graph, *clone, source.Vertices()), End::kSource, source.name());
  const Vertex& t =
      *OneOf(*clone, InClone(graph, *clone, target.Vertices()), End::kTarget, target.name());
  GraphOfConvexSetsOptions rest = options;
  rest.solver_options.time_limit -= std::chrono::duration<double>(Clock::now() - start).count();
  found.search = FindShortestPath(*clone, s, t, rest);
  SegmentPath path = PathOf(*clone, s, t, options, found.search);
  DropHubs(found.search);
  twins.Translate(path);
  twins.Translate(found.search);
  RecoverTrajectory(*problem_, path, found);
  return found;
}

std::pair<CompositeTrajectory<double>, MathematicalProgramResult>
GcsTrajectoryOptimization::SolvePath(const Subgraph& source, const Subgraph& target,
                                     const GraphOfConvexSetsOptions& options) const {
  GcsTrajectory found = FindPath(source, target, options);
  return {std::move(found.trajectory), std::move(found.search.result)};
}

std::pair<CompositeTrajectory<double>, MathematicalProgramResult>
GcsTrajectoryOptimization::SolveConvexRestriction(const std::vector<const Vertex*>& active_vertices,
                                                  const GraphOfConvexSetsOptions& options) const {
  GcsTrajectory found;
  found.search.result = problem_->graph.SolveConvexRestriction(
      std::span<const Vertex* const>(active_vertices), options);
  const MathematicalProgramResult& result = found.search.result;
  SegmentPath path;
  for (const Vertex* vertex : active_vertices) {
    if (result.primal != PointKind::kFeasible && result.primal != PointKind::kNearlyFeasible) break;
    path.vertices.push_back(vertex);
    path.points.push_back(result.GetSolution(vertex->x()));
    if (path.vertices.size() == 1) continue;
    for (const Edge* edge : path.vertices[path.vertices.size() - 2]->outgoing_edges()) {
      if (&edge->v() != vertex || result.GetSolution(edge->phi()) < 0.5) continue;
      path.edges.push_back(edge);
      break;
    }
  }
  RecoverTrajectory(*problem_, path, found);
  return {std::move(found.trajectory), std::move(found.search.result)};
}

// ---- Again ----

struct GcsTrajectorySearch::State {
  /// Of a subgraph of several regions, by its number.
  struct Hubs {
    Vertex* source = nullptr;
    Vertex* target = nullptr;
  };

  GcsTrajectoryOptimization& problem;
  ShortestPathSearch search;
  std::map<int, Hubs> hubs;
};

GcsTrajectorySearch::GcsTrajectorySearch(GcsTrajectoryOptimization& problem, Host& host)
    : state_(new State{problem, ShortestPathSearch(problem.graph_of_convex_sets(), host), {}}) {}

GcsTrajectorySearch::~GcsTrajectorySearch() {
  GraphOfConvexSets& graph = state_->problem.problem_->graph;
  for (const auto& [number, hubs] : state_->hubs) {
    if (hubs.source != nullptr) graph.RemoveVertex(hubs.source);
    if (hubs.target != nullptr) graph.RemoveVertex(hubs.target);
  }
}

GcsTrajectory GcsTrajectorySearch::FindPath(const Subgraph& source, const Subgraph& target,
                                            const GraphOfConvexSetsOptions& options) {
  TrajectoryProblem& problem = *state_->problem.problem_;
  RequireOurs(problem.subgraphs, source, "source");
  RequireOurs(problem.subgraphs, target, "target");
  const auto hub = [&](const Subgraph& subgraph, End end) -> const Vertex& {
    const SubgraphContent& content = *subgraph.content_;
    if (content.regions.size() == 1) return *content.segments.vertices[0];
    State::Hubs& hubs = state_->hubs[content.number];
    Vertex*& one = end == End::kSource ? hubs.source : hubs.target;
    if (one == nullptr) one = AddHub(problem.graph, content.segments.vertices, end, content.name);
    return *one;
  };
  const Vertex& s = hub(source, End::kSource);
  const Vertex& t = hub(target, End::kTarget);
  GcsTrajectory found;
  found.search = state_->search.Find(s, t, options);
  const SegmentPath path = PathOf(problem.graph, s, t, options, found.search);
  DropHubs(found.search);
  RecoverTrajectory(problem, path, found);
  return found;
}

}  // namespace switchyard
