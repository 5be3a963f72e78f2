// switchyard/trajectory/gcs_trajectory_optimization.hpp - the best trajectory through convex
// regions, as a shortest path in a graph of convex sets.
//
// Regions without collisions in, a trajectory of Bezier segments out, each within one region: by
// Marcucci, Petersen, von Wrangel and Tedrake, Motion planning around obstacles with convex
// optimization, Science Robotics 8(84), 2023.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "switchyard/gcs/shortest_path.hpp"
#include "switchyard/trajectory/composite_trajectory.hpp"

namespace switchyard {

struct GcsTrajectory;
struct TrajectoryProblem;  // what these are made of

/// A segment of order m in a region X of R^n is a vertex: control points r_0, ..., r_m in X by the
/// columns of P, and a duration h in [h_min, h_max] seconds; q(t) = r((t - t_0) / h) with the
/// Bezier curve r of P. The curve is within the hull of its control points, and so in X. Where an
/// edge leads from segment u to segment v, the last point of u is the first of v: on continuous
/// revolute joints up to a multiple of 2 pi.
///
/// Regions with the same order and range of durations are a Subgraph; EdgesBetweenSubgraphs lead
/// from one subgraph to another. Starts and goals are subgraphs of order 0. A segment of order 0
/// with h_min = 0 is a place to pass and takes no time: it is no part of the trajectory. With
/// h_min > 0 it is a stop.
///
/// Costs and constraints that are asked of the whole go to all subgraphs that there are and that
/// will be, and to the edges between them where that is said; subgraphs whose order is too low for
/// one are left out.
///
/// The object owns its subgraphs and edges; references to them are good until RemoveSubgraph. Not
/// thread-safe while it changes; const members, FindPath too, may be called from several threads.
/// What is called with a mistake throws InvalidArgument and changes nothing.
class SWITCHYARD_EXPORT GcsTrajectoryOptimization final {
 public:
  class Subgraph;
  class EdgesBetweenSubgraphs;
  using Vertex = GraphOfConvexSets::Vertex;
  using Edge = GraphOfConvexSets::Edge;

  /// R^num_positions; joints that turn without limits, in radians, along which each region must be
  /// narrower than pi (see PartitionConvexSet).
  explicit GcsTrajectoryOptimization(int num_positions,
                                     std::vector<int> continuous_revolute_joints = {});
  GcsTrajectoryOptimization(const GcsTrajectoryOptimization&) = delete;
  GcsTrajectoryOptimization& operator=(const GcsTrajectoryOptimization&) = delete;
  ~GcsTrajectoryOptimization();
  [[nodiscard]] int num_positions() const;
  [[nodiscard]] const std::vector<int>& continuous_revolute_joints() const;

  // ---- Regions ----

  /// One segment of `order` for each region, and an edge from i to j for each pair (i, j).
  /// `edge_offsets`: of each edge the multiples of 2 pi, on continuous revolute joints, that are
  /// added to the end of the first segment to be the start of the second; found from the regions'
  /// ranges where it is not given. Throws where there is no region, one has another dimension or is
  /// empty, an index is out of range, order < 0, not 0 <= h_min <= h_max < infinity, or an offset
  /// has another size or is no such multiple. No name: "Subgraph" and a number.
  Subgraph& AddRegions(const ConvexSets& regions,
                       const std::vector<std::pair<int, int>>& edges_between_regions, int order,
                       double h_min = 0, double h_max = 20, std::string name = "",
                       const std::vector<Eigen::VectorXd>* edge_offsets = nullptr);
  /// With edges both ways between all regions that meet (ComputePairwiseIntersections).
  Subgraph& AddRegions(const ConvexSets& regions, int order, double h_min = 1e-6, double h_max = 20,
                       std::string name = "");
  /// With its vertices, their edges, and the EdgesBetweenSubgraphs from and to it.
  void RemoveSubgraph(const Subgraph& subgraph);

