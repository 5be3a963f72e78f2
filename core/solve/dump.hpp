// core/solve/dump.hpp - a lowered problem as a file, for a bug report.
#pragma once

#include <string>

#include "switchyard/abi.h"

namespace switchyard {

/// Writes the problem as "problem/1" JSON: sections by their names in abi.h, matrices as lists of
/// [row, column, value], infinities as strings, doubles that read back exactly. `path` may be "-".
/// Throws InvalidArgument where the file cannot be written.
void WriteProblem(const sy_problem& problem, const std::string& path);

}  // namespace switchyard
