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

// Relative. Of a node that is split anyway the last digits of its point do not matter.
constexpr double kRough = 1e-5;

bool AnyIntegerIsOpen(const NodeBoxes& boxes) {
  const auto count = static_cast<std::int32_t>(boxes.lower().size());
  for (std::int32_t j = 0; j < count; ++j) {
    if (boxes.IsInteger(j) && !boxes.IsFixed(j)) return true;
  }
  return false;
}

/// Closed; or far enough below the cutoff, with an integer that is plainly divided.
bool IsEnough(const Relaxed& rough, const NodeBoxes& boxes, double cutoff) {
  constexpr double kShare = 0.1;  // of what is left up to the cutoff
  constexpr double kDivided = 0.01;
  using State = Relaxed::State;
  if (rough.state == State::kCutoff || rough.state == State::kEmpty) return true;
  if (rough.state != State::kPoint) return false;
  const double bound = rough.bound.value;
  if (!(std::abs(rough.objective - bound) <= kShare * (cutoff - bound))) return false;
  for (std::int32_t j = 0; j < static_cast<std::int32_t>(rough.x.size()); ++j) {
    if (!boxes.IsInteger(j) || boxes.IsFixed(j)) continue;
    const double v = rough.x[static_cast<std::size_t>(j)];
    if (std::abs(v - std::round(v)) > kDivided) return true;
  }
  return false;
}

}  // namespace

ConicEngine::ConicEngine(const sy_problem& problem, const sy_problem& relaxation,
                         const sy_solver& solver, const sy_host& host, rounding::Budget& budget)
    : problem_(problem),
      relaxation_(Continuous(relaxation)),
      solver_(solver),
      host_(host),
      budget_(budget),
      lower_(Whole(relaxation.x_lower, problem.num_vars, -kInfinity)),
      upper_(Whole(relaxation.x_upper, problem.num_vars, kInfinity)),
      loaded_(solver, host, relaxation_, SY_UPDATES_BOUNDS) {}

// The backend is given what was decided, of integers, and what that fixes, or all that follows from
// it; the proof always uses all. An end that rows imply, and the relaxation has not, is no
// decision.
void ConicEngine::SetBoxes(const NodeBoxes& boxes, bool all) {
  for (std::int32_t j = 0; j < problem_.num_vars; ++j) {
    const auto at = static_cast<std::size_t>(j);
    const double lower = boxes.lower(j), upper = boxes.upper(j);
    const bool told = all || boxes.IsFixed(j), integer = boxes.IsInteger(j);
    const bool raised = integer && lower > OpenEnd(problem_.x_lower, j, -kInfinity);
    const bool lowered = integer && upper < OpenEnd(problem_.x_upper, j, kInfinity);
    lower_[at] = told || raised ? lower : OpenEnd(relaxation_.x_lower, j, -kInfinity);
    upper_[at] = told || lowered ? upper : OpenEnd(relaxation_.x_upper, j, kInfinity);
  }
  part_ = SmallestPart();
  if (part_ == nullptr) return loaded_.SetBounds(lower_, upper_);
  part_->loaded.SetBounds(part_->problem.Kept(lower_), part_->problem.Kept(upper_));
}

// Of those at hand that leave open what the boxes do; a new one where that has twice as many
// variables as it needs.
ConicEngine::Part* ConicEngine::SmallestPart() {
  constexpr std::size_t kMost = 4, kTimes = 2;
  if (relaxation_.P != nullptr) return nullptr;
  std::size_t open = 0, size = lower_.size();
  for (std::size_t j = 0; j < size; ++j) open += lower_[j] != upper_[j] ? 1 : 0;
  auto best = parts_.end();
  for (auto part = parts_.begin(); part != parts_.end(); ++part) {
    if (part->problem.num_vars() >= size || !part->problem.Covers(lower_, upper_)) continue;
    size = part->problem.num_vars();
    best = part;
  }
  if (open > 0 && kTimes * open <= size) {
    if (parts_.size() == kMost) parts_.pop_back();
    parts_.emplace_front(relaxation_, lower_, upper_, solver_, host_);
  } else if (best != parts_.end()) {
    parts_.splice(parts_.begin(), parts_, best);
  } else {
    return nullptr;
  }
  return &parts_.front();
}

rounding::Answer ConicEngine::Ask(const sy_control& control) {
  if (part_ == nullptr) return loaded_.Solve(control);
  return part_->problem.Back(part_->loaded.Solve(control));
}

Relaxed ConicEngine::SolveFinely(const NodeBoxes& boxes, double cutoff, bool in_all_boxes) {
  constexpr double kFine = 1e-11;
  SetBoxes(boxes, in_all_boxes);
  sy_control control = budget_.Part(1);
  control.feasibility = control.optimality = kFine;
  return Judge(Ask(control), boxes, cutoff);
}

Relaxed ConicEngine::Solve(const NodeBoxes& boxes, double cutoff, int /*rounds*/) {
  SetBoxes(boxes, false);
  sy_control control = budget_.Part(1);
  control.cutoff = cutoff;
  std::int64_t iterations = 0;
  if (cutoff < kInfinity && AnyIntegerIsOpen(boxes)) {
    control.feasibility = control.optimality = kRough;
    Relaxed rough = Judge(Ask(control), boxes, cutoff);
    if (IsEnough(rough, boxes, cutoff) || budget_.Stopped()) return rough;
    iterations = rough.iterations;
    control = budget_.Part(1);
    control.cutoff = cutoff;
    if (last_termination_ == SY_OPTIMAL) control.flags |= SY_CONTINUE;
  }
  Relaxed relaxed = Judge(Ask(control), boxes, cutoff);
  relaxed.iterations += iterations;
  const bool unproven = relaxed.state == Relaxed::State::kTrouble && cutoff < kInfinity;
  if (!unproven || budget_.Stopped()) return relaxed;
  control = budget_.Part(1);
  return Judge(Ask(control), boxes, cutoff);
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
    relaxed.duals = duals;
    relaxed.objective = Objective(problem_, relaxed.x.data());
  } else if (budget_.Stopped()) {
    relaxed.state = Relaxed::State::kStopped;
  }
  return relaxed;
}

}  // namespace switchyard::mip
