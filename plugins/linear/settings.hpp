// linear/settings.hpp - a solver's own options against their table.
#pragma once

#include <cstdint>
#include <map>
#include <sstream>
#include <string>
#include <string_view>

#include "switchyard/abi.h"
#include "switchyard/plugin.hpp"

namespace switchyard::linear {

template <class T>
std::string Join(const T& part) {
  std::ostringstream out;
  out << part;
  return out.str();
}

inline std::string Said(const sy_value& value) {
  if (value.type == SY_INTEGER) return Join(value.as.integer);
  if (value.type == SY_REAL) return Join(value.as.real);
  return std::string("'") + (value.as.text != nullptr ? value.as.text : "") + "'";
}

inline double Number(const sy_value& value) {
  return value.type == SY_REAL ? value.as.real : static_cast<double>(value.as.integer);
}

/// Is `text` one of the row's words? A row without words takes any.
inline void CheckWord(const sy_option& row, const sy_value& value) {
  if (row.choices == nullptr) return;
  std::string all;
  for (const char* const* word = row.choices; *word != nullptr; ++word) {
    if (std::string_view(*word) == value.as.text) return;
    all += std::string(all.empty() ? "" : ", ") + *word;
  }
  throw plugin::Failure(SY_E_ARGUMENT, std::string("option ") + row.name + " is one of " + all +
                                           "; " + Said(value) + " came");
}

/// The row of `name`. Throws Failure: an unknown name, another type, a value out of range. An
/// integer serves for a real number.
inline const sy_option& CheckOption(const sy_option* const* table, const char* solver,
                                    std::string_view name, const sy_value& value) {
  while (*table != nullptr && name != (*table)->name) ++table;
  if (*table == nullptr) {
    throw plugin::Failure(SY_E_ARGUMENT,
                          std::string(solver) + " has no option '" + std::string(name) + "'");
  }
  const sy_option& row = **table;
  const sy_type type = row.fallback.type;
  if (value.type != type && !(type == SY_REAL && value.type == SY_INTEGER)) {
    constexpr const char* kTypes[] = {"an integer", "a real number", "a text"};
    throw plugin::Failure(SY_E_ARGUMENT, std::string("option ") + row.name + " takes " +
                                             kTypes[type] + "; " + Said(value) + " came");
  }
  if (type == SY_TEXT) {
    CheckWord(row, value);
  } else if (!(Number(value) >= row.lower && Number(value) <= row.upper)) {
    throw plugin::Failure(SY_E_ARGUMENT, std::string("option ") + row.name + " lies in [" +
                                             Join(row.lower) + ", " + Join(row.upper) + "]; " +
                                             Said(value) + " came");
  }
  return row;
}

/// The options of one instance: what was set, else the table's fallback.
class Settings {
 public:
  Settings(const sy_option* const* table, const char* solver) : table_(table), solver_(solver) {}

  void Set(std::string_view name, const sy_value& value) {
    const sy_option& row = CheckOption(table_, solver_, name, value);
    Held& held = held_[row.name];
    if (row.fallback.type == SY_TEXT) {
      held.text = value.as.text;
    } else {
      held.number = Number(value);
    }
  }
  [[nodiscard]] bool Has(std::string_view name) const { return held_.contains(name); }
  [[nodiscard]] double Real(std::string_view name) const {
    const auto held = held_.find(name);
    return held != held_.end() ? held->second.number : Number(Fallback(name));
  }
  [[nodiscard]] int Integer(std::string_view name) const { return static_cast<int>(Real(name)); }
  [[nodiscard]] std::string Text(std::string_view name) const {
    const auto held = held_.find(name);
    return held != held_.end() ? held->second.text : Fallback(name).as.text;
  }

 private:
  struct Held {
    double number = 0;
    std::string text;
  };

  [[nodiscard]] const sy_value& Fallback(std::string_view name) const {
    const sy_option* const* row = table_;
    while (name != (*row)->name) ++row;
    return (*row)->fallback;
  }

  const sy_option* const* table_;
  const char* solver_;
  std::map<std::string, Held, std::less<>> held_;
};

/// Rows of a table written down in the source.
constexpr sy_option RealOption(const char* name, double fallback, double lower, double upper,
                               const char* help) {
  sy_option row = {sizeof(sy_option), 0, name, help, {SY_REAL, 0, {}}, lower, upper, nullptr};
  row.fallback.as.real = fallback;
  return row;
}
constexpr sy_option IntegerOption(const char* name, std::int64_t fallback, double lower,
                                  double upper, const char* help) {
  sy_option row = {sizeof(sy_option), 0, name, help, {SY_INTEGER, 0, {}}, lower, upper, nullptr};
  row.fallback.as.integer = fallback;
  return row;
}
constexpr sy_option WordOption(const char* name, const char* const* words, const char* help) {
  sy_option row = {sizeof(sy_option), 0, name, help, {SY_TEXT, 0, {}}, 0, 0, words};
  row.fallback.as.text = words[0];
  return row;
}

}  // namespace switchyard::linear
