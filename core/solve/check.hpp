// core/solve/check.hpp - what a backend says, held against the problem that it was given.
#pragma once

#include <limits>
#include <string>

#include "core/lower/lowering.hpp"
#include "core/problem/vectors.hpp"
#include "switchyard/solve/result.hpp"

namespace switchyard {

/// Relative to 1 + the largest term that meets in the row, cone or bound: what makes a point
/// feasible, and what duals must leave open at the most to support an optimum.
inline constexpr double kSupported = 1e-6;
inline constexpr double kNearly = 1e-3;
/// How far from an integer a value may be; simplex codes leave 1e-6, and their scaling more.
inline constexpr double kIntegral = 1e-5;

/// The largest violation of x over bounds, rows and cones, each relative to 1 + its largest term;
/// that of integrality is absolute, times kSupported / kIntegral.
double RelativeViolation(const sy_problem& problem, const std::vector<double>& x);

/// What the duals prove about a convex problem without integers.
struct DualCheck {
  double bound = -std::numeric_limits<double>::infinity();     // proven; -infinity: nothing is
  double estimate = std::numeric_limits<double>::quiet_NaN();  // were the open residual 0
  double open_residual = 0;  // relative, on columns without a finite box
  int open_column = -1;
};
/// `cutoff`: the objective of a feasible point; the boxes are proven below it.
DualCheck CheckDuals(const sy_problem& problem, const Vectors& v, double cutoff);

/// Do the duals prove that no feasible point exists (Farkas)?
bool ProvesInfeasible(const sy_problem& problem, const Vectors& v);
/// Is v.x a direction along which the objective falls for ever?
bool IsUnboundedRay(const sy_problem& problem, const Vectors& v);

}  // namespace switchyard
