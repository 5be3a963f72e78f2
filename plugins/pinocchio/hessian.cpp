#include "hessian.hpp"

#include <Eigen/Geometry>
#include <utility>

namespace switchyard::dynamics {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// m x n of motions.
Vector6 Cross(const Vector6& m, const Vector6& n) {
  const Vector3d turn = m.tail<3>(), other = n.tail<3>();
  Vector6 out;
  out << turn.cross(Vector3d(n.head<3>())) + Vector3d(m.head<3>()).cross(other), turn.cross(other);
  return out;
}

// m x* f of a motion and a force: (n x m) . f = n . (m x* f).
Vector6 CrossForce(const Vector6& m, const Vector6& f) {
  const Vector3d turn = m.tail<3>(), force = f.head<3>();
  Vector6 out;
  out << turn.cross(force), turn.cross(Vector3d(f.tail<3>())) + Vector3d(m.head<3>()).cross(force);
  return out;
}

Matrix3d Skew(const Vector3d& u) {
  Matrix3d s;
  s << 0, -u[2], u[1], u[2], 0, -u[0], -u[1], u[0], 0;
  return s;
}

// I (m x) - (m x*) I, which is I (m x) and its transpose.
Matrix6 Variation(const Matrix6& I, const Vector6& m) {
  const Matrix3d turn = Skew(m.tail<3>());
  Matrix6 half;
  half.leftCols<3>().noalias() = I.leftCols<3>() * turn;
  half.rightCols<3>().noalias() = I.leftCols<3>() * Skew(m.head<3>());
  half.rightCols<3>().noalias() += I.rightCols<3>() * turn;
  return half + half.transpose();
}

}  // namespace

EffortHessian::EffortHessian(std::vector<int> parent)
    : axes(6, static_cast<Eigen::Index>(parent.size())),
      inertias(parent.size()),
      parent_(std::move(parent)),
      joints_(parent_.size()),
      hessian_(3 * axes.cols(), 3 * axes.cols()) {}

// The motions of body k, and what it adds to the sums.
void EffortHessian::Outwards(int k, double v, double a, double w, const Vector6& root) {
  const auto at = static_cast<std::size_t>(k);
  const int p = parent_[at];
  Joint& joint = joints_[at];
  const Vector6 S = axes.col(k), zero = Vector6::Zero();
  const Joint* const before = p >= 0 ? &joints_[static_cast<std::size_t>(p)] : nullptr;
  const Vector6& V = before != nullptr ? before->V : zero;
  const Vector6& A = before != nullptr ? before->A : root;
  const Vector6& W = before != nullptr ? before->W : zero;
  joint.x = Cross(W, S);
  joint.y = Cross(V, S);
  joint.z = Cross(A, S) + Cross(V, joint.y);
  joint.V = V + S * v;
  joint.A = A + S * a + joint.y * v;
  joint.W = W + S * w;

  joint.I = inertias[at];
  const Vector6 momentum = joint.I * joint.V;
  joint.f = joint.I * joint.A + CrossForce(joint.V, momentum);
  joint.g = joint.I * joint.W;
  joint.E = Variation(joint.I, joint.W);
  joint.D = -Variation(joint.I, joint.V);
  const Matrix3d linear = Skew(momentum.head<3>());
  joint.D.topRightCorner<3, 3>() -= linear;
  joint.D.bottomLeftCorner<3, 3>() -= linear;
  joint.D.bottomRightCorner<3, 3>() -= Skew(momentum.tail<3>());
  joint.h.noalias() = joint.D.transpose() * joint.W;
}

// The entries of joint k with itself and those before it, and its sums to the joint before it.
void EffortHessian::Inwards(int k) {
  const Joint& s = joints_[static_cast<std::size_t>(k)];
  const Vector6 S = axes.col(k);
  const Vector6 of_x = CrossForce(S, s.f) + s.I * s.z + s.D * s.y;
  const Vector6 of_z = s.I * s.x + CrossForce(S, s.g);
  const Vector6 of_y =
      s.D.transpose() * s.x + CrossForce(S, s.h) + CrossForce(s.y, s.g) + s.E * s.y;
  const Vector6 of_S = CrossForce(S, s.g) + s.E * S;
  const Vector6 of_x_a = s.I * S;
  const Vector6 of_x_v = 2.0 * s.I * s.y + s.D * S;
  const auto m = static_cast<int>(parent_.size());
  const auto set = [&](int row, int column, double value) {
    hessian_(row, column) = value;
    hessian_(column, row) = value;
  };
  for (int j = k; j >= 0; j = parent_[static_cast<std::size_t>(j)]) {
    const Joint& b = joints_[static_cast<std::size_t>(j)];
    const auto axis = axes.col(j);
    set(j, k, b.x.dot(of_x) + b.z.dot(of_z) + b.y.dot(of_y));
    set(m + j, m + k, axis.dot(of_S));
    set(k, 2 * m + j, axis.dot(of_z));
    set(j, 2 * m + k, b.x.dot(of_x_a));
    set(k, m + j, 2.0 * b.y.dot(of_z) + axis.dot(of_y));
    set(j, m + k, b.x.dot(of_x_v) + b.y.dot(of_S));
  }
  const int p = parent_[static_cast<std::size_t>(k)];
  if (p < 0) return;
  Joint& before = joints_[static_cast<std::size_t>(p)];
  before.f += s.f;
  before.g += s.g;
  before.h += s.h;
  before.I += s.I;
  before.D += s.D;
  before.E += s.E;
}

const Eigen::MatrixXd& EffortHessian::Compute(const Eigen::VectorXd& v, const Eigen::VectorXd& a,
                                              const Eigen::VectorXd& w, const Vector3d& gravity) {
  Vector6 root = Vector6::Zero();
  root.head<3>() = -gravity;
  const auto m = static_cast<int>(parent_.size());
  hessian_.setZero();
  for (int k = 0; k < m; ++k) Outwards(k, v[k], a[k], w[k], root);
  for (int k = m - 1; k >= 0; --k) Inwards(k);
  return hessian_;
}

}  // namespace switchyard::dynamics
