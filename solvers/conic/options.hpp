// solvers/conic/options.hpp - what a user may set.
#pragma once

#include <string_view>

#include "switchyard/abi.h"

namespace switchyard::conic {

struct Options {
  int presolve = 1;  // a switch, as the next one
  int blocks = 1;
  int corrections = 4;
  int max_iterations = 200;

  /// Throws plugin::Failure where there is no such option, or not with such a value.
  void Set(std::string_view name, const sy_value& value);
};

/// The rows of sy_solver.options.
const sy_option* const* OptionTable();

}  // namespace switchyard::conic
