// core/io/cbf.hpp - the Conic Benchmark Format, versions 1 to 3.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/io/text.hpp"
#include "switchyard/model/program.hpp"

namespace switchyard::io {

/// Scalar variables come first, under the file's numbers, then the matrices of PSDVAR. Rows in L=,
/// L+, L- and F are one binding in the file's order, every other cone is one.
std::unique_ptr<MathematicalProgram> ReadCbf(const FileText& text, Notes* notes);

std::vector<std::string> CbfCannotHold(const MathematicalProgram& program);
std::string WriteCbf(const MathematicalProgram& program, Notes* notes);

}  // namespace switchyard::io
