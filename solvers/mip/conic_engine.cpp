#include "solvers/mip/conic_engine.hpp"

#include <algorithm>
#include <cmath>

#include "solvers/rounding/verdict.hpp"

namespace switchyard::mip {
namespace {

std::vector<double> Whole(const double* given, std::int32_t count, double none) {
  return given != nullptr ? std::vector<double>(given, given + count)
                          : std::vector<double>(static_cast<std::size_t>(count), none);
}

double OpenEnd(const double* given, std::int32_t j, double none) {
  return given != nullptr ? given[j] : none;
}

sy_problem Continuous(const sy_problem& problem) {
  sy_problem relaxation = problem;
  relaxation.integer = nullptr;
  return relaxation;
}

}  // namespace

ConicEngine::ConicEngine(const sy_problem& problem, const sy_problem& relaxation,
                         const sy_solver& solver, const sy_host& host, rounding::Budget& budget)
    : problem_(problem),
      relaxation_(Continuous(relaxation)),
      solver_(solver),
      budget_(budget),
      lower_(Whole(relaxation.x_lower, problem.num_vars, -kInfinity)),
      upper_(Whole(relaxation.x_upper, problem.num_vars, kInfinity)) {
  loaded_.emplace(solver, host, relaxation_, SY_UPDATES_BOUNDS);
}

// The backend is given what was decided, of integers, and what that fixes, or all that follows from
// it; the proof always uses all.
void ConicEngine::SetBoxes(const NodeBoxes& boxes, bool all) {
  for (std::int32_t j = 0; j < problem_.num_vars; ++j) {
    const auto at = static_cast<std::size_t>(j);
    const bool told = all || boxes.IsInteger(j) || boxes.IsFixed(j);
    lower_[at] = told ? boxes.lower(j) : OpenEnd(relaxation_.x_lower, j, -kInfinity);
    upper_[at] = told ? boxes.upper(j) : OpenEnd(relaxation_.x_upper, j, kInfinity);
  }
  loaded_->SetBounds(lower_, upper_);
}

Relaxed ConicEngine::SolveFinely(const NodeBoxes& boxes, double cutoff, bool in_all_boxes) {
  constexpr double kFine = 1e-11;
  SetBoxes(boxes, in_all_boxes);
  sy_control control = budget_.Part(1);
  control.feasibility = control.optimality = kFine;
  return Judge(loaded_->Solve(control), boxes, cutoff);
}

Relaxed ConicEngine::Solve(const NodeBoxes& boxes, double cutoff, int /*rounds*/) {
  SetBoxes(boxes, false);
  sy_control control = budget_.Part(1);
  control.cutoff = cutoff;
  Relaxed relaxed = Judge(loaded_->Solve(control), boxes, cutoff);
  const bool unproven = relaxed.state == Relaxed::State::kTrouble && cutoff < kInfinity;
  if (!unproven || budget_.Stopped()) return relaxed;
  control = budget_.Part(1);
  return Judge(loaded_->Solve(control), boxes, cutoff);
}

Relaxed ConicEngine::Judge(const rounding::Answer& answer, const NodeBoxes& boxes, double cutoff) {
  Relaxed relaxed;
  relaxed.iterations = answer.iterations;
  last_termination_ = answer.termination;
  const rounding::Duals duals{answer.row_dual, answer.cone_dual};
  if (answer.dual == SY_CERTIFICATE) {
    const bool empty = ProvesEmpty(problem_, duals, boxes.lower(), boxes.upper());
    relaxed.state = empty ? Relaxed::State::kEmpty : Relaxed::State::kTrouble;
    return relaxed;
  }
  relaxed.bound = BoundFrom(problem_, duals, boxes.lower(), boxes.upper());
  if (relaxed.bound.value >= cutoff) {
    relaxed.state = Relaxed::State::kCutoff;
  } else if (rounding::IsPoint(answer.primal) && answer.termination != SY_CUTOFF) {
    relaxed.state = Relaxed::State::kPoint;
    relaxed.x = answer.x;
    relaxed.objective = Objective(problem_, relaxed.x.data());
  } else if (budget_.Stopped()) {
    relaxed.state = Relaxed::State::kStopped;
  }
  return relaxed;
}

}  // namespace switchyard::mip
