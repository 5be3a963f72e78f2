// switchyard/trajectory/edges_between_subgraphs.hpp - the edges from one subgraph to another, and
// what is asked of trajectories that pass there.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "switchyard/symbolic/lists.hpp"
#include "switchyard/trajectory/gcs_trajectory_optimization.hpp"

namespace switchyard {

struct EdgesBetweenContent;

/// Below, the last control point of a derivative of segment u, and the first of segment v, are
/// those next to the joint: where they are, q's derivative is their value. Bounds and zeros are for
/// the sides whose order is high enough; they throw where none is. As those of Subgraph, the rest
/// of which holds here too.
class SWITCHYARD_EXPORT GcsTrajectoryOptimization::EdgesBetweenSubgraphs final {
 public:
  using TranscriptionSet = GraphOfConvexSets::TranscriptionSet;

  EdgesBetweenSubgraphs(const EdgesBetweenSubgraphs&) = delete;
  EdgesBetweenSubgraphs& operator=(const EdgesBetweenSubgraphs&) = delete;
  ~EdgesBetweenSubgraphs();
  [[nodiscard]] const Subgraph& from_subgraph() const;
  [[nodiscard]] const Subgraph& to_subgraph() const;
  [[nodiscard]] const std::vector<Edge*>& Edges();
  [[nodiscard]] std::vector<const Edge*> Edges() const;

  /// lb <= dq/dt <= ub on both sides of the joint.
  void AddVelocityBounds(const VectorRef& lb, const VectorRef& ub);
  /// lb <= d^N q / dt^N <= ub, N >= 2, on both sides, each with its own duration.
  void AddNonlinearDerivativeBounds(const VectorRef& lb, const VectorRef& ub, int derivative_order);
  /// d^k q / dt^k = 0 on both sides: linear, since it is zero where d^k r / ds^k is.
  void AddZeroDerivativeConstraints(int derivative_order);
  /// As those of Subgraph; both sides need the order.
  void AddPathContinuityConstraints(int continuity_order);
  void AddContinuityConstraints(int continuity_order);

  /// Placeholders, as those of Subgraph: the sides may have different orders.
  [[nodiscard]] const std::pair<Variable, Variable>& edge_constituent_vertex_durations() const;
  [[nodiscard]] const std::pair<MatrixXDecisionVariable, MatrixXDecisionVariable>&
  edge_constituent_vertex_control_points() const;
  void AddEdgeCost(const Expression& e, TranscriptionSet in = {});
  void AddEdgeCost(const Binding<Cost>& binding, TranscriptionSet in = {});
  void AddEdgeConstraint(const FormulaList& formula, TranscriptionSet in = {});
  void AddEdgeConstraint(const Binding<Constraint>& binding, TranscriptionSet in = {});

 private:
  friend class GcsTrajectoryOptimization;
  explicit EdgesBetweenSubgraphs(std::unique_ptr<EdgesBetweenContent> content);
  std::unique_ptr<EdgesBetweenContent> content_;
};

}  // namespace switchyard
