#include "describe.hpp"

#include <fmt/format.h>

#include <cmath>

namespace switchyard::cli {
namespace {

struct Word {
  std::uint64_t bit;
  const char* text;
};

template <std::size_t N>
std::vector<std::string> Words(std::uint64_t bits, const Word (&table)[N]) {
  std::vector<std::string> words;
  for (const Word& word : table) {
    if ((bits & word.bit) != 0) words.emplace_back(word.text);
  }
  return words;
}

constexpr Word kSections[] = {{SY_ACCEPTS_BOUNDS, "bounds"},
                              {SY_ACCEPTS_ROWS, "rows"},
                              {SY_ACCEPTS_QUADRATIC_OBJECTIVE, "quadratic objective"},
                              {SY_ACCEPTS_NONCONVEX_OBJECTIVE, "nonconvex objective"},
                              {SY_ACCEPTS_INTEGER, "integers"},
                              {SY_ACCEPTS_NLP, "nonlinear functions"}};
constexpr Word kCones[] = {{1U << SY_CONE_ZERO, "zero"},
                           {1U << SY_CONE_NONNEGATIVE, "nonnegative"},
                           {1U << SY_CONE_SECOND_ORDER, "second-order"},
                           {1U << SY_CONE_ROTATED, "rotated second-order"},
                           {1U << SY_CONE_PSD, "positive semidefinite"},
                           {1U << SY_CONE_EXPONENTIAL, "exponential"},
                           {1U << SY_CONE_POWER, "power"}};
constexpr Word kTraits[] = {{SY_NEEDS_GRADIENT, "needs gradients"},
                            {SY_NEEDS_HESSIAN, "needs Hessians"},
                            {SY_PROVES_GLOBAL, "proves global optima"},
                            {SY_GIVES_DUALS, "duals"},
                            {SY_GIVES_CERTIFICATES, "certificates"},
                            {SY_GIVES_BASIS, "bases"},
                            {SY_GIVES_BOUND, "bounds before the end"},
                            {SY_ONE_AT_A_TIME, "one at a time"},
                            {SY_STRATEGY, "a strategy over other backends"},
                            {SY_OPEN_OPTIONS, "takes options that it does not list"}};
constexpr Word kLimits[] = {{SY_HONORS_THREADS, "threads"},
                            {SY_HONORS_SECONDS, "seconds"},
                            {SY_HONORS_ITERATIONS, "iterations"},
                            {SY_HONORS_NODES, "nodes"},
                            {SY_HONORS_CUTOFF, "cutoff"},
                            {SY_HONORS_TARGET, "target"},
                            {SY_HONORS_FEASIBILITY, "feasibility"},
                            {SY_HONORS_OPTIMALITY, "optimality"},
                            {SY_HONORS_INTEGRALITY, "integrality"},
                            {SY_HONORS_ABSOLUTE_GAP, "absolute gap"},
                            {SY_HONORS_RELATIVE_GAP, "relative gap"},
                            {SY_HONORS_SEED, "seed"},
                            {SY_HONORS_VERBOSITY, "verbosity"},
                            {SY_HONORS_CANCELLED, "cancel"}};
constexpr Word kUpdates[] = {{SY_UPDATES_BOUNDS, "bounds"}, {SY_UPDATES_VECTORS, "vectors"},
                             {SY_UPDATES_VALUES, "values"}, {SY_UPDATES_SWITCH, "cones off and on"},
                             {SY_UPDATES_APPEND, "append"}, {SY_UPDATES_REMOVE, "remove"},
                             {SY_UPDATES_NLP, "functions"}, {SY_UPDATES_HINTS, "hints"}};

std::string ValueText(const sy_value& value) {
  switch (value.type) {
    case SY_INTEGER:
      return std::to_string(value.as.integer);
    case SY_REAL:
      return fmt::format("{}", value.as.real);
    default:
      return fmt::format("\"{}\"", value.as.text != nullptr ? value.as.text : "");
  }
}

}  // namespace

std::vector<std::string> SectionWords(std::uint64_t bits) { return Words(bits, kSections); }
std::vector<std::string> ConeWords(std::uint64_t bits) { return Words(bits, kCones); }
std::vector<std::string> TraitWords(std::uint64_t bits) { return Words(bits, kTraits); }
std::vector<std::string> LimitWords(std::uint64_t bits) { return Words(bits, kLimits); }
std::vector<std::string> UpdateWords(std::uint64_t bits) { return Words(bits, kUpdates); }

std::string Joined(const std::vector<std::string>& words) {
  return words.empty() ? "none" : fmt::format("{}", fmt::join(words, ", "));
}

std::string ProblemClasses(const sy_solver& solver) {
  if ((solver.traits & SY_STRATEGY) != 0) return "a strategy over other backends";
  std::vector<std::string> classes;
  const auto add = [&](std::uint64_t accepts, std::uint64_t cones, const std::string& prefix) {
    const auto has = [&](std::int32_t kind) { return (cones >> kind & 1) != 0; };
    const bool linear = (accepts & SY_ACCEPTS_ROWS) != 0 || has(SY_CONE_NONNEGATIVE);
    if (linear) classes.push_back(prefix + "LP");
    if ((accepts & SY_ACCEPTS_QUADRATIC_OBJECTIVE) != 0) classes.push_back(prefix + "QP");
    if (has(SY_CONE_SECOND_ORDER) || has(SY_CONE_ROTATED)) classes.push_back(prefix + "SOCP");
    if (has(SY_CONE_PSD)) classes.push_back(prefix + "SDP");
    if (has(SY_CONE_EXPONENTIAL)) classes.push_back(prefix + "exponential cones");
    if (has(SY_CONE_POWER)) classes.push_back(prefix + "power cones");
    if ((accepts & SY_ACCEPTS_NLP) != 0) classes.push_back(prefix + "NLP");
  };
  add(solver.accepts, solver.cones, "");
  if ((solver.integer_accepts & SY_ACCEPTS_INTEGER) != 0) {
    add(solver.integer_accepts, solver.integer_cones, "MI");
  }
  return Joined(classes);
}

std::string OptionRange(const sy_option& option) {
  std::string range;
  if (option.fallback.type == SY_TEXT) {
    std::vector<std::string> choices;
    for (const char* const* c = option.choices; c != nullptr && *c != nullptr; ++c) {
      choices.emplace_back(*c);
    }
    range = choices.empty() ? "text" : "one of " + Joined(choices);
  } else if (option.fallback.type == SY_INTEGER && option.lower == 0 && option.upper == 1) {
    range = "switch";
  } else {
    range = fmt::format("{} {} to {}", option.fallback.type == SY_INTEGER ? "integer" : "number",
                        option.lower, option.upper);
  }
  return fmt::format("{}, {} unless set", range, ValueText(option.fallback));
}

}  // namespace switchyard::cli
