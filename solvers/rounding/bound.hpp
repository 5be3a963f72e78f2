// solvers/rounding/bound.hpp - what is proven of a path problem by duals of its relaxation.
#pragma once

#include "solvers/rounding/backend.hpp"
#include "switchyard/abi.h"

namespace switchyard::rounding {

/// A bound on the objective of every feasible point of `problem`, from duals of any quality of a
/// problem with the same rows and cones: SafeDualBound over the problem's own bounds, or, where
/// that proves nothing, over the boxes that rows and cones prove, the epigraph variables' residuals
/// made exactly 0. With a finite `cutoff` instead over the boxes that rows, cones and the cutoff
/// prove: then the smaller of that and the cutoff. -infinity where nothing is proven.
double ProvenBound(const sy_problem& problem, const Answer& relaxed, double cutoff);

/// Do the duals of a certificate prove that `problem` has no feasible point? They do where the
/// bound of 0'x, over the same rows, cones and either of these boxes, is positive.
bool ProvesInfeasible(const sy_problem& problem, const Answer& certificate);

}  // namespace switchyard::rounding
