#include "switchyard/solve/choose_solver.hpp"

#include "core/lower/lowering.hpp"
#include "switchyard/error.hpp"

namespace switchyard {
namespace {

const Backend& Named(const SolverId& id, const Host& host) {
  if (const Backend* backend = host.Find(id.name())) return *backend;
  std::vector<std::string> known;
  for (const Backend* one : host.backends()) known.push_back(one->short_name);
  const std::string near = NearestName(id.name(), known);
  Refuse("there is no backend \"", id.name(), "\"",
         near.empty() ? "" : "; the nearest is \"" + near + "\"");
}

}  // namespace

ProgramType GetProgramType(const MathematicalProgram& program) {
  return ProgramTypeOf(Lowering(program).problem().view());
}

std::vector<Considered> ExplainChoice(const MathematicalProgram& program, const Host& host) {
  const Lowering lowering(program);
  std::vector<Considered> all;
  bool chosen = false;
  for (const Candidate& candidate : host.Rank(lowering.problem().view())) {
    const bool first = candidate.suitable && !chosen;
    chosen = chosen || first;
    all.push_back({candidate.backend->id, first, lowering.WithNames(program, candidate.why)});
  }
  return all;
}

SolverId ChooseBestSolver(const MathematicalProgram& program, const Host& host) {
  std::string reasons;
  for (const Considered& one : ExplainChoice(program, host)) {
    if (one.chosen) return SolverId(one.solver);
    reasons += (reasons.empty() ? "" : "; ") + one.solver + ": " + one.why;
  }
  Refuse("no backend serves the program: ", reasons.empty() ? "none is there" : reasons);
}

std::set<SolverId> GetKnownSolvers(const Host& host) {
  std::set<SolverId> ids;
  for (const Backend* backend : host.backends()) ids.emplace(backend->id);
  return ids;
}

std::vector<SolverId> GetAvailableSolvers(ProgramType type, const Host& host) {
  std::vector<SolverId> ids;
  for (const Backend* backend : host.backends()) {
    const bool strategy = (backend->facts.traits & SY_STRATEGY) != 0;
    if (!strategy && host.Serves(*backend, type)) ids.emplace_back(backend->id);
  }
  return ids;
}

std::unique_ptr<SolverInterface> MakeSolver(const SolverId& id, Host& host) {
  return std::make_unique<SolverInterface>(Named(id, host).id, host);
}

std::unique_ptr<SolverInterface> MakeFirstAvailableSolver(const std::vector<SolverId>& ids,
                                                          Host& host) {
  std::string reasons;
  for (const SolverId& id : ids) {
    const Backend* backend = host.Find(id.name());
    if (backend == nullptr) {
      reasons += Text(reasons.empty() ? "" : "; ", id.name(), ": there is none of that name");
      continue;
    }
    const Readiness readiness = host.Ready(*backend);
    if (readiness.ready) return std::make_unique<SolverInterface>(backend->id, host);
    reasons += Text(reasons.empty() ? "" : "; ", id.name(), ": ", readiness.text);
  }
  Refuse("none of ", ids.size(),
         " backends is ready: ", reasons.empty() ? "none was named" : reasons);
}

}  // namespace switchyard
