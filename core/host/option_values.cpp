// Options: names that are nearly right, texts that are values, values in their ranges.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>
#include <utility>

#include "switchyard/error.hpp"
#include "switchyard/host/host.hpp"

namespace switchyard {
namespace {

// Levenshtein's distance, one row at a time.
std::size_t EditDistance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

template <class Number>
bool Parse(const std::string& text, Number& number) {
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
  return fault == std::errc() && end == text.data() + text.size();
}

sy_value Integer(std::int64_t integer) {
  sy_value value{};
  value.type = SY_INTEGER;
  value.as.integer = integer;
  return value;
}

sy_value ParseInteger(const sy_option& option, const std::string& text) {
  static const std::vector<std::string> yes = {"true", "on", "yes"};
  static const std::vector<std::string> no = {"false", "off", "no"};
  const bool is_switch = option.lower == 0 && option.upper == 1;
  if (is_switch && std::find(yes.begin(), yes.end(), text) != yes.end()) return Integer(1);
  if (is_switch && std::find(no.begin(), no.end(), text) != no.end()) return Integer(0);
  std::int64_t integer = 0;
  Require(Parse(text, integer), "option ", option.name, " needs ",
          is_switch ? "true or false" : "an integer", ", got \"", text, "\"");
  const auto real = static_cast<double>(integer);
  Require(real >= option.lower && real <= option.upper, "option ", option.name,
          " needs an integer from ", option.lower, " to ", option.upper, ", got ", text);
  return Integer(integer);
}

sy_value ParseReal(const sy_option& option, const std::string& text) {
  sy_value value{};
  value.type = SY_REAL;
  double real = 0;
  Require(Parse(text, real) && !std::isnan(real), "option ", option.name, " needs a number, got \"",
          text, "\"");
  Require(real >= option.lower && real <= option.upper, "option ", option.name,
          " needs a number from ", option.lower, " to ", option.upper, ", got ", text);
  value.as.real = real;
  return value;
}

sy_value ParseText(const sy_option& option, const std::string& text) {
  if (option.choices != nullptr) {
    std::string list;
    bool known = false;
    for (const char* const* choice = option.choices; *choice != nullptr; ++choice) {
      known = known || text == *choice;
      list += (list.empty() ? "" : ", ") + std::string(*choice);
    }
    Require(known, "option ", option.name, " needs one of ", list, "; got \"", text, "\"");
  }
  sy_value value{};
  value.type = SY_TEXT;
  value.as.text = text.c_str();
  return value;
}

}  // namespace

std::string NearestName(const std::string& wrong, const std::vector<std::string>& names) {
  std::string best;
  std::size_t distance = std::max<std::size_t>(2, wrong.size() / 2) + 1;
  for (const std::string& name : names) {
    const std::size_t d = EditDistance(wrong, name);
    if (d < distance) {
      distance = d;
      best = name;
    }
  }
  return best;
}

sy_value ParseOptionValue(const sy_option& option, const std::string& text) {
  switch (option.fallback.type) {
    case SY_INTEGER:
      return ParseInteger(option, text);
    case SY_REAL:
      return ParseReal(option, text);
    default:
      return ParseText(option, text);
  }
}

const sy_option* FindOption(const sy_solver& solver, const std::string& name) {
  std::vector<std::string> names;
  for (const sy_option* const* o = solver.options; o != nullptr && *o != nullptr; ++o) {
    if (name == (*o)->name) return *o;
    names.emplace_back((*o)->name);
  }
  if ((solver.traits & SY_OPEN_OPTIONS) != 0) return nullptr;
  const std::string near = NearestName(name, names);
  Refuse(solver.id, " has no option \"", name, "\"",
         near.empty() ? "" : "; the nearest is \"" + near + "\"");
}

}  // namespace switchyard
