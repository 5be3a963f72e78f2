#include "switchyard/dynamics/rigid_body_model.hpp"

#include <algorithm>

#include "core/dynamics/loaded_model.hpp"

namespace switchyard {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Where a name stands among others; throws with the nearest where it does not.
int IndexOf(const char* what, const std::string& model, const std::string& name,
            const std::vector<std::string>& names) {
  const auto at = std::find(names.begin(), names.end(), name);
  if (at != names.end()) return static_cast<int>(at - names.begin());
  const std::string near = NearestName(name, names);
  Refuse("\"", model, "\" has no ", what, " \"", name, "\"",
         near.empty() ? "" : Text("; is \"", near, "\" meant?"));
}

}  // namespace

RigidBodyModel::RigidBodyModel(std::shared_ptr<const LoadedModel> loaded)
    : loaded_(std::move(loaded)) {}

const std::string& RigidBodyModel::name() const { return loaded_->name; }
const std::string& RigidBodyModel::engine() const { return loaded_->engine; }
const std::vector<RigidBodyJoint>& RigidBodyModel::joints() const { return loaded_->joints; }
const std::vector<std::string>& RigidBodyModel::frames() const { return loaded_->frames; }
const std::vector<std::pair<std::string, std::string>>& RigidBodyModel::pairs() const {
  return loaded_->pairs;
}

namespace {

VectorXd OfJoints(const RigidBodyModel& model, double RigidBodyJoint::*fact) {
  VectorXd all(model.num_positions());
  for (int i = 0; i < all.size(); ++i) all[i] = model.joints()[static_cast<std::size_t>(i)].*fact;
  return all;
}

void CheckSize(const RigidBodyModel& model, const char* call, const char* what, const VectorXd& x) {
  Require(x.size() == model.num_positions(), call, ": ", what, " needs ", model.num_positions(),
          model.num_positions() == 1 ? " entry" : " entries", ", one for each joint of \"",
          model.name(), "\", got ", x.size());
}

void CheckState(const RigidBodyModel& model, const char* call, const VectorXd& q, const VectorXd& v,
                const VectorXd& a) {
  CheckSize(model, call, "q", q);
  CheckSize(model, call, "v", v);
  CheckSize(model, call, "a", a);
}

}  // namespace

VectorXd RigidBodyModel::position_lower_limits() const {
  return OfJoints(*this, &RigidBodyJoint::position_lower);
}
VectorXd RigidBodyModel::position_upper_limits() const {
  return OfJoints(*this, &RigidBodyJoint::position_upper);
}
VectorXd RigidBodyModel::velocity_limits() const {
  return OfJoints(*this, &RigidBodyJoint::velocity);
}
VectorXd RigidBodyModel::effort_limits() const { return OfJoints(*this, &RigidBodyJoint::effort); }

int RigidBodyModel::JointIndex(const std::string& name) const {
  std::vector<std::string> names;
  for (const RigidBodyJoint& joint : joints()) names.push_back(joint.name);
  return IndexOf("joint", loaded_->name, name, names);
}

int RigidBodyModel::FrameIndex(const std::string& name) const {
  return IndexOf("frame", loaded_->name, name, frames());
}

int RigidBodyModel::PairIndex(const std::string& first, const std::string& second) const {
  std::vector<std::string> shapes;
  for (std::size_t i = 0; i < pairs().size(); ++i) {
    const auto& [a, b] = pairs()[i];
    if ((a == first && b == second) || (a == second && b == first)) return static_cast<int>(i);
    shapes.push_back(a);
    shapes.push_back(b);
  }
  Require(!shapes.empty(), "PairIndex: \"", name(),
          "\" has no pairs of shapes; load the model with geometry");
  for (const std::string& shape : {first, second}) IndexOf("shape", name(), shape, shapes);
  Refuse("PairIndex: \"", first, "\" and \"", second,
         "\" are no pair: of one body, or of a body and the one that carries it");
}

VectorXd RigidBodyModel::InverseDynamics(const VectorXd& q, const VectorXd& v,
                                         const VectorXd& a) const {
  CheckState(*this, "InverseDynamics", q, v, a);
  VectorXd tau(num_positions());
  loaded_->InverseDynamics(q.data(), v.data(), a.data(), tau.data(), nullptr, nullptr, nullptr);
  return tau;
}

InverseDynamicsDerivatives RigidBodyModel::DerivativesOfInverseDynamics(const VectorXd& q,
                                                                        const VectorXd& v,
                                                                        const VectorXd& a) const {
  CheckState(*this, "DerivativesOfInverseDynamics", q, v, a);
  const int n = num_positions();
  InverseDynamicsDerivatives all{VectorXd(n), MatrixXd(n, n), MatrixXd(n, n), MatrixXd(n, n)};
  loaded_->InverseDynamics(q.data(), v.data(), a.data(), all.tau.data(), all.d_q.data(),
                           all.d_v.data(), all.d_a.data());
  return all;
}

MatrixXd RigidBodyModel::HessianOfInverseDynamics(const VectorXd& q, const VectorXd& v,
                                                  const VectorXd& a, const VectorXd& w) const {
  CheckState(*this, "HessianOfInverseDynamics", q, v, a);
  CheckSize(*this, "HessianOfInverseDynamics", "w", w);
  MatrixXd hessian(3 * num_positions(), 3 * num_positions());
  loaded_->Hessian(q.data(), v.data(), a.data(), w.data(), hessian.data());
  return hessian;
}

FramePose RigidBodyModel::PoseOf(const std::string& frame, const VectorXd& q) const {
  CheckSize(*this, "PoseOf", "q", q);
  FramePose pose;
  loaded_->Frame(FrameIndex(frame), q.data(), pose.position.data(), pose.rotation.data(), nullptr);
  return pose;
}

FrameMotion RigidBodyModel::MotionOf(const std::string& frame, const VectorXd& q) const {
  CheckSize(*this, "MotionOf", "q", q);
  FrameMotion motion;
  motion.jacobian.resize(6, num_positions());
  loaded_->Frame(FrameIndex(frame), q.data(), motion.pose.position.data(),
                 motion.pose.rotation.data(), motion.jacobian.data());
  return motion;
}

VectorXd RigidBodyModel::Distances(const VectorXd& q, const std::vector<int>& indices) const {
  CheckSize(*this, "Distances", "q", q);
  loaded_->CheckPairs("Distances", indices);
  VectorXd distances(std::ssize(indices));
  loaded_->Distances(q.data(), indices, distances.data(), nullptr);
  return distances;
}

PairDistances RigidBodyModel::DerivativesOfDistances(const VectorXd& q,
                                                     const std::vector<int>& indices) const {
  CheckSize(*this, "DerivativesOfDistances", "q", q);
  loaded_->CheckPairs("DerivativesOfDistances", indices);
  const auto num = std::ssize(indices);
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows(num, num_positions());
  PairDistances all{VectorXd(num), {}};
  loaded_->Distances(q.data(), indices, all.distance.data(), rows.data());
  all.gradient = rows;
  return all;
}

}  // namespace switchyard
