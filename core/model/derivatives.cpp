#include "core/model/derivatives.hpp"

#include <algorithm>

namespace switchyard {

SparsityPattern PatternOf(const SparseMatrix& A) {
  SparsityPattern pattern{static_cast<int>(A.rows()), static_cast<int>(A.cols()), {}, {}};
  for (int j = 0; j < A.outerSize(); ++j) {
    for (SparseMatrix::InnerIterator entry(A, j); entry; ++entry) {
      pattern.Add(static_cast<int>(entry.row()), j);
    }
  }
  return pattern;
}

SparsityPattern UpperPatternOf(const SparseMatrix& Q) {
  SparsityPattern pattern{static_cast<int>(Q.rows()), static_cast<int>(Q.cols()), {}, {}};
  for (int j = 0; j < Q.outerSize(); ++j) {
    for (SparseMatrix::InnerIterator entry(Q, j); entry && entry.row() <= j; ++entry) {
      pattern.Add(static_cast<int>(entry.row()), j);
    }
  }
  return pattern;
}

void EvaluateAffine(const SparseMatrix& A, const Eigen::VectorXd* b, const Evaluation& wanted) {
  if (wanted.values != nullptr) {
    Eigen::Map<Eigen::VectorXd> y(wanted.values, A.rows());
    y = A * Eigen::Map<const Eigen::VectorXd>(wanted.x, A.cols());
    if (b != nullptr) y += *b;
  }
  if (wanted.jacobian != nullptr) {
    std::copy(A.valuePtr(), A.valuePtr() + A.nonZeros(), wanted.jacobian);
  }
}

void EvaluateQuadratic(const SparseMatrix& Q, const Eigen::VectorXd& b, double c,
                       const Evaluation& wanted) {
  const Eigen::Map<const Eigen::VectorXd> x(wanted.x, Q.cols());
  if (wanted.values != nullptr) *wanted.values = 0.5 * x.dot(Q * x) + b.dot(x) + c;
  if (wanted.jacobian != nullptr) {
    Eigen::Map<Eigen::VectorXd>(wanted.jacobian, Q.cols()) = Q * x + b;
  }
  if (wanted.hessian == nullptr) return;
  double* to = wanted.hessian;
  for (int j = 0; j < Q.outerSize(); ++j) {
    for (SparseMatrix::InnerIterator entry(Q, j); entry && entry.row() <= j; ++entry) {
      *to++ = *wanted.weights * entry.value();
    }
  }
}

}  // namespace switchyard
