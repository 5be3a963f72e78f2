#include "core/trajectory/segment_knots.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace switchyard {
namespace {

// Of the mean share of time, the least that a segment gets.
constexpr double kLeastShare = 0.1;

std::size_t At(int i) { return static_cast<std::size_t>(i); }

/// The time of a path at a parameter.
double TimeOf(const CompositeTrajectory<double>& path, const std::vector<double>& shares,
              double s) {
  const bool whole = shares.size() == 1;
  double begin = 0, start = path.start_time();
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const double end = whole ? path.end_time() : path.segment(static_cast<int>(i)).end_time();
    if (s <= begin + shares[i]) return start + (s - begin) / shares[i] * (end - start);
    begin += shares[i];
    start = end;
  }
  return path.end_time();
}

}  // namespace

SegmentKnots::SegmentKnots(std::vector<double> shares, int order, int num_control_points)
    : order_(order), shares_(std::move(shares)), knots_(At(order), 0.0) {
  const int wanted = num_control_points - order + 1, least = shares_.size() > 1 ? order - 1 : 1;
  double begin = 0;
  for (std::size_t i = 0; i < shares_.size(); ++i) {
    const int parts = std::max(least, static_cast<int>(std::lround(shares_[i] * wanted)));
    for (int k = 1; k <= parts; ++k) {
      knots_.push_back(begin + shares_[i] * k / parts);
      segments_.push_back(static_cast<int>(i));
    }
    begin += shares_[i];
  }
  knots_.back() = 1;
  knots_.insert(knots_.end(), At(order - 1), 1.0);
}

std::vector<int> SegmentKnots::SegmentsOf(int j) const {
  const int first = std::max(0, j - order_ + 1), last = std::min(num_intervals() - 1, j);
  std::vector<int> segments(segments_.begin() + first, segments_.begin() + last + 1);
  segments.erase(std::unique(segments.begin(), segments.end()), segments.end());
  return segments;
}

double SegmentKnots::Inside(int l, double share) const {
  const double begin = knots_[At(l + order_ - 1)];
  return begin + share * (knots_[At(l + order_)] - begin);
}

Eigen::MatrixXd SegmentKnots::Guess(const CompositeTrajectory<double>& path) const {
  Eigen::MatrixXd points(path.rows(), num_control_points());
  for (int j = 0; j < num_control_points(); ++j) {
    const auto first = knots_.begin() + j + 1;
    const double sum = std::accumulate(first, first + order_ - 1, 0.0);
    points.col(j) = path.value(TimeOf(path, shares_, sum / (order_ - 1)));
  }
  return points;
}

std::vector<double> SharesOfTime(const CompositeTrajectory<double>& path) {
  const int n = path.get_number_of_segments();
  const double duration = path.end_time() - path.start_time();
  std::vector<double> shares;
  for (int i = 0; i < n; ++i) {
    shares.push_back(std::max(path.duration(i) / duration, kLeastShare / n));
  }
  const double sum = std::accumulate(shares.begin(), shares.end(), 0.0);
  for (double& share : shares) share /= sum;
  return shares;
}

}  // namespace switchyard
