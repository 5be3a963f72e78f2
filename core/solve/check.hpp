// core/solve/check.hpp - what a backend says, held against the problem that it was given.
#pragma once

#include <limits>
#include <string>

#include "core/lower/lowering.hpp"
#include "core/problem/vectors.hpp"
#include "switchyard/solve/result.hpp"

namespace switchyard {

/// What makes a point feasible: violations relative to 1 + the largest term that meets in the row,
/// cone or bound. What duals must show at the most to support an optimum.
inline constexpr double kSupported = 1e-6;
inline constexpr double kNearly = 1e-3;
/// What makes a point feasible, too: violations relative to 1 + the largest term of the problem,
/// in which interior-point methods measure.
inline constexpr double kSupportedByNorm = 1e-8;
/// How far from an integer a value may be; simplex codes leave 1e-6, and their scaling more.
inline constexpr double kIntegral = 1e-5;

/// The largest violation of x over bounds, rows, cones and functions, in units in which kSupported
/// is the most that is feasible: each relative to 1 + its largest term or, where that is smaller,
/// to 1 + the largest of all terms and kSupportedByNorm; that of integrality in units of kIntegral.
/// The term of a nonlinear constraint is its bound; infinite where a function is not defined.
double RelativeViolation(const sy_problem& problem, const std::vector<double>& x);

/// What duals say about a convex problem without integers.
struct DualCheck {
  /// Proven, on boxes that hold an optimal point; -infinity: nothing is.
  double bound = -std::numeric_limits<double>::infinity();
  /// The dual objective on the problem's own bounds, what is left of stationarity on open columns
  /// (a wrong sign against an infinite side) left out: no bound, but what solvers go by.
  double estimate = std::numeric_limits<double>::quiet_NaN();
  double open_worth = 0;  // what was left out, as an objective, were x no larger than it is
  int open_column = -1;   // where the proof of `bound` ends; -1: nowhere
};
/// Of any continuous problem: the estimate alone, in which `bound` stays -infinity. At a point that
/// satisfies the conditions of first order with these duals it is the point's objective.
DualCheck EstimateDuals(const sy_problem& problem, const Vectors& v);
/// `cutoff`: the objective of a feasible point; the boxes are proven below it.
DualCheck CheckDuals(const sy_problem& problem, const Vectors& v, double cutoff);

/// Do the duals prove that no feasible point exists (Farkas)?
bool ProvesInfeasible(const sy_problem& problem, const Vectors& v);
/// Is v.x a direction along which the objective falls for ever?
bool IsUnboundedRay(const sy_problem& problem, const Vectors& v);

}  // namespace switchyard
