// core/sets/set_program.hpp - a set, or the cone of its directions of recession, as a program.
#pragma once

#include <string>

#include "switchyard/sets/convex_set.hpp"
#include "switchyard/solve/result.hpp"

namespace switchyard {

/// x in the set; terms are added by the caller.
struct SetProgram {
  explicit SetProgram(const ConvexSet& set);
  MathematicalProgram program;
  VectorXDecisionVariable x;
};

/// The largest direction'r over the set's directions of recession r with |r_i| <= 1: 0 where none
/// goes that way. Of a set without points it is the same of its scaled form at 0.
struct RecessionProgram {
  RecessionProgram(const ConvexSet& set, const VectorRef& direction);
  /// Throws std::runtime_error where the backend could not tell.
  [[nodiscard]] double Value(const MathematicalProgramResult& result) const;
  MathematicalProgram program;
  std::string kind;
};

/// Throws std::runtime_error: `what` of the set could not be told.
[[noreturn]] void CouldNotTell(const std::string& kind, const std::string& what,
                               const MathematicalProgramResult& result);

}  // namespace switchyard
