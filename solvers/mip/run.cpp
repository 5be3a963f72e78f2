#include "solvers/mip/run.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <exception>
#include <limits>
#include <memory>
#include <numeric>
#include <sstream>
#include <thread>

#include "solvers/mip/implied_integers.hpp"
#include "solvers/mip/probing.hpp"
#include "solvers/rounding/diving.hpp"
#include "solvers/rounding/verdict.hpp"
#include "switchyard/plugin.hpp"

namespace switchyard::mip {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kLanes = 4;  // of a deterministic search

const char* NamesOf(const std::string& names) { return names.empty() ? nullptr : names.c_str(); }

bool HasContinuous(const sy_problem& p) {
  return std::any_of(p.integer, p.integer + p.num_vars, [](std::uint8_t i) { return i == 0; });
}

const std::int32_t* PriorityOf(const sy_problem& p) {
  for (const sy_hint* hint = p.hints; hint != nullptr && hint->id != nullptr; ++hint) {
    if (std::string(hint->id) != "sy.branching/1") continue;
    return plugin::Whole(*static_cast<const sy_branching*>(hint->data)).priority;
  }
  return nullptr;
}

}  // namespace

Run::Run(const rounding::IntegerProblem& whole, const rounding::PathProblem* paths,
         const Options& options, const sy_host& host, const sy_control& control,
         const std::vector<double>& start)
    : whole_(whole),
      paths_(paths),
      options_(options),
      host_(host),
      start_(start),
      budget_(control),
      propagator_(whole.problem(), VariablesOf(ImpliedIntegers(whole.problem()))),
      workspace_(propagator_),
      shared_(whole.problem(), static_cast<std::size_t>(options.pool), budget_),
      instance_{whole, options, host, propagator_, propagator_.Bounds()} {
  instance_.paths = paths;
  instance_.priority = PriorityOf(problem());
  instance_.has_continuous = HasContinuous(problem());
}

void Run::Solve() {
  workers_ = static_cast<std::size_t>(std::max(1, budget_.control().threads));
  shared_.SetWorkers(workers_);
  if (!Tighten()) {
    return Finish(SY_INFEASIBLE, "no point: " + instance_.root.contradiction().Name());
  }
  if (!Relax()) return;
  ChooseEngine();
  auto root = std::make_shared<Node>();
  root->bound = root_bound_;
  shared_.Push(std::move(root));  // from here on the tree has a bound
  TakeStart();
  Dive();
  Search();
  Conclude();
}

bool Run::Tighten() {
  NodeBoxes& boxes = instance_.root;
  if (!propagator_.Propagate(boxes, workspace_)) return false;
  if (options_.probing != 0 && paths_ == nullptr) Probe();
  const bool left = !boxes.contradiction();
  if (left) boxes.Commit();
  return left;
}

void Run::Probe() {
  constexpr std::int64_t kPasses = 100;  // over all entries
  constexpr double kShare = 0.02;        // of the time there is
  ProbingOptions options;
  options.work = kPasses * std::max<std::int64_t>(1000, propagator_.num_entries());
  options.seconds = std::min(10.0, kShare * budget_.control().seconds);
  const std::vector<std::int32_t> binaries = BinariesByConstraints(propagator_, instance_.root);
  mip::Probe(propagator_, binaries, options, instance_.root, workspace_);
}

// Of the problem as it is: what tells infeasible and unbounded ones apart, and where the cones'
// cuts begin. False: that was the answer.
bool Run::Relax() {
  sy_problem relaxation = instance_.relaxation();
  relaxation.integer = nullptr;
  instance_.conic = &rounding::FindBackend(host_, relaxation, NamesOf(options_.solver),
                                           static_cast<std::int64_t>(workers_), SY_UPDATES_BOUNDS);
  ConicEngine engine(problem(), instance_.relaxation(), *instance_.conic, host_, budget_);
  root_ = engine.Solve(instance_.root, kInfinity, 0);
  root_bound_ = root_.bound.value;
  const bool unbounded = engine.last_termination() == SY_UNBOUNDED;
  if (root_.state == Relaxed::State::kEmpty) {
    Finish(SY_INFEASIBLE, "the relaxation has a certificate");
  } else if (root_.state == Relaxed::State::kStopped) {
    Finish(budget_.reason(), "");
  } else if (unbounded) {
    Finish(SY_INFEASIBLE_OR_UNBOUNDED, "the relaxation is unbounded");
  } else if (root_.bound.value >= shared_.cutoff()) {
    Finish(SY_CUTOFF, "");
  }
  return termination_ == SY_NOT_SOLVED;
}

