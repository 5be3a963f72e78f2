#include <unistd.h>

#include <chrono>
#include <cmath>
#include <iostream>

#include <fmt/format.h>

#include "commands.hpp"
#include "interrupt.hpp"
#include "json_result.hpp"
#include "no_backend.hpp"
#include "solve_options.hpp"
#include "switchyard/io/read.hpp"
#include "switchyard/solve/solve.hpp"

namespace switchyard::cli {
namespace {

using Clock = std::chrono::steady_clock;

double Since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

int ExitCodeOf(const MathematicalProgramResult& result) {
  switch (result.termination) {
    case Termination::kOptimal:
    case Termination::kLocallyOptimal:
    case Termination::kInfeasible:
    case Termination::kUnbounded:
    case Termination::kCutoff:
    case Termination::kTarget:
      return kAnswered;
    case Termination::kBackendFailed:
      return kFailure;
    case Termination::kNumericalTrouble:
      return kNotAnswered;
    default:  // a limit: answered where it left a feasible point
      return result.primal == PointKind::kFeasible ? kAnswered : kNotAnswered;
  }
}

std::string Advice(Termination termination) {
  switch (termination) {
    case Termination::kNoBackend:
      return "try: switchyard plugins doctor";
    case Termination::kTimeLimit:
      return "try a larger --time-limit";
    case Termination::kNumericalTrouble:
      return "try another --solver; --explain lists those that could serve";
    case Termination::kInfeasibleOrUnbounded:
      return "try another --solver to learn which";
    default:
      return "";
  }
}

void Explain(const MathematicalProgramResult& result) {
  for (const Considered& one : result.considered) {
    std::cerr << fmt::format("{} {}: {}\n", one.chosen ? "chosen " : "skipped", one.solver,
                             one.why);
  }
  for (const std::string& bridge : result.bridges) std::cerr << "bridge  " << bridge << '\n';
}

void SayInWords(const MathematicalProgramResult& r) {
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
    std::cout << fmt::format(", integrality {:.2g}\n", v.integrality);
  }
  std::cout << fmt::format("seconds    {:.3f}\n", r.seconds.total);
  for (const std::string& note : r.notes) std::cerr << "note: " << note << '\n';
}

/// A line on the terminal, renewed a few times a second; nothing where there is no terminal.
std::function<bool(const SolveProgress&)> TerminalProgress(bool quiet) {
  if (quiet || isatty(STDERR_FILENO) == 0) return nullptr;
  return [last = Clock::time_point()](const SolveProgress& p) mutable {
    constexpr double kEvery = 0.25;
    if (Since(last) < kEvery) return false;
    last = Clock::now();
    const auto count = [](std::int64_t n) { return n < 0 ? "-" : std::to_string(n); };
    std::cerr << fmt::format(
        "\r{:8.1f} s  iterations {}  nodes {}  objective {:.8g}  bound {:.8g} ", p.seconds,
        count(p.iteration), count(p.nodes), p.objective, p.bound);
    return false;
  };
}

int Solve(const std::string& file, SolveOptions& options) {
  const Clock::time_point start = Clock::now();
  WatchInterrupts();
  std::vector<std::string> notes;
  ReadOptions reading;
  reading.notes = &notes;
  const auto program = ReadProgram(file, reading);
  const double read = Since(start);
  for (const std::string& note : notes) {
    if (!options.quiet) std::cerr << "note: " << note << '\n';
  }
  const auto host = options.MakeHost();
  SolverOptions given = options.ForSolver(*host, Since(start));
  given.progress = TerminalProgress(options.quiet);
  SolverSession session(*program, options.solver, given, *host);
  if (!options.dump.empty()) session.Dump(options.dump);
  MathematicalProgramResult result = session.Solve();
  if (given.progress) std::cerr << "\r\033[K";
  result.seconds.read = read;
  result.seconds.total = Since(start);
  if (options.explain) Explain(result);
  if (!options.json.empty()) WriteResult(*program, result, options.json);
  if (!options.solution.empty()) WriteSolution(*program, result, options.solution);
  if (!options.quiet && options.json != "-" && options.solution != "-") SayInWords(result);
  const int code = ExitCodeOf(result);
  if (code != kAnswered && !options.quiet) {
    const std::string advice = Advice(result.termination);
    std::cerr << fmt::format("switchyard: {}: {}: {}{}{}\n", file, to_string(result.termination),
                             result.message, advice.empty() ? "" : "; ", advice);
  }
  return code;
}

}  // namespace

void AddSolveCommand(CLI::App& app, int& code) {
  CLI::App* command = app.add_subcommand("solve", "Solve a problem from a file (MPS, CBF)");
  command->footer("Example: switchyard solve problem.mps.gz --solver highs,clp --json result.json");
  auto options = std::make_shared<SolveOptions>();
  auto file = std::make_shared<std::string>();
  command->add_option("FILE", *file, "The problem; - is standard input, .gz is read as it is")
      ->required();
  options->AddTo(*command);
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
