// switchyard/io/format.hpp - the file formats that programs are read from and written to.
#pragma once

#include <string>
#include <vector>

#include "switchyard/export.hpp"

namespace switchyard {

enum class FileFormat {
  kByEnding,  // of the path, ".gz" aside; where that says nothing, by the first line of the text
  kMps,       // MPS, fixed or free: linear and quadratic programs, with integers
  kCbf,       // Conic Benchmark Format: cones, semidefinite ones among them, with integers
  kJson,      // program/1: all but functions of a user's own code, exactly
};

/// The format called so ("mps", "cbf", "json"). Throws InvalidArgument, with the names there are.
SWITCHYARD_EXPORT FileFormat FileFormatByName(const std::string& name);
/// The names of all formats.
SWITCHYARD_EXPORT std::vector<std::string> FileFormatNames();

}  // namespace switchyard
