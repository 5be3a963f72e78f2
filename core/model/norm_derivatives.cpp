// First and second derivatives of the norms of z = Ax + b, and of (z_1^2 + ...) / z_0.
#include <algorithm>
#include <limits>

#include "core/model/derivatives.hpp"
#include "switchyard/model/cost.hpp"

namespace switchyard {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Norm = NormCost::Norm;

double Sign(double v) { return v > 0 ? 1 : v < 0 ? -1 : 0; }

/// d/dz: of a kink, the subgradient of least norm where it is simple, else of the first maximum.
VectorXd Gradient(Norm norm, const VectorXd& z) {
  switch (norm) {
    case Norm::kL1:
      return z.unaryExpr(&Sign);
    case Norm::kL2: {
      const double length = z.stableNorm();
      return length == 0 ? VectorXd::Zero(z.size()) : VectorXd(z / length);
    }
    case Norm::kLInf: {
      Eigen::Index largest = 0;
      z.cwiseAbs().maxCoeff(&largest);
      VectorXd g = VectorXd::Zero(z.size());
      g[largest] = Sign(z[largest]);
      return g;
    }
    case Norm::kPerspectiveQuadratic:
      break;
  }
  VectorXd g = 2 / z[0] * z;
  g[0] = -z.tail(z.size() - 1).squaredNorm() / (z[0] * z[0]);
  return g;
}

/// d^2/dz^2, of those that have one: (I - uu')/|z| with u = z/|z|, and that of w'w/z_0.
MatrixXd Curvature(Norm norm, const VectorXd& z) {
  const Eigen::Index m = z.size();
  if (norm == Norm::kL2) {
    const double length = z.stableNorm();
    if (length == 0) return MatrixXd::Zero(m, m);
    const VectorXd u = z / length;
    return (MatrixXd::Identity(m, m) - u * u.transpose()) / length;
  }
  const VectorXd w = z.tail(m - 1) / z[0];
  MatrixXd H = 2 / z[0] * MatrixXd::Identity(m, m);
  H(0, 0) = 2 / z[0] * w.squaredNorm();
  H.block(1, 0, m - 1, 1) = -2 / z[0] * w;
  H.block(0, 1, 1, m - 1) = -2 / z[0] * w.transpose();
  return H;
}

bool Curved(Norm norm) { return norm == Norm::kL2 || norm == Norm::kPerspectiveQuadratic; }

/// The variables that z depends on, ascending.
std::vector<int> Used(const SparseMatrix& A) {
  std::vector<int> used;
  for (int j = 0; j < A.outerSize(); ++j) {
    if (SparseMatrix::InnerIterator(A, j)) used.push_back(j);
  }
  return used;
}

}  // namespace

SparsityPattern NormCost::JacobianPattern() const {
  SparsityPattern pattern{1, num_vars(), {}, {}};
  for (const int j : Used(A_)) pattern.Add(0, j);
  return pattern;
}

SparsityPattern NormCost::HessianPattern() const {
  SparsityPattern pattern{num_vars(), num_vars(), {}, {}};
  if (!Curved(norm_)) return pattern;
  const std::vector<int> used = Used(A_);
  for (std::size_t b = 0; b < used.size(); ++b) {
    for (std::size_t a = 0; a <= b; ++a) pattern.Add(used[a], used[b]);
  }
  return pattern;
}

void NormCost::DoEvaluate(const Evaluation& wanted) const {
  const Eigen::Map<const VectorXd> x(wanted.x, num_vars());
  const VectorXd z = A_ * x + b_;
  if (wanted.values != nullptr) *wanted.values = DoEval(x)[0];
  const std::vector<int> used = Used(A_);
  if (wanted.jacobian != nullptr) {
    const VectorXd g = A_.transpose() * Gradient(norm_, z);
    for (std::size_t k = 0; k < used.size(); ++k) wanted.jacobian[k] = g[used[k]];
  }
  if (wanted.hessian == nullptr || !Curved(norm_)) return;
  const MatrixXd H = *wanted.weights * (A_.transpose() * (Curvature(norm_, z) * A_));
  double* to = wanted.hessian;
  for (std::size_t b = 0; b < used.size(); ++b) {
    for (std::size_t a = 0; a <= b; ++a) *to++ = H(used[a], used[b]);
  }
}

}  // namespace switchyard
