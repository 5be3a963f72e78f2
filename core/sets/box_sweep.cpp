#include "core/sets/box_sweep.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace switchyard {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

double OffsetOf(double lower_a, double upper_b) {
  return kTurn * std::floor((upper_b - lower_a + kTouch) / kTurn);
}

/// A box on the line that is swept.
struct Interval {
  double lower;
  double upper;
  int index;
  bool of_b;
};

std::vector<Interval> OnLine(const BoxColumns& boxes, int line, bool of_b) {
  std::vector<Interval> intervals;
  for (std::size_t k = 0; k < boxes.count(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    if (boxes.empty[k]) continue;
    intervals.push_back(
        {boxes.lower(line, column), boxes.upper(line, column), static_cast<int>(k), of_b});
  }
  return intervals;
}

std::vector<Interval> ByLowerEnd(const BoxColumns& a, const BoxColumns& b, int line, bool within) {
  std::vector<Interval> all = OnLine(a, line, false);
  if (!within) {
    const std::vector<Interval> others = OnLine(b, line, true);
    all.insert(all.end(), others.begin(), others.end());
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Interval& x, const Interval& y) { return x.lower < y.lower; });
  return all;
}

/// How many pairs of intervals overlap: all but those of which one ends before the other begins.
std::size_t CountOverlaps(const std::vector<Interval>& by_lower) {
  std::vector<double> ends;
  for (const Interval& interval : by_lower) ends.push_back(interval.upper);
  std::sort(ends.begin(), ends.end());
  std::size_t ended = 0;
  std::size_t apart = 0;
  for (const Interval& interval : by_lower) {
    while (ended < ends.size() && ends[ended] + kTouch < interval.lower) ++ended;
    apart += ended;
  }
  return by_lower.size() * (by_lower.size() - 1) / 2 - apart;
}

}  // namespace

BoxColumns::BoxColumns(int dim, std::size_t count)
    : lower(dim, static_cast<Eigen::Index>(count)), upper(lower), empty(count, false) {}

void BoxColumns::Set(std::size_t k, const SetBox& box) {
  lower.col(static_cast<Eigen::Index>(k)) = box.lower;
  upper.col(static_cast<Eigen::Index>(k)) = box.upper;
  empty[k] = box.empty;
}

BoxOverlap::BoxOverlap(int dim, std::vector<int> joints) : dim_(dim), joints_(std::move(joints)) {
  for (int i = 0; i < dim; ++i) {
    if (std::find(joints_.begin(), joints_.end(), i) == joints_.end()) lines_.push_back(i);
  }
}

Eigen::VectorXd BoxOverlap::Offset(const BoxColumns& a, std::size_t i, const BoxColumns& b,
                                   std::size_t j) const {
  Eigen::VectorXd offset = Eigen::VectorXd::Zero(dim_);
  for (const int joint : joints_) {
    offset[joint] = OffsetOf(a.lower(joint, static_cast<Eigen::Index>(i)),
                             b.upper(joint, static_cast<Eigen::Index>(j)));
  }
  return offset;
}

bool BoxOverlap::Overlap(const BoxColumns& a, std::size_t i, const BoxColumns& b,
                         std::size_t j) const {
  const auto lower_a = a.lower.col(static_cast<Eigen::Index>(i));
  const auto upper_a = a.upper.col(static_cast<Eigen::Index>(i));
  const auto lower_b = b.lower.col(static_cast<Eigen::Index>(j));
  const auto upper_b = b.upper.col(static_cast<Eigen::Index>(j));
  if (a.empty[i] || b.empty[j]) return false;
  const auto on_line = [&](int k) {
    return lower_a[k] <= upper_b[k] + kTouch && lower_b[k] <= upper_a[k] + kTouch;
  };
  const auto on_circle = [&](int k) {
    return upper_a[k] + OffsetOf(lower_a[k], upper_b[k]) >= lower_b[k] - kTouch;
  };
  return std::all_of(lines_.begin(), lines_.end(), on_line) &&
         std::all_of(joints_.begin(), joints_.end(), on_circle);
}

std::vector<IndexPair> OverlappingPairs(const BoxColumns& a, const BoxColumns& b,
                                        const BoxOverlap& overlap, bool within) {
  std::vector<IndexPair> pairs;
  const auto see = [&](int i, int j) {
    if (within && i > j) std::swap(i, j);
    if (overlap.Overlap(a, static_cast<std::size_t>(i), b, static_cast<std::size_t>(j))) {
      pairs.emplace_back(i, j);
    }
  };
  std::vector<Interval> sweep;
  std::size_t fewest = std::numeric_limits<std::size_t>::max();
  for (const int line : overlap.lines()) {
    std::vector<Interval> along = ByLowerEnd(a, b, line, within);
    const std::size_t count = along.empty() ? 0 : CountOverlaps(along);
    if (count >= fewest) continue;
    fewest = count;
    sweep = std::move(along);
  }
  if (overlap.lines().empty()) {
    for (int i = 0; i < static_cast<int>(a.count()); ++i) {
      for (int j = within ? i + 1 : 0; j < static_cast<int>(b.count()); ++j) see(i, j);
    }
    return pairs;
  }
  for (auto first = sweep.begin(); first != sweep.end(); ++first) {
    for (auto next = first + 1; next != sweep.end(); ++next) {
      if (next->lower > first->upper + kTouch) break;
      if (within) {
        see(first->index, next->index);
      } else if (first->of_b != next->of_b) {
        see(first->of_b ? next->index : first->index, first->of_b ? first->index : next->index);
      }
    }
  }
  return pairs;
}

}  // namespace switchyard
