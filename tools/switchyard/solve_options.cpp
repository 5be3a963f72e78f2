#include "solve_options.hpp"

#include <algorithm>
#include <filesystem>
#include <mutex>
#include <system_error>

#include "interrupt.hpp"
#include "no_backend.hpp"
#include "switchyard/error.hpp"

namespace switchyard::cli {

void SolveOptions::AddTo(CLI::App& command) {
  command.add_option("--solver", solver,
                     "Backend by id or short name; a list with commas is an order of preference");
  command
      .add_option("--option", options,
                  "A backend's own option, NAME=VALUE or BACKEND:NAME=VALUE (repeatable)")
      ->take_all();
  command
      .add_option("--time-limit", time_limit, "Seconds from reading to recovery (default: none)")
      ->check(CLI::NonNegativeNumber);
  command.add_option("--threads", threads, "At most this many (default: the cores allowed)")
      ->check(CLI::PositiveNumber);
  command.add_option("--gap", gap, "Relative gap at which integers are optimal (default 1e-4)")
      ->check(CLI::NonNegativeNumber);
  command.add_option("--seed", seed, "Random seed (default 0)");
  command.add_option("--json", json, "Write result/1 to this file; - is standard output");
  command.add_option("--solution", solution, "Write values and duals by name, as JSON");
  command.add_option("--log", log, "Write the backend's log to this file");
  command.add_option("--plugin", plugins, "Load this module too (repeatable)")->take_all();
  command.add_flag("--quiet", quiet, "No progress, and no answer in words");
  command.add_flag("--explain", explain, "Say which backends could serve, and which one does");
}

void SolveOptions::AddOwnOfSolveTo(CLI::App& command) {
  command.add_option("--dump", dump, "Write the lowered problem, for a bug report");
  command
      .add_option("--starts", starts,
                  "Solve from so many points: the file's guess, and others drawn by --seed")
      ->check(CLI::PositiveNumber);
  CLI::Option* const check = command.add_flag(
      "--check-derivatives", check_derivatives,
      "Do not solve: compare the derivatives of functions with differences, at the guess");
  for (const char* answer : {"--starts", "--json", "--solution", "--dump"}) {
    check->excludes(command.get_option(answer));
  }
}

std::unique_ptr<Host> SolveOptions::MakeHost() {
  HostOptions host_options;
  host_options.files = plugins;
  auto host = std::make_unique<Host>(std::move(host_options));
  for (const PluginProblem& problem : host->problems()) {
    const bool asked_for = std::find(plugins.begin(), plugins.end(), problem.path) != plugins.end();
    Require(!asked_for, "--plugin ", problem.path, ": ", problem.reason);
  }
  SendLog(*host);
  return host;
}

void SolveOptions::SetUp(Host& host) {
  for (const std::string& file : plugins) {
    const auto backends = host.backends();
    const bool there = std::any_of(backends.begin(), backends.end(), [&](const Backend* one) {
      std::error_code absent;
      return std::filesystem::equivalent(one->origin, file, absent);
    });
    if (!there && !host.Load(file)) {
      Refuse("--plugin ", file, ": ", host.problems().back().reason);
    }
  }
  SendLog(host);
}

void SolveOptions::SendLog(Host& host) {
  if (log.empty()) return;
  log_file_ = std::make_shared<std::ofstream>(log);
  Require(log_file_->good(), "--log ", log, ": the file cannot be written");
  auto mutex = std::make_shared<std::mutex>();
  host.SetLog([file = log_file_, mutex](sy_level, const std::string& text) {
    const std::lock_guard lock(*mutex);
    *file << text;
    if (text.empty() || text.back() != '\n') *file << '\n';
  });
}

SolverOptions SolveOptions::ForSolver(Host& host, double spent) const {
  SolverOptions given;
  given.time_limit = std::max(0.0, time_limit - spent);
  given.threads = threads;
  given.relative_gap = gap;
  given.seed = seed;
  given.verbosity = log.empty() ? 0 : 2;
  given.cancelled = &Interrupted();
  for (const std::string& text : options) {
    const std::size_t equals = text.find('=');
    Require(equals != std::string::npos && equals > 0, "--option needs NAME=VALUE, got \"", text,
            "\"");
    const std::string name = text.substr(0, equals);
    const std::string value = text.substr(equals + 1);
    const std::size_t colon = name.find(':');
    if (colon == std::string::npos) {
      given.SetOption(SolverId(), name, value);
      continue;
    }
    const std::string backend = name.substr(0, colon);
    if (host.Find(backend) == nullptr) {
      throw NoBackend(Text("--option ", text, ": there is no backend \"", backend, "\""));
    }
    host.SetOption(backend, name.substr(colon + 1), value);
  }
  return given;
}

}  // namespace switchyard::cli
