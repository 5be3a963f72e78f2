#include "answer.hpp"

#include <unistd.h>

#include <iostream>

#include <fmt/format.h>

#include "commands.hpp"

namespace switchyard::cli {
namespace {

std::string Advice(Termination termination) {
  switch (termination) {
    case Termination::kNoBackend:
      return "try: switchyard plugins doctor";
    case Termination::kTimeLimit:
      return "try a larger --time-limit";
    case Termination::kNumericalTrouble:
      return "try another --solver; --explain lists those that could serve";
    case Termination::kLocallyInfeasible:
      return "try other points: --starts N";
    case Termination::kEvaluationFailed:
      return "--check-derivatives names what is not defined at the guess";
    case Termination::kInfeasibleOrUnbounded:
      return "try another --solver to learn which";
    case Termination::kNoPath:
    case Termination::kRestrictionsFailed:
      return "try more --paths or another --seed";
    default:
      return "";
  }
}

}  // namespace

double Since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

bool HasFunctions(const MathematicalProgram& program) {
  return !program.generic_costs().empty() || !program.quadratic_constraints().empty() ||
         !program.generic_constraints().empty();
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

void Explain(const MathematicalProgramResult& result) {
  for (const Considered& one : result.considered) {
    std::cerr << fmt::format("{} {}: {}\n", one.chosen ? "chosen " : "skipped", one.solver,
                             one.why);
  }
  for (const std::string& bridge : result.bridges) std::cerr << "bridge  " << bridge << '\n';
}

void SayWhyNot(const std::string& file, const MathematicalProgramResult& result, int code) {
  if (code == kAnswered) return;
  const std::string advice = Advice(result.termination);
  std::cerr << fmt::format("switchyard: {}: {}: {}{}{}\n", file, to_string(result.termination),
                           result.message, advice.empty() ? "" : "; ", advice);
}

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

void EndProgress(const std::function<bool(const SolveProgress&)>& progress) {
  if (progress) std::cerr << "\r\033[K";
}

}  // namespace switchyard::cli
