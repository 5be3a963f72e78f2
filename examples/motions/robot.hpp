// What the examples of motions share: a 7-joint arm, and a picture of its motion.
#pragma once

#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "examples/trajectories/svg.hpp"
#include "switchyard/dynamics/rigid_body_model.hpp"
#include "switchyard/trajectory/efforts.hpp"

/// What a program that cannot run here returns.
constexpr int kSkipped = 77;

/// The arm "panda" of example-robot-data, its fingers half open, from the folder of robots that the
/// program is called with. None, and a sentence why, where it or an engine of dynamics is not
/// there.
inline std::optional<switchyard::RigidBodyModel> Panda(int argc, char** argv) {
  using switchyard::RigidBodyModel;
  const std::filesystem::path robots = argc > 1 ? argv[1] : "";
  const std::filesystem::path file =
      robots / "example-robot-data/robots/panda_description/urdf/panda.urdf";
  if (!std::filesystem::exists(file)) {
    std::cout << "skipped: the robot " << file
              << " is not there; call with a folder of robots, the "
              << "share/ of PyPI's example-robot-data\n";
    return std::nullopt;
  }
  if (RigidBodyModel::Engines().empty()) {
    std::cout << "skipped: no plugin that was found offers rigid-body dynamics; pinocchio does\n";
    return std::nullopt;
  }
  // The second finger follows the first.
  return RigidBodyModel::LoadUrdf(
      file, {.packages = {robots}, .locked = {{"panda_finger_joint1", 0.02}}});
}

// Of the arm's data sheet, which the file does not have: rad/s^2, rad/s^3.
inline Eigen::VectorXd PandaAccelerations() {
  return Eigen::Vector<double, 7>(15, 7.5, 10, 12.5, 15, 20, 20);
}
inline Eigen::VectorXd PandaJerks() { return 500 * PandaAccelerations(); }
/// Two thirds of what the joints can, the rest for what the hand holds.
inline Eigen::VectorXd PandaEfforts(const switchyard::RigidBodyModel& arm) {
  return 2.0 / 3.0 * arm.effort_limits();
}

/// Joints, velocities, accelerations and torques over time, each with its limits.
inline void DrawMotion(const std::string& path, const std::string& title,
                       const switchyard::RigidBodyModel& arm,
                       const switchyard::Trajectory<double>& motion,
                       const std::vector<double>& marks = {}) {
  std::vector<std::string> names;
  for (const auto& joint : arm.joints()) {
    names.push_back(joint.name.substr(joint.name.rfind('_') + 1));
  }
  PlotGrid plots(names,
                 {"position, rad", "velocity, rad/s", "acceleration, rad/s²", "torque, N m"});
  const Eigen::VectorXd times =
      Eigen::VectorXd::LinSpaced(400, motion.start_time(), motion.end_time());
  const Eigen::MatrixXd values[] = {
      motion.vector_values(times), motion.MakeDerivative(1)->vector_values(times),
      motion.MakeDerivative(2)->vector_values(times), EffortsAlong(arm, motion, times)};
  const Eigen::VectorXd upper[] = {arm.position_upper_limits(), arm.velocity_limits(),
                                   PandaAccelerations(), PandaEfforts(arm)};
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto joint = static_cast<Eigen::Index>(i);
    for (std::size_t j = 0; j < 4; ++j) {
      plots.Curve(i, j, times, values[j].row(joint).transpose());
      const double lower = j == 0 ? arm.position_lower_limits()[joint] : -upper[j][joint];
      plots.Limits(i, j, lower, upper[j][joint]);
    }
  }
  for (const double mark : marks) plots.Mark(mark);
  plots.Write(path, title);
}
