// switchyard/trajectory/efforts.hpp - what a motion takes of a robot's joints.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "switchyard/dynamics/rigid_body_model.hpp"
#include "switchyard/model/evaluator.hpp"
#include "switchyard/trajectory/trajectory.hpp"

namespace switchyard {

/// tau of inverse dynamics along the trajectory, a column for each time. Throws where the
/// trajectory is not a column of as many rows as the model has joints, or has no derivatives.
SWITCHYARD_EXPORT Eigen::MatrixXd EffortsAlong(const RigidBodyModel& model,
                                               const Trajectory<double>& trajectory,
                                               const VectorRef& times);

/// By how much, when and at which joint efforts are farthest outside of their bounds.
struct EffortExcess {
  double amount = 0;  // newton metres, newtons; 0 where none is outside
  double time = 0;
  int joint = -1;
};

/// At `samples` + 1 times, evenly from start to end. A side that is not given is the model's; an
/// infinite one is free. Throws as EffortsAlong does, for bounds of another size or NaN, and for
/// fewer samples than 1.
SWITCHYARD_EXPORT EffortExcess
EffortViolation(const RigidBodyModel& model, const Trajectory<double>& trajectory,
                const std::optional<Eigen::VectorXd>& lb = std::nullopt,
                const std::optional<Eigen::VectorXd>& ub = std::nullopt, int samples = 1000);

}  // namespace switchyard
