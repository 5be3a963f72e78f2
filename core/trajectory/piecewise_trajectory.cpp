#include "switchyard/trajectory/piecewise_trajectory.hpp"

#include <algorithm>
#include <cmath>

namespace switchyard {

template <class T>
PiecewiseTrajectory<T>::PiecewiseTrajectory(std::vector<T> breaks) : breaks_(std::move(breaks)) {
  Require(breaks_.size() != 1, "breaks: two or more are needed, got one");
  for (std::size_t i = 0; i + 1 < breaks_.size(); ++i) {
    Require(breaks_[i + 1] - breaks_[i] >= kEpsilonTime, "breaks: breaks[", i + 1,
            "] = ", breaks_[i + 1], " needs to be above breaks[", i, "] = ", breaks_[i]);
  }
}

template <class T>
void PiecewiseTrajectory<T>::RequireSegments() const {
  Require(!breaks_.empty(), "a ", this->Kind(), " with segments is needed, got one without");
}

template <class T>
void PiecewiseTrajectory<T>::segment_number_range_check(int segment_number) const {
  Require(segment_number >= 0 && segment_number < get_number_of_segments(),
          "the number of a segment needs to be from 0 to ", get_number_of_segments() - 1, ", got ",
          segment_number);
}

template <class T>
T PiecewiseTrajectory<T>::start_time(int segment_number) const {
  segment_number_range_check(segment_number);
  return breaks_[static_cast<std::size_t>(segment_number)];
}

template <class T>
T PiecewiseTrajectory<T>::end_time(int segment_number) const {
  segment_number_range_check(segment_number);
  return breaks_[static_cast<std::size_t>(segment_number) + 1];
}

template <class T>
T PiecewiseTrajectory<T>::duration(int segment_number) const {
  return end_time(segment_number) - start_time(segment_number);
}

template <class T>
T PiecewiseTrajectory<T>::do_start_time() const {
  RequireSegments();
  return breaks_.front();
}

template <class T>
T PiecewiseTrajectory<T>::do_end_time() const {
  RequireSegments();
  return breaks_.back();
}

template <class T>
bool PiecewiseTrajectory<T>::is_time_in_range(const T& t) const {
  return t >= this->start_time() && t <= this->end_time();
}

template <class T>
int PiecewiseTrajectory<T>::get_segment_index(const T& t) const {
  RequireSegments();
  Require(!std::isnan(t), "a time is needed to find its segment, got nan");
  const auto behind = std::upper_bound(breaks_.begin() + 1, breaks_.end() - 1, t);
  return static_cast<int>(behind - breaks_.begin()) - 1;
}

template <class T>
std::vector<T> PiecewiseTrajectory<T>::RandomSegmentTimes(int num_segments,
                                                          std::default_random_engine& generator) {
  Require(num_segments >= 0, "a number of segments needs to be 0 or more, got ", num_segments);
  std::uniform_real_distribution<double> duration(0.1, 1.1);
  std::vector<T> times = {0};
  for (int i = 0; i < num_segments; ++i) times.push_back(times.back() + duration(generator));
  return times;
}

template class PiecewiseTrajectory<double>;

}  // namespace switchyard
