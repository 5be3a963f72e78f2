// tools/switchyard/solve_options.hpp - the options that commands which solve have in common.
#pragma once

#include <CLI/CLI.hpp>
#include <fstream>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "switchyard/host/host.hpp"
#include "switchyard/model/solver_options.hpp"

namespace switchyard::cli {

struct SolveOptions {
  std::string solver;
  std::vector<std::string> options;  // NAME=VALUE or BACKEND:NAME=VALUE
  double time_limit = std::numeric_limits<double>::infinity();
  int threads = 0;
  double gap = 1e-4;
  std::uint64_t seed = 0;
  std::string json;
  std::string solution;
  std::string log;
  std::string dump;
  std::vector<std::string> plugins;
  int starts = 0;  // 0: one solve, from the guess of the file
  bool check_derivatives = false;
  bool quiet = false;
  bool explain = false;

  void AddTo(CLI::App& command);
  /// Those that `solve` alone has.
  void AddOwnOfSolveTo(CLI::App& command);

  /// A host with --plugin and --log applied. Throws InvalidArgument for a plugin that cannot be
  /// used, with the reason.
  [[nodiscard]] std::unique_ptr<Host> MakeHost();
  /// The same of the process's own host, which solves that run at once use.
  void SetUp(Host& host);
  /// What a solve is given, `spent` seconds after the command began. Options named for a backend
  /// go to `host`.
  [[nodiscard]] SolverOptions ForSolver(Host& host, double spent) const;

 private:
  void SendLog(Host& host);

  std::shared_ptr<std::ofstream> log_file_;
};

}  // namespace switchyard::cli
