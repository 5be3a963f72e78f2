// core/trajectory/trajectory_problem.hpp - what the classes of gcs_trajectory_optimization.hpp are
// made of.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/trajectory/regions.hpp"
#include "core/trajectory/term_groups.hpp"
#include "switchyard/trajectory/gcs_trajectory_optimization.hpp"

namespace switchyard {

struct SubgraphContent {
  const TrajectoryProblem* problem;
  int number;  // by which it is known; none is used again
  std::string name;
  ConvexSets regions;
  SegmentGroup segments;
  JointGroup joints;
};

struct EdgesBetweenContent {
  const TrajectoryProblem* problem;
  const GcsTrajectoryOptimization::Subgraph* from;
  const GcsTrajectoryOptimization::Subgraph* to;
  JointGroup joints;
};

struct TrajectoryProblem {
  using Subgraph = GcsTrajectoryOptimization::Subgraph;
  using EdgesBetween = GcsTrajectoryOptimization::EdgesBetweenSubgraphs;
  struct OfVertex {
    const SubgraphContent* subgraph = nullptr;
    std::size_t region = 0;
  };
  struct OfEdge {
    const JointGroup* joints = nullptr;
    std::size_t edge = 0;
  };

  int num_positions = 0;
  std::vector<int> continuous_revolute_joints;
  GraphOfConvexSets graph;
  std::vector<std::unique_ptr<Subgraph>> subgraphs;
  std::vector<std::unique_ptr<EdgesBetween>> between;
  int num_made = 0;  // subgraphs, ever
  // By id of vertex and edge.
  std::vector<OfVertex> of_vertex;
  std::vector<OfEdge> of_edge;
  // Asked of all.
  std::vector<std::function<void(Subgraph&)>> costs;
  Demands demands;
  std::optional<double> characteristic_time;  // of surrogates

  void Know(const JointGroup& joints);
};

/// Checked: `n` entries each, no NaN, not crossed.
DerivativeBound CheckedBound(const std::string& call, int n, int order, const VectorRef& lower,
                             const VectorRef& upper);
/// For N >= 2.
DerivativeBound CheckedNonlinearBound(const std::string& call, int n, int order,
                                      const VectorRef& lower, const VectorRef& upper);
void CheckWeight(const std::string& call, int n, const Eigen::MatrixXd& W);
void CheckWeight(const std::string& call, double weight);

// ---- What was found, as a trajectory ----

/// A path of segments, without vertices of no dimension at its ends.
struct SegmentPath {
  std::vector<const GraphOfConvexSets::Vertex*> vertices;
  std::vector<const GraphOfConvexSets::Edge*> edges;  // between them
  std::vector<Eigen::VectorXd> points;                // of the vertices
  /// Of a relaxation that was not rounded: the least flow on it. A path's is 1.
  double flow = 1;
};

/// Fills in what follows from the path, and completes the result, which is there.
void RecoverTrajectory(const TrajectoryProblem& problem, const SegmentPath& path,
                       GcsTrajectory& found);

/// Seconds; what is shorter is no segment.
constexpr double kNoTime = 1e-10;

/// A segment of a path, or a place that it passes.
struct PathPiece {
  const SubgraphContent* subgraph;
  std::size_t region;
  Eigen::MatrixXd points;
  double duration;
  bool has_time;  // a segment of the trajectory
};

/// `edges`: between the pieces.
TrajectoryViolation Verify(const TrajectoryProblem& problem, const std::vector<PathPiece>& pieces,
                           const std::vector<const GraphOfConvexSets::Edge*>& edges,
                           const CompositeTrajectory<double>& trajectory);

}  // namespace switchyard
