#include "solvers/rounding/options.hpp"

#include <array>
#include <cstdint>
#include <sstream>

#include "switchyard/plugin.hpp"

namespace switchyard::rounding {
namespace {

constexpr sy_option Row(const char* name, const char* help, sy_type type, double lower,
                        double upper) {
  return {sizeof(sy_option), 0, name, help, {type, 0, {}}, lower, upper, nullptr};
}

const std::array<sy_option, 7>& Rows() {
  static const std::array<sy_option, 7> rows = [] {
    const Options fallback;
    std::array<sy_option, 7> r = {
        Row("solver", "Backends for relaxation and restrictions, in order; empty: any", SY_TEXT, 0,
            0),
        Row("paths", "Distinct paths to try; 0: the relaxation alone", SY_INTEGER, 0, 100000),
        Row("trials", "Draws of a path", SY_INTEGER, 0, 10000000),
        Row("flow_tolerance", "Arcs with no more flow are not drawn", SY_REAL, 0, 1),
        Row("cut_rounds", "Times that the relaxation is solved again with cuts, at most",
            SY_INTEGER, 0, 1000),
        Row("hulls", "1: where two-cycles give no cut, vertices' transitions are asked for one",
            SY_INTEGER, 0, 1),
        Row("dives",
            "Without paths: tries of an integer point, the first by rounding; 0: the relaxation "
            "alone",
            SY_INTEGER, 0, 100000)};
    r[0].fallback.as.text = "";
    r[1].fallback.as.integer = fallback.paths;
    r[2].fallback.as.integer = fallback.trials;
    r[3].fallback.as.real = fallback.flow_tolerance;
    r[4].fallback.as.integer = fallback.cut_rounds;
    r[5].fallback.as.integer = fallback.hulls;
    r[6].fallback.as.integer = fallback.dives;
    return r;
  }();
  return rows;
}

[[noreturn]] void Refuse(const sy_option& row, const std::string& need, const sy_value& value) {
  std::ostringstream text;
  text << "option " << row.name << " " << need << "; ";
  if (value.type == SY_TEXT) text << "'" << (value.as.text != nullptr ? value.as.text : "") << "'";
  if (value.type == SY_REAL) text << value.as.real;
  if (value.type == SY_INTEGER) text << value.as.integer;
  text << " came";
  throw plugin::Failure(SY_E_ARGUMENT, text.str());
}

/// The number of a value that fits the row's type and range; an integer serves for a real.
double Number(const sy_option& row, const sy_value& value) {
  const bool real = row.fallback.type == SY_REAL;
  if (value.type != SY_INTEGER && !(real && value.type == SY_REAL)) {
    Refuse(row, real ? "takes a real number" : "takes an integer", value);
  }
  const double number =
      value.type == SY_REAL ? value.as.real : static_cast<double>(value.as.integer);
  if (!(number >= row.lower && number <= row.upper)) {
    std::ostringstream need;
    need << "lies in [" << row.lower << ", " << row.upper << "]";
    Refuse(row, need.str(), value);
  }
  return number;
}

}  // namespace

const sy_option* const* OptionTable() {
  static const std::array<const sy_option*, 8> table = {
      &Rows()[0], &Rows()[1], &Rows()[2], &Rows()[3], &Rows()[4], &Rows()[5], &Rows()[6], nullptr};
  return table.data();
}

void Options::Set(std::string_view name, const sy_value& value) {
  const auto& [solver_row, paths_row, trials_row, tolerance_row, cuts_row, hulls_row, dives_row] =
      Rows();
  if (name == solver_row.name) {
    if (value.type != SY_TEXT || value.as.text == nullptr)
      Refuse(solver_row, "takes a text", value);
    solver = value.as.text;
  } else if (name == paths_row.name) {
    paths = static_cast<int>(Number(paths_row, value));
  } else if (name == trials_row.name) {
    trials = static_cast<int>(Number(trials_row, value));
  } else if (name == tolerance_row.name) {
    flow_tolerance = Number(tolerance_row, value);
  } else if (name == cuts_row.name) {
    cut_rounds = static_cast<int>(Number(cuts_row, value));
  } else if (name == hulls_row.name) {
    hulls = static_cast<int>(Number(hulls_row, value));
  } else if (name == dives_row.name) {
    dives = static_cast<int>(Number(dives_row, value));
  } else {
    throw plugin::Failure(SY_E_ARGUMENT,
                          "relax-and-round has no option '" + std::string(name) + "'");
  }
}

}  // namespace switchyard::rounding
