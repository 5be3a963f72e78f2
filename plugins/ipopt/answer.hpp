// answer.hpp - what a point that Ipopt ended in is worth, and Ipopt's verdict in words.
#pragma once

#include <optional>
#include <string>

#include "functions.hpp"
#include "nlp.hpp"
#include "switchyard/abi.h"

namespace switchyard::ipopt {

/// A point measured against the whole problem.
struct Measured {
  Point point;  // with all its duals: x_dual is what stationarity leaves
  double objective = 0;
  double violation = 0;  // the largest of a row or of c, relative; the bounds hold
  // The largest |d| min(1, distance to the side that d stands against) of a dual d, relative to its
  // entry of the gradient, or to the objective for a row or c: 0 where the optimality conditions of
  // first order hold.
  double optimality = 0;
};

/// Measures x, row_dual and nlp_dual of `point`. Nothing where the functions are not defined there,
/// or one of them has ended the solve.
std::optional<Measured> Measure(const sy_problem& problem, Functions& functions, Point point);

/// Ipopt's status by its name, and what it means where the name does not say. `at`: the last point.
std::string Words(const Found& found, const std::optional<Measured>& at,
                  const Functions& functions);

}  // namespace switchyard::ipopt
