#include "solvers/mip/options.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

#include "solvers/rounding/option_values.hpp"
#include "switchyard/plugin.hpp"

namespace switchyard::mip {
namespace {

using rounding::NumberOf;
using rounding::OptionRow;
using rounding::TextOf;

constexpr std::array<const char*, 4> kEngines = {"auto", "conic", "outer", nullptr};

struct Integer {
  int Options::*member;
  const char* name;
  const char* help;
  double upper;
};

constexpr std::array kIntegers = {
    Integer{&Options::cut_rounds, "cut_rounds",
            "Times that the root is solved again with cuts, at most", 1e4},
    Integer{&Options::node_rounds, "node_rounds",
            "Times that a node with fractions is solved again with cuts, at most", 1e3},
    Integer{&Options::dives, "dives",
            "Tries of an integer point at the root, the first by rounding; 0: none", 1e4},
    Integer{&Options::reliability, "reliability",
            "Children of a variable solved in each direction until its pseudocost is believed",
            1e3},
    Integer{&Options::candidates, "candidates",
            "Variables whose children are solved at a node, at most", 1e4},
    Integer{&Options::probing, "probing", "1: binaries are probed at the root", 1},
    Integer{&Options::strengthening, "strengthening",
            "1: perspectives and rows for integers tighten the problem before the root", 1},
    Integer{&Options::pool, "pool", "Solutions kept, the best first", 1e4},
    Integer{&Options::deterministic, "deterministic",
            "1: the same tree however many threads there are", 1}};

/// `engine`, `solver`, `linear`, then the integers.
constexpr std::size_t kTexts = 3;

const std::array<sy_option, kTexts + kIntegers.size()>& Rows() {
  static const std::array<sy_option, kTexts + kIntegers.size()> rows = [] {
    const Options fallback;
    std::array<sy_option, kTexts + kIntegers.size()> r = {
        OptionRow("engine",
                  "What bounds the nodes: conic relaxations, linear ones with cuts (outer "
                  "approximation), or what suits the problem",
                  SY_TEXT, 0, kEngines.data()),
        OptionRow("solver", "Backends for conic problems, in order; empty: any", SY_TEXT, 0),
        OptionRow("linear", "Backends for linear problems, in order; empty: any with a basis",
                  SY_TEXT, 0)};
    r[0].fallback.as.text = kEngines[0];
    r[1].fallback.as.text = r[2].fallback.as.text = "";
    for (std::size_t k = 0; k < kIntegers.size(); ++k) {
      const Integer& of = kIntegers[k];
      r[kTexts + k] = OptionRow(of.name, of.help, SY_INTEGER, of.upper);
      r[kTexts + k].fallback.as.integer = fallback.*of.member;
    }
    return r;
  }();
  return rows;
}

}  // namespace

const sy_option* const* OptionTable() {
  static const auto table = [] {
    std::array<const sy_option*, kTexts + kIntegers.size() + 1> t{};  // ends with a null pointer
    for (std::size_t k = 0; k < Rows().size(); ++k) t[k] = &Rows()[k];
    return t;
  }();
  return table.data();
}

void Options::Set(std::string_view name, const sy_value& value) {
  const auto& rows = Rows();
  if (name == rows[0].name) {
    const std::string given = TextOf(rows[0], value);
    engine = given == kEngines[1]   ? EngineKind::kConic
             : given == kEngines[2] ? EngineKind::kOuter
                                    : EngineKind::kAuto;
    return;
  }
  for (std::size_t k : {1, 2}) {
    if (name == rows[k].name) return void((k == 1 ? solver : linear) = TextOf(rows[k], value));
  }
  for (std::size_t k = 0; k < kIntegers.size(); ++k) {
    if (name != kIntegers[k].name) continue;
    this->*kIntegers[k].member = static_cast<int>(NumberOf(rows[kTexts + k], value));
    return;
  }
  throw plugin::Failure(SY_E_ARGUMENT,
                        "branch-and-bound has no option '" + std::string(name) + "'");
}

}  // namespace switchyard::mip
