// options.hpp - HiGHS's own options: their table, and those a user chose.
#pragma once

#include <set>
#include <string>
#include <string_view>

#include "Highs.h"
#include "switchyard/abi.h"

namespace switchyard::highs {

/// The records of HiGHS, letter for letter, without the two that write to standard output.
const sy_option* const* OptionTable();

class Options {
 public:
  /// Throws Failure: an unknown name, another type, a value out of range.
  void Set(std::string_view name, const sy_value& value);

  /// The user's choices over the defaults of HiGHS.
  [[nodiscard]] const HighsOptions& own() const { return own_; }

  /// What one solve runs with: the user's choice, else the host's, else the default of HiGHS.
  [[nodiscard]] HighsOptions For(const sy_control& control) const;

 private:
  template <class T, class From>
  void Prefer(T& field, const char* name, From value) const {
    if (!chosen_.contains(name)) field = static_cast<T>(value);
  }

  HighsOptions own_;
  std::set<std::string, std::less<>> chosen_;
};

}  // namespace switchyard::highs
