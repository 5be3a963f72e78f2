#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "closest.hpp"
#include "hessian.hpp"
#include "model.hpp"
#include "pinocchio/algorithm/jacobian.hpp"
#include "pinocchio/algorithm/kinematics.hpp"
#include "pinocchio/algorithm/rnea-derivatives.hpp"
#include "pinocchio/algorithm/rnea.hpp"
#include "pool.hpp"
#include "switchyard/plugin.hpp"
#include "tree.hpp"

namespace switchyard::dynamics {
namespace {

using Eigen::Map;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using pinocchio::JointIndex;

std::vector<int> ParentsOf(const pinocchio::Model& model) {
  std::vector<int> parents;
  for (JointIndex j = 1; j < model.parents.size(); ++j) {
    parents.push_back(static_cast<int>(model.parents[j]) - 1);
  }
  return parents;
}

// What one evaluation writes to: q, v, a and w of Pinocchio's joints.
struct Workspace {
  explicit Workspace(const Tree& tree)
      : data(tree.model),
        q(tree.model.nq),
        v(tree.model.nv),
        a(tree.model.nv),
        w(tree.model.nv),
        hessian(ParentsOf(tree.model)) {
    const auto& objects = tree.geometry.geometryObjects;
    for (const pinocchio::CollisionPair& pair : tree.geometry.collisionPairs) {
      pairs.emplace_back(*objects[pair.first].geometry, *objects[pair.second].geometry);
    }
  }

  pinocchio::Data data;
  VectorXd q, v, a, w;
  EffortHessian hessian;
  std::vector<PairDistance> pairs;
};

}  // namespace

class Workspaces {
 public:
  explicit Workspaces(const Tree& tree) : tree_(tree) {}
  Pool<Workspace>::Lease Borrow() {
    return pool_.Borrow([this] { return std::make_unique<Workspace>(tree_); });
  }

