// tools/switchyard/derivatives.hpp - solve --check-derivatives.
#pragma once

#include "switchyard/model/program.hpp"

namespace switchyard::cli {

/// Holds the derivatives of the program's functions against differences, at the initial guess; a
/// variable without one is in the middle of its bounds, or as near to 0 as they let it be. The
/// report goes to standard output unless `quiet`. Do they all agree, and is every function defined
/// there?
bool CheckDerivativesAtGuess(const MathematicalProgram& program, bool quiet);

}  // namespace switchyard::cli
