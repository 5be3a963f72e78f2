// solvers/rounding/verify.hpp - a point against a problem's own rows, cones and bounds.
#pragma once

#include <string>

#include "switchyard/abi.h"

namespace switchyard::rounding {

/// What x violates by more than `tolerance`, relative to the sides and to the terms of a row or
/// cone, with how far; "" where it is feasible. Integer variables must be integers to `tolerance`.
std::string WhatIsViolated(const sy_problem& problem, const double* x, double tolerance);

}  // namespace switchyard::rounding
