// core/solve/tangent.hpp - a nonlinear problem at a point, as one without functions.
#pragma once

#include <optional>
#include <vector>

#include "core/problem/vectors.hpp"
#include "switchyard/problem.hpp"

namespace switchyard {

/// The problem with its functions replaced by their tangents at x, the constraints as rows behind
/// the others. Its duals at x are those of the problem, and a point satisfies the conditions of
/// first order for the one where it does for the other. Where the functions are convex as
/// SY_PROBLEM_CONVEX says, it is a relaxation: a bound on it is one on the problem.
/// None: the functions have no derivatives, or are not defined at x.
std::optional<Problem> TangentProblem(const sy_problem& problem, const std::vector<double>& x);

/// nlp_dual behind row_dual.
void DualsOfTangentProblem(Vectors& v);

}  // namespace switchyard
