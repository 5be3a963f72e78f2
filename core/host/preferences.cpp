#include "core/host/preferences.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <vector>

#include "switchyard/error.hpp"

namespace switchyard {
namespace {

std::string WithoutSpaces(std::string text) {
  std::erase_if(text, [](unsigned char c) { return std::isspace(c) != 0; });
  return text;
}

ProgramType TypeNamed(const std::string& name, const std::string& source, int line) {
  if (const auto type = ProgramTypeNamed(name)) return *type;
  std::vector<std::string> known;
  for (int k = 0; k <= static_cast<int>(ProgramType::kMINLP); ++k) {
    known.emplace_back(to_string(static_cast<ProgramType>(k)));
  }
  const std::string near = NearestName(name, known);
  Refuse(source, ":", line, ": there is no class of programs \"", name, "\"",
         near.empty() ? "" : "; the nearest is \"" + near + "\"");
}

std::filesystem::path ConfigurationFile() {
  if (const char* folder = std::getenv("XDG_CONFIG_HOME"); folder != nullptr && *folder != '\0') {
    return std::filesystem::path(folder) / "switchyard" / "solvers.conf";
  }
  const char* home = std::getenv("HOME");
  if (home == nullptr) return {};
  return std::filesystem::path(home) / ".config" / "switchyard" / "solvers.conf";
}

}  // namespace

Preferences::Preferences(const std::string& text, const std::string& source) {
  std::istringstream lines(text);
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    std::istringstream parts(line.substr(0, line.find('#')));
    for (std::string part; std::getline(parts, part, ';');) {
      part = WithoutSpaces(part);
      if (part.empty()) continue;
      const std::size_t equals = part.find('=');
      if (equals == std::string::npos) {
        Set(std::nullopt, part, source);
      } else {
        Set(TypeNamed(part.substr(0, equals), source, number), part.substr(equals + 1), source);
      }
    }
  }
}

void Preferences::Set(std::optional<ProgramType> type, const std::string& names,
                      const std::string& source) {
  if (names.empty()) {
    by_type_.erase(type);
  } else {
    by_type_[type] = {WithoutSpaces(names), source};
  }
}

Preference Preferences::For(ProgramType type) const {
  for (const std::optional<ProgramType> key : {std::optional(type), std::optional<ProgramType>()}) {
    const auto found = by_type_.find(key);
    if (found != by_type_.end()) return found->second;
  }
  return {};
}

Preferences ConfiguredPreferences() {
  if (const char* variable = std::getenv("SWITCHYARD_SOLVERS")) {
    return {variable, "SWITCHYARD_SOLVERS"};
  }
  const std::filesystem::path file = ConfigurationFile();
  std::ifstream in(file);
  if (file.empty() || !in) return {};
  std::ostringstream text;
  text << in.rdbuf();
  return {text.str(), file.string()};
}

}  // namespace switchyard
