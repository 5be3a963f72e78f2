#include "switchyard/trajectory/gcs_trajectory_optimization.hpp"

#include <algorithm>
#include <cmath>

#include "core/trajectory/trajectory_problem.hpp"
#include "switchyard/sets/geodesic_convexity.hpp"

namespace switchyard {
namespace {

using Subgraph = GcsTrajectoryOptimization::Subgraph;
using EdgesBetweenSubgraphs = GcsTrajectoryOptimization::EdgesBetweenSubgraphs;

void CheckShape(const std::string& call, const SegmentShape& shape) {
  Require(shape.order >= 0, call, " needs an order of 0 or more, got ", shape.order);
  Require(shape.h_min >= 0, call, " needs h_min of 0 or more, got ", shape.h_min);
  Require(shape.h_min <= shape.h_max, call, ": h_min = ", shape.h_min,
          " is above h_max = ", shape.h_max);
  Require(std::isfinite(shape.h_max), call, " needs a finite h_max, got ", shape.h_max);
}

/// Does what was asked of all hold there, or leave it out?
void CheckDemands(const std::string& call, const Demands& demands, const SegmentShape& shape) {
  if (shape.h_min > 0) return;
  for (const DerivativeBound& bound : demands.bounds) {
    Require(bound.order < 2 || bound.order > shape.order, call,
            " needs h_min > 0 for the bounds of derivative ", bound.order,
            " that were asked of all subgraphs, got 0");
  }
}

/// Continuity that was asked of all, on these joints.
void CheckContinuity(const std::string& call, const Demands& demands, const JointShape& shape) {
  if (shape.u.h_min > 0 && shape.v.h_min > 0) return;
  for (const int k : demands.time_continuity) {
    Require(k > shape.u.order || k > shape.v.order, call,
            " needs h_min > 0 for the continuity of derivative ", k,
            " that was asked of all subgraphs, got ", shape.u.h_min,
            shape.u.h_min == shape.v.h_min ? "" : Text(" and ", shape.v.h_min));
  }
}

/// What was asked of all, for these joints.
void AddContinuity(const TrajectoryProblem& problem, JointGroup& joints) {
  if (joints.edges.empty()) return;
  const int order = std::min(joints.shape.u.order, joints.shape.v.order);
  for (const int k : problem.demands.path_continuity) {
    if (k <= order) joints.AddPathContinuity("AddPathContinuityConstraints", k);
  }
  for (const int k : problem.demands.time_continuity) {
    if (k <= order) {
      joints.AddTimeContinuity("AddContinuityConstraints", k, problem.characteristic_time);
    }
  }
}

}  // namespace

GcsTrajectoryOptimization::GcsTrajectoryOptimization(int num_positions,
                                                     std::vector<int> continuous_revolute_joints)
    : problem_(std::make_unique<TrajectoryProblem>()) {
  Require(num_positions >= 1, "GcsTrajectoryOptimization needs a position or more, got ",
          num_positions);
  ThrowsForInvalidContinuousJointsList(num_positions, continuous_revolute_joints);
  problem_->num_positions = num_positions;
  problem_->continuous_revolute_joints = std::move(continuous_revolute_joints);
}
GcsTrajectoryOptimization::~GcsTrajectoryOptimization() = default;

int GcsTrajectoryOptimization::num_positions() const { return problem_->num_positions; }
const std::vector<int>& GcsTrajectoryOptimization::continuous_revolute_joints() const {
  return problem_->continuous_revolute_joints;
}
const GraphOfConvexSets& GcsTrajectoryOptimization::graph_of_convex_sets() const {
  return problem_->graph;
}

std::string GcsTrajectoryOptimization::GetGraphvizString(const MathematicalProgramResult* result,
                                                         const GcsGraphvizOptions& options) const {
  return problem_->graph.GetGraphvizString(result, options);
}

std::vector<Subgraph*> GcsTrajectoryOptimization::GetSubgraphs() const {
  std::vector<Subgraph*> all;
  for (const auto& subgraph : problem_->subgraphs) all.push_back(subgraph.get());
  return all;
}

std::vector<EdgesBetweenSubgraphs*> GcsTrajectoryOptimization::GetEdgesBetweenSubgraphs() const {
  std::vector<EdgesBetweenSubgraphs*> all;
  for (const auto& edges : problem_->between) all.push_back(edges.get());
  return all;
}

// ---- Regions ----

namespace {

/// Where to, and what was asked for.
struct NewRegions {
  std::string call;
  std::string name;
  SegmentShape shape;
};

NewRegions Named(const TrajectoryProblem& problem, int order, double h_min, double h_max,
                 std::string name) {
  if (name.empty()) name = Text("Subgraph", problem.num_made);
  return {"AddRegions for subgraph " + name, name, {problem.num_positions, order, h_min, h_max}};
}

/// All checks stand before the first change.
std::unique_ptr<SubgraphContent> MakeSubgraph(TrajectoryProblem& problem, const NewRegions& what,
                                              const ConvexSets& regions,
                                              const ConnectionWish& wish) {
  CheckShape(what.call, what.shape);
  CheckRegions(what.call, regions, problem.num_positions, problem.continuous_revolute_joints);
  CheckDemands(what.call, problem.demands, what.shape);
  const Connections connections =
      Connect(what.call, regions, regions, true, problem.continuous_revolute_joints, wish);
  const JointShape joint{what.shape, what.shape};
  if (!connections.pairs.empty()) CheckContinuity(what.call, problem.demands, joint);
  const std::string where = "subgraph " + what.name;
  auto content = std::make_unique<SubgraphContent>(
      SubgraphContent{&problem, problem.num_made++, what.name, regions,
                      SegmentGroup(where, what.shape), JointGroup(where, where, where, joint)});
  for (std::size_t k = 0; k < regions.size(); ++k) {
    content->segments.vertices.push_back(
        problem.graph.AddVertex(SegmentSet(regions[k], what.shape), Text(what.name, ": ", k)));
    problem.of_vertex.resize(
        static_cast<std::size_t>(content->segments.vertices.back()->id().value) + 1);
    problem.of_vertex.back() = {content.get(), k};
  }
  for (std::size_t k = 0; k < connections.pairs.size(); ++k) {
    const auto [i, j] = connections.pairs[k];
    content->joints.Connect(&problem.graph, content->segments.vertices[static_cast<std::size_t>(i)],
                            content->segments.vertices[static_cast<std::size_t>(j)],
                            connections.offsets[k]);
  }
  problem.Know(content->joints);
  for (const DerivativeBound& bound : problem.demands.bounds) {
    if (bound.order <= what.shape.order) {
      content->segments.AddBound(bound, problem.characteristic_time);
    }
  }
  AddContinuity(problem, content->joints);
  return content;
}

}  // namespace

Subgraph& GcsTrajectoryOptimization::AddRegions(
    const ConvexSets& regions, const std::vector<std::pair<int, int>>& edges_between_regions,
    int order, double h_min, double h_max, std::string name,
    const std::vector<Eigen::VectorXd>* edge_offsets) {
  const NewRegions what = Named(*problem_, order, h_min, h_max, std::move(name));
  const ConnectionWish wish{nullptr, &edges_between_regions, edge_offsets};
  problem_->subgraphs.emplace_back(new Subgraph(MakeSubgraph(*problem_, what, regions, wish)));
  for (const auto& cost : problem_->costs) cost(*problem_->subgraphs.back());
  return *problem_->subgraphs.back();
}

Subgraph& GcsTrajectoryOptimization::AddRegions(const ConvexSets& regions, int order, double h_min,
                                                double h_max, std::string name) {
  const NewRegions what = Named(*problem_, order, h_min, h_max, std::move(name));
  problem_->subgraphs.emplace_back(new Subgraph(MakeSubgraph(*problem_, what, regions, {})));
  for (const auto& cost : problem_->costs) cost(*problem_->subgraphs.back());
  return *problem_->subgraphs.back();
}

void GcsTrajectoryOptimization::RemoveSubgraph(const Subgraph& subgraph) {
  const auto is_it = [&](const auto& one) { return one.get() == &subgraph; };
  const auto place = std::find_if(problem_->subgraphs.begin(), problem_->subgraphs.end(), is_it);
  Require(place != problem_->subgraphs.end(),
          "RemoveSubgraph needs a subgraph of this problem, got one that is not");
  for (Vertex* vertex : (*place)->Vertices()) {
    problem_->of_vertex[static_cast<std::size_t>(vertex->id().value)] = {};
    for (const auto* edges : {&vertex->incoming_edges(), &vertex->outgoing_edges()}) {
      for (const Edge* edge : *edges) {
        const auto id = static_cast<std::size_t>(edge->id().value);
        if (id < problem_->of_edge.size()) problem_->of_edge[id] = {};
      }
    }
    problem_->graph.RemoveVertex(vertex);
  }
  std::erase_if(problem_->between, [&](const auto& edges) {
    return &edges->from_subgraph() == &subgraph || &edges->to_subgraph() == &subgraph;
  });
  problem_->subgraphs.erase(place);
}

EdgesBetweenSubgraphs& GcsTrajectoryOptimization::AddEdges(
    const Subgraph& from_subgraph, const Subgraph& to_subgraph, const ConvexSet* subspace,
    const std::vector<std::pair<int, int>>* edges_between_regions,
    const std::vector<Eigen::VectorXd>* edge_offsets) {
  const SubgraphContent &from = *from_subgraph.content_, &to = *to_subgraph.content_;
  Require(from.problem == problem_.get() && to.problem == problem_.get(),
          "AddEdges needs subgraphs of this problem, got one of another");
  const std::string name = Text("edges from ", from.name, " to ", to.name);
  const std::string call = Text("AddEdges from ", from.name, " to ", to.name);
  const Connections connections =
      Connect(call, from.regions, to.regions, &from == &to, problem_->continuous_revolute_joints,
              {subspace, edges_between_regions, edge_offsets});
  Require(!connections.pairs.empty(), call, ": no region of the one meets a region of the other",
          subspace == nullptr ? "" : " in the subspace");
  const JointShape shape{from.segments.shape, to.segments.shape};
  CheckContinuity(call, problem_->demands, shape);
  auto content = std::make_unique<EdgesBetweenContent>(
      EdgesBetweenContent{problem_.get(), &from_subgraph, &to_subgraph,
                          JointGroup(name, from.segments.name, to.segments.name, shape)});
  JointGroup& joints = content->joints;
  for (std::size_t k = 0; k < connections.pairs.size(); ++k) {
    const auto [i, j] = connections.pairs[k];
    Edge* const edge =
        joints.Connect(&problem_->graph, from.segments.vertices[static_cast<std::size_t>(i)],
                       to.segments.vertices[static_cast<std::size_t>(j)], connections.offsets[k]);
    if (subspace != nullptr) joints.Hold(edge, *subspace, connections.to_subspace[k]);
  }
  problem_->Know(joints);
  AddContinuity(*problem_, joints);
  problem_->between.emplace_back(new EdgesBetweenSubgraphs(std::move(content)));
  return *problem_->between.back();
}

}  // namespace switchyard
