// core/trajectory/powers.hpp - polynomials with vectors for coefficients: a column for each power.
#pragma once

#include <Eigen/Core>

#include "switchyard/error.hpp"

namespace switchyard {

/// i (i - 1) ... (i - k + 1): what the k-th derivative of x^i has before x^(i - k).
template <class T>
T FallingFactorial(Eigen::Index i, int k) {
  T product = 1;
  for (int j = 0; j < k; ++j) product *= static_cast<T>(i - j);
  return product;
}

/// The k-th derivative of sum_i c_i x^i, c_i the columns, at x, by Horner's rule; constants are not
/// multiplied by x, which may then be infinite.
template <class T>
Eigen::VectorX<T> SumOfPowers(const Eigen::Ref<const Eigen::MatrixX<T>>& c, const T& x, int k) {
  Require(k >= 0, "the order of a derivative needs to be 0 or more, got ", k);
  if (k >= c.cols()) return Eigen::VectorX<T>::Zero(c.rows());
  const Eigen::Index last = c.cols() - 1;
  Eigen::VectorX<T> sum = FallingFactorial<T>(last, k) * c.col(last);
  for (Eigen::Index i = last - 1; i >= k; --i) sum = sum * x + FallingFactorial<T>(i, k) * c.col(i);
  return sum;
}

/// The columns of the k-th derivative, one where it is constant.
template <class T>
Eigen::MatrixX<T> DerivativeOfPowers(const Eigen::Ref<const Eigen::MatrixX<T>>& c, int k) {
  Require(k >= 0, "the order of a derivative needs to be 0 or more, got ", k);
  if (k >= c.cols()) return Eigen::VectorX<T>::Zero(c.rows());
  Eigen::MatrixX<T> derivative = c.rightCols(c.cols() - k);
  for (Eigen::Index i = k; i < c.cols(); ++i) derivative.col(i - k) *= FallingFactorial<T>(i, k);
  return derivative;
}

/// The columns of the antiderivative that is 0 at 0.
template <class T>
Eigen::MatrixX<T> IntegralOfPowers(const Eigen::Ref<const Eigen::MatrixX<T>>& c) {
  Eigen::MatrixX<T> integral(c.rows(), c.cols() + 1);
  integral.col(0).setZero();
  for (Eigen::Index i = 0; i < c.cols(); ++i)
    integral.col(i + 1) = c.col(i) / static_cast<T>(i + 1);
  return integral;
}

}  // namespace switchyard
