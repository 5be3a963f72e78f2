#include "options.hpp"

#include <array>
#include <limits>
#include <string>

#include "switchyard/plugin.hpp"

namespace switchyard::nlopt {
namespace {

using linear::IntegerOption;
using linear::RealOption;

constexpr double kMost = std::numeric_limits<double>::max();
constexpr double kMostInteger = std::numeric_limits<int>::max();
constexpr const char* kAuto = "auto";

/// A word of NLopt's own.
constexpr sy_option NameOption(const char* name, const char* help) {
  sy_option row = {sizeof(sy_option), 0, name, help, {SY_TEXT, 0, {}}, 0, 0, nullptr};
  row.fallback.as.text = kAuto;
  return row;
}

// Looser, and NLopt stops before its point is stationary by the plugin's own measure: each solve
// would begin again from there.
constexpr std::array kOptions = {
    NameOption("algorithm",
               "LD_SLSQP, LD_MMA, LN_COBYLA, LN_BOBYQA, GN_ISRES, GN_DIRECT_L or any other by "
               "NLopt's name; auto: LD_SLSQP, for a large program LD_LBFGS, without derivatives "
               "LN_COBYLA"),
    NameOption("local_algorithm",
               "What MLSL and AUGLAG work through; auto: LD_LBFGS, without derivatives LN_COBYLA"),
    RealOption("xtol_rel", 1e-7, 0, kMost, "Stop at a step this small, relative to the point"),
    RealOption("xtol_abs", 0, 0, kMost, "Stop at a step this small"),
    RealOption("ftol_rel", 1e-11, 0, kMost, "Stop at a gain this small, relative to the objective"),
    RealOption("ftol_abs", 0, 0, kMost, "Stop at a gain this small"),
    RealOption("constraint_tol", 1e-9, 0, kMost,
               "Violation of a constraint, of largest coefficient 1, that NLopt calls feasible"),
    IntegerOption("maxeval", 0, 0, kMostInteger,
                  "Evaluations of the objective in a run; 0: for a global algorithm "
                  "2000 (variables + 1), else no limit"),
    IntegerOption("population", 0, 0, kMostInteger,
                  "Points that a stochastic algorithm keeps; 0: its own choice"),
    RealOption("initial_step", 0, 0, kMost,
               "First step of an algorithm without derivatives; 0: from bounds and point"),
    IntegerOption("vector_storage", 0, 0, kMostInteger,
                  "Gradients that a quasi-Newton algorithm remembers; 0: its own choice"),
    IntegerOption("polish", 1, 0, 1,
                  "Solve locally, by gradients, from where a global algorithm or one without "
                  "derivatives ended"),
};

constexpr auto kOptionList = [] {
  std::array<const sy_option*, kOptions.size() + 1> list{};
  for (std::size_t k = 0; k < kOptions.size(); ++k) list[k] = &kOptions[k];
  return list;
}();

const Algorithm* Chosen(std::string_view option, std::string_view name) {
  return name == kAuto ? nullptr : &AlgorithmNamed(option, name);
}

}  // namespace

const sy_option* const* OptionTable() { return kOptionList.data(); }

void Options::Set(std::string_view name, const sy_value& value) {
  linear::CheckOption(OptionTable(), "NLopt", name, value);
  if (name == "algorithm") {
    algorithm_ = Chosen(name, value.as.text);
  } else if (name == "local_algorithm") {
    const Algorithm* local = Chosen(name, value.as.text);
    if (local != nullptr && local->Is(kInnerWith | kInnerWithout)) {
      throw plugin::Failure(SY_E_ARGUMENT, std::string("option local_algorithm: ") + local->name() +
                                               " works through a local algorithm itself");
    }
    local_ = local;
  }
  held_.Set(name, value);
}

}  // namespace switchyard::nlopt
