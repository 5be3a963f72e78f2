// tests/io/same_program.hpp - are two programs the same one?
#pragma once

#include <string>

#include "switchyard/model/program.hpp"

namespace switchyard::testing {

/// The first difference in words; "" where there is none. Compared are sense, types (binary is
/// integer in [0, 1]), bounds, costs, rows and cones, over all variables, number by number, and
/// functions, operation by operation.
std::string Difference(const MathematicalProgram& a, const MathematicalProgram& b);

/// The first difference of names: of the program, of variables, of rows.
std::string DifferenceOfNames(const MathematicalProgram& a, const MathematicalProgram& b);

}  // namespace switchyard::testing
