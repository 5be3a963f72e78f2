// Paths that the flows of a result say, and paths drawn from them.
#include <algorithm>
#include <unordered_set>

#include "core/gcs/flow.hpp"
#include "switchyard/arcs.hpp"
#include "switchyard/error.hpp"
#include "switchyard/gcs/graph_of_convex_sets.hpp"

namespace switchyard {
namespace {

using Vertex = GraphOfConvexSets::Vertex;
using Edge = GraphOfConvexSets::Edge;

constexpr int kPaths = 10;

void RequireFlows(const char* caller, const MathematicalProgramResult& result) {
  Require(result.get_x_val().size() > 0, caller, ": the result has no flows: the solve ended with ",
          to_string(result.termination));
}

}  // namespace

std::vector<const Edge*> GraphOfConvexSets::GetSolutionPath(const Vertex& source,
                                                            const Vertex& target,
                                                            const MathematicalProgramResult& result,
                                                            double tolerance) const {
  RequireValid(source, "GetSolutionPath");
  RequireValid(target, "GetSolutionPath");
  Require(tolerance >= 0 && tolerance < 1, "GetSolutionPath needs a tolerance in [0, 1), got ",
          tolerance);
  RequireFlows("GetSolutionPath", result);
  std::vector<const Edge*> path;
  std::unordered_set<const Edge*> used;
  for (const Vertex* at = &source; at != &target;) {
    const Edge* next = nullptr;
    double flow = 0;
    for (const Edge* edge : at->outgoing_edges()) {
      const double phi = FlowOf(*edge, result);
      if (!(phi >= 1 - tolerance) || phi <= flow || used.contains(edge)) continue;
      next = edge;
      flow = phi;
    }
    Require(next != nullptr, "GetSolutionPath: the flows form no path from ", source.name(), " to ",
            target.name(), ": none of at least ", 1 - tolerance, " leaves ", at->name());
    path.push_back(next);
    used.insert(next);
    at = &next->v();
  }
  return path;
}

std::vector<std::vector<const Edge*>> GraphOfConvexSets::SamplePaths(
    const Vertex& source, const Vertex& target,
    const std::unordered_map<const Edge*, double>& flows,
    const GraphOfConvexSetsOptions& options) const {
  RequireValid(source, "SamplePaths");
  RequireValid(target, "SamplePaths");
  const int most = options.max_rounded_paths.value_or(kPaths);
  Require(most >= 0, "SamplePaths needs max_rounded_paths of at least 0, got ", most);
  for (const auto& [edge, flow] : flows) {
    Require(edge != nullptr, "SamplePaths needs flows of edges, got a null pointer");
    RequireValid(*edge, "SamplePaths");
  }
  const std::vector<const Edge*> edges = Edges();
  std::vector<std::int32_t> tail, head;
  std::vector<double> flow;
  for (const Edge* edge : edges) {
    tail.push_back(edge->u_->id_.value);
    head.push_back(edge->v_->id_.value);
    const auto given = flows.find(edge);
    flow.push_back(given == flows.end() ? 0 : given->second);
  }
  const Arcs arcs{static_cast<std::int32_t>(vertices_.size()), tail, head};
  const Leaving out(arcs);
  Random random(static_cast<std::uint64_t>(options.rounding_seed));
  std::vector<std::vector<std::int32_t>> drawn;
  for (int k = 0; k < options.max_rounding_trials && static_cast<int>(drawn.size()) < most; ++k) {
    const auto path = SamplePath(arcs, out, flow, options.flow_tolerance, source.id_.value,
                                 target.id_.value, random);
    if (!path.has_value()) break;
    if (std::find(drawn.begin(), drawn.end(), *path) == drawn.end()) drawn.push_back(*path);
  }
  std::vector<std::vector<const Edge*>> paths;
  for (const auto& path : drawn) {
    std::vector<const Edge*>& one = paths.emplace_back();
    for (const std::int32_t a : path) one.push_back(edges[static_cast<std::size_t>(a)]);
  }
  return paths;
}

std::vector<std::vector<const Edge*>> GraphOfConvexSets::SamplePaths(
    const Vertex& source, const Vertex& target, const MathematicalProgramResult& result,
    const GraphOfConvexSetsOptions& options) const {
  RequireFlows("SamplePaths", result);
  std::unordered_map<const Edge*, double> flows;
  for (const Edge* edge : Edges()) flows.emplace(edge, FlowOf(*edge, result));
  return SamplePaths(source, target, flows, options);
}

}  // namespace switchyard
