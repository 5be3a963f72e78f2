// switchyard/trajectory/trajectory.hpp - a matrix as a function of time.
#pragma once

#include <Eigen/Core>
#include <concepts>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "switchyard/error.hpp"
#include "switchyard/export.hpp"

namespace switchyard {

/// q(t), of rows() x cols(), for t from start_time() to end_time(); mostly a column. Times are in
/// seconds, a k-th derivative in units of q over seconds^k.
///
/// Outside of its times a trajectory is silently evaluated at the nearest of them: value(t) is
/// value(clamp(t, start_time(), end_time())), and so are derivatives. Where pieces meet the later
/// one counts, at the end the last one.
///
/// A class of trajectories says what stands among the protected members. Const members may be
/// called from several threads.
template <class T>
class SWITCHYARD_EXPORT Trajectory {
  static_assert(std::is_same_v<T, double>,
                "a trajectory has T = double: programs take control points as variables by the "
                "maps AsLinearInControlPoints and EvaluateLinearInControlPoints");

 public:
  virtual ~Trajectory();
  [[nodiscard]] std::unique_ptr<Trajectory<T>> Clone() const { return DoClone(); }
  /// "Bezier curve", "composite trajectory", ... for messages.
  [[nodiscard]] virtual std::string Kind() const { return "trajectory of a user's class"; }

  /// Throws InvalidArgument where t is NaN, as all that take a time do.
  [[nodiscard]] Eigen::MatrixX<T> value(const T& t) const;
  /// The values at many times: of a trajectory with one column, a column for each time; else, of
  /// one with one row, a row for each. Throws InvalidArgument where it has neither.
  [[nodiscard]] Eigen::MatrixX<T> vector_values(const std::vector<T>& t) const;
  [[nodiscard]] Eigen::MatrixX<T> vector_values(const Eigen::Ref<const Eigen::VectorX<T>>& t) const;

  [[nodiscard]] bool has_derivative() const { return do_has_derivative(); }
  /// d^k q / dt^k at t, k = derivative_order >= 0; order 0 is the value. At a corner: that of the
  /// later piece. Throws InvalidArgument where there is no derivative, or the order is negative.
  [[nodiscard]] Eigen::MatrixX<T> EvalDerivative(const T& t, int derivative_order = 1) const;
  /// The trajectory whose value is EvalDerivative(t, derivative_order). Throws as that does.
  [[nodiscard]] std::unique_ptr<Trajectory<T>> MakeDerivative(int derivative_order = 1) const;
  /// The same curve with its start moved to `time`. Throws InvalidArgument where `time` or
  /// start_time() is not finite.
  [[nodiscard]] std::unique_ptr<Trajectory<T>> StartingAt(const T& time) const;

  [[nodiscard]] Eigen::Index rows() const { return do_rows(); }
  [[nodiscard]] Eigen::Index cols() const { return do_cols(); }
  [[nodiscard]] T start_time() const { return do_start_time(); }
  [[nodiscard]] T end_time() const { return do_end_time(); }

 protected:
  Trajectory() = default;
  Trajectory(const Trajectory&) = default;
  Trajectory& operator=(const Trajectory&) = default;

  [[nodiscard]] virtual std::unique_ptr<Trajectory<T>> DoClone() const = 0;
  /// t is any number.
  [[nodiscard]] virtual Eigen::MatrixX<T> do_value(const T& t) const = 0;
  [[nodiscard]] virtual Eigen::Index do_rows() const = 0;
  [[nodiscard]] virtual Eigen::Index do_cols() const = 0;
  [[nodiscard]] virtual T do_start_time() const = 0;
  [[nodiscard]] virtual T do_end_time() const = 0;

  /// A class that has derivatives says so, and overrides DoEvalDerivative, which takes any order
  /// >= 1. Others are not asked.
  [[nodiscard]] virtual bool do_has_derivative() const { return false; }
  [[nodiscard]] virtual Eigen::MatrixX<T> DoEvalDerivative(const T& t, int derivative_order) const;
  /// What stands here evaluates the derivatives of a copy; for an order >= 1.
  [[nodiscard]] virtual std::unique_ptr<Trajectory<T>> DoMakeDerivative(int derivative_order) const;
  /// What stands here goes along a copy at another time.
  [[nodiscard]] virtual std::unique_ptr<Trajectory<T>> DoStartingAt(const T& time) const;
};

/// Trajectories by value: copies mean the same trajectory, which is not changed through them.
template <class T>
class TrajectoryPointer {
 public:
  // NOLINTBEGIN(google-explicit-constructor): a value of any class of trajectories
  TrajectoryPointer(const Trajectory<T>& trajectory) : trajectory_(trajectory.Clone()) {}
  /// A shared_ptr or unique_ptr. Throws InvalidArgument where it is null.
  template <class Pointer>
  requires std::convertible_to<Pointer, std::shared_ptr<const Trajectory<T>>> TrajectoryPointer(
      Pointer pointer)
      : trajectory_(std::move(pointer)) {
    Require(trajectory_ != nullptr, "a trajectory is needed, got a null pointer");
  }
  // NOLINTEND(google-explicit-constructor)
  const Trajectory<T>& operator*() const { return *trajectory_; }
  const Trajectory<T>* operator->() const { return trajectory_.get(); }
  [[nodiscard]] const std::shared_ptr<const Trajectory<T>>& shared() const { return trajectory_; }

 private:
  std::shared_ptr<const Trajectory<T>> trajectory_;
};

extern template class Trajectory<double>;

}  // namespace switchyard
