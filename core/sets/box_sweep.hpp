// core/sets/box_sweep.hpp - the pairs of many boxes that overlap.
#pragma once

#include <utility>
#include <vector>

#include "switchyard/sets/convex_set.hpp"

namespace switchyard {

/// What misses each other by no more than this meets, per coordinate.
inline constexpr double kTouch = 1e-9;

/// Boxes side by side: number k in column k.
struct BoxColumns {
  BoxColumns(int dim, std::size_t count);
  void Set(std::size_t k, const SetBox& box);
  [[nodiscard]] std::size_t count() const { return static_cast<std::size_t>(lower.cols()); }

  Eigen::MatrixXd lower;  // dim x count
  Eigen::MatrixXd upper;
  std::vector<bool> empty;
};

/// How boxes overlap: coordinates of continuous joints do modulo 2 pi.
class BoxOverlap {
 public:
  BoxOverlap(int dim, std::vector<int> joints);
  /// The offset along the joints that ComputeOffsetContinuousRevoluteJoints gives.
  [[nodiscard]] Eigen::VectorXd Offset(const BoxColumns& a, std::size_t i, const BoxColumns& b,
                                       std::size_t j) const;
  [[nodiscard]] bool Overlap(const BoxColumns& a, std::size_t i, const BoxColumns& b,
                             std::size_t j) const;
  [[nodiscard]] const std::vector<int>& joints() const { return joints_; }
  [[nodiscard]] const std::vector<int>& lines() const { return lines_; }  // the other coordinates

 private:
  int dim_;
  std::vector<int> joints_;
  std::vector<int> lines_;
};

using IndexPair = std::pair<int, int>;
/// All (i, j), i of a and j of b, that overlap; a sweep along the line with the fewest overlaps.
/// With `within`, b is a and i < j. In no order that means anything.
std::vector<IndexPair> OverlappingPairs(const BoxColumns& a, const BoxColumns& b,
                                        const BoxOverlap& overlap, bool within);

}  // namespace switchyard