  /// An edge for each region of one that meets a region of the other; or for each pair (i, j) of
  /// region i of the first and j of the second. With a subspace, the last point of the first
  /// segment is in it, and edges are where both regions and it have a point in common; the first
  /// segment is as near to the subspace as 2 pi allows, offsets going from the first region to it.
  /// Along continuous revolute joints the subspace, too, must be narrower than pi. Throws where no
  /// two regions meet, and for pairs and offsets as AddRegions does.
  EdgesBetweenSubgraphs& AddEdges(
      const Subgraph& from_subgraph, const Subgraph& to_subgraph,
      const ConvexSet* subspace = nullptr,
      const std::vector<std::pair<int, int>>* edges_between_regions = nullptr,
      const std::vector<Eigen::VectorXd>* edge_offsets = nullptr);

  // ---- Of all subgraphs, now and later: see Subgraph ----

  void AddTimeCost(double weight = 1.0);
  void AddPathLengthCost(const Eigen::MatrixXd& weight_matrix);
  void AddPathLengthCost(double weight = 1.0);
  void AddPathEnergyCost(const Eigen::MatrixXd& weight_matrix);
  void AddPathEnergyCost(double weight = 1.0);
  void AddVelocityBounds(const VectorRef& lb, const VectorRef& ub);
  void AddNonlinearDerivativeBounds(const VectorRef& lb, const VectorRef& ub, int derivative_order);
  /// These two go to the edges between subgraphs as well.
  void AddPathContinuityConstraints(int continuity_order);
  void AddContinuityConstraints(int continuity_order);

  /// Guides rounding where terms are nonlinear: the relaxation gets, beside what holds of every
  /// trajectory, rows with a characteristic time h0 in seconds in place of durations: h0^{N-1} h
  /// for h^N in derivative bounds, h0 for both durations in continuity. That is no relaxation: it
  /// may exclude every good path, and where there is such a row there is no bound and no gap. For
  /// terms that there are and will be; once. Throws where h0 is not above 0.
  void UseSurrogates(double characteristic_time = 1.0);

  // ---- Trajectories ----

  /// From a region of the one to a region of the other, whichever is best; with all that was found
  /// on the way. What is found is a value, also that there is nothing; see GcsTrajectory. Throws
  /// where a subgraph is not of this problem, and, with convex_relaxation = false, where a term is
  /// nonlinear.
  [[nodiscard]] GcsTrajectory FindPath(const Subgraph& source, const Subgraph& target,
                                       const GraphOfConvexSetsOptions& options = {}) const;
  /// The trajectory (without segments where there is none) and the result of that.
  [[nodiscard]] std::pair<CompositeTrajectory<double>, MathematicalProgramResult> SolvePath(
      const Subgraph& source, const Subgraph& target,
      const GraphOfConvexSetsOptions& options = {}) const;
  /// The best trajectory through the segments of these vertices, in this order; see
  /// GraphOfConvexSets::SolveConvexRestriction.
  [[nodiscard]] std::pair<CompositeTrajectory<double>, MathematicalProgramResult>
  SolveConvexRestriction(const std::vector<const Vertex*>& active_vertices,
                         const GraphOfConvexSetsOptions& options = {}) const;

  /// In the order of addition.
  [[nodiscard]] std::vector<Subgraph*> GetSubgraphs() const;
  [[nodiscard]] std::vector<EdgesBetweenSubgraphs*> GetEdgesBetweenSubgraphs() const;
  [[nodiscard]] const GraphOfConvexSets& graph_of_convex_sets() const;
  /// See GraphOfConvexSets::GetGraphvizString.
  [[nodiscard]] std::string GetGraphvizString(const MathematicalProgramResult* result = nullptr,
                                              const GcsGraphvizOptions& options = {}) const;

