// switchyard/cones.hpp - the one table of cone facts: what a kind of cone is called, which
// dimensions it has, how far a point is from it, how a dual is moved into its dual cone, and what
// membership says about the ranges of the coordinates.
//
// A new cone is a row of kCones and the functions that it names.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include "switchyard/abi.h"
#include "switchyard/cone_functions.hpp"
#include "switchyard/cone_intervals.hpp"

namespace switchyard {

/// What there is to know about a kind of cone. Coordinates are those of SY_CONE_* in abi.h.
struct ConeFacts {
  sy_cone_kind kind;
  const char* name;

  /// What a cone of this kind needs and (dim, parameter) lack; null where nothing is lacking.
  const char* (*need)(int dim, double parameter);

  /// How far s is from the cone: at least the distance in the largest-entry norm, 0 exactly inside
  /// (to the rounding of its evaluation), of degree 1 in s. NaN where s has a NaN.
  double (*violation)(const double* s, int dim, double parameter);

  /// Moves y into the dual cone; what is in it stays. Where a coordinate is raised or cut to the
  /// boundary, its rounding is away from the outside, so that what comes out is dual feasible.
  void (*into_dual)(double* y, int dim, double parameter);

  /// Narrows ranges s[0..dim) of the coordinates to ranges that hold every point of the cone in
  /// them. A range that comes out with lower > upper says that there is none.
  void (*narrow)(Interval* s, int dim, double parameter);
};

namespace cones_detail {

inline constexpr std::array kTable = {
    ConeFacts{SY_CONE_ZERO, "zero", AtLeast<0>, OrNaN<ZeroViolation>, AnyDual, NarrowZero},
    ConeFacts{SY_CONE_NONNEGATIVE, "nonnegative", AtLeast<0>, OrNaN<NonnegativeViolation>,
              NonnegativeIntoDual, NarrowNonnegative},
    ConeFacts{SY_CONE_SECOND_ORDER, "second-order", AtLeast<1>, OrNaN<SecondOrderViolation>,
              SecondOrderIntoDual, NarrowSecondOrder},
    ConeFacts{SY_CONE_PSD, "positive semidefinite", SemidefiniteNeed, OrNaN<SemidefiniteViolation>,
              SemidefiniteIntoDual, NarrowSemidefinite},
    ConeFacts{SY_CONE_EXPONENTIAL, "exponential", ExponentialNeed, OrNaN<ExponentialViolation>,
              ExponentialIntoDual, NarrowExponential},
    ConeFacts{SY_CONE_POWER, "power", PowerNeed, OrNaN<PowerViolation>, PowerIntoDual, NarrowPower},
    ConeFacts{SY_CONE_ROTATED, "rotated second-order", AtLeast<2>, OrNaN<RotatedViolation>,
              RotatedIntoDual, NarrowRotated},
};

constexpr bool RowsStandInOrder() {
  for (std::size_t i = 0; i < kTable.size(); ++i) {
    if (kTable[i].kind != static_cast<sy_cone_kind>(i)) return false;
  }
  return true;
}
static_assert(RowsStandInOrder(), "row i is the cone of kind i");

}  // namespace cones_detail

/// One row for each kind, at the place of its number.
inline constexpr auto& kCones = cones_detail::kTable;

/// The row of a kind. Throws std::invalid_argument for a kind that has none.
inline const ConeFacts& FactsOf(sy_cone_kind kind) {
  if (kind < 0 || static_cast<std::size_t>(kind) >= kCones.size()) {
    throw std::invalid_argument("cone: the kind must be 0 to " + std::to_string(kCones.size() - 1) +
                                ", and is " + std::to_string(kind));
  }
  return kCones[static_cast<std::size_t>(kind)];
}

/// How far y is from the dual cone: the largest entry of the move that brings it there.
inline double DualViolation(const sy_cone& cone, const double* y) {
  std::vector<double> moved(y, y + cone.dim);
  FactsOf(cone.kind).into_dual(moved.data(), cone.dim, cone.parameter);
  double largest = 0;
  for (int i = 0; i < cone.dim; ++i) {
    const double move = std::abs(moved[static_cast<std::size_t>(i)] - y[i]);
    if (!(move <= largest)) largest = move;
  }
  return largest;
}

}  // namespace switchyard
