#include "switchyard/trajectory/path_parameterized_trajectory.hpp"

#include <algorithm>

namespace switchyard {
namespace {

// The partial Bell polynomials B_nk, k = 0, ..., n, of derivatives.size() = n derivatives, the
// first one first.
template <class T>
Eigen::VectorX<T> BellPolynomials(const std::vector<T>& derivatives) {
  const auto n = static_cast<Eigen::Index>(derivatives.size());
  Eigen::MatrixX<T> bell = Eigen::MatrixX<T>::Zero(n + 1, n + 1);
  bell(0, 0) = 1;
  for (Eigen::Index m = 1; m <= n; ++m) {
    T binomial = 1;  // m - 1 over i
    for (Eigen::Index i = 0; i < m; ++i) {
      const T factor = binomial * derivatives[static_cast<std::size_t>(i)];
      for (Eigen::Index k = 1; k <= m - i; ++k) bell(m, k) += factor * bell(m - 1 - i, k - 1);
      binomial = binomial * static_cast<T>(m - 1 - i) / static_cast<T>(i + 1);
    }
  }
  return bell.row(n);
}

}  // namespace

template <class T>
PathParameterizedTrajectory<T>::PathParameterizedTrajectory(const Trajectory<T>& path,
                                                            const Trajectory<T>& time_scaling)
    : path_(path), time_scaling_(time_scaling) {
  Require(time_scaling.rows() == 1 && time_scaling.cols() == 1,
          "a time scaling needs values of 1 x 1, got ", time_scaling.rows(), " x ",
          time_scaling.cols());
}

template <class T>
std::unique_ptr<Trajectory<T>> PathParameterizedTrajectory<T>::DoClone() const {
  return std::make_unique<PathParameterizedTrajectory>(*this);
}

template <class T>
Eigen::MatrixX<T> PathParameterizedTrajectory<T>::do_value(const T& t) const {
  const T inside = std::clamp(t, this->start_time(), this->end_time());
  return path_->value(time_scaling_->value(inside)(0, 0));
}

template <class T>
bool PathParameterizedTrajectory<T>::do_has_derivative() const {
  return path_->has_derivative() && time_scaling_->has_derivative();
}

template <class T>
Eigen::MatrixX<T> PathParameterizedTrajectory<T>::DoEvalDerivative(const T& t,
                                                                   int derivative_order) const {
  const T inside = std::clamp(t, this->start_time(), this->end_time());
  const T s = time_scaling_->value(inside)(0, 0);
  std::vector<T> derivatives;
  for (int i = 1; i <= derivative_order; ++i) {
    derivatives.push_back(time_scaling_->EvalDerivative(inside, i)(0, 0));
  }
  const Eigen::VectorX<T> bell = BellPolynomials(derivatives);
  Eigen::MatrixX<T> sum = Eigen::MatrixX<T>::Zero(this->rows(), this->cols());
  for (int k = 1; k <= derivative_order; ++k) sum += bell(k) * path_->EvalDerivative(s, k);
  return sum;
}

template <class T>
std::unique_ptr<Trajectory<T>> PathParameterizedTrajectory<T>::DoStartingAt(const T& time) const {
  return std::make_unique<PathParameterizedTrajectory>(*path_, *time_scaling_->StartingAt(time));
}

template class PathParameterizedTrajectory<double>;

}  // namespace switchyard