  /// The same control points, a second for each segment, from the same start. Throws where a
  /// segment is not a Bezier curve.
  [[nodiscard]] static CompositeTrajectory<double> NormalizeSegmentTimes(
      const CompositeTrajectory<double>& trajectory);
  /// Segments moved by multiples of 2 pi along the joints so that each starts where the one before
  /// ends. `starting_rounds`, one for each joint: k puts the start into [2 pi k, 2 pi (k + 1));
  /// without, it stays where it is. Throws where segments do not join to `tol` modulo 2 pi, on
  /// joints that are not continuous or are not in the list to `tol`, where a segment is not a
  /// Bezier curve, and for joints and rounds that do not fit.
  [[nodiscard]] static CompositeTrajectory<double> UnwrapToContinuousTrajectory(
      const CompositeTrajectory<double>& gcs_trajectory,
      std::vector<int> continuous_revolute_joints,
      std::optional<std::vector<int>> starting_rounds = std::nullopt, double tol = 1e-8);

 private:
  friend class GcsTrajectorySearch;
  std::unique_ptr<TrajectoryProblem> problem_;
};

/// How far a trajectory is from what was asked, absolute; 0: nothing was.
struct TrajectoryViolation {
  /// Of a control point in its region, or a sample of the trajectory (see ConvexSet::Violation).
  double regions = 0;
  double durations = 0;  // of a duration from [h_min, h_max], seconds
  /// The largest jump of derivative k where one segment follows another, by k: of q itself (k = 0,
  /// after its offset), and of the time derivatives, and the path derivatives, whose continuity was
  /// asked for.
  std::vector<double> continuity;
  std::vector<double> path_continuity;
  /// Of a derivative's control point, or a sample, from its bounds (0 for zero derivatives), in
  /// units of q / s^k. A short segment shows the solver's error divided by h^k.
  double derivative_bounds = 0;
  [[nodiscard]] SWITCHYARD_EXPORT double max() const;
};

/// What FindPath finds.
///
/// `search.result` is the result; its point is in the placeholders of graph_of_convex_sets().
/// `violation` is folded into its violation (regions and joints into rows, durations into bounds,
/// derivatives into nonlinear), and what is not as it should be into its notes.
struct GcsTrajectory {
  /// Its segments have a time each. Without segments where there is none.
  CompositeTrajectory<double> trajectory{{}};
  /// The result, bound and gap, the paths that were tried and why each failed, the relaxation's
  /// cost.
  ShortestPath search;
  /// The path's, one for each segment and each place that it passes without time.
  std::vector<const GraphOfConvexSets::Vertex*> vertices;
  /// Those of them that have a segment in `trajectory`.
  std::vector<const GraphOfConvexSets::Vertex*> segment_vertices;
  TrajectoryViolation violation;
  /// Do the segments join? Those of a relaxation alone (max_rounded_paths = 0) do where it is
  /// tight: where not, the trajectory is no solution, and the result says no path.
  bool is_continuous = false;

  [[nodiscard]] const MathematicalProgramResult& result() const { return search.result; }
};

/// A problem that is searched again and again: what it comes to in a program is written once; see
/// ShortestPathSearch. Between two searches everything may change: source and target, terms,
/// subgraphs added (a new start point with its edges) and removed (the old one); what is the same
/// is not written again. Not thread-safe, and the problem outlives it.
///
/// A source or target of several regions has, from its first search on and as long as this lives, a
/// vertex of dimension 0 in the problem's graph.
class SWITCHYARD_EXPORT GcsTrajectorySearch {
 public:
  explicit GcsTrajectorySearch(GcsTrajectoryOptimization& problem, Host& host = Host::Default());
  GcsTrajectorySearch(const GcsTrajectorySearch&) = delete;
  GcsTrajectorySearch& operator=(const GcsTrajectorySearch&) = delete;
  ~GcsTrajectorySearch();
  /// As GcsTrajectoryOptimization::FindPath.
  GcsTrajectory FindPath(const GcsTrajectoryOptimization::Subgraph& source,
                         const GcsTrajectoryOptimization::Subgraph& target,
                         const GraphOfConvexSetsOptions& options = {});

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace switchyard

#include "switchyard/trajectory/edges_between_subgraphs.hpp"  // IWYU pragma: export
#include "switchyard/trajectory/subgraph.hpp"                 // IWYU pragma: export
