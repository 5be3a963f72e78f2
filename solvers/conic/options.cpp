#include "solvers/conic/options.hpp"

#include <array>
#include <cstdint>
#include <sstream>

#include "switchyard/plugin.hpp"

namespace switchyard::conic {
namespace {

struct Row {
  const char* name;
  const char* help;
  int Options::*field;
  double upper;
};

constexpr std::array kRows = {
    Row{"presolve", "1: make the problem smaller first; 0: only where variables are fixed",
        &Options::presolve, 1},
    Row{"blocks", "1: use the hint sy.blocks/1, and look for blocks where there is none",
        &Options::blocks, 1},
    Row{"corrections", "centrality corrections an iteration, at most", &Options::corrections, 10},
    Row{"max_iterations", "iterations at most", &Options::max_iterations, 1e9},
};

sy_option Described(const Row& row) {
  sy_option option{sizeof(sy_option),   0, row.name,  row.help,
                   {SY_INTEGER, 0, {}}, 0, row.upper, nullptr};
  option.fallback.as.integer = Options().*row.field;
  return option;
}

}  // namespace

const sy_option* const* OptionTable() {
  struct Table {
    std::array<sy_option, kRows.size()> options;
    std::array<const sy_option*, kRows.size() + 1> pointers{};
    Table() {
      for (std::size_t k = 0; k < kRows.size(); ++k) {
        options[k] = Described(kRows[k]);
        pointers[k] = &options[k];
      }
    }
  };
  static const Table table;
  return table.pointers.data();
}

void Options::Set(std::string_view name, const sy_value& value) {
  for (const Row& row : kRows) {
    if (name != row.name) continue;
    const auto number = static_cast<double>(value.as.integer);
    if (value.type != SY_INTEGER || !(number >= 0 && number <= row.upper)) {
      std::ostringstream text;
      text << "option " << row.name << " takes an integer in [0, " << row.upper << "]; ";
      if (value.type == SY_INTEGER) text << value.as.integer;
      if (value.type == SY_REAL) text << value.as.real;
      if (value.type == SY_TEXT) text << '"' << (value.as.text ? value.as.text : "") << '"';
      text << " came";
      throw plugin::Failure(SY_E_ARGUMENT, text.str());
    }
    this->*row.field = static_cast<int>(value.as.integer);
    return;
  }
  throw plugin::Failure(SY_E_ARGUMENT, "conic has no option \"" + std::string(name) + '"');
}

}  // namespace switchyard::conic
