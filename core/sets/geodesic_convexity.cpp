#include "switchyard/sets/geodesic_convexity.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "switchyard/error.hpp"
#include "switchyard/sets/hyperrectangle.hpp"
#include "switchyard/sets/intersection.hpp"

namespace switchyard {
namespace {

using std::numbers::pi;
using Range = std::pair<double, double>;

/// As many equal ranges as needed for none to be longer than pi - epsilon, each beginning epsilon
/// before the end of the last: k of length l with k l - (k - 1) epsilon the whole.
std::vector<Range> Cut(const Range& whole, double epsilon) {
  const double width = whole.second - whole.first;
  if (width <= pi - epsilon) return {whole};
  const double count = std::ceil((width - epsilon) / (pi - 2 * epsilon));
  const double length = (width + (count - 1) * epsilon) / count;
  std::vector<Range> parts;
  for (int k = 0; k < static_cast<int>(count); ++k) {
    const double first = whole.first + k * (length - epsilon);
    parts.emplace_back(first, first + length);
  }
  parts.back().second = whole.second;
  return parts;
}

}  // namespace

Range GetMinimumAndMaximumValueAlongDimension(const ConvexSet& region, int dimension) {
  const int n = region.ambient_dimension();
  Require(dimension >= 0 && dimension < n, "a ", region.Kind(), " in R^", n, " has no dimension ",
          dimension);
  const SetBox& box = region.bounding_box();
  Require(!box.empty, "an empty ", region.Kind(), " has no values along dimension ", dimension);
  const Eigen::VectorXd unit = Eigen::VectorXd::Unit(n, dimension);
  const Range range(std::max(box.lower[dimension], -region.SupportFunction(-unit)),
                    std::min(box.upper[dimension], region.SupportFunction(unit)));
  Require(range.first <= range.second || !region.IsEmpty(), "an empty ", region.Kind(),
          " has no values along dimension ", dimension);
  Require(std::isfinite(range.first) && std::isfinite(range.second), "a ", region.Kind(), " in R^",
          n, " is unbounded along dimension ", dimension);
  return {range.first, std::max(range.first, range.second)};
}

std::vector<Range> GetMinimumAndMaximumValueAlongDimension(const ConvexSet& region,
                                                           const std::vector<int>& dimensions) {
  std::vector<Range> ranges;
  for (const int dimension : dimensions) {
    ranges.push_back(GetMinimumAndMaximumValueAlongDimension(region, dimension));
  }
  return ranges;
}

void ThrowsForInvalidContinuousJointsList(int num_positions,
                                          const std::vector<int>& continuous_revolute_joints) {
  std::vector<int> sorted = continuous_revolute_joints;
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t k = 0; k < sorted.size(); ++k) {
    Require(sorted[k] >= 0 && sorted[k] < num_positions, "continuous revolute joints: index ",
            sorted[k], " is not one of ", num_positions, " positions");
    Require(k == 0 || sorted[k] != sorted[k - 1], "continuous revolute joints: index ", sorted[k],
            " stands twice");
  }
}

Eigen::VectorXd ComputeOffsetContinuousRevoluteJoints(
    int num_positions, const std::vector<int>& continuous_revolute_joints,
    const std::vector<Range>& continuous_bbox_A, const std::vector<Range>& continuous_bbox_B) {
  ThrowsForInvalidContinuousJointsList(num_positions, continuous_revolute_joints);
  const std::size_t joints = continuous_revolute_joints.size();
  Require(continuous_bbox_A.size() == joints && continuous_bbox_B.size() == joints, joints,
          " continuous revolute joints need as many ranges, got ", continuous_bbox_A.size(),
          " and ", continuous_bbox_B.size());
  Eigen::VectorXd offset = Eigen::VectorXd::Zero(num_positions);
  for (std::size_t k = 0; k < joints; ++k) {
    const double gap = continuous_bbox_B[k].second - continuous_bbox_A[k].first;
    Require(std::isfinite(gap), "the ranges along joint ", continuous_revolute_joints[k],
            " must be finite");
    offset[continuous_revolute_joints[k]] = 2 * pi * std::floor((gap + 1e-9) / (2 * pi));
  }
  return offset;
}

bool CheckIfSatisfiesConvexityRadius(const ConvexSet& convex_set,
                                     const std::vector<int>& continuous_revolute_joints) {
  const int n = convex_set.ambient_dimension();
  ThrowsForInvalidContinuousJointsList(n, continuous_revolute_joints);
  return std::all_of(
      continuous_revolute_joints.begin(), continuous_revolute_joints.end(), [&](int joint) {
        const auto [lower, upper] = GetMinimumAndMaximumValueAlongDimension(convex_set, joint);
        return upper - lower < pi;
      });
}

ConvexSets PartitionConvexSet(const ConvexSet& convex_set,
                              const std::vector<int>& continuous_revolute_joints, double epsilon) {
  const int n = convex_set.ambient_dimension();
  ThrowsForInvalidContinuousJointsList(n, continuous_revolute_joints);
  Require(epsilon > 0 && epsilon < pi / 2,
          "PartitionConvexSet needs an epsilon in (0, pi / 2), got ", epsilon);
  if (!continuous_revolute_joints.empty() && convex_set.IsEmpty()) return {};
  std::vector<Hyperrectangle> boxes = {Hyperrectangle(Eigen::VectorXd::Constant(n, -kInfinity),
                                                      Eigen::VectorXd::Constant(n, kInfinity))};
  for (const int joint : continuous_revolute_joints) {
    const std::vector<Range> parts =
        Cut(GetMinimumAndMaximumValueAlongDimension(convex_set, joint), epsilon);
    if (parts.size() == 1) continue;
    std::vector<Hyperrectangle> cut;
    for (const Hyperrectangle& box : boxes) {
      for (const auto& [lower, upper] : parts) {
        Eigen::VectorXd lb = box.lb();
        Eigen::VectorXd ub = box.ub();
        lb[joint] = lower;
        ub[joint] = upper;
        cut.emplace_back(lb, ub);
      }
    }
    boxes = std::move(cut);
  }
  if (boxes.size() == 1) return MakeConvexSets(convex_set);
  ConvexSets pieces;
  for (const Hyperrectangle& box : boxes) {
    const Intersection piece(convex_set, box);
    if (!piece.IsEmpty()) pieces.emplace_back(piece);
  }
  return pieces;
}

ConvexSets PartitionConvexSet(const ConvexSets& convex_sets,
                              const std::vector<int>& continuous_revolute_joints, double epsilon) {
  ConvexSets pieces;
  for (const ConvexSetPointer& set : convex_sets) {
    const ConvexSets of_set = PartitionConvexSet(*set, continuous_revolute_joints, epsilon);
    pieces.insert(pieces.end(), of_set.begin(), of_set.end());
  }
  return pieces;
}

}  // namespace switchyard
