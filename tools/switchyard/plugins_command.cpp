#include <fmt/format.h>

#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "commands.hpp"
#include "describe.hpp"
#include "switchyard/dynamics.h"
#include "switchyard/error.hpp"
#include "switchyard/host/host.hpp"

namespace switchyard::cli {
namespace {

using Json = nlohmann::ordered_json;

// Tables that are no solvers: rigid-body dynamics.
struct Engine {
  std::string name, version, plugin, file;
};

std::vector<Engine> DynamicsEngines(const Host& host) {
  std::vector<Engine> engines;
  for (const PluginTable& found : host.Tables("sy.dynamics/1")) {
    const auto& table = *static_cast<const sy_dynamics*>(found.table);
    engines.push_back({table.name, table.version, found.plugin, found.origin});
  }
  return engines;
}

Json ListAsJson(const Host& host) {
  Json solvers = Json::array();
  for (const Backend* backend : host.backends()) {
    const Readiness ready = host.Ready(*backend);
    solvers.push_back({{"name", backend->short_name},
                       {"id", backend->id},
                       {"version", ready.version},
                       {"license", backend->facts.license != nullptr ? backend->facts.license : ""},
                       {"classes", ProblemClasses(backend->facts)},
                       {"ready", ready.ready},
                       {"text", ready.text},
                       {"plugin", backend->plugin},
                       {"file", backend->origin}});
  }
  Json problems = Json::array();
  for (const PluginProblem& problem : host.problems()) {
    problems.push_back(
        {{"file", problem.path}, {"state", to_string(problem.state)}, {"reason", problem.reason}});
  }
  Json dynamics = Json::array();
  for (const Engine& engine : DynamicsEngines(host)) {
    dynamics.push_back({{"name", engine.name},
                        {"version", engine.version},
                        {"plugin", engine.plugin},
                        {"file", engine.file}});
  }
  return {{"solvers", solvers},
          {"dynamics", dynamics},
          {"problems", problems},
          {"folders", host.folders()}};
}

void List(const Host& host) {
  for (const Backend* backend : host.backends()) {
    const Readiness ready = host.Ready(*backend);
    std::cout << fmt::format("{:<16} {:<10} {:<9} {}\n", backend->short_name, ready.version,
                             ready.ready ? "ready" : "not ready", ProblemClasses(backend->facts));
    if (!ready.ready) std::cout << fmt::format("{:<16} {}\n", "", ready.text);
  }
  for (const Engine& engine : DynamicsEngines(host)) {
    std::cout << fmt::format("dynamics: {} {} ({})\n", engine.name, engine.version, engine.file);
  }
  if (host.backends().empty()) std::cout << "no backend was found in\n";
  for (const std::string& folder : host.folders()) {
    if (host.backends().empty()) std::cout << "  " << folder << '\n';
  }
  if (!host.problems().empty()) {
    std::cerr << fmt::format("{} more could not be used: see switchyard plugins doctor\n",
                             host.problems().size());
  }
}

void Describe(const Host& host, const std::string& name) {
  const Backend* backend = host.Find(name);
  if (backend == nullptr) {
    std::vector<std::string> names;
    for (const Backend* one : host.backends()) names.push_back(one->short_name);
    const std::string near = NearestName(name, names);
    Refuse("there is no backend \"", name, "\"",
           near.empty() ? "" : "; the nearest is \"" + near + "\"");
  }
  const sy_solver& s = backend->facts;
  const Readiness ready = host.Ready(*backend);
  const auto line = [](const char* what, const std::string& text) {
    std::cout << fmt::format("{:<14} {}\n", what, text);
  };
  line("id", backend->id);
  line("name", fmt::format("{} {}", backend->name, ready.version));
  line("license", s.license != nullptr ? s.license : "not said");
  line("state", ready.ready ? "ready" : "not ready: " + ready.text);
  if (ready.ready && !ready.text.empty()) line("", ready.text);
  line("plugin", fmt::format("{}, {}", backend->plugin, backend->origin));
  line("classes", ProblemClasses(s));
  line("takes", Joined(SectionWords(s.accepts)));
  line("cones", Joined(ConeWords(s.cones)));
  if (s.integer_accepts != 0) {
    line("with integers", fmt::format("{}; cones: {}", Joined(SectionWords(s.integer_accepts)),
                                      Joined(ConeWords(s.integer_cones))));
  }
  line("gives", Joined(TraitWords(s.traits)));
  line("keeps", Joined(LimitWords(s.honors)));
  line("updates", Joined(UpdateWords(s.updates)));
  if (s.options == nullptr || *s.options == nullptr) return;
  std::cout << "options\n";
  for (const sy_option* const* o = s.options; *o != nullptr; ++o) {
    std::cout << fmt::format("  {} ({})\n", (*o)->name, OptionRange(**o));
    if ((*o)->help != nullptr && *(*o)->help != '\0') {
      std::cout << fmt::format("      {}\n", (*o)->help);
    }
  }
}

std::string WhatToDo(const PluginProblem& problem) {
  if (problem.reason.starts_with("dependency absent")) {
    return "install that library, or put it into deps/ beside the module";
  }
  if (problem.reason.find("already there") != std::string::npos) {
    return "remove one of the two; the first one found serves";
  }
  if (problem.state == BackendState::kNotCompatible) {
    return "build it against this version's switchyard/abi.h, or remove it";
  }
  if (problem.reason == "file absent") return "check the path";
  return "remove it, or build it again";
}

int Doctor(const std::string& file) {
  HostOptions options;
  if (!file.empty()) {
    options.files = {file};
    options.folders = std::vector<std::string>();
  }
  const Host host(std::move(options));
  bool healthy = true;
  for (const Backend* backend : host.backends()) {
    const Readiness ready = host.Ready(*backend);
    healthy = healthy && ready.ready;
    std::cout << fmt::format("{} {}: {} ({})\n", backend->id, ready.version,
                             ready.ready ? "ready" : "not ready: " + ready.text, backend->origin);
  }
  const std::vector<Engine> engines = DynamicsEngines(host);
  for (const Engine& engine : engines) {
    std::cout << fmt::format("dynamics: {} {}: ready ({})\n", engine.name, engine.version,
                             engine.file);
  }
  for (const PluginProblem& problem : host.problems()) {
    healthy = false;
    std::cout << fmt::format("{}: {}: {}\n    {}\n", problem.path, to_string(problem.state),
                             problem.reason, WhatToDo(problem));
  }
  for (const std::string& folder : host.folders()) std::cout << "searched " << folder << '\n';
  const bool found = !host.backends().empty() || (!file.empty() && !engines.empty());
  if (!found) {
    std::cout << "no backend was found; set SWITCHYARD_PLUGIN_PATH, or give --plugin FILE.so\n";
  }
  return healthy && found ? kAnswered : kNotAnswered;
}

}  // namespace

void AddPluginsCommand(CLI::App& app, int& code) {
  CLI::App* command = app.add_subcommand("plugins", "What backends are there");
  command->footer("Example: switchyard plugins describe highs");
  command->require_subcommand(1);

  CLI::App* list = command->add_subcommand("list", "Each backend, a line");
  list->footer("Example: switchyard plugins list --json");
  auto as_json = std::make_shared<bool>(false);
  list->add_flag("--json", *as_json, "As JSON");
  list->callback([as_json] {
    const Host host;
    if (*as_json) {
      std::cout << ListAsJson(host).dump(2) << '\n';
    } else {
      List(host);
    }
  });

  CLI::App* describe = command->add_subcommand("describe", "What a backend can do; its options");
  describe->footer("Example: switchyard plugins describe highs");
  auto name = std::make_shared<std::string>();
  describe->add_option("NAME", *name, "Id or short name")->required();
  describe->callback([name] { Describe(Host(), *name); });

  CLI::App* doctor =
      command->add_subcommand("doctor", "Why a backend is missing, and what to do about it");
  doctor->footer("Example: switchyard plugins doctor build/lib/switchyard/plugins/highs.so");
  auto file = std::make_shared<std::string>();
  doctor->add_option("FILE.so", *file, "Look at this module alone");
  doctor->callback([file, &code] { code = Doctor(*file); });
}

}  // namespace switchyard::cli
