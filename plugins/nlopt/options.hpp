// options.hpp - what can be set of NLopt: its parameters, letter for letter, and its algorithm.
#pragma once

#include <string_view>

#include "algorithms.hpp"
#include "linear/settings.hpp"
#include "switchyard/abi.h"

namespace switchyard::nlopt {

const sy_option* const* OptionTable();

class Options {
 public:
  Options() : held_(OptionTable(), "NLopt") {}

  /// Throws Failure: an unknown name, another type, a value out of range, an algorithm that is not
  /// there.
  void Set(std::string_view name, const sy_value& value);

  /// NULL: whatever fits the program.
  [[nodiscard]] const Algorithm* algorithm() const { return algorithm_; }
  [[nodiscard]] const Algorithm* local_algorithm() const { return local_; }
  [[nodiscard]] bool Has(std::string_view name) const { return held_.Has(name); }
  [[nodiscard]] double Real(std::string_view name) const { return held_.Real(name); }
  [[nodiscard]] int Integer(std::string_view name) const { return held_.Integer(name); }

 private:
  linear::Settings held_;
  const Algorithm* algorithm_ = nullptr;
  const Algorithm* local_ = nullptr;
};

}  // namespace switchyard::nlopt
