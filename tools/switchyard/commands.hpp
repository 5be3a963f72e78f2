// tools/switchyard/commands.hpp - the commands, each in a file of its own.
#pragma once

#include <CLI/CLI.hpp>

namespace switchyard::cli {

/// What the process ends with.
enum ExitCode : int {
  kAnswered = 0,
  kNotAnswered = 1,  // a limit without a feasible point, numerical trouble, no backend
  kBadInput = 2,     // a file, an option or the usage
  kFailure = 3,      // a bug, or a backend that failed
};

/// Each adds its subcommand, which leaves its exit code in `code`.
void AddSolveCommand(CLI::App& app, int& code);
void AddPlanCommand(CLI::App& app, int& code);
void AddPluginsCommand(CLI::App& app, int& code);
void AddConvertCommand(CLI::App& app, int& code);
void AddGenerateCommand(CLI::App& app, int& code);

}  // namespace switchyard::cli
