// switchyard/trajectory/composite_trajectory.hpp - trajectories of any class, one after the other.
#pragma once

#include <vector>

#include "switchyard/trajectory/piecewise_trajectory.hpp"

namespace switchyard {

/// At a break the later segment counts, at the end the last one. Values may jump at breaks.
template <class T>
class SWITCHYARD_EXPORT CompositeTrajectory final : public PiecewiseTrajectory<T> {
 public:
  /// Each segment starts where the one before ends, to 64 machine epsilons of max(1, |t|). Throws
  /// InvalidArgument where it does not, or sizes differ. No segments are allowed.
  explicit CompositeTrajectory(std::vector<TrajectoryPointer<T>> segments);
  [[nodiscard]] std::string Kind() const override { return "composite trajectory"; }
  /// Throws InvalidArgument where there is no such segment.
  [[nodiscard]] const Trajectory<T>& segment(int segment_index) const;
  /// The segments, each from the second on moved in time (StartingAt) to where the one before ends.
  /// Throws InvalidArgument where sizes differ, or a time at which two meet is not finite.
  [[nodiscard]] static CompositeTrajectory<T> AlignAndConcatenate(
      const std::vector<TrajectoryPointer<T>>& segments);

 private:
  [[nodiscard]] std::unique_ptr<Trajectory<T>> DoClone() const override;
  [[nodiscard]] Eigen::MatrixX<T> do_value(const T& t) const override;
  [[nodiscard]] bool do_has_derivative() const override;
  [[nodiscard]] Eigen::MatrixX<T> DoEvalDerivative(const T& t, int derivative_order) const override;
  [[nodiscard]] std::unique_ptr<Trajectory<T>> DoMakeDerivative(
      int derivative_order) const override;
  [[nodiscard]] std::unique_ptr<Trajectory<T>> DoStartingAt(const T& time) const override;
  [[nodiscard]] Eigen::Index do_rows() const override;
  [[nodiscard]] Eigen::Index do_cols() const override;

  std::vector<TrajectoryPointer<T>> segments_;
};

extern template class CompositeTrajectory<double>;

}  // namespace switchyard
