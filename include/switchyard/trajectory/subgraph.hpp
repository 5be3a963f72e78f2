// switchyard/trajectory/subgraph.hpp - regions whose segments have the same order and range of
// durations, and what is asked of them.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "switchyard/symbolic/lists.hpp"
#include "switchyard/trajectory/gcs_trajectory_optimization.hpp"

namespace switchyard {

struct SubgraphContent;

/// In what follows P is n x (order + 1), the control points of a segment by columns, h its duration
/// in seconds, M_k the map of BezierDerivativeMap. Bounds have num_positions() entries; an infinite
/// side is free. All that add something throw InvalidArgument for numbers that are NaN, sizes that
/// do not fit, bounds that are crossed, and an order that is too low.
class SWITCHYARD_EXPORT GcsTrajectoryOptimization::Subgraph final {
 public:
  using TranscriptionSet = GraphOfConvexSets::TranscriptionSet;

  Subgraph(const Subgraph&) = delete;
  Subgraph& operator=(const Subgraph&) = delete;
  ~Subgraph();
  [[nodiscard]] const std::string& name() const;
  [[nodiscard]] int order() const;
  [[nodiscard]] int size() const;  // the number of regions
  [[nodiscard]] double h_min() const;
  [[nodiscard]] double h_max() const;
  [[nodiscard]] const ConvexSets& regions() const;
  /// By region.
  [[nodiscard]] const std::vector<Vertex*>& Vertices();
  [[nodiscard]] std::vector<const Vertex*> Vertices() const;
  /// Between its own regions.
  [[nodiscard]] const std::vector<Edge*>& Edges();
  [[nodiscard]] std::vector<const Edge*> Edges() const;

  /// weight h.
  void AddTimeCost(double weight = 1.0);
  /// sum_i |W (r_{i+1} - r_i)|, no less than the length of the curve W r. A number w >= 0 is the
  /// matrix w I. W has num_positions() columns; of order 0 there is nothing to add.
  void AddPathLengthCost(const Eigen::MatrixXd& weight_matrix);
  void AddPathLengthCost(double weight = 1.0);
  /// sum_i |W (r_{i+1} - r_i)|^2. A number w >= 0 is sum_i w |r_{i+1} - r_i|^2, the matrix
  /// sqrt(w) I.
  void AddPathEnergyCost(const Eigen::MatrixXd& weight_matrix);
  void AddPathEnergyCost(double weight = 1.0);

  /// lb <= dq/dt <= ub: h lb <= P M_1 <= h ub, by columns, which holds q's velocity, a convex
  /// combination of them. Linear.
  void AddVelocityBounds(const VectorRef& lb, const VectorRef& ub);
  /// lb <= d^N q / dt^N <= ub for N >= 2: h^N lb <= P M_N <= h^N ub, by columns. Nonlinear, for the
  /// mixed-integer program (that no backend takes) and the restriction; the relaxation has linear
  /// rows that every such trajectory satisfies, by chords and tangents of h^N over [h_min, h_max]:
  /// the narrower that range, the better the bound. Needs h_min > 0. See UseSurrogates.
  void AddNonlinearDerivativeBounds(const VectorRef& lb, const VectorRef& ub, int derivative_order);
  /// On its edges, the k-th derivative of r is the same at the end of one segment and the start of
  /// the next. Linear; q's is where durations are equal, or after NormalizeSegmentTimes.
  void AddPathContinuityConstraints(int continuity_order);
  /// On its edges, the k-th time derivative of q is the same on both sides. Nonlinear, for the
  /// mixed-integer program and the restriction, unless h_min = h_max; the relaxation has nothing of
  /// it. Needs h_min > 0. For C^k ask for each order from 1 to k.
  void AddContinuityConstraints(int continuity_order);

  // ---- Costs and constraints of a user's own, by placeholders ----

  /// These variables stand for those of every segment, and for those of the two segments u and v of
  /// every edge, in the calls below and nowhere else.
  [[nodiscard]] Variable vertex_duration() const;
  [[nodiscard]] const MatrixXDecisionVariable& vertex_control_points() const;
  [[nodiscard]] const std::pair<Variable, Variable>& edge_constituent_vertex_durations() const;
  [[nodiscard]] const std::pair<MatrixXDecisionVariable, MatrixXDecisionVariable>&
  edge_constituent_vertex_control_points() const;

  /// For each segment. They throw where a variable is not a placeholder of this subgraph's
  /// vertices, as the others for edges.
  void AddVertexCost(const Expression& e, TranscriptionSet in = {});
  void AddVertexCost(const Binding<Cost>& binding, TranscriptionSet in = {});
  void AddVertexConstraint(const FormulaList& formula, TranscriptionSet in = {});
  void AddVertexConstraint(const Binding<Constraint>& binding, TranscriptionSet in = {});
  /// For each edge between two of its regions.
  void AddEdgeCost(const Expression& e, TranscriptionSet in = {});
  void AddEdgeCost(const Binding<Cost>& binding, TranscriptionSet in = {});
  void AddEdgeConstraint(const FormulaList& formula, TranscriptionSet in = {});
  void AddEdgeConstraint(const Binding<Constraint>& binding, TranscriptionSet in = {});

 private:
  friend class GcsTrajectoryOptimization;
  friend class GcsTrajectorySearch;
  explicit Subgraph(std::unique_ptr<SubgraphContent> content);
  std::unique_ptr<SubgraphContent> content_;
};

}  // namespace switchyard