 private:
  const Tree& tree_;
  Pool<Workspace> pool_;
};

namespace {

void SetPositions(const Tree& tree, const double* q, VectorXd& out) {
  for (const Follows& joint : tree.joints) {
    const double at = joint.factor * q[joint.coordinate] + joint.offset;
    if (joint.on_circle) {
      out[joint.first] = std::cos(at);
      out[joint.first + 1] = std::sin(at);
    } else {
      out[joint.first] = at;
    }
  }
}

void SetRates(const Tree& tree, const double* rates, VectorXd& out) {
  Eigen::Index j = 0;
  for (const Follows& joint : tree.joints) out[j++] = joint.factor * rates[joint.coordinate];
}

// With q_pinocchio = F q + offsets: out += F' in, and out += F' in F.
void AddForces(const Tree& tree, const VectorXd& in, Map<VectorXd>& out) {
  Eigen::Index j = 0;
  for (const Follows& joint : tree.joints) out[joint.coordinate] += joint.factor * in[j++];
}

template <class Matrix, class Block>
void AddCongruent(const Tree& tree, const Matrix& in, Block&& out) {
  Eigen::Index k = 0;
  for (const Follows& column : tree.joints) {
    Eigen::Index j = 0;
    for (const Follows& row : tree.joints) {
      out(row.coordinate, column.coordinate) += row.factor * column.factor * in(j++, k);
    }
    ++k;
  }
}

// gradient += direction . d(point)/dq of a point that the body of `joint` carries.
void AddMotion(const Tree& tree, const pinocchio::Data& data, JointIndex joint,
               const Eigen::Vector3d& point, const Eigen::Vector3d& direction,
               Map<VectorXd>& gradient) {
  const Eigen::Vector3d moment = point.cross(direction);
  for (const JointIndex j : tree.model.supports[joint]) {
    if (j == 0) continue;
    const Follows& follows = tree.joints[j - 1];
    const auto column = data.J.col(static_cast<Eigen::Index>(j) - 1);
    gradient[follows.coordinate] +=
        follows.factor * (direction.dot(column.head<3>()) + moment.dot(column.tail<3>()));
  }
}

}  // namespace

Model::Model(const sy_dynamics_source& source)
    : tree_(std::make_unique<Tree>(LoadTree(source))),
      workspaces_(std::make_unique<Workspaces>(*tree_)) {
  WriteFacts();
}

Model::~Model() = default;

void Model::WriteFacts() {
  Tree& tree = *tree_;
  for (std::size_t i = 0; i < tree.coordinates.size(); ++i) {
    tree.coordinates[i].name = tree.names[i].c_str();
    joints_.push_back(&tree.coordinates[i]);
  }
  for (const pinocchio::Frame& frame : tree.model.frames) frames_.push_back(frame.name.c_str());
  for (const pinocchio::CollisionPair& pair : tree.geometry.collisionPairs) {
    pair_first_.push_back(tree.geometry.geometryObjects[pair.first].name.c_str());
    pair_second_.push_back(tree.geometry.geometryObjects[pair.second].name.c_str());
  }
  facts_.size = sizeof facts_;
  facts_.num_positions = static_cast<std::int32_t>(joints_.size());
  facts_.name = tree.model.name.c_str();
  facts_.joints = joints_.data();
  facts_.frames = frames_.data();
  facts_.num_frames = static_cast<std::int32_t>(frames_.size());
  facts_.num_pairs = static_cast<std::int32_t>(pair_first_.size());
  facts_.pair_first = pair_first_.data();
  facts_.pair_second = pair_second_.data();
}

void Model::InverseDynamics(const double* q, const double* v, const double* a, double* tau,
                            double* d_q, double* d_v, double* d_a) const {
  const Tree& tree = *tree_;
  const auto n = static_cast<Eigen::Index>(joints_.size());
  const auto lease = workspaces_->Borrow();
  Workspace& work = *lease;
  SetPositions(tree, q, work.q);
  SetRates(tree, v, work.v);
  SetRates(tree, a, work.a);
  pinocchio::Data& data = work.data;
  if (d_q == nullptr && d_v == nullptr && d_a == nullptr) {
    pinocchio::rnea(tree.model, data, work.q, work.v, work.a);
  } else {
    pinocchio::computeRNEADerivatives(tree.model, data, work.q, work.v, work.a);
    data.M.triangularView<Eigen::StrictlyLower>() =
        data.M.transpose().triangularView<Eigen::StrictlyLower>();
    data.dtau_dv.diagonal() += tree.model.damping;
  }
  const auto add = [&](const auto& derivative, double* out) {
    if (out == nullptr) return;
    Map<MatrixXd> matrix(out, n, n);
    matrix.setZero();
    AddCongruent(tree, derivative, matrix);
  };
  add(data.dtau_dq, d_q);
  add(data.dtau_dv, d_v);
  add(data.M, d_a);
  if (tau == nullptr) return;
  data.tau += tree.model.damping.cwiseProduct(work.v);
  Map<VectorXd> forces(tau, n);
  forces.setZero();
  AddForces(tree, data.tau, forces);
}

void Model::InverseDynamicsHessian(const double* q, const double* v, const double* a,
                                   const double* w, double* hessian) const {
  const Tree& tree = *tree_;
  const auto n = static_cast<Eigen::Index>(joints_.size());
  const auto lease = workspaces_->Borrow();
  Workspace& work = *lease;
  SetPositions(tree, q, work.q);
  SetRates(tree, v, work.v);
  SetRates(tree, a, work.a);
  SetRates(tree, w, work.w);
  pinocchio::Data& data = work.data;
  pinocchio::computeJointJacobians(tree.model, data, work.q);
  EffortHessian& sweep = work.hessian;
  sweep.axes = data.J;
  for (std::size_t k = 0; k < sweep.inertias.size(); ++k) {
    sweep.inertias[k] = data.oMi[k + 1].act(tree.model.inertias[k + 1]).matrix();
  }
  const MatrixXd& found = sweep.Compute(work.v, work.a, work.w, tree.model.gravity.linear());
  const auto m = static_cast<Eigen::Index>(tree.joints.size());
  Map<MatrixXd> h(hessian, 3 * n, 3 * n);
  h.setZero();
  for (Eigen::Index row = 0; row < 3; ++row) {
    for (Eigen::Index column = 0; column < 3; ++column) {
      AddCongruent(tree, found.block(row * m, column * m, m, m),
                   h.block(row * n, column * n, n, n));
    }
  }
}

void Model::Frame(std::int32_t frame, const double* q, double* position, double* rotation,
                  double* jacobian) const {
  const Tree& tree = *tree_;
  if (frame < 0 || frame >= facts_.num_frames) {
    throw plugin::Failure(SY_E_ARGUMENT, "frame " + std::to_string(frame) +
                                             " is not there: there are " +
                                             std::to_string(facts_.num_frames));
  }
  const auto lease = workspaces_->Borrow();
  Workspace& work = *lease;
  SetPositions(tree, q, work.q);
  pinocchio::Data& data = work.data;
  if (jacobian == nullptr) {
    pinocchio::forwardKinematics(tree.model, data, work.q);
  } else {
    pinocchio::computeJointJacobians(tree.model, data, work.q);
  }
  const pinocchio::Frame& of = tree.model.frames[static_cast<std::size_t>(frame)];
  const pinocchio::SE3 pose = data.oMi[of.parentJoint] * of.placement;
  if (position != nullptr) Map<Eigen::Vector3d>{position} = pose.translation();
  if (rotation != nullptr) Map<Eigen::Matrix3d>{rotation} = pose.rotation();
  if (jacobian == nullptr) return;
  Map<pinocchio::Data::Matrix6x> columns(jacobian, 6, static_cast<Eigen::Index>(joints_.size()));
  columns.setZero();
  for (const JointIndex j : tree.model.supports[of.parentJoint]) {
    if (j == 0) continue;
    const Follows& joint = tree.joints[j - 1];
    const auto column = data.J.col(static_cast<Eigen::Index>(j) - 1);
    const Eigen::Vector3d turn = column.tail<3>();
    auto out = columns.col(joint.coordinate);
    out.head<3>() += joint.factor * (column.head<3>() + turn.cross(pose.translation()));
    out.tail<3>() += joint.factor * turn;
  }
}

void Model::Distances(const double* q, const std::int32_t* pairs, std::int32_t num,
                      double* distances, double* gradients) const {
  const Tree& tree = *tree_;
  for (std::int32_t i = 0; i < num; ++i) {
    if (pairs[i] < 0 || pairs[i] >= facts_.num_pairs) {
      throw plugin::Failure(SY_E_ARGUMENT, "pair " + std::to_string(pairs[i]) +
                                               " is not there: there are " +
                                               std::to_string(facts_.num_pairs));
    }
  }
  if (num <= 0) return;
  const auto lease = workspaces_->Borrow();
  Workspace& work = *lease;
  SetPositions(tree, q, work.q);
  pinocchio::computeJointJacobians(tree.model, work.data, work.q);
  const auto n = static_cast<Eigen::Index>(joints_.size());
  const auto placed = [&](const pinocchio::GeometryObject& object) {
    const pinocchio::SE3 pose = work.data.oMi[object.parentJoint] * object.placement;
    return coal::Transform3s(pose.rotation(), pose.translation());
  };
  for (std::int32_t i = 0; i < num; ++i) {
    const auto index = static_cast<std::size_t>(pairs[i]);
    const pinocchio::CollisionPair& pair = tree.geometry.collisionPairs[index];
    const auto& first = tree.geometry.geometryObjects[pair.first];
    const auto& second = tree.geometry.geometryObjects[pair.second];
    const Closest found = work.pairs[index](placed(first), placed(second));
    distances[i] = found.distance;
    if (gradients == nullptr) continue;
    // The distance grows by how the second's point moves along the normal, the first's against it.
    Map<VectorXd> gradient(gradients + i * n, n);
    gradient.setZero();
    AddMotion(tree, work.data, first.parentJoint, found.on_first, -found.normal, gradient);
    AddMotion(tree, work.data, second.parentJoint, found.on_second, found.normal, gradient);
  }
}

}  // namespace switchyard::dynamics
