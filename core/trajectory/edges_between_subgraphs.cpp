#include "switchyard/trajectory/edges_between_subgraphs.hpp"

#include "core/trajectory/trajectory_problem.hpp"

namespace switchyard {
namespace {

using Edge = GraphOfConvexSets::Edge;

std::string Of(const EdgesBetweenContent& content, const char* call) {
  return Text(call, " of ", content.joints.name);
}

}  // namespace

GcsTrajectoryOptimization::EdgesBetweenSubgraphs::EdgesBetweenSubgraphs(
    std::unique_ptr<EdgesBetweenContent> content)
    : content_(std::move(content)) {}
GcsTrajectoryOptimization::EdgesBetweenSubgraphs::~EdgesBetweenSubgraphs() = default;

const GcsTrajectoryOptimization::Subgraph&
GcsTrajectoryOptimization::EdgesBetweenSubgraphs::from_subgraph() const {
  return *content_->from;
}
const GcsTrajectoryOptimization::Subgraph&
GcsTrajectoryOptimization::EdgesBetweenSubgraphs::to_subgraph() const {
  return *content_->to;
}
const std::vector<Edge*>& GcsTrajectoryOptimization::EdgesBetweenSubgraphs::Edges() {
  return content_->joints.edges;
}
std::vector<const Edge*> GcsTrajectoryOptimization::EdgesBetweenSubgraphs::Edges() const {
  return {content_->joints.edges.begin(), content_->joints.edges.end()};
}

// ---- Bounds, zeros, continuity ----

void GcsTrajectoryOptimization::EdgesBetweenSubgraphs::AddVelocityBounds(const VectorRef& lb,
                                                                         const VectorRef& ub) {
  JointGroup& joints = content_->joints;
  const DerivativeBound bound =
      CheckedBound(Of(*content_, "AddVelocityBounds"), joints.shape.u.num_positions, 1, lb, ub);
  joints.AddBound("AddVelocityBounds", bound, std::nullopt);
}

void GcsTrajectoryOptimization::EdgesBetweenSubgraphs::AddNonlinearDerivativeBounds(
    const VectorRef& lb, const VectorRef& ub, int derivative_order) {
  JointGroup& joints = content_->joints;
  const DerivativeBound bound =
      CheckedNonlinearBound(Of(*content_, "AddNonlinearDerivativeBounds"),
                            joints.shape.u.num_positions, derivative_order, lb, ub);
  joints.AddBound("AddNonlinearDerivativeBounds", bound, content_->problem->characteristic_time);
}

void GcsTrajectoryOptimization::EdgesBetweenSubgraphs::AddZeroDerivativeConstraints(
    int derivative_order) {
  content_->joints.AddZero("AddZeroDerivativeConstraints", derivative_order);
}

void GcsTrajectoryOptimization::EdgesBetweenSubgraphs::AddPathContinuityConstraints(
    int continuity_order) {
  content_->joints.AddPathContinuity("AddPathContinuityConstraints", continuity_order);
}

void GcsTrajectoryOptimization::EdgesBetweenSubgraphs::AddContinuityConstraints(
    int continuity_order) {
  content_->joints.AddTimeContinuity("AddContinuityConstraints", continuity_order,
                                     content_->problem->characteristic_time);
}

// ---- Placeholders ----

const std::pair<Variable, Variable>&
GcsTrajectoryOptimization::EdgesBetweenSubgraphs::edge_constituent_vertex_durations() const {
  return content_->joints.durations;
}
const std::pair<MatrixXDecisionVariable, MatrixXDecisionVariable>&
GcsTrajectoryOptimization::EdgesBetweenSubgraphs::edge_constituent_vertex_control_points() const {
  return content_->joints.points;
}

void GcsTrajectoryOptimization::EdgesBetweenSubgraphs::AddEdgeCost(const Expression& e,
                                                                   TranscriptionSet in) {
  JointGroup& joints = content_->joints;
  joints.Add(joints.placeholders.Place(e, in, Of(*content_, "AddEdgeCost")));
}
void GcsTrajectoryOptimization::EdgesBetweenSubgraphs::AddEdgeCost(const Binding<Cost>& binding,
                                                                   TranscriptionSet in) {
  JointGroup& joints = content_->joints;
  joints.Add(joints.placeholders.Place(binding, in, Of(*content_, "AddEdgeCost")));
}
void GcsTrajectoryOptimization::EdgesBetweenSubgraphs::AddEdgeConstraint(const FormulaList& formula,
                                                                         TranscriptionSet in) {
  JointGroup& joints = content_->joints;
  joints.Add(joints.placeholders.Place(formula, in, Of(*content_, "AddEdgeConstraint")));
}
void GcsTrajectoryOptimization::EdgesBetweenSubgraphs::AddEdgeConstraint(
    const Binding<Constraint>& binding, TranscriptionSet in) {
  JointGroup& joints = content_->joints;
  joints.Add(joints.placeholders.Place(binding, in, Of(*content_, "AddEdgeConstraint")));
}

}  // namespace switchyard
