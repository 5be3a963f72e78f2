// switchyard/trajectory/piecewise_trajectory.hpp - segments, one after the other.
#pragma once

#include <limits>
#include <random>
#include <vector>

#include "switchyard/trajectory/trajectory.hpp"

namespace switchyard {

/// Segment i is from break i to break i + 1. Without segments there are no times and no values, and
/// what asks for them throws InvalidArgument.
template <class T>
class SWITCHYARD_EXPORT PiecewiseTrajectory : public Trajectory<T> {
 public:
  /// The shortest duration of a segment, seconds.
  static constexpr double kEpsilonTime = std::numeric_limits<double>::epsilon();

  [[nodiscard]] int get_number_of_segments() const {
    return breaks_.empty() ? 0 : static_cast<int>(breaks_.size()) - 1;
  }
  using Trajectory<T>::start_time;
  using Trajectory<T>::end_time;
  /// Of one segment. Throw InvalidArgument where there is no such segment.
  [[nodiscard]] T start_time(int segment_number) const;
  [[nodiscard]] T end_time(int segment_number) const;
  [[nodiscard]] T duration(int segment_number) const;
  /// start_time() <= t <= end_time()?
  [[nodiscard]] bool is_time_in_range(const T& t) const;
  /// The last segment that starts at t or before; the first where none does.
  [[nodiscard]] int get_segment_index(const T& t) const;
  /// The breaks; none where there is no segment.
  [[nodiscard]] const std::vector<T>& get_segment_times() const { return breaks_; }
  /// Throws InvalidArgument where there is no such segment.
  void segment_number_range_check(int segment_number) const;
  /// num_segments + 1 times from 0 on, the durations between them drawn evenly from [0.1, 1.1).
  [[nodiscard]] static std::vector<T> RandomSegmentTimes(int num_segments,
                                                         std::default_random_engine& generator);

 protected:
  PiecewiseTrajectory() = default;
  /// Throws InvalidArgument for one break, and where a break is not kEpsilonTime after the one
  /// before. The first and the last may be infinite.
  explicit PiecewiseTrajectory(std::vector<T> breaks);
  [[nodiscard]] T do_start_time() const override;
  [[nodiscard]] T do_end_time() const override;
  /// Throws InvalidArgument where there are no segments.
  void RequireSegments() const;

 private:
  std::vector<T> breaks_;
};

extern template class PiecewiseTrajectory<double>;

}  // namespace switchyard
