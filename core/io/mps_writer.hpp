// core/io/mps_writer.hpp - programs as free MPS.
#pragma once

#include <string>
#include <vector>

#include "core/io/text.hpp"
#include "switchyard/model/program.hpp"

namespace switchyard::io {

std::vector<std::string> MpsCannotHold(const MathematicalProgram& program);
std::string WriteMps(const MathematicalProgram& program, Notes* notes);

}  // namespace switchyard::io
