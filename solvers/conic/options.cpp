#include "solvers/conic/options.hpp"

#include <array>
#include <cstdint>
#include <sstream>

#include "switchyard/plugin.hpp"

namespace switchyard::conic {
namespace {

constexpr sy_option Row(const char* name, const char* help, std::int64_t fallback, double upper) {
  sy_option row{sizeof(sy_option), 0, name, help, {SY_INTEGER, 0, {}}, 0, upper, nullptr};
  row.fallback.as.integer = fallback;
  return row;
}

constexpr Options kFallback;
constexpr std::array kRows = {
    Row("presolve", "1: make the problem smaller first; 0: only where variables are fixed",
        kFallback.presolve ? 1 : 0, 1),
    Row("blocks", "1: use the hint sy.blocks/1, and look for blocks where there is none",
        kFallback.blocks ? 1 : 0, 1),
    Row("corrections", "centrality corrections an iteration, at most", kFallback.corrections, 10),
    Row("max_iterations", "iterations at most", kFallback.max_iterations, 1e9),
};

}  // namespace

const sy_option* const* OptionTable() {
  static constexpr std::array<const sy_option*, kRows.size() + 1> kTable = {
      &kRows[0], &kRows[1], &kRows[2], &kRows[3], nullptr};
  return kTable.data();
}

void Options::Set(std::string_view name, const sy_value& value) {
  for (const sy_option& row : kRows) {
    if (name != row.name) continue;
    const auto number = static_cast<double>(value.as.integer);
    if (value.type != SY_INTEGER || !(number >= row.lower && number <= row.upper)) {
      std::ostringstream text;
      text << "option " << row.name << " takes an integer in [" << row.lower << ", " << row.upper
           << "]; ";
      if (value.type == SY_INTEGER) text << value.as.integer;
      if (value.type == SY_REAL) text << value.as.real;
      if (value.type == SY_TEXT) text << '"' << (value.as.text ? value.as.text : "") << '"';
      text << " came";
      throw plugin::Failure(SY_E_ARGUMENT, text.str());
    }
    const auto given = static_cast<int>(value.as.integer);
    if (&row == &kRows[0]) presolve = given != 0;
    if (&row == &kRows[1]) blocks = given != 0;
    if (&row == &kRows[2]) corrections = given;
    if (&row == &kRows[3]) max_iterations = given;
    return;
  }
  throw plugin::Failure(SY_E_ARGUMENT, "conic has no option \"" + std::string(name) + '"');
}

}  // namespace switchyard::conic
