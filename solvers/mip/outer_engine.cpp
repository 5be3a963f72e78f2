#include "solvers/mip/outer_engine.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "solvers/rounding/verdict.hpp"

namespace switchyard::mip {
namespace {

using State = Relaxed::State;

constexpr double kViolated = 1e-7;     // relative: a cut that is asked for
constexpr double kProgress = 1e-4;     // of the bound, in a round that was worth it
constexpr int kStalled = 4;            // rounds without progress
constexpr int kIdle = 40;              // solves without a dual, until a cut is forgotten
constexpr std::size_t kFewCuts = 400;  // are always kept
constexpr std::int64_t kGlance = 100;  // iterations

}  // namespace

OuterEngine::OuterEngine(const OuterModel& model, const sy_solver& solver, const sy_host& host,
                         rounding::Budget& budget)
    : model_(model),
      solver_(solver),
      budget_(budget),
      lower_(model.linear().data().x_lower),
      upper_(model.linear().data().x_upper) {
  constexpr std::uint64_t kUpdates = SY_UPDATES_BOUNDS | SY_UPDATES_APPEND | SY_UPDATES_REMOVE;
  loaded_.emplace(solver, host, model.linear().view(), kUpdates);
}

void OuterEngine::SetBoxes(const NodeBoxes& boxes) {
  std::copy(boxes.lower().begin(), boxes.lower().end(), lower_.begin());
  std::copy(boxes.upper().begin(), boxes.upper().end(), upper_.begin());
  loaded_->SetBounds(lower_, upper_);
}

Relaxed OuterEngine::SolveOnce(const NodeBoxes& boxes, double cutoff, std::int64_t iterations) {
  sy_control control = budget_.Part(1);
  control.flags = SY_CONTINUE;
  control.cutoff = cutoff;
  control.iterations = iterations;
  Relaxed relaxed = Judge(loaded_->Solve(control), boxes, cutoff);
  const bool unproven = relaxed.state == State::kTrouble && !budget_.Stopped();
  if (!unproven || iterations != std::numeric_limits<std::int64_t>::max()) return relaxed;
  control = budget_.Part(1);  // from nothing, to the end
  const std::int64_t before = relaxed.iterations;
  relaxed = Judge(loaded_->Solve(control), boxes, cutoff);
  relaxed.iterations += before;
  return relaxed;
}

Relaxed OuterEngine::Judge(const rounding::Answer& answer, const NodeBoxes& boxes, double cutoff) {
  Relaxed relaxed;
  relaxed.iterations = answer.iterations;
  const rounding::Duals duals = model_.DualsOf(answer.row_dual, cuts_);
  const sy_problem& problem = model_.problem();
  if (answer.dual == SY_CERTIFICATE) {
    const bool empty = ProvesEmpty(problem, duals, boxes.lower(), boxes.upper());
    relaxed.state = empty ? State::kEmpty : State::kTrouble;
    return relaxed;
  }
  relaxed.bound = BoundFrom(problem, duals, boxes.lower(), boxes.upper());
  for (std::size_t k = 0; k < cuts_.size(); ++k) {
    const double y = answer.row_dual[answer.row_dual.size() - cuts_.size() + k];
    idle_[k] = y > 0 ? 0 : idle_[k] + 1;
  }
  if (relaxed.bound.value >= cutoff) {
    relaxed.state = State::kCutoff;
  } else if (rounding::IsPoint(answer.primal) && answer.termination == SY_OPTIMAL) {
    relaxed.state = State::kPoint;
    point_ = answer.x;
    relaxed.x.assign(answer.x.begin(), answer.x.begin() + problem.num_vars);
    relaxed.objective = Objective(problem, relaxed.x.data());
  } else if (budget_.Stopped()) {
    relaxed.state = State::kStopped;
  }
  return relaxed;
}

Relaxed OuterEngine::Solve(const NodeBoxes& boxes, double cutoff, int rounds) {
  SetBoxes(boxes);
  Forget();
  Relaxed best;
  int stalled = 0;
  std::int64_t iterations = 0;
  for (int round = 0;; ++round) {
    Relaxed relaxed = SolveOnce(boxes, cutoff, std::numeric_limits<std::int64_t>::max());
    iterations += relaxed.iterations;
    const double before = best.bound.value;
    const double progress = relaxed.bound.value - before;
    if (round > 0 && before > relaxed.bound.value) relaxed.bound = std::move(best.bound);
    best = std::move(relaxed);
    best.iterations = iterations;
    if (best.state != State::kPoint || round >= rounds || budget_.Stopped()) return best;
    stalled = progress > kProgress * std::max(1e-3, std::abs(best.bound.value)) ? 0 : stalled + 1;
    if (stalled >= kStalled || !Tighten()) return best;
  }
}

Relaxed OuterEngine::Glance(const NodeBoxes& boxes, double cutoff) {
  SetBoxes(boxes);
  return SolveOnce(boxes, cutoff, kGlance);
}

bool OuterEngine::Tighten() {
  std::vector<Cut> cuts;
  model_.Separate(point_, kViolated, cuts);
  if (cuts.empty()) return false;
  Append(std::move(cuts));
  return true;
}

void OuterEngine::See(const std::vector<double>& x) {
  std::vector<Cut> cuts;
  model_.TangentsAt(x, cuts);
  if (!cuts.empty()) Append(std::move(cuts));
}

void OuterEngine::Append(std::vector<Cut> cuts) {
  Csc At(model_.linear().data().num_vars, 0);
  std::vector<double> lower;
  for (Cut& cut : cuts) {
    std::sort(cut.entries.begin(), cut.entries.end(),
              [](const Entry& a, const Entry& b) { return a.variable < b.variable; });
    for (const Entry& e : cut.entries) {
      At.row.push_back(e.variable);
      At.value.push_back(e.value);
    }
    At.start.push_back(static_cast<std::int32_t>(At.row.size()));
    lower.push_back(cut.lower);
  }
  At.cols = static_cast<std::int32_t>(cuts.size());
  loaded_->AppendRows(At, lower);
  idle_.resize(cuts_.size() + cuts.size(), 0);
  cuts_.insert(cuts_.end(), std::make_move_iterator(cuts.begin()),
               std::make_move_iterator(cuts.end()));
}

void OuterEngine::Forget() {
  const auto rows = static_cast<std::int32_t>(model_.linear().data().row_lower.size());
  if (cuts_.size() < kFewCuts + static_cast<std::size_t>(rows)) return;
  std::vector<std::int32_t> gone;
  std::size_t kept = 0;
  for (std::size_t k = 0; k < cuts_.size(); ++k) {
    if (idle_[k] > kIdle) {
      gone.push_back(rows + static_cast<std::int32_t>(k));
      continue;
    }
    if (kept != k) cuts_[kept] = std::move(cuts_[k]);
    idle_[kept++] = idle_[k];
  }
  if (gone.empty()) return;
  cuts_.resize(kept);
  idle_.resize(kept);
  loaded_->RemoveRows(gone);
}

}  // namespace switchyard::mip
