#include "switchyard/solve/solve.hpp"

#include "core/host/facade.hpp"
#include "core/solve/dump.hpp"
#include "core/solve/session.hpp"

namespace switchyard {

MathematicalProgramResult Solve(const MathematicalProgram& program,
                                const std::optional<Eigen::VectorXd>& initial_guess,
                                const SolverOptions& options) {
  return SolverInterface().Solve(program, initial_guess, options);
}

SolverInterface::SolverInterface(std::string names, Host& host)
    : names_(std::move(names)), host_(&host) {}

bool SolverInterface::available() const {
  for (const Backend* backend : host_->backends()) {
    const bool named =
        names_.empty() || ("," + names_ + ",").find("," + backend->id + ",") != std::string::npos ||
        ("," + names_ + ",").find("," + backend->short_name + ",") != std::string::npos;
    if (named && host_->Ready(*backend).ready) return true;
  }
  return false;
}

bool SolverInterface::Accepts(const MathematicalProgram& program, std::string* why) const {
  const Lowering lowering(program);
  std::string reasons;
  for (const Candidate& candidate : host_->Rank(lowering.problem().view(), names_)) {
    if (candidate.suitable) return true;
    reasons += (reasons.empty() ? "" : "; ") + candidate.backend->id + ": " + candidate.why;
  }
  if (why != nullptr) *why = reasons.empty() ? "no such backend is there" : reasons;
  return false;
}

std::string SolverInterface::ExplainUnsatisfiedProgramAttributes(
    const MathematicalProgram& program) const {
  std::string why;
  return Accepts(program, &why) ? "" : why;
}

void SolverInterface::Solve(const MathematicalProgram& program,
                            const std::optional<Eigen::VectorXd>& initial_guess,
                            const std::optional<SolverOptions>& options,
                            MathematicalProgramResult* result) const {
  *result = Solve(program, initial_guess, options.value_or(SolverOptions()));
}

MathematicalProgramResult SolverInterface::Solve(
    const MathematicalProgram& program, const std::optional<Eigen::VectorXd>& initial_guess,
    const SolverOptions& options) const {
  SolverSession::State once(program, names_, options, *host_, false);
  return once.Solve(initial_guess);
}

SolverSession::SolverSession(const MathematicalProgram& program, std::string names,
                             const SolverOptions& options, Host& host)
    : state_(std::make_unique<State>(program, std::move(names), options, host, true)) {}

SolverSession::SolverSession(SolverSession&&) noexcept = default;
SolverSession::~SolverSession() = default;

MathematicalProgramResult SolverSession::Solve(
    const std::optional<Eigen::VectorXd>& initial_guess) {
  return state_->Solve(initial_guess);
}

int SolverSession::num_loads() const {
  if (state_->instance == nullptr) return 0;
  return ServiceOf(*state_->instance).loads(state_->instance->get());
}

int SolverSession::num_updates() const {
  if (state_->instance == nullptr) return 0;
  return ServiceOf(*state_->instance).updates(state_->instance->get());
}

void SolverSession::Dump(const std::string& path) const {
  if (!state_->lowering.has_value()) state_->lowering.emplace(state_->program);
  WriteProblem(state_->lowering->problem().view(), path);
}

}  // namespace switchyard
