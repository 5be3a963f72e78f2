// Limits of a robot's joints: of positions and velocities at all times, of efforts at some.
#include <algorithm>
#include <cmath>

#include "core/trajectory/kinematic_checks.hpp"
#include "switchyard/dynamics/model_functions.hpp"
#include "switchyard/trajectory/kinematic_trajectory_optimization.hpp"

namespace switchyard {

using Eigen::VectorXd;

void KinematicTrajectoryOptimization::CheckModel(const std::string& call,
                                                 const RigidBodyModel& model) const {
  Require(model.num_positions() == num_positions(), call, " needs a model of ", num_positions(),
          num_positions() == 1 ? " joint" : " joints", ", one for each position, got \"",
          model.name(), "\" of ", model.num_positions());
}

std::vector<Binding<Constraint>> KinematicTrajectoryOptimization::AddFunction(
    const std::string& call, const std::string& description, std::shared_ptr<const Function> f,
    const VectorRef& lb, const VectorRef& ub, const VariableList& placeholders,
    const VectorRef& s) {
  const auto constraint = std::make_shared<FunctionConstraint>(std::move(f), lb, ub);
  constraint->set_description(description);
  const Binding<Constraint> binding(constraint, placeholders);
  std::vector<Binding<Constraint>> all;
  for (const double one : s) all.push_back(ConstraintAt(call, binding, one));
  for (const auto& one : all) program_.AddConstraint(one);
  return all;
}

void KinematicTrajectoryOptimization::AddJointLimits(const RigidBodyModel& model) {
  CheckModel("AddJointLimits", model);
  const VectorXd velocity = model.velocity_limits();
  Require(basis_.order() > 1 || !velocity.array().isFinite().any(), "AddJointLimits",
          " needs a spline of order 2 or more for velocities, got ", basis_.order());
  AddPositionBounds(model.position_lower_limits(), model.position_upper_limits());
  if (velocity.array().isFinite().any()) AddVelocityBounds(-velocity, velocity);
}

std::vector<Binding<Constraint>> KinematicTrajectoryOptimization::AddEffortBoundsAtNormalizedTimes(
    const RigidBodyModel& model, const VectorRef& s, const std::optional<VectorXd>& lb,
    const std::optional<VectorXd>& ub) {
  constexpr const char* kCall = "AddEffortBoundsAtNormalizedTimes";
  CheckModel(kCall, model);
  const VectorXd lower = lb.value_or(-model.effort_limits());
  const VectorXd upper = ub.value_or(model.effort_limits());
  CheckBounds(kCall, lower, upper);
  std::vector<int> joints;
  for (int i = 0; i < num_positions(); ++i) {
    if (std::isfinite(lower[i]) || std::isfinite(upper[i])) joints.push_back(i);
  }
  Require(!joints.empty(), kCall, " needs a joint with a finite bound: ",
          lb && ub ? "those given have none" : Text("\"", model.name(), "\" has none"));
  const auto added = AddFunction(kCall, "efforts of \"" + model.name() + "\"",
                                 InverseDynamicsFunction(model, joints), lower(joints),
                                 upper(joints), {q(), qdot(), qddot()}, s);
  effort_bounds_.push_back({model, lower, upper});
  return added;
}

}  // namespace switchyard
