// switchyard/gcs/shortest_path.hpp - a shortest path with all that was found on the way.
#pragma once

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "switchyard/gcs/graph_of_convex_sets.hpp"

namespace switchyard {

/// A path that was tried.
struct RoundedPath {
  std::vector<const GraphOfConvexSets::Edge*> edges;
  double cost = std::numeric_limits<double>::quiet_NaN();
  Termination termination = Termination::kNotSolved;
  std::string reason;
};

/// What SolveShortestPath finds, and how it was found.
struct ShortestPath {
  /// Its point holds the placeholders of vertices and edges: phi, phi x_u, phi x_v, x of vertices
  /// with flow (NaN elsewhere).
  MathematicalProgramResult result;
  std::vector<const GraphOfConvexSets::Edge*> edges;  // of the path; none where there is none
  std::vector<Eigen::VectorXd> points;                // one for each vertex of the path
  std::vector<RoundedPath> rounded;                   // in the order in which they were drawn
  double relaxation_cost = std::numeric_limits<double>::quiet_NaN();
  double relaxation_seconds = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> relaxed_flow;  // by GraphOfConvexSets::Edges(); empty without a relaxation
  std::vector<std::string> subsolvers;
  int edges_before = 0;  // preprocessing
  int edges_after = 0;
  int cycle_rounds = 0;  // times that a mixed-integer program was solved again without its cycles
};

/// A graph that is searched again and again: what its sets, costs and constraints come to in a
/// program is written once. Between two searches anything may change: source and target, phi
/// constraints, coefficients and bounds (by their evaluators), terms, vertices and edges; what is
/// the same is not written again. Not thread-safe. The graph outlives it.
class SWITCHYARD_EXPORT ShortestPathSearch {
 public:
  explicit ShortestPathSearch(const GraphOfConvexSets& graph, Host& host = Host::Default());
  ShortestPathSearch(const ShortestPathSearch&) = delete;
  ShortestPathSearch& operator=(const ShortestPathSearch&) = delete;
  ~ShortestPathSearch();

  /// What is found is a value, also that there is no path. Throws InvalidArgument where a vertex is
  /// not of the graph, or a term cannot be transcribed.
  ShortestPath Find(const GraphOfConvexSets::Vertex& source,
                    const GraphOfConvexSets::Vertex& target,
                    const GraphOfConvexSetsOptions& options = {});

 private:
  struct Written;
  const GraphOfConvexSets& graph_;
  Host& host_;
  std::unique_ptr<Written> written_;
};

/// One search.

SWITCHYARD_EXPORT ShortestPath FindShortestPath(const GraphOfConvexSets& graph,
                                                const GraphOfConvexSets::Vertex& source,
                                                const GraphOfConvexSets::Vertex& target,
                                                const GraphOfConvexSetsOptions& options = {},
                                                Host& host = Host::Default());

}  // namespace switchyard
