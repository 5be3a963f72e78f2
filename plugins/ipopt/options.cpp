#include "options.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <sstream>

#include "linear/settings.hpp"

namespace switchyard::ipopt {
namespace {

using plugin::Failure;

constexpr const char* kStrategies[] = {"adaptive", "monotone", nullptr};
constexpr const char* kOracles[] = {"quality-function", "probing", "loqo", nullptr};
constexpr const char* kNoYes[] = {"no", "yes", nullptr};
constexpr const char* kYesNo[] = {"yes", "no", nullptr};
constexpr const char* kHessians[] = {"exact", "limited-memory", nullptr};
constexpr const char* kScalings[] = {"gradient-based", "none", "equilibration-based", nullptr};

constexpr const char* kForms[] = {"auto", "condensed", "augmented", nullptr};
constexpr const char* kFormName = "kkt";

constexpr double kLeast = 1e-300;  // for what must be positive
constexpr double kMost = std::numeric_limits<double>::max();
constexpr double kMostInteger = std::numeric_limits<Ipopt::Index>::max();

using linear::IntegerOption;
using linear::RealOption;
using linear::WordOption;

// The tolerances are tighter than Ipopt's own, and a point that is merely acceptable does not
// count: the host checks an optimum by the bound its duals prove.
constexpr std::array kOptions = {
    RealOption("tol", 1e-9, kLeast, kMost, "Scaled error of the optimality conditions at the end"),
    RealOption("constr_viol_tol", 1e-7, kLeast, kMost, "Violation of a row at the end, unscaled"),
    RealOption("dual_inf_tol", 1e-6, kLeast, kMost, "Error of stationarity at the end, unscaled"),
    RealOption("compl_inf_tol", 1e-6, kLeast, kMost, "Complementarity at the end, unscaled"),
    IntegerOption("max_iter", 3000, 0, kMostInteger, "Iterations at most"),
    RealOption("max_cpu_time", 1e6, kLeast, kMost, "Seconds of processor time at most"),
    RealOption("acceptable_tol", 1e-6, kLeast, kMost, "Scaled error of a point that would do"),
    IntegerOption("acceptable_iter", 0, 0, kMostInteger,
                  "Stop after so many points in a row that would do; 0: never"),
    WordOption("mu_strategy", kStrategies, "How the barrier parameter goes down"),
    WordOption("mu_oracle", kOracles, "How an adaptive strategy picks the barrier parameter"),
    RealOption("mu_init", 0.1, kLeast, kMost, "Barrier parameter to begin with"),
    WordOption("mehrotra_algorithm", kNoYes,
               "Predictor and corrector without a line search, for linear and convex programs"),
    WordOption(
        "hessian_approximation", kHessians,
        "Second derivatives; limited-memory where it is not set and the functions have none"),
    RealOption("bound_push", 0.01, kLeast, kMost, "Least distance of the first point to a bound"),
    RealOption("bound_frac", 0.01, kLeast, 0.5, "The same, relative to the width of the bounds"),
    RealOption("bound_relax_factor", 1e-9, 0, kMost,
               "How far bounds and rows are widened, relative to their size"),
    WordOption("honor_original_bounds", kYesNo, "Move the last point back into its bounds"),
    WordOption("nlp_scaling_method", kScalings, "How objective and rows are scaled"),
    RealOption("nlp_scaling_max_gradient", 100, kLeast, kMost,
               "Gradients longer than this are scaled down to it"),
    RealOption("diverging_iterates_tol", 1e15, kLeast, kMost,
               "An entry of the point this large ends the solve, and a ray is looked for"),
    IntegerOption("max_refinement_steps", 10, 0, kMostInteger,
                  "Rounds of iterative refinement of a linear system"),
    WordOption(kFormName, kForms,
               "Linear systems: condensed, without slacks and inequality multipliers, by a "
               "factorization of the plugin's own; or augmented, by Ipopt's linear_solver; auto: "
               "condensed where that is predicted to be cheaper"),
    IntegerOption("print_level", 0, 0, 12, "Detail of the log, over the host's verbosity"),
};

constexpr auto kOptionList = [] {
  std::array<const sy_option*, kOptions.size() + 1> list{};
  for (std::size_t k = 0; k < kOptions.size(); ++k) list[k] = &kOptions[k];
  return list;
}();

// Ipopt would read a file that the host knows nothing of, or be given functions it has not.
constexpr std::array<std::string_view, 3> kTheHosts = {
    "option_file_name", "warm_start_same_structure", "jacobian_approximation"};

const sy_option* Listed(std::string_view name) {
  const auto row = std::find_if(kOptions.begin(), kOptions.end(),
                                [&](const sy_option& o) { return name == o.name; });
  return row != kOptions.end() ? &*row : nullptr;
}

/// The number that `value` is or spells.
double NumberIn(std::string_view name, const sy_value& value) {
  if (value.type != SY_TEXT) return linear::Number(value);
  std::istringstream text(value.as.text);
  double number = 0;
  if (text >> number && (text >> std::ws).eof()) return number;
  throw Failure(SY_E_ARGUMENT, "option " + std::string(name) + " takes a number; " +
                                   linear::Said(value) + " came");
}

sy_type TypeOf(const Ipopt::RegisteredOption& option) {
  if (option.Type() == Ipopt::OT_Integer) return SY_INTEGER;
  return option.Type() == Ipopt::OT_String ? SY_TEXT : SY_REAL;
}

bool IsValid(const Ipopt::RegisteredOption& option, double number, const std::string& text) {
  if (option.Type() == Ipopt::OT_Integer) {
    return number == std::floor(number) && std::abs(number) <= kMostInteger &&
           option.IsValidIntegerSetting(static_cast<Ipopt::Index>(number));
  }
  return option.Type() == Ipopt::OT_String ? option.IsValidStringSetting(text)
                                           : option.IsValidNumberSetting(number);
}

}  // namespace

const sy_option* const* OptionTable() { return kOptionList.data(); }

void Options::Set(std::string_view name, const sy_value& value) {
  Held held;
  if (const sy_option* row = Listed(name)) {
    linear::CheckOption(OptionTable(), "Ipopt", name, value);
    held.type = row->fallback.type;
    (held.type == SY_TEXT ? void(held.text = value.as.text)
                          : void(held.number = linear::Number(value)));
    chosen_[std::string(name)] = held;
    return;
  }
  constexpr bool kConsole = false;
  Ipopt::SmartPtr<Ipopt::IpoptApplication> own = new Ipopt::IpoptApplication(kConsole);
  const auto option = own->RegOptions()->GetOption(std::string(name));
  const bool theirs = std::find(kTheHosts.begin(), kTheHosts.end(), name) != kTheHosts.end();
  if (!Ipopt::IsValid(option) || theirs) {
    throw Failure(SY_E_ARGUMENT, "Ipopt has no option '" + std::string(name) + "'");
  }
  held.type = TypeOf(*option);
  if (held.type == SY_TEXT) {
    held.text = value.type == SY_TEXT ? value.as.text : linear::Said(value);
  } else {
    held.number = NumberIn(name, value);
  }
  if (!IsValid(*option, held.number, held.text)) {
    throw Failure(SY_E_ARGUMENT, "Ipopt refuses the value of option " + std::string(name) + ": " +
                                     linear::Said(value));
  }
  chosen_[std::string(name)] = held;
}

KktForm Options::Form() const {
  const auto held = chosen_.find(kFormName);
  const std::string& word = held != chosen_.end() ? held->second.text : kForms[0];
  if (word == "auto")
    return chosen_.contains("linear_solver") ? KktForm::kAugmented : KktForm::kAuto;
  return word == "condensed" ? KktForm::kCondensed : KktForm::kAugmented;
}

double Options::Real(std::string_view name) const {
  const auto held = chosen_.find(name);
  return held != chosen_.end() ? held->second.number : linear::Number(Listed(name)->fallback);
}

void Options::Put(const std::string& name, const Held& held, Ipopt::OptionsList& to) {
  if (held.type == SY_TEXT) {
    to.SetStringValue(name, held.text);
  } else if (held.type == SY_INTEGER) {
    to.SetIntegerValue(name, static_cast<Ipopt::Index>(held.number));
  } else {
    to.SetNumericValue(name, held.number);
  }
}

bool Options::ChoosesItsWay() const {
  return chosen_.contains("mehrotra_algorithm") || chosen_.contains("max_iter") ||
         chosen_.contains("hessian_approximation") ||
         std::any_of(chosen_.begin(), chosen_.end(),
                     [](const auto& own) { return own.first.starts_with("mu_"); });
}

void Options::GiveWay(Way way, Ipopt::OptionsList& to) {
  constexpr Ipopt::Index kFewIterations = 150;
  to.SetStringValue("mu_strategy", "adaptive");
  if (way == Way::kFullSteps) {
    to.SetStringValue("mehrotra_algorithm", "yes");
    to.SetIntegerValue("max_iter", kFewIterations);
  }
  if (way != Way::kWarm) return;
  to.SetStringValue("warm_start_init_point", "yes");
  to.SetStringValue("mu_strategy", "monotone");
  to.SetNumericValue("mu_init", 1e-7);
  for (const char* name :
       {"warm_start_bound_push", "warm_start_bound_frac", "warm_start_slack_bound_push",
        "warm_start_slack_bound_frac", "warm_start_mult_bound_push"}) {
    to.SetNumericValue(name, 1e-9);
  }
}

bool Options::UsesHessian(const Derivatives& derivatives) const {
  const auto held = chosen_.find("hessian_approximation");
  if (held == chosen_.end()) return derivatives.has_hessian;
  if (held->second.text != "exact") return false;
  if (derivatives.has_hessian) return true;
  throw Failure(SY_E_ARGUMENT,
                "option hessian_approximation is exact, which needs the Hessian of the functions; "
                "they have none: set it to limited-memory");
}

void Options::GiveDerivatives(const Derivatives& derivatives, Ipopt::OptionsList& to) const {
  const bool uses_hessian = UsesHessian(derivatives);
  to.SetStringValue("hessian_approximation", uses_hessian ? "exact" : "limited-memory");
  const auto word = [](bool constant) { return constant ? "yes" : "no"; };
  to.SetStringValue("jac_c_constant", word(derivatives.constant_jacobian));
  to.SetStringValue("jac_d_constant", word(derivatives.constant_jacobian));
  to.SetStringValue("hessian_constant", word(derivatives.constant_hessian && uses_hessian));
}

// A bound of 1e-6 is what MUMPS is given by Ipopt, too; Ipopt raises it where a solution is not
// accurate. The systems are scaled and refined by their own solver.
void Options::GiveKkt(const KktPlan& kkt, Ipopt::OptionsList& to) {
  if (kkt.condensed) {
    to.SetStringValue("linear_solver", "ma27");
    to.SetStringValue("linear_system_scaling", "none");
    to.SetNumericValue("ma27_pivtol", 1e-6);
    to.SetNumericValue("ma27_pivtolmax", 0.1);
    to.SetIntegerValue("min_refinement_steps", 0);
  } else if (kkt.has_dense_column) {
    constexpr Ipopt::Index kMinimumDegreeWithDenseColumnsApart = 6;
    to.SetIntegerValue("mumps_pivot_order", kMinimumDegreeWithDenseColumnsApart);
  }
}

void Options::Give(const sy_control& control, Way way, const Derivatives& derivatives,
                   const KktPlan& kkt, Ipopt::OptionsList& to) const {
  to.SetIntegerValue("acceptable_iter", 0);
  for (const char* name : {"constr_viol_tol", "dual_inf_tol", "compl_inf_tol", "bound_relax_factor",
                           "diverging_iterates_tol"}) {
    to.SetNumericValue(name, Real(name));
  }
  const auto put = [&to](const char* name, double value) { to.SetNumericValue(name, value); };
  // `tol` is of all conditions at once, so the tighter wish rules it.
  const double own = Real("tol");
  const auto wish = [own](double asked) {
    return std::isnan(asked) ? own : std::max(asked, kLeast);
  };
  put("tol", std::min(wish(control.feasibility), wish(control.optimality)));
  if (!std::isnan(control.feasibility)) put("constr_viol_tol", wish(control.feasibility));
  if (!std::isnan(control.optimality)) {
    put("dual_inf_tol", wish(control.optimality));
    put("compl_inf_tol", wish(control.optimality));
  }
  GiveWay(way, to);
  to.SetIntegerValue("print_level", control.verbosity <= 0   ? 0
                                    : control.verbosity <= 2 ? Ipopt::J_ITERSUMMARY
                                                             : Ipopt::J_DETAILED);
  GiveDerivatives(derivatives, to);
  GiveKkt(kkt, to);
  to.SetStringValue("honor_original_bounds", "no");  // the plugin moves the last point into them
  to.SetStringValue("sb", "yes");                    // no banner
  for (const auto& [name, held] : chosen_) {
    if (name != kFormName) Put(name, held, to);
  }
}

}  // namespace switchyard::ipopt
