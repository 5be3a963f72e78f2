#include "core/solve/choice.hpp"

#include <sstream>

#include "switchyard/error.hpp"

namespace switchyard {
namespace {

std::string TextOf(const SolverOptions::OptionValue& value) {
  return std::visit([](const auto& v) { return Text(v); }, value);
}

/// A sentence for each name that no backend has.
std::vector<Considered> UnknownNames(const Host& host, const std::string& names) {
  std::vector<Considered> unknown;
  std::istringstream list(names);
  for (std::string name; std::getline(list, name, ',');) {
    if (name.empty() || host.Find(name) != nullptr) continue;
    std::vector<std::string> known;
    for (const Backend* one : host.backends()) known.push_back(one->short_name);
    const std::string near = NearestName(name, known);
    unknown.push_back({name, false,
                       near.empty() ? "there is none of that name"
                                    : "there is none of that name; the nearest is " + near});
  }
  return unknown;
}

/// Loads the problem, or says why it cannot.
std::unique_ptr<Instance> Try(const Host& host, const sy_problem& problem, const BackendWish& wish,
                              const Candidate& candidate, std::string& why) {
  try {
    auto fresh = std::make_unique<Instance>(*host.Facade(*candidate.backend), *wish.table);
    SetOptions(*wish.options, *candidate.backend, *fresh);
    fresh->Load(problem, wish.updates);
    return fresh;
  } catch (const BackendError& e) {
    if (e.code() == SY_E_ARGUMENT) throw InvalidArgument(e.what());
    why = e.reason();
    return nullptr;
  }
}

std::string WhyNone(const Host& host, const sy_problem& problem, const BackendWish& wish,
                    const std::vector<Considered>& considered) {
  std::string text;
  for (const Considered& one : considered) {
    text += (text.empty() ? "" : "; ") + one.solver + ": " + one.why;
  }
  if (text.empty()) text = "no backend is there";
  if (wish.names.empty()) return text;
  std::string others;
  for (const Candidate& candidate : host.Rank(problem)) {
    if (candidate.suitable) others += (others.empty() ? "" : ", ") + candidate.backend->short_name;
  }
  return text + (others.empty() ? "; no other backend would serve" : "; would serve: " + others);
}

}  // namespace

void SetOptions(const SolverOptions& options, const Backend& backend, Instance& instance) {
  for (const auto& [name, values] : options.options) {
    if (!name.empty() && name != backend.id && name != backend.short_name) continue;
    for (const auto& [key, value] : values) {
      const std::string text = TextOf(value);
      const sy_option* option = FindOption(backend.facts, key);
      sy_value given{};
      given.type = SY_TEXT;
      given.as.text = text.c_str();
      instance.SetOption(key, option != nullptr ? ParseOptionValue(*option, text) : given);
    }
  }
}

BackendChoice ChooseBackend(const Host& host, const sy_problem& problem, const BackendWish& wish) {
  const auto named = [&](const std::string& text) {
    return wish.with_names ? wish.with_names(text) : text;
  };
  BackendChoice choice;
  choice.considered = UnknownNames(host, wish.names);
  for (const Candidate& candidate : host.Rank(problem, wish.names)) {
    std::string why = candidate.why;
    if (choice.backend == nullptr && candidate.suitable) {
      choice.instance = Try(host, problem, wish, candidate, why);
      if (choice.instance != nullptr) choice.backend = candidate.backend;
    } else if (candidate.suitable) {
      why = "comes later in the order";
    }
    const bool chosen = choice.backend == candidate.backend;
    choice.considered.push_back({candidate.backend->id, chosen, named(why)});
  }
  if (choice.backend == nullptr) choice.why_none = WhyNone(host, problem, wish, choice.considered);
  return choice;
}

}  // namespace switchyard
