// solvers/rounding/option_values.hpp - values of a strategy's options against its table.
#pragma once

#include <string>

#include "switchyard/abi.h"

namespace switchyard::rounding {

/// A row of an option table, its fallback's value yet to be written.
constexpr sy_option OptionRow(const char* name, const char* help, sy_type type, double upper,
                              const char* const* choices = nullptr) {
  return {sizeof(sy_option), 0, name, help, {type, 0, {}}, 0, upper, choices};
}

/// Throws plugin::Failure (SY_E_ARGUMENT): the option, what it needs, what came.
[[noreturn]] void RefuseValue(const sy_option& row, const std::string& need, const sy_value& value);

/// The number of a value that fits the row's type and range; an integer serves for a real. Throws
/// plugin::Failure.
double NumberOf(const sy_option& row, const sy_value& value);

/// The text of a value, one of the row's choices where it has some. Throws plugin::Failure.
std::string TextOf(const sy_option& row, const sy_value& value);

}  // namespace switchyard::rounding
