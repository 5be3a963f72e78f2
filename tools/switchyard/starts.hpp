// tools/switchyard/starts.hpp - solve --starts N.
#pragma once

#include "solve_options.hpp"
#include "switchyard/model/program.hpp"
#include "switchyard/solve/result.hpp"

namespace switchyard::cli {

/// What solves from many starts came to.
struct StartCounts {
  int tried = 0;
  int answered = 0;  // solved, at least locally
  int distinct = 0;  // points among these, further apart than tolerances leave them
};

/// Solves from `options.starts` points, some at once by the backends of the process; the best. The
/// time that is left is shared evenly, so that all have ended when it has.
MathematicalProgramResult SolveFromStarts(const MathematicalProgram& program,
                                          const SolveOptions& options, SolverOptions given,
                                          StartCounts* counts);

}  // namespace switchyard::cli
