// stationarity.hpp - the multipliers of a point, and how far it is from meeting the optimality
// conditions of first order.
#pragma once

#include <optional>
#include <vector>

#include "functions.hpp"
#include "least_squares.hpp"

namespace switchyard::nlopt {

/// In the signs of switchyard/abi.h. The multipliers of the bounds are what the others leave of the
/// gradient.
struct Multipliers {
  std::vector<double> bound;       // of each variable
  std::vector<double> constraint;  // of each row, then of each nonlinear constraint
  std::vector<double> on_bound;    // of `bound`, what has the right sign at a bound that is near
  // The most that no multiplier of the right sign takes of the gradient, relative to 1 + its size.
  double residual = 0;
  // What is open in units of the objective: each multiplier times the distance to its side, and
  // each entry of the residual times that of x. Of a convex program the duality gap, or more.
  double gap = 0;
};

/// The multipliers that leave least of the gradient where the functions are, of the constraints
/// and bounds within `near` of a side (relative to 1 + its size): >= 0 at a lower side, <= 0 at an
/// upper one. Nothing where it was stopped, where derivatives are not defined, or where there are
/// too many.
std::optional<Multipliers> EstimateMultipliers(Functions& functions, double near, const Stop& stop);

}  // namespace switchyard::nlopt
