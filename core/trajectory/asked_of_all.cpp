// What is asked of a whole problem: of its subgraphs that there are, and those that will be.
#include <algorithm>
#include <cmath>

#include "core/trajectory/trajectory_problem.hpp"

namespace switchyard {
namespace {

using Subgraph = GcsTrajectoryOptimization::Subgraph;

/// Now, and later.
template <class Cost>
void AddToAll(TrajectoryProblem& problem, Cost cost) {
  for (const auto& subgraph : problem.subgraphs) cost(*subgraph);
  problem.costs.push_back(cost);
}

}  // namespace

void GcsTrajectoryOptimization::AddTimeCost(double weight) {
  Require(std::isfinite(weight), "AddTimeCost needs a finite weight, got ", weight);
  AddToAll(*problem_, [weight](Subgraph& subgraph) { subgraph.AddTimeCost(weight); });
}

void GcsTrajectoryOptimization::AddPathLengthCost(const Eigen::MatrixXd& weight_matrix) {
  CheckWeight("AddPathLengthCost", num_positions(), weight_matrix);
  AddToAll(*problem_,
           [weight_matrix](Subgraph& subgraph) { subgraph.AddPathLengthCost(weight_matrix); });
}

void GcsTrajectoryOptimization::AddPathLengthCost(double weight) {
  CheckWeight("AddPathLengthCost", weight);
  AddToAll(*problem_, [weight](Subgraph& subgraph) { subgraph.AddPathLengthCost(weight); });
}

void GcsTrajectoryOptimization::AddPathEnergyCost(const Eigen::MatrixXd& weight_matrix) {
  CheckWeight("AddPathEnergyCost", num_positions(), weight_matrix);
  AddToAll(*problem_,
           [weight_matrix](Subgraph& subgraph) { subgraph.AddPathEnergyCost(weight_matrix); });
}

void GcsTrajectoryOptimization::AddPathEnergyCost(double weight) {
  CheckWeight("AddPathEnergyCost", weight);
  AddToAll(*problem_, [weight](Subgraph& subgraph) { subgraph.AddPathEnergyCost(weight); });
}

void GcsTrajectoryOptimization::AddVelocityBounds(const VectorRef& lb, const VectorRef& ub) {
  const DerivativeBound bound = CheckedBound("AddVelocityBounds", num_positions(), 1, lb, ub);
  for (const auto& subgraph : problem_->subgraphs) {
    if (subgraph->order() >= 1) subgraph->AddVelocityBounds(lb, ub);
  }
  problem_->demands.bounds.push_back(bound);
}

void GcsTrajectoryOptimization::AddNonlinearDerivativeBounds(const VectorRef& lb,
                                                             const VectorRef& ub,
                                                             int derivative_order) {
  const DerivativeBound bound = CheckedNonlinearBound("AddNonlinearDerivativeBounds",
                                                      num_positions(), derivative_order, lb, ub);
  for (const auto& subgraph : problem_->subgraphs) {
    Require(subgraph->order() < derivative_order || subgraph->h_min() > 0,
            "AddNonlinearDerivativeBounds: derivative bounds need h_min > 0 at every segment they "
            "touch, and at subgraph ",
            subgraph->name(), " it is ", subgraph->h_min());
  }
  for (const auto& subgraph : problem_->subgraphs) {
    if (subgraph->order() < derivative_order) continue;
    subgraph->AddNonlinearDerivativeBounds(lb, ub, derivative_order);
  }
  problem_->demands.bounds.push_back(bound);
}

void GcsTrajectoryOptimization::AddPathContinuityConstraints(int continuity_order) {
  Require(continuity_order >= 1, "AddPathContinuityConstraints needs an order of 1 or more, got ",
          continuity_order, ": segments join anyway");
  for (const auto& subgraph : problem_->subgraphs) {
    if (subgraph->order() < continuity_order) continue;
    subgraph->AddPathContinuityConstraints(continuity_order);
  }
  for (const auto& edges : problem_->between) {
    const int order = std::min(edges->from_subgraph().order(), edges->to_subgraph().order());
    if (order >= continuity_order) edges->AddPathContinuityConstraints(continuity_order);
  }
  problem_->demands.path_continuity.push_back(continuity_order);
}

void GcsTrajectoryOptimization::AddContinuityConstraints(int continuity_order) {
  constexpr const char* kCall = "AddContinuityConstraints";
  Require(continuity_order >= 1, kCall, " needs an order of 1 or more, got ", continuity_order,
          ": segments join anyway");
  std::vector<JointGroup*> all;
  const auto take = [&](JointGroup& joints) {
    if (std::min(joints.shape.u.order, joints.shape.v.order) < continuity_order) return;
    if (joints.edges.empty()) return;
    joints.RequireTimeContinuity(kCall, continuity_order);
    all.push_back(&joints);
  };
  for (const auto& subgraph : problem_->subgraphs) take(subgraph->content_->joints);
  for (const auto& edges : problem_->between) take(edges->content_->joints);
  for (JointGroup* joints : all) {
    joints->AddTimeContinuity(kCall, continuity_order, problem_->characteristic_time);
  }
  problem_->demands.time_continuity.push_back(continuity_order);
}

void GcsTrajectoryOptimization::UseSurrogates(double characteristic_time) {
  Require(characteristic_time > 0 && std::isfinite(characteristic_time),
          "UseSurrogates needs a characteristic time above 0, got ", characteristic_time);
  Require(!problem_->characteristic_time.has_value(),
          "UseSurrogates: surrogates are in use already, with a characteristic time of ",
          problem_->characteristic_time.value_or(0));
  problem_->characteristic_time = characteristic_time;
  for (const auto& subgraph : problem_->subgraphs) {
    subgraph->content_->segments.AddSurrogates(characteristic_time);
    subgraph->content_->joints.AddSurrogates(characteristic_time);
  }
  for (const auto& edges : problem_->between) {
    edges->content_->joints.AddSurrogates(characteristic_time);
  }
}

}  // namespace switchyard
