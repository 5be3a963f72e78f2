// tools/switchyard/json_result.hpp - result/1 and solution files.
#pragma once

#include <string>

#include "switchyard/solve/result.hpp"

namespace switchyard::cli {

/// Writes result/1 to `path`, "-" being standard output. Throws InvalidArgument where it cannot.
void WriteResult(const MathematicalProgram& program, const MathematicalProgramResult& result,
                 const std::string& path);

/// {"variables": {name: value}, "rows": {name: dual}}.
void WriteSolution(const MathematicalProgram& program, const MathematicalProgramResult& result,
                   const std::string& path);

}  // namespace switchyard::cli
