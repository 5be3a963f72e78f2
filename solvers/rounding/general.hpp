// solvers/rounding/general.hpp - relax-and-round where the problem says nothing of paths: the
// relaxation is rounded and dived in, and the best integer point is kept.
#pragma once

#include "solvers/rounding/integer_problem.hpp"
#include "solvers/rounding/options.hpp"
#include "switchyard/abi.h"

namespace switchyard::rounding {

/// Answers as RelaxAndRound says. One thread solves a dive, and dives are taken in order: the
/// answer does not depend on how many threads there are. Without integer variables it is the
/// relaxation's answer, with duals, and with the bound proven here.
void SolveGeneral(const IntegerProblem& whole, const Options& options, const sy_host& host,
                  const sy_control& control, sy_result& result);

}  // namespace switchyard::rounding
