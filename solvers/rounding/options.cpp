#include "solvers/rounding/options.hpp"

#include <array>
#include <cstdint>

#include "solvers/rounding/option_values.hpp"
#include "switchyard/plugin.hpp"

namespace switchyard::rounding {
namespace {

/// An integer of the options.
struct Integer {
  int Options::*member;
  const char* name;
  const char* help;
  double upper;
};

constexpr std::array kIntegers = {
    Integer{&Options::paths, "paths",
            "Distinct paths with a point to compare; 0: the relaxation alone", 1e5},
    Integer{&Options::trials, "trials", "Draws of a path", 1e7},
    Integer{&Options::cut_rounds, "cut_rounds",
            "Times that the relaxation is solved again with cuts, at most", 1e3},
    Integer{&Options::cut_dimension, "cut_dimension",
            "Coordinates of a vertex that gets cuts while paths are sought, at most", 1e9},
    Integer{&Options::hulls, "hulls",
            "1: where two-cycles give no cut, vertices' transitions are asked for one", 1},
    Integer{&Options::dives, "dives",
            "Without paths: tries of an integer point, the first by rounding; 0: the relaxation "
            "alone",
            1e5}};

/// `solver`, `flow_tolerance`, then the integers.
const std::array<sy_option, 2 + kIntegers.size()>& Rows() {
  static const std::array<sy_option, 2 + kIntegers.size()> rows = [] {
    const Options fallback;
    std::array<sy_option, 2 + kIntegers.size()> r = {
        OptionRow("solver", "Backends for relaxation and restrictions, in order; empty: any",
                  SY_TEXT, 0),
        OptionRow("flow_tolerance", "Arcs with no more flow are not drawn", SY_REAL, 1)};
    r[0].fallback.as.text = "";
    r[1].fallback.as.real = fallback.flow_tolerance;
    for (std::size_t k = 0; k < kIntegers.size(); ++k) {
      const Integer& of = kIntegers[k];
      r[2 + k] = OptionRow(of.name, of.help, SY_INTEGER, of.upper);
      r[2 + k].fallback.as.integer = fallback.*of.member;
    }
    return r;
  }();
  return rows;
}

}  // namespace

const sy_option* const* OptionTable() {
  static const auto table = [] {
    std::array<const sy_option*, 3 + kIntegers.size()> t{};  // ends with a null pointer
    for (std::size_t k = 0; k < Rows().size(); ++k) t[k] = &Rows()[k];
    return t;
  }();
  return table.data();
}

void Options::Set(std::string_view name, const sy_value& value) {
  if (name == Rows()[0].name) {
    solver = TextOf(Rows()[0], value);
    return;
  }
  if (name == Rows()[1].name) {
    flow_tolerance = NumberOf(Rows()[1], value);
    return;
  }
  for (std::size_t k = 0; k < kIntegers.size(); ++k) {
    if (name != kIntegers[k].name) continue;
    this->*kIntegers[k].member = static_cast<int>(NumberOf(Rows()[2 + k], value));
    return;
  }
  throw plugin::Failure(SY_E_ARGUMENT, "relax-and-round has no option '" + std::string(name) + "'");
}

}  // namespace switchyard::rounding
