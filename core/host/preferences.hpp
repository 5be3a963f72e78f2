// core/host/preferences.hpp - which backends a user prefers, for all programs or by their class.
#pragma once

#include <map>
#include <string>

#include "switchyard/host/program_type.hpp"

namespace switchyard {

/// Names in order of preference, and where that was said; empty: nothing was.
struct Preference {
  std::string names;
  std::string source;
};

/// Reads lines (or parts between semicolons) `names` or `class = names`, # begins a comment:
///
///   lp = clp, highs
///   nlp = ipopt
///
/// Throws InvalidArgument, with the source and the line, for a class that is none.
class Preferences {
 public:
  Preferences() = default;
  Preferences(const std::string& text, const std::string& source);

  void Set(std::optional<ProgramType> type, const std::string& names, const std::string& source);
  /// That of the class, else that of all.
  [[nodiscard]] Preference For(ProgramType type) const;

 private:
  std::map<std::optional<ProgramType>, Preference> by_type_;
};

/// Those of SWITCHYARD_SOLVERS, else those of the file solvers.conf in the user's folder of
/// configuration; read anew.
Preferences ConfiguredPreferences();

}  // namespace switchyard
