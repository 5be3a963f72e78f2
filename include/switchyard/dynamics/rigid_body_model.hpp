// switchyard/dynamics/rigid_body_model.hpp - a robot as its file describes it: the efforts that its
// motion takes, where its frames are, how far its bodies are apart.
#pragma once

#include <Eigen/Core>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "switchyard/export.hpp"

namespace switchyard {

class Host;
struct LoadedModel;  // what a model is made of

struct RigidBodyOptions {
  /// Folders in which what a file names package://... is looked for.
  std::vector<std::string> packages = {};
  /// Joints that are fixed, as if welded, and where: radians, metres. They have no coordinate.
  std::map<std::string, double> locked = {};
  /// m/s^2. Unset: the file's own, or (0, 0, -9.81) where it has none.
  std::optional<Eigen::Vector3d> gravity = {};
  /// Are shapes loaded, too, so that distances can be asked?
  bool geometry = false;
  /// The name of an engine or of its plugin; empty: the first that there is.
  std::string engine = {};
  /// Whose plugins are asked; null: those of Host::Default().
  const Host* host = nullptr;
};

/// A joint of one coordinate. Infinite limits are none.
struct RigidBodyJoint {
  enum class Type { kRevolute, kContinuous, kPrismatic };
  std::string name;
  Type type = Type::kRevolute;
  double position_lower = 0;  // radians, metres
  double position_upper = 0;
  double velocity = 0;  // |v| <= velocity
  double effort = 0;    // |tau| <= effort; newton metres, newtons
  double armature = 0;  // inertia of the rotor at the joint, part of inverse dynamics
  double damping = 0;   // damping v is part of inverse dynamics
  double friction = 0;  // dry; no part of it: it has no derivative at rest
};

/// tau and its derivatives by q, v and a, n x n each; that by a is the mass matrix.
struct InverseDynamicsDerivatives {
  Eigen::VectorXd tau;
  Eigen::MatrixXd d_q, d_v, d_a;
};

/// Where a frame is in the world.
struct FramePose {
  Eigen::Vector3d position;
  Eigen::Matrix3d rotation;  // its axes, by columns
};

/// And how it moves: the velocity of its origin is the first three rows of `jacobian` times v, its
/// angular velocity the last three, both along the world's axes. 6 x n.
struct FrameMotion {
  FramePose pose;
  Eigen::Matrix<double, 6, Eigen::Dynamic> jacobian;
};

/// Distances of pairs, and their gradients by q as rows.
struct PairDistances {
  Eigen::VectorXd distance;
  Eigen::MatrixXd gradient;
};

/// A tree of bodies and joints with n coordinates q, whose rates are the velocities v; joints are
/// numbered from the root outwards. Revolute, continuous and prismatic joints.
///
/// An engine of a plugin computes (switchyard/dynamics.h). A value: copies are the same model.
/// All members are const and may be called from several threads at once. They throw
/// InvalidArgument where a vector has another size than n, an index or name is none, and where the
/// engine fails, with its words.
class SWITCHYARD_EXPORT RigidBodyModel final {
 public:
  // Throw InvalidArgument where no plugin offers dynamics, the text is not understood (with its
  // line, where the engine knows it), a joint to lock is not there or a joint has another type.
  [[nodiscard]] static RigidBodyModel LoadUrdf(const std::string& path,
                                               const RigidBodyOptions& options = {});
  [[nodiscard]] static RigidBodyModel LoadMjcf(const std::string& path,
                                               const RigidBodyOptions& options = {});
  /// From the content of such a file.
  [[nodiscard]] static RigidBodyModel ParseUrdf(const std::string& text,
                                                const RigidBodyOptions& options = {});
  [[nodiscard]] static RigidBodyModel ParseMjcf(const std::string& text,
                                                const RigidBodyOptions& options = {});
  /// The names of the engines that there are. Of Host::Default() where `host` is null.
  [[nodiscard]] static std::vector<std::string> Engines(const Host* host = nullptr);

  [[nodiscard]] const std::string& name() const;
  /// "pinocchio 4.1"
  [[nodiscard]] const std::string& engine() const;
  [[nodiscard]] int num_positions() const { return static_cast<int>(joints().size()); }
  [[nodiscard]] const std::vector<RigidBodyJoint>& joints() const;
  [[nodiscard]] int JointIndex(const std::string& name) const;

  // Of all joints, n entries each.
  [[nodiscard]] Eigen::VectorXd position_lower_limits() const;
  [[nodiscard]] Eigen::VectorXd position_upper_limits() const;
  [[nodiscard]] Eigen::VectorXd velocity_limits() const;
  [[nodiscard]] Eigen::VectorXd effort_limits() const;

  /// tau = M(q) a + C(q, v) v + damping v - tau_g(q).
  [[nodiscard]] Eigen::VectorXd InverseDynamics(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                                const Eigen::VectorXd& a) const;
  [[nodiscard]] InverseDynamicsDerivatives DerivativesOfInverseDynamics(
      const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a) const;
  /// Of w'tau by (q, v, a), 3 n x 3 n.
  [[nodiscard]] Eigen::MatrixXd HessianOfInverseDynamics(const Eigen::VectorXd& q,
                                                         const Eigen::VectorXd& v,
                                                         const Eigen::VectorXd& a,
                                                         const Eigen::VectorXd& w) const;

  /// Names of bodies, joints and frames.
  [[nodiscard]] const std::vector<std::string>& frames() const;
  [[nodiscard]] int FrameIndex(const std::string& name) const;
  [[nodiscard]] FramePose PoseOf(const std::string& frame, const Eigen::VectorXd& q) const;
  [[nodiscard]] FrameMotion MotionOf(const std::string& frame, const Eigen::VectorXd& q) const;

  /// Names of two shapes each, whose distance can be asked: not those of one body, nor of a body
  /// and the one that carries it. Empty without `geometry`.
  [[nodiscard]] const std::vector<std::pair<std::string, std::string>>& pairs() const;
  /// In any order of the two.
  [[nodiscard]] int PairIndex(const std::string& first, const std::string& second) const;
  /// Metres, negative where two meet, by the depth.
  [[nodiscard]] Eigen::VectorXd Distances(const Eigen::VectorXd& q,
                                          const std::vector<int>& pairs) const;
  [[nodiscard]] PairDistances DerivativesOfDistances(const Eigen::VectorXd& q,
                                                     const std::vector<int>& pairs) const;

  [[nodiscard]] const std::shared_ptr<const LoadedModel>& loaded() const { return loaded_; }

 private:
  explicit RigidBodyModel(std::shared_ptr<const LoadedModel> loaded);
  std::shared_ptr<const LoadedModel> loaded_;
};

}  // namespace switchyard
