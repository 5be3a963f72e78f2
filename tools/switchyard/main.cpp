// The command line: see docs/command-line.md.
#include <exception>
#include <iostream>

#include "commands.hpp"
#include "switchyard/error.hpp"

int main(int argc, char** argv) {
  using namespace switchyard::cli;
  CLI::App app(
      "Optimization programs written once, solved by whatever backend is there.\n"
      "Example: switchyard solve problem.mps --time-limit 10 --json -",
      "switchyard");
  app.set_version_flag("--version", "switchyard " SWITCHYARD_VERSION);
  app.require_subcommand(1);
  int code = kAnswered;
  AddSolveCommand(app, code);
  AddPlanCommand(app, code);
  AddPluginsCommand(app, code);
  AddConvertCommand(app, code);
  AddGenerateCommand(app, code);
  try {
    app.parse(argc, argv);
    return code;
  } catch (const CLI::ParseError& e) {
    return app.exit(e, std::cout, std::cerr) == 0 ? kAnswered : kBadInput;
  } catch (const switchyard::InvalidArgument& e) {
    std::cerr << "switchyard: " << e.what() << '\n';
    return kBadInput;
  } catch (const std::exception& e) {
    std::cerr << "switchyard: this is a bug: " << e.what() << '\n';
    return kFailure;
  }
}
