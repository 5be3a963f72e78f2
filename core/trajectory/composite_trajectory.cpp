#include "switchyard/trajectory/composite_trajectory.hpp"

#include <algorithm>

#include "core/trajectory/joins.hpp"

namespace switchyard {
namespace {

template <class T>
std::vector<T> BreaksOf(const std::vector<TrajectoryPointer<T>>& segments) {
  std::vector<T> breaks;
  if (segments.empty()) return breaks;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const T start = segments[i]->start_time();
    if (i > 0) {
      const T end = segments[i - 1]->end_time();
      Require(Joins(end, start), "segments: segment ", i, " needs to start at ", end,
              ", where segment ", i - 1, " ends, got ", start);
    }
    breaks.push_back(start);
  }
  breaks.push_back(segments.back()->end_time());
  return breaks;
}

}  // namespace

template <class T>
CompositeTrajectory<T>::CompositeTrajectory(std::vector<TrajectoryPointer<T>> segments)
    : PiecewiseTrajectory<T>(BreaksOf(segments)), segments_(std::move(segments)) {
  for (std::size_t i = 1; i < segments_.size(); ++i) {
    const Trajectory<T>& segment = *segments_[i];
    Require(segment.rows() == this->rows() && segment.cols() == this->cols(), "segments: segment ",
            i, " needs values of ", this->rows(), " x ", this->cols(), " as the first, got ",
            segment.rows(), " x ", segment.cols());
  }
}

template <class T>
const Trajectory<T>& CompositeTrajectory<T>::segment(int segment_index) const {
  this->segment_number_range_check(segment_index);
  return *segments_[static_cast<std::size_t>(segment_index)];
}

template <class T>
CompositeTrajectory<T> CompositeTrajectory<T>::AlignAndConcatenate(
    const std::vector<TrajectoryPointer<T>>& segments) {
  std::vector<TrajectoryPointer<T>> aligned;
  aligned.reserve(segments.size());
  for (const auto& segment : segments) {
    if (aligned.empty()) {
      aligned.push_back(segment);
    } else {
      aligned.push_back(segment->StartingAt(aligned.back()->end_time()));
    }
  }
  return CompositeTrajectory(std::move(aligned));
}

template <class T>
std::unique_ptr<Trajectory<T>> CompositeTrajectory<T>::DoClone() const {
  return std::make_unique<CompositeTrajectory>(*this);
}

template <class T>
Eigen::MatrixX<T> CompositeTrajectory<T>::do_value(const T& t) const {
  const T inside = std::clamp(t, this->start_time(), this->end_time());
  return segment(this->get_segment_index(inside)).value(inside);
}

template <class T>
bool CompositeTrajectory<T>::do_has_derivative() const {
  return std::all_of(segments_.begin(), segments_.end(),
                     [](const auto& segment) { return segment->has_derivative(); });
}

template <class T>
Eigen::MatrixX<T> CompositeTrajectory<T>::DoEvalDerivative(const T& t, int derivative_order) const {
  const T inside = std::clamp(t, this->start_time(), this->end_time());
  return segment(this->get_segment_index(inside)).EvalDerivative(inside, derivative_order);
}

template <class T>
std::unique_ptr<Trajectory<T>> CompositeTrajectory<T>::DoMakeDerivative(
    int derivative_order) const {
  std::vector<TrajectoryPointer<T>> derivatives;
  derivatives.reserve(segments_.size());
  for (const auto& segment : segments_) {
    derivatives.push_back(segment->MakeDerivative(derivative_order));
  }
  return std::make_unique<CompositeTrajectory>(std::move(derivatives));
}

// One after the other: what each ends at after rounding is where the next one starts.
template <class T>
std::unique_ptr<Trajectory<T>> CompositeTrajectory<T>::DoStartingAt(const T& time) const {
  std::vector<TrajectoryPointer<T>> moved = segments_;
  moved[0] = moved[0]->StartingAt(time);
  return std::make_unique<CompositeTrajectory>(AlignAndConcatenate(moved));
}

template <class T>
Eigen::Index CompositeTrajectory<T>::do_rows() const {
  this->RequireSegments();
  return segments_[0]->rows();
}

template <class T>
Eigen::Index CompositeTrajectory<T>::do_cols() const {
  this->RequireSegments();
  return segments_[0]->cols();
}

template class CompositeTrajectory<double>;

}  // namespace switchyard
