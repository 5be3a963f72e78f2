#include <cmath>
#include <iostream>
#include <optional>

#include <fmt/format.h>

#include "answer.hpp"
#include "commands.hpp"
#include "derivatives.hpp"
#include "interrupt.hpp"
#include "json_result.hpp"
#include "no_backend.hpp"
#include "solve_options.hpp"
#include "starts.hpp"
#include "switchyard/io/read.hpp"
#include "switchyard/solve/solve.hpp"

namespace switchyard::cli {
namespace {

void SayInWords(const MathematicalProgram& program, const MathematicalProgramResult& r,
                const std::optional<StartCounts>& starts) {
  std::cout << fmt::format("{}", to_string(r.termination));
  if (!r.solver.empty()) std::cout << fmt::format(" by {} {}", r.solver, r.solver_version);
  std::cout << '\n';
  if (!std::isnan(r.objective)) std::cout << fmt::format("objective  {:.12g}\n", r.objective);
  if (!std::isnan(r.bound)) std::cout << fmt::format("bound      {:.12g}\n", r.bound);
  if (!std::isnan(r.gap())) std::cout << fmt::format("gap        {:.3g}\n", r.gap());
  if (r.primal != PointKind::kNone && r.primal != PointKind::kRay) {
    const Violation& v = r.violation;
    std::cout << fmt::format("violation  bounds {:.2g}, rows {:.2g}, cones {:.2g}", v.bounds,
                             v.rows, v.cones);
    if (HasFunctions(program)) std::cout << fmt::format(", functions {:.2g}", v.nonlinear);
    std::cout << fmt::format(", integrality {:.2g}\n", v.integrality);
  }
  if (starts) {
    std::cout << fmt::format("starts     {} of {} gave an answer, {} of these distinct\n",
                             starts->answered, starts->tried, starts->distinct);
  }
  std::cout << fmt::format("seconds    {:.3f}\n", r.seconds.total);
  for (const std::string& note : r.notes) std::cerr << "note: " << note << '\n';
}

std::unique_ptr<MathematicalProgram> Read(const std::string& file, const SolveOptions& options) {
  std::vector<std::string> notes;
  ReadOptions reading;
  reading.notes = &notes;
  auto program = ReadProgram(file, reading);
  for (const std::string& note : notes) {
    if (!options.quiet) std::cerr << "note: " << note << '\n';
  }
  return program;
}

MathematicalProgramResult SolveOnce(const MathematicalProgram& program, SolveOptions& options,
                                    Clock::time_point start) {
  const auto host = options.MakeHost();
  SolverOptions given = options.ForSolver(*host, Since(start));
  given.progress = TerminalProgress(options.quiet);
  SolverSession session(program, options.solver, given, *host);
  if (!options.dump.empty()) session.Dump(options.dump);
  MathematicalProgramResult result = session.Solve();
  EndProgress(given.progress);
  return result;
}

MathematicalProgramResult SolveOften(const MathematicalProgram& program, SolveOptions& options,
                                     Clock::time_point start, StartCounts* counts) {
  Host& host = Host::Default();
  options.SetUp(host);
  const SolverOptions given = options.ForSolver(host, Since(start));
  if (!options.dump.empty()) SolverSession(program, options.solver, given).Dump(options.dump);
  return SolveFromStarts(program, options, given, counts);
}

int Solve(const std::string& file, SolveOptions& options) {
  const Clock::time_point start = Clock::now();
  WatchInterrupts();
  const auto program = Read(file, options);
  const double read = Since(start);
  if (options.check_derivatives) {
    return CheckDerivativesAtGuess(*program, options.quiet) ? kAnswered : kNotAnswered;
  }
  std::optional<StartCounts> starts;
  if (options.starts > 0) starts.emplace();
  MathematicalProgramResult result =
      starts ? SolveOften(*program, options, start, &*starts) : SolveOnce(*program, options, start);
  result.seconds.read = read;
  result.seconds.total = Since(start);
  if (options.explain) Explain(result);
  if (!options.json.empty()) WriteResult(*program, result, starts, options.json);
  if (!options.solution.empty()) WriteSolution(*program, result, options.solution);
  if (!options.quiet && options.json != "-" && options.solution != "-") {
    SayInWords(*program, result, starts);
  }
  const int code = ExitCodeOf(result);
  if (!options.quiet) SayWhyNot(file, result, code);
  return code;
}

}  // namespace

void AddSolveCommand(CLI::App& app, int& code) {
  CLI::App* command =
      app.add_subcommand("solve", "Solve a problem from a file (MPS, CBF, program/1)");
  command->footer("Example: switchyard solve problem.mps.gz --solver highs,clp --json result.json");
  auto options = std::make_shared<SolveOptions>();
  auto file = std::make_shared<std::string>();
  command->add_option("FILE", *file, "The problem; - is standard input, .gz is read as it is")
      ->required();
  options->AddTo(*command);
  options->AddOwnOfSolveTo(*command);
  command->callback([options, file, &code] {
    try {
      code = Solve(*file, *options);
    } catch (const NoBackend& e) {
      std::cerr << "switchyard: no_backend: " << e.what() << '\n';
      code = kNotAnswered;
    }
  });
}

}  // namespace switchyard::cli
