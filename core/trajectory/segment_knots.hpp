// core/trajectory/segment_knots.hpp - the knots of one spline along the segments of a trajectory.
#pragma once

#include <vector>

#include "switchyard/trajectory/composite_trajectory.hpp"

namespace switchyard {

/// Parameters from 0 to 1: a segment has its share of them, in order - 1 equal intervals or more.
/// The function of a control point is not 0 on `order` intervals, so it is not on those of two
/// segments at most. One share alone: equal intervals, as many as that takes.
class SegmentKnots {
 public:
  SegmentKnots(std::vector<double> shares, int order, int num_control_points);

  [[nodiscard]] const std::vector<double>& shares() const { return shares_; }
  [[nodiscard]] int num_intervals() const { return static_cast<int>(segments_.size()); }
  [[nodiscard]] int num_control_points() const { return num_intervals() + order_ - 1; }
  [[nodiscard]] const std::vector<double>& knots() const { return knots_; }
  /// The segments to which control point j belongs: of the intervals where its function is not 0.
  [[nodiscard]] std::vector<int> SegmentsOf(int j) const;
  /// The parameter at this share of interval l.
  [[nodiscard]] double Inside(int l, double share) const;
  /// A path whose segments are these, or which is the only one, at the mean of each function's
  /// inner knots, by columns: the curve of these control points overshoots nowhere (Schoenberg's
  /// variation-diminishing approximation).
  [[nodiscard]] Eigen::MatrixXd Guess(const CompositeTrajectory<double>& path) const;

 private:
  int order_;
  std::vector<double> shares_;
  std::vector<double> knots_;
  std::vector<int> segments_;  // of each interval
};

/// What each segment has of the time; a tenth of the mean or more.
std::vector<double> SharesOfTime(const CompositeTrajectory<double>& path);

}  // namespace switchyard