void Run::ChooseEngine() {
  const std::string why_not = OuterModel::WhyNot(problem());
  if (options_.engine == EngineKind::kOuter && !why_not.empty()) {
    throw plugin::Failure(
        SY_E_UNSUPPORTED,
        "engine outer takes linear objectives, rows and second-order cones, and " + why_not);
  }
  // Conic nodes know the cones at once, and cost little more than linear ones; where there are no
  // cones, a simplex method goes on where it was.
  const bool linear = why_not.empty() && !OuterModel::IsCurved(problem()) && paths_ == nullptr;
  const bool outer =
      options_.engine == EngineKind::kOuter || (options_.engine == EngineKind::kAuto && linear);
  instance_.outer_nodes = outer && root_.state == Relaxed::State::kPoint;
  if (!instance_.outer_nodes && root_.state == Relaxed::State::kPoint) instance_.relaxed = &root_;
  engine_ = instance_.outer_nodes ? "outer approximation" : "conic nodes";
  if (!why_not.empty()) return;
  outer_.emplace(problem());
  constexpr std::uint64_t kUpdates = SY_UPDATES_BOUNDS | SY_UPDATES_APPEND | SY_UPDATES_REMOVE;
  try {
    instance_.linear =
        &rounding::FindBackend(host_, outer_->linear().view(), NamesOf(options_.linear),
                               static_cast<std::int64_t>(workers_), kUpdates, SY_GIVES_BASIS);
    instance_.outer = &*outer_;
  } catch (const plugin::Failure&) {
    if (instance_.outer_nodes) throw;  // conic nodes do without
  }
}

void Run::OfferIfFeasible(std::vector<double> x) {
  for (const std::int32_t j : whole_.integers()) {
    double& v = x[static_cast<std::size_t>(j)];
    v = std::round(v);
  }
  if (!whole_.WhatIsViolatedBy(x, kFeasible).empty()) return;
  shared_.Offer(Objective(problem(), x.data()), x);
}

// The integers of the user's point, and the best rest for them.
void Run::TakeStart() {
  if (start_.empty()) return;
  NodeBoxes boxes = instance_.root;
  for (const std::int32_t j : whole_.integers()) {
    const double v = start_[static_cast<std::size_t>(j)];
    if (!std::isfinite(v)) return;
    boxes.Impose(j, std::round(v), std::round(v));
  }
  if (!propagator_.Propagate(boxes, workspace_)) return;
  ConicEngine engine(problem(), instance_.relaxation(), *instance_.conic, host_, budget_);
  const Relaxed rest = engine.Solve(boxes, kInfinity, 0);
  if (rest.state == Relaxed::State::kPoint) OfferIfFeasible(rest.x);
}

// Rounding and dives from the relaxed point, while they cost no more than a few relaxations, or
// there is no point yet.
void Run::Dive() {
  if (root_.state != Relaxed::State::kPoint || paths_ != nullptr) return;
  rounding::Domain domain(whole_);
  if (!domain.Propagate()) return;
  sy_problem relaxation = problem();
  relaxation.integer = nullptr;
  relaxation.x_lower = instance_.root.lower().data();
  relaxation.x_upper = instance_.root.upper().data();
  const rounding::Root root{whole_, relaxation, domain, root_.x, *instance_.conic, host_};
  const double begin = budget_.Seconds();
  const double enough = 10 * begin + 0.02 * std::min(1e3, budget_.control().seconds);
  constexpr rounding::DiveRule kRules[] = {rounding::DiveRule::kFractional,
                                           rounding::DiveRule::kCoefficient,
                                           rounding::DiveRule::kDrawn};
  for (int k = 0; k < options_.dives && !budget_.Stopped(); ++k) {
    const bool late = options_.deterministic == 0 && budget_.Seconds() - begin > enough;
    if (k > 0 && (shared_.best() < kInfinity || late)) return;
    rounding::DiveOptions dive;
    dive.rule = kRules[static_cast<std::size_t>(k) % std::size(kRules)];
    dive.seed = budget_.control().seed + static_cast<std::uint64_t>(k);
    const rounding::Try found =
        k == 0 ? rounding::RoundToNearest(root, budget_) : rounding::Dive(root, dive, budget_);
    if (found.feasible) shared_.Offer(found.objective, found.x);
  }
}

void Run::Work(std::size_t index) noexcept {
  try {
    Worker worker(instance_, Ledger(shared_, index, false));
    if (index == 0 && root_.state == Relaxed::State::kPoint) worker.See(root_.x);
    while (NodePointer node = shared_.Pop(index)) worker.Plunge(std::move(node));
  } catch (const std::exception& e) {
    shared_.Fail(e.what());
  }
}

