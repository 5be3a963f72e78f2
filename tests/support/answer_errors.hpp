// tests/support/answer_errors.hpp - how far vectors over a problem are from what abi.h says at
// sy_result: an optimum with its duals, a contradiction, a ray. It knows no solver.
#pragma once

#include "core/problem/vectors.hpp"
#include "switchyard/cones.hpp"
#include "switchyard/problem.hpp"
#include "tests/shared_headers/random_problem.hpp"

namespace switchyard::testing {

Vector Product(const Csc& M, const Vector& x);

/// x_dual + A'row_dual + F'cone_dual; a vector that is empty counts as 0.
Vector Combined(const ProblemData& d, const Vectors& v);

double Outside(double value, double lower, double upper);

/// How far x is from feasible, the largest over bounds, rows and cones.
double PrimalError(const ProblemData& d, const Vector& x);

/// sum side(x_dual) + sum side(row_dual) - g'cone_dual; a dual against an infinite side is worth
/// -infinity.
double SideSum(const ProblemData& d, const Vectors& v);

/// How far the cone duals are from their dual cones.
double ConeDualError(const ProblemData& d, const Vector& cone_dual);

/// The largest of: primal error, |Px + q - x_dual - A'row_dual - F'cone_dual|, cone dual error and
/// |objective - dual objective|. 0 at an optimum with its duals; NaN in, NaN out.
double OptimumError(const ProblemData& d, const Vectors& v);

/// 0 where the duals prove, as abi.h says, that there is no feasible point; scaled to a sum of 1.
double ContradictionError(const ProblemData& d, const Vectors& v);

/// 0 where x is a ray as abi.h says; scaled to a slope of -1.
double RayError(const ProblemData& given, const Vector& x);

}  // namespace switchyard::testing
