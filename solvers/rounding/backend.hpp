// solvers/rounding/backend.hpp - a solver of the host's, as a strategy uses it: asked for by the
// shape of a problem, given one problem, solved once.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "switchyard/abi.h"

namespace switchyard::rounding {

/// What a backend found, by value. Its word is not yet taken for anything.
struct Answer {
  sy_termination termination = SY_NOT_SOLVED;
  sy_point_kind primal = SY_NO_POINT;
  sy_point_kind dual = SY_NO_POINT;
  std::int64_t iterations = 0;
  std::vector<double> x, x_dual, row_dual, cone_dual;
  std::string text;
};

/// The host's best for a problem of this shape among `names` (NULL: any): one that gives duals
/// where there is one. Throws Failure (SY_E_UNSUPPORTED) with the host's reasons where none will.
const sy_solver& FindBackend(const sy_host& host, const sy_problem& problem, const char* names,
                             std::int64_t instances);

/// Solves `problem` once, from nothing, by an instance of its own. Throws Failure with the
/// backend's id and words where a call fails.
Answer SolveBy(const sy_solver& solver, const sy_host& host, const sy_problem& problem,
               const sy_control& control);

}  // namespace switchyard::rounding
