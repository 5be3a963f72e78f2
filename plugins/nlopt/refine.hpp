// refine.hpp - a step of Newton's method from where NLopt has ended: the last digits, which no
// line search sees in the objective.
#pragma once

#include <optional>
#include <vector>

#include "functions.hpp"
#include "stationarity.hpp"

namespace switchyard::nlopt {

/// From x with its multipliers: the variables whose bound has a multiplier go to that bound, the
/// others by the shortest d of
///   H d - N v = N y - g,   N'd = side - value,
/// H the second derivatives of the Lagrangian, by differences where there are none, N the normals
/// of the equations and of the constraints with a multiplier y; then back into the bounds. Nothing
/// where that is too large, or not defined.
std::optional<std::vector<double>> NewtonStep(Functions& functions, std::vector<double> x,
                                              const Multipliers& multipliers, const Stop& stop);

}  // namespace switchyard::nlopt
