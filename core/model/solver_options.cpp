#include "switchyard/model/solver_options.hpp"

#include <cmath>

#include "switchyard/error.hpp"

namespace switchyard {
namespace {

using OptionValue = SolverOptions::OptionValue;

template <class T>
const T& As(const OptionValue& value, const char* option, const char* need) {
  const T* held = std::get_if<T>(&value);
  if (held == nullptr) {
    std::visit([&](const auto& v) { Refuse(option, " needs ", need, ", got ", v); }, value);
  }
  return *held;
}

// Two values that are both unset, be it as NaN, are the same.
template <class T>
bool IsUnset(const T& value, const T& unset) {
  if constexpr (std::is_floating_point_v<T>) {
    if (std::isnan(unset)) return std::isnan(value);
  }
  return value == unset;
}

}  // namespace

void SolverOptions::SetOption(CommonSolverOption key, const OptionValue& value) {
  switch (key) {
    case CommonSolverOption::kPrintFileName:
      log_file = As<std::string>(value, "kPrintFileName", "a text");
      verbosity = std::max(verbosity, log_file.empty() ? 0 : 1);
      return;
    case CommonSolverOption::kPrintToConsole:
      log_to_console = As<int>(value, "kPrintToConsole", "0 or 1") != 0;
      verbosity = std::max(verbosity, log_to_console ? 1 : 0);
      return;
    case CommonSolverOption::kStandaloneReproductionFileName:
      problem_file = As<std::string>(value, "kStandaloneReproductionFileName", "a text");
      return;
    case CommonSolverOption::kMaxThreads:
      threads = As<int>(value, "kMaxThreads", "a whole number");
      Require(threads >= 1, "kMaxThreads needs to be 1 or more, got ", threads);
      return;
  }
}

void SolverOptions::Merge(const SolverOptions& other) {
  const SolverOptions unset;
  const auto take = [&](auto SolverOptions::*field) {
    if (IsUnset(this->*field, unset.*field)) this->*field = other.*field;
  };
  take(&SolverOptions::time_limit);
  take(&SolverOptions::iteration_limit);
  take(&SolverOptions::node_limit);
  take(&SolverOptions::threads);
  take(&SolverOptions::verbosity);
  take(&SolverOptions::log_to_console);
  take(&SolverOptions::log_file);
  take(&SolverOptions::problem_file);
  take(&SolverOptions::cutoff);
  take(&SolverOptions::target);
  take(&SolverOptions::feasibility_tolerance);
  take(&SolverOptions::optimality_tolerance);
  take(&SolverOptions::integrality_tolerance);
  take(&SolverOptions::absolute_gap);
  take(&SolverOptions::relative_gap);
  take(&SolverOptions::seed);
  take(&SolverOptions::cancelled);
  if (!progress) progress = other.progress;
  for (const auto& [solver, values] : other.options) {
    for (const auto& [key, value] : values) options[solver].try_emplace(key, value);
  }
}

}  // namespace switchyard
