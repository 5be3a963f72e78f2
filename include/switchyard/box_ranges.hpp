// switchyard/box_ranges.hpp - the boxes that boxes.hpp narrows: what is accepted as narrower, when
// they are empty, and sums over them with their rounding.
#pragma once

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "switchyard/abi.h"
#include "switchyard/problem.hpp"

namespace switchyard {

enum class BoxSource { kNone, kVariable, kRow, kCone, kCutoff };

struct Boxes {
  std::vector<double> lower;  // num_vars
  std::vector<double> upper;
  bool infeasible = false;              // no point is left, by more than rounding; found by
  BoxSource source = BoxSource::kNone;  // the last thing propagated:
  std::int32_t index = -1;              // variable, row or cone, -1 for the cutoff
};

namespace boxes_detail {

// An empty range that is emptier than this, relative to its ends, is not the data's last digits.
inline constexpr double kCrossing = 1e-9;
// So near to an integer, the bound of an integer variable is that integer.
inline constexpr double kIntegral = 1e-9;
// A narrowing below this share of the range is taken but calls for no further pass.
inline constexpr double kRelevant = 1e-3;

/// A lower bound of a sum over the boxes: infinite terms apart, and the size of the finite ones,
/// to which its rounding is relative.
struct Activity {
  double sum = 0;
  double size = 0;
  std::int32_t infinite = 0;

  void Add(double term) {
    if (std::isfinite(term)) {
      sum += term;
      size += std::abs(term);
    } else {
      infinite += 1;
    }
  }
  /// More than what a sum of `count` terms of three operations each, its difference from `side`
  /// and a division after that rounded; 0 where all is 0.
  [[nodiscard]] double Slack(std::int32_t count, double side) const {
    return (count + 8) * DBL_EPSILON * (size + std::abs(side));
  }
};

/// The ends of an integer that a proven end v leaves.
inline double IntegerBelow(double v) {
  return std::floor(v + kIntegral * std::max(1.0, std::abs(v)));
}
inline double IntegerAbove(double v) { return -IntegerBelow(-v); }

/// Is lhs <= side more wrong than rounding explains?
inline bool IsWrong(double lhs, double side) {
  return lhs - side > kCrossing * std::max(1.0, std::abs(side));
}

/// Is it worth another look that v replaces the end `old` of a range whose other end is `other`?
inline bool IsRelevant(double v, double old, double other) {
  const double range = std::isfinite(other) ? std::abs(old - other) : std::max(1.0, std::abs(v));
  return std::isinf(old) || std::abs(old - v) > kRelevant * range;
}

/// The boxes while they are narrowed. Bounds given to Cut and Raise are proven; an integer's are
/// taken to the next integer inside.
class Ranges {
 public:
  explicit Ranges(const sy_problem& problem) : integer_(problem.integer) {
    const auto n = static_cast<std::size_t>(problem.num_vars);
    boxes_.lower.assign(n, -kInfinity);
    boxes_.upper.assign(n, kInfinity);
    for (std::int32_t j = 0; j < problem.num_vars && !infeasible(); ++j) {
      At(BoxSource::kVariable, j);
      if (problem.x_lower != nullptr) Raise(j, problem.x_lower[j]);
      if (problem.x_upper != nullptr) Cut(j, problem.x_upper[j]);
    }
  }

  /// What the following bounds come from.
  void At(BoxSource source, std::int32_t index) {
    boxes_.source = source;
    boxes_.index = index;
  }
  /// lhs <= side is proven; the boxes are empty where that is wrong.
  void Demand(double lhs, double side) {
    if (IsWrong(lhs, side)) boxes_.infeasible = true;
  }
  void Cut(std::int32_t j, double v) {
    if (v >= upper(j)) return;
    if (IsInteger(j)) v = IntegerBelow(v);
    if (v < upper(j) && Accept(v, upper(j), lower(j), lower(j) - v)) {
      boxes_.upper[static_cast<std::size_t>(j)] = v;
    }
  }
  void Raise(std::int32_t j, double v) {
    if (v <= lower(j)) return;
    if (IsInteger(j)) v = IntegerAbove(v);
    if (v > lower(j) && Accept(v, lower(j), upper(j), v - upper(j))) {
      boxes_.lower[static_cast<std::size_t>(j)] = v;
    }
  }

  [[nodiscard]] double lower(std::int32_t j) const {
    return boxes_.lower[static_cast<std::size_t>(j)];
  }
  [[nodiscard]] double upper(std::int32_t j) const {
    return boxes_.upper[static_cast<std::size_t>(j)];
  }
  [[nodiscard]] bool infeasible() const { return boxes_.infeasible; }
  /// Was anything narrowed by a relevant share since the last time this was asked?
  [[nodiscard]] bool TakeChanged() { return std::exchange(changed_, false); }
  [[nodiscard]] Boxes Take() {
    if (!boxes_.infeasible) At(BoxSource::kNone, -1);
    return std::move(boxes_);
  }

 private:
  [[nodiscard]] bool IsInteger(std::int32_t j) const {
    return integer_ != nullptr && integer_[j] != 0;
  }
  /// Is v to replace the end `old` of a range whose other end is `other`? Not where nothing would
  /// be left, v being `beyond` the other end.
  bool Accept(double v, double old, double other, double beyond) {
    if (!std::isfinite(v)) return false;
    if (beyond > 0) {
      Demand(beyond, 0);
      return false;
    }
    if (IsRelevant(v, old, other)) changed_ = true;
    return true;
  }

  const std::uint8_t* integer_;
  Boxes boxes_;
  bool changed_ = false;
};

}  // namespace boxes_detail
}  // namespace switchyard
