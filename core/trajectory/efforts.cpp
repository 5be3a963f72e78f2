#include "switchyard/trajectory/efforts.hpp"

#include "core/trajectory/kinematic_checks.hpp"

namespace switchyard {

Eigen::MatrixXd EffortsAlong(const RigidBodyModel& model, const Trajectory<double>& trajectory,
                             const VectorRef& times) {
  Require(trajectory.rows() == model.num_positions() && trajectory.cols() == 1,
          "EffortsAlong needs a trajectory of ", model.num_positions(),
          " x 1, one for each joint of \"", model.name(), "\", got ", trajectory.rows(), " x ",
          trajectory.cols());
  Eigen::MatrixXd efforts(model.num_positions(), times.size());
  for (Eigen::Index k = 0; k < times.size(); ++k) {
    efforts.col(k) =
        model.InverseDynamics(trajectory.value(times[k]), trajectory.EvalDerivative(times[k], 1),
                              trajectory.EvalDerivative(times[k], 2));
  }
  return efforts;
}

EffortExcess EffortViolation(const RigidBodyModel& model, const Trajectory<double>& trajectory,
                             const std::optional<Eigen::VectorXd>& lb,
                             const std::optional<Eigen::VectorXd>& ub, int samples) {
  constexpr const char* kCall = "EffortViolation";
  Require(samples >= 1, kCall, " needs 1 sample or more, got ", samples);
  const Eigen::VectorXd lower = lb.value_or(-model.effort_limits());
  const Eigen::VectorXd upper = ub.value_or(model.effort_limits());
  CheckVectorOfBounds(kCall, "lb", lower, model.num_positions());
  CheckVectorOfBounds(kCall, "ub", upper, model.num_positions());
  const Eigen::VectorXd times =
      Eigen::VectorXd::LinSpaced(samples + 1, trajectory.start_time(), trajectory.end_time());
  const Eigen::MatrixXd efforts = EffortsAlong(model, trajectory, times);
  EffortExcess worst;
  for (Eigen::Index k = 0; k < times.size(); ++k) {
    Eigen::Index joint = 0;
    const double excess =
        (lower - efforts.col(k)).cwiseMax(efforts.col(k) - upper).maxCoeff(&joint);
    if (excess > worst.amount) worst = {excess, times[k], static_cast<int>(joint)};
  }
  return worst;
}

}  // namespace switchyard