void Run::Search() {
  if (options_.deterministic != 0) return SearchInRounds();
  std::vector<std::jthread> others;
  for (std::size_t w = 1; w < workers_; ++w) others.emplace_back([this, w] { Work(w); });
  Work(0);
}

// The best open nodes, one for each of a number of workers that does not depend on the threads;
// what they found is told in their order when all have ended.
void Run::SearchInRounds() {
  std::vector<std::unique_ptr<Worker>> lanes;
  shared_.SetWorkers(kLanes);
  for (std::size_t k = 0; k < kLanes; ++k) {
    lanes.push_back(std::make_unique<Worker>(instance_, Ledger(shared_, k, true)));
    if (root_.state == Relaxed::State::kPoint) lanes.back()->See(root_.x);
  }
  for (;;) {
    const std::vector<NodePointer> nodes = shared_.PopSome(kLanes);
    if (nodes.empty()) return;
    for (std::size_t k = 0; k < nodes.size(); ++k) lanes[k]->ledger().BeginRound();
    std::atomic<std::size_t> next = 0;
    const auto work = [&]() noexcept {
      for (std::size_t k = next++; k < nodes.size(); k = next++) {
        try {
          lanes[k]->Plunge(nodes[k]);
        } catch (const std::exception& e) {
          shared_.Fail(e.what());
        }
      }
    };
    {
      std::vector<std::jthread> others;
      for (std::size_t w = 1; w < std::min(workers_, nodes.size()); ++w) others.emplace_back(work);
      work();
    }
    for (std::size_t k = 0; k < nodes.size(); ++k) lanes[k]->ledger().Settle();
  }
}

void Run::Conclude() {
  const std::string failure = shared_.failure();
  if (!failure.empty()) throw plugin::Failure(SY_E_INTERNAL, failure);
  const double best = shared_.best(), bound = shared_.Bound();
  const sy_control& control = budget_.control();
  const bool found = best < kInfinity;
  const double relative = std::isnan(control.relative_gap) ? 1e-4 : control.relative_gap;
  sy_control floored = control;
  floored.relative_gap = std::max(relative, kLeastGap);
  if (found && rounding::IsWithinTheGap(floored, best, bound)) return Finish(SY_OPTIMAL, "");
  if (found && best <= control.target) return Finish(SY_TARGET, "");
  if (budget_.reason() != SY_NOT_SOLVED) return Finish(budget_.reason(), "");
  if (shared_.node_limit()) return Finish(SY_NODE_LIMIT, "");
  if (shared_.given_up() > 0) {
    return Finish(SY_NUMERICAL_TROUBLE,
                  std::to_string(shared_.given_up()) + " nodes without a proof");
  }
  if (found) return Finish(SY_NUMERICAL_TROUBLE, "the gap could not be closed");
  Finish(control.cutoff < kInfinity ? SY_CUTOFF : SY_INFEASIBLE, "every node is closed");
}

void Run::Finish(sy_termination termination, const std::string& why) {
  termination_ = termination;
  std::ostringstream text;
  text << (engine_.empty() ? "root" : engine_);
  if (instance_.outer_nodes) text << " by " << instance_.linear->id << " and";
  if (instance_.conic != nullptr) text << " by " << instance_.conic->id;
  text << "; " << shared_.nodes() << " nodes";
  if (!why.empty()) text << "; " << why;
  text_ = text.str();
}

void Run::Write(sy_result& result) const {
  result.termination = termination_;
  result.primal = result.dual = SY_NO_POINT;
  result.objective = result.relaxed = kNaN;
  const double bound = engine_.empty() ? root_bound_ : std::max(root_bound_, shared_.Bound());
  result.bound = termination_ == SY_INFEASIBLE || !std::isfinite(bound) ? -kInfinity : bound;
  result.iterations = shared_.iterations() + root_.iterations;
  result.nodes = shared_.nodes();
  const Incumbents& found = shared_.incumbents();
  if (!found.empty()) {
    result.primal = SY_FEASIBLE;
    result.objective = found.objective();
    const std::vector<double>& x = found.all().front().x;
    if (result.x != nullptr) std::copy(x.begin(), x.end(), result.x);
  }
  if (root_.state == Relaxed::State::kPoint) {
    result.relaxed = root_.objective;
    if (result.relaxed_x != nullptr) std::copy(root_.x.begin(), root_.x.end(), result.relaxed_x);
  }
  if (result.text != nullptr && result.text_size > 0) {
    std::snprintf(result.text, result.text_size, "%s", text_.c_str());
  }
  result.seconds = budget_.Seconds();
}

}  // namespace switchyard::mip
