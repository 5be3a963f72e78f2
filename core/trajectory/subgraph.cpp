#include "switchyard/trajectory/subgraph.hpp"

#include <cmath>

#include "core/trajectory/trajectory_problem.hpp"

namespace switchyard {
namespace {

using Vertex = GraphOfConvexSets::Vertex;
using Edge = GraphOfConvexSets::Edge;

std::string Of(const SubgraphContent& content, const char* call) {
  return Text(call, " of subgraph ", content.name);
}

}  // namespace

GcsTrajectoryOptimization::Subgraph::Subgraph(std::unique_ptr<SubgraphContent> content)
    : content_(std::move(content)) {}
GcsTrajectoryOptimization::Subgraph::~Subgraph() = default;

const std::string& GcsTrajectoryOptimization::Subgraph::name() const { return content_->name; }
int GcsTrajectoryOptimization::Subgraph::order() const { return content_->segments.shape.order; }
int GcsTrajectoryOptimization::Subgraph::size() const {
  return static_cast<int>(content_->regions.size());
}
double GcsTrajectoryOptimization::Subgraph::h_min() const { return content_->segments.shape.h_min; }
double GcsTrajectoryOptimization::Subgraph::h_max() const { return content_->segments.shape.h_max; }
const ConvexSets& GcsTrajectoryOptimization::Subgraph::regions() const { return content_->regions; }
const std::vector<Vertex*>& GcsTrajectoryOptimization::Subgraph::Vertices() {
  return content_->segments.vertices;
}
std::vector<const Vertex*> GcsTrajectoryOptimization::Subgraph::Vertices() const {
  return {content_->segments.vertices.begin(), content_->segments.vertices.end()};
}
const std::vector<Edge*>& GcsTrajectoryOptimization::Subgraph::Edges() {
  return content_->joints.edges;
}
std::vector<const Edge*> GcsTrajectoryOptimization::Subgraph::Edges() const {
  return {content_->joints.edges.begin(), content_->joints.edges.end()};
}

// ---- Costs ----

void GcsTrajectoryOptimization::Subgraph::AddTimeCost(double weight) {
  Require(std::isfinite(weight), Of(*content_, "AddTimeCost"), " needs a finite weight, got ",
          weight);
  content_->segments.Add(TimeCost(content_->segments.shape, weight));
}

void GcsTrajectoryOptimization::Subgraph::AddPathLengthCost(const Eigen::MatrixXd& weight_matrix) {
  CheckWeight(Of(*content_, "AddPathLengthCost"), content_->segments.shape.num_positions,
              weight_matrix);
  content_->segments.AddLength(weight_matrix);
}

void GcsTrajectoryOptimization::Subgraph::AddPathLengthCost(double weight) {
  CheckWeight(Of(*content_, "AddPathLengthCost"), weight);
  const int n = content_->segments.shape.num_positions;
  content_->segments.AddLength(weight * Eigen::MatrixXd::Identity(n, n));
}

void GcsTrajectoryOptimization::Subgraph::AddPathEnergyCost(const Eigen::MatrixXd& weight_matrix) {
  CheckWeight(Of(*content_, "AddPathEnergyCost"), content_->segments.shape.num_positions,
              weight_matrix);
  content_->segments.AddEnergy(weight_matrix);
}

void GcsTrajectoryOptimization::Subgraph::AddPathEnergyCost(double weight) {
  CheckWeight(Of(*content_, "AddPathEnergyCost"), weight);
  const int n = content_->segments.shape.num_positions;
  content_->segments.AddEnergy(std::sqrt(weight) * Eigen::MatrixXd::Identity(n, n));
}

// ---- Bounds and continuity ----

void GcsTrajectoryOptimization::Subgraph::AddVelocityBounds(const VectorRef& lb,
                                                            const VectorRef& ub) {
  const std::string call = Of(*content_, "AddVelocityBounds");
  SegmentGroup& segments = content_->segments;
  const DerivativeBound bound = CheckedBound(call, segments.shape.num_positions, 1, lb, ub);
  Require(segments.shape.order >= 1, call,
          " needs order 1 or more, got 0: a point has no velocity");
  segments.AddBound(bound, std::nullopt);
}

void GcsTrajectoryOptimization::Subgraph::AddNonlinearDerivativeBounds(const VectorRef& lb,
                                                                       const VectorRef& ub,
                                                                       int derivative_order) {
  const std::string call = Of(*content_, "AddNonlinearDerivativeBounds");
  SegmentGroup& segments = content_->segments;
  const DerivativeBound bound =
      CheckedNonlinearBound(call, segments.shape.num_positions, derivative_order, lb, ub);
  Require(segments.shape.order >= derivative_order, call, " needs order ", derivative_order,
          " or more, got ", segments.shape.order);
  segments.AddBound(bound, content_->problem->characteristic_time);
}

void GcsTrajectoryOptimization::Subgraph::AddPathContinuityConstraints(int continuity_order) {
  content_->joints.AddPathContinuity("AddPathContinuityConstraints", continuity_order);
}

void GcsTrajectoryOptimization::Subgraph::AddContinuityConstraints(int continuity_order) {
  content_->joints.AddTimeContinuity("AddContinuityConstraints", continuity_order,
                                     content_->problem->characteristic_time);
}

// ---- Placeholders ----

Variable GcsTrajectoryOptimization::Subgraph::vertex_duration() const {
  return content_->segments.placeholders.durations().front();
}
const MatrixXDecisionVariable& GcsTrajectoryOptimization::Subgraph::vertex_control_points() const {
  return content_->segments.placeholders.points().front();
}
const std::pair<Variable, Variable>&
GcsTrajectoryOptimization::Subgraph::edge_constituent_vertex_durations() const {
  return content_->joints.durations;
}
const std::pair<MatrixXDecisionVariable, MatrixXDecisionVariable>&
GcsTrajectoryOptimization::Subgraph::edge_constituent_vertex_control_points() const {
  return content_->joints.points;
}

void GcsTrajectoryOptimization::Subgraph::AddVertexCost(const Expression& e, TranscriptionSet in) {
  SegmentGroup& segments = content_->segments;
  segments.Add(segments.placeholders.Place(e, in, Of(*content_, "AddVertexCost")));
}
void GcsTrajectoryOptimization::Subgraph::AddVertexCost(const Binding<Cost>& binding,
                                                        TranscriptionSet in) {
  SegmentGroup& segments = content_->segments;
  segments.Add(segments.placeholders.Place(binding, in, Of(*content_, "AddVertexCost")));
}
void GcsTrajectoryOptimization::Subgraph::AddVertexConstraint(const FormulaList& formula,
                                                              TranscriptionSet in) {
  SegmentGroup& segments = content_->segments;
  segments.Add(segments.placeholders.Place(formula, in, Of(*content_, "AddVertexConstraint")));
}
void GcsTrajectoryOptimization::Subgraph::AddVertexConstraint(const Binding<Constraint>& binding,
                                                              TranscriptionSet in) {
  SegmentGroup& segments = content_->segments;
  segments.Add(segments.placeholders.Place(binding, in, Of(*content_, "AddVertexConstraint")));
}
void GcsTrajectoryOptimization::Subgraph::AddEdgeCost(const Expression& e, TranscriptionSet in) {
  JointGroup& joints = content_->joints;
  joints.Add(joints.placeholders.Place(e, in, Of(*content_, "AddEdgeCost")));
}
void GcsTrajectoryOptimization::Subgraph::AddEdgeCost(const Binding<Cost>& binding,
                                                      TranscriptionSet in) {
  JointGroup& joints = content_->joints;
  joints.Add(joints.placeholders.Place(binding, in, Of(*content_, "AddEdgeCost")));
}
void GcsTrajectoryOptimization::Subgraph::AddEdgeConstraint(const FormulaList& formula,
                                                            TranscriptionSet in) {
  JointGroup& joints = content_->joints;
  joints.Add(joints.placeholders.Place(formula, in, Of(*content_, "AddEdgeConstraint")));
}
void GcsTrajectoryOptimization::Subgraph::AddEdgeConstraint(const Binding<Constraint>& binding,
                                                            TranscriptionSet in) {
  JointGroup& joints = content_->joints;
  joints.Add(joints.placeholders.Place(binding, in, Of(*content_, "AddEdgeConstraint")));
}

}  // namespace switchyard
