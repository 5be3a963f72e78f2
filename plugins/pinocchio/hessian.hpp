#pragma once

#include <Eigen/Core>
#include <vector>

namespace switchyard::dynamics {

using Vector6 = Eigen::Matrix<double, 6, 1>;  // linear, then angular, at the world's origin
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Matrix6X = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// The Hessian of phi = w'tau, tau the inverse dynamics of a tree of m joints of one degree of
/// freedom each, by (q, v, a).
///
/// With S_k the axis of joint k in the world, p(k) the joint before it and I_i the inertia of body
/// i,
///   V_i = sum_{k <= i} S_k v_k,   A_i = A_0 + sum_{k <= i} S_k a_k + V_p(k) x S_k v_k,
///   W_i = sum_{k <= i} S_k w_k,   phi = sum_i W_i . f_i,   f_i = I_i A_i + V_i x* I_i V_i,
/// where k <= i are the joints that carry body i, and A_0 is minus gravity. Each term is the same
/// in every frame: seen from body i its inertia is constant, and q_j moves what is before joint j,
/// by -S_j x. So with x_j = W_p(j) x S_j, y_j = V_p(j) x S_j and z_j = A_p(j) x S_j + V_p(j) x y_j
///   dW_i/dq_j = x_j,   dV_i/dq_j = y_j,   dA_i/dq_j = z_j + y_j x V_i,   dA_i/dv_j = 2 y_j + S_j x
///   V_i,
/// and for j <= k, by the identity of Jacobi,
///   d2W_i/dq_j dq_k = x_j x S_k,   d2V_i/dq_j dq_k = y_j x S_k,
///   d2A_i/dq_j dq_k = z_j x S_k + y_j x y_k + (y_j x S_k) x V_i.
/// Where these enter phi, the sums over the bodies i >= k that joint k carries are those of I_i,
/// f_i,
///   D_i: d -> I_i (d x V_i) + V_i x* I_i d + d x* I_i V_i,   E_i = I_i (W_i x) - (W_i x*) I_i,
///   g_i = I_i W_i and h_i = D_i'W_i; what is left is a product of two vectors for each entry.
class EffortHessian {
 public:
  /// parent[k]: the joint before joint k, less than k; -1 at the root.
  explicit EffortHessian(std::vector<int> parent);

  /// In the world, joint k's axis and the inertia of what it carries up to the next joints; set
  /// before Compute.
  Matrix6X axes;
  std::vector<Matrix6> inertias;

  /// 3m x 3m, valid until the next call. `gravity` is the acceleration.
  const Eigen::MatrixXd& Compute(const Eigen::VectorXd& v, const Eigen::VectorXd& a,
                                 const Eigen::VectorXd& w, const Eigen::Vector3d& gravity);

 private:
  struct Joint {
    Vector6 V, A, W, x, y, z;
    Vector6 f, g, h;  // of body k, then of all that joint k carries, as I, D and E
    Matrix6 I, D, E;
  };
  void Outwards(int k, double v, double a, double w, const Vector6& root);
  void Inwards(int k);

  std::vector<int> parent_;
  std::vector<Joint> joints_;
  Eigen::MatrixXd hessian_;
};

}  // namespace switchyard::dynamics
