// switchyard/trajectory/path_parameterized_trajectory.hpp - a path, and when one is where on it.
#pragma once

#include "switchyard/trajectory/trajectory.hpp"

namespace switchyard {

/// q(t) = r(s(t)), r the path, s the time scaling, which gives the times of q.
///
/// Derivatives of any order are those of the chain rule, q^(n) = sum_k r^(k)(s) B_nk(s', s'', ...),
/// with the partial Bell polynomials by the recurrence B_nk = sum_i binomial(n - 1, i) s^(i+1)
/// B_(n-1-i)(k-1) (Comtet, Advanced Combinatorics, 3.3). Where s(t) is not among the path's times,
/// r and its derivatives are those at the nearest of them.
template <class T>
class SWITCHYARD_EXPORT PathParameterizedTrajectory final : public Trajectory<T> {
 public:
  /// Copies both. Throws InvalidArgument where the time scaling is not 1 x 1.
  PathParameterizedTrajectory(const Trajectory<T>& path, const Trajectory<T>& time_scaling);
  [[nodiscard]] std::string Kind() const override { return "path-parameterized trajectory"; }
  [[nodiscard]] const Trajectory<T>& path() const { return *path_; }
  [[nodiscard]] const Trajectory<T>& time_scaling() const { return *time_scaling_; }

 private:
  [[nodiscard]] std::unique_ptr<Trajectory<T>> DoClone() const override;
  [[nodiscard]] Eigen::MatrixX<T> do_value(const T& t) const override;
  [[nodiscard]] bool do_has_derivative() const override;
  [[nodiscard]] Eigen::MatrixX<T> DoEvalDerivative(const T& t, int derivative_order) const override;
  [[nodiscard]] std::unique_ptr<Trajectory<T>> DoStartingAt(const T& time) const override;
  [[nodiscard]] Eigen::Index do_rows() const override { return path_->rows(); }
  [[nodiscard]] Eigen::Index do_cols() const override { return path_->cols(); }
  [[nodiscard]] T do_start_time() const override { return time_scaling_->start_time(); }
  [[nodiscard]] T do_end_time() const override { return time_scaling_->end_time(); }

  TrajectoryPointer<T> path_;
  TrajectoryPointer<T> time_scaling_;
};

extern template class PathParameterizedTrajectory<double>;

}  // namespace switchyard
