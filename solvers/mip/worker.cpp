#include "solvers/mip/worker.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solvers/mip/neighborhood.hpp"
#include "solvers/mip/path_branching.hpp"
#include "solvers/mip/path_costs.hpp"
#include "solvers/mip/path_pricing.hpp"

namespace switchyard::mip {
namespace {

using State = Relaxed::State;

std::size_t At(std::int32_t j) { return static_cast<std::size_t>(j); }

// What trouble leaves where there is no point goes as far as the tolerance lets it: with an integer
// that switches a cone's head off, far.
constexpr double kFine = 1e-8;
constexpr int kIntegralRounds = 20;  // of cuts at a point whose integers are whole
constexpr std::int64_t kNodesOfARound = 8;
constexpr int kShortPlunge = 4;  // children, whatever the bound
constexpr double kFarFromTheBest = 0.3;

std::unique_ptr<Engine> MakeEngine(const Instance& instance, rounding::Budget& budget) {
  if (instance.outer_nodes) {
    return std::make_unique<OuterEngine>(*instance.outer, *instance.linear, instance.host, budget);
  }
  return std::make_unique<ConicEngine>(instance.problem(), instance.relaxation(), *instance.conic,
                                       instance.host, budget);
}

}  // namespace

Worker::Worker(const Instance& instance, Ledger ledger)
    : instance_(instance),
      ledger_(std::move(ledger)),
      workspace_(instance.propagator),
      engine_(MakeEngine(instance, ledger_.budget())),
      boxes_(instance.root),
      mark_(boxes_.Now()) {
  path_options_.solver = instance.options.solver;
}

bool Worker::Enter(const Node& node) {
  boxes_ = node.base != nullptr ? *node.base : instance_.root;
  EachDecision(node,
               [&](const VariableBox& box) { boxes_.Impose(box.variable, box.lower, box.upper); });
  return !boxes_.contradiction();
}

void Worker::Plunge(NodePointer node) {
  node_ = std::move(node);
  bound_ = node_->bound;
  length_ = 0;
  mark_ = boxes_.Now();
  if (!Enter(*node_)) return ledger_.Done();
  mark_ = boxes_.Now();
  while (Look()) {
  }
}

// False: the boxes hold nothing below the cutoff.
bool Worker::Propagate() {
  const bool left = instance_.propagator.Propagate(boxes_, workspace_, cutoff_);
  if (!left || instance_.paths == nullptr) return left;
  return PropagatePaths(*instance_.paths, boxes_) &&
         instance_.propagator.Propagate(boxes_, workspace_, cutoff_);
}

// The node at hand; is there another one to go on with?
bool Worker::Look() {
  if (ledger_.Stopped()) return false;  // what is held stays part of the bound
  cutoff_ = ledger_.cutoff();
  const auto close = [&](double bound) {
    ledger_.Close(bound);
    ledger_.Done();
    return false;
  };
  if (bound_ >= cutoff_) return close(bound_);
  if (!Propagate()) return close(cutoff_);
  const bool root = node_->depth == 0;
  Relaxed relaxed = Relax(root ? instance_.options.cut_rounds : instance_.options.node_rounds);
  if (relaxed.state == State::kStopped) return false;
  LearnFrom(relaxed);
  if (Judge(relaxed) != End::kClosed) return true;
  ledger_.Done();
  return false;
}

// Points that others found, too, say where cuts are needed.
Relaxed Worker::Relax(int rounds) {
  for (std::vector<double>& x : ledger_.NewPoints()) {
    engine_->See(x);
    best_x_ = std::move(x);
  }
  if (node_->depth == 0 && cutoff_ == kInfinity && !took_root_ && instance_.relaxed != nullptr) {
    took_root_ = true;
    ledger_.CountNode(0);
    return *instance_.relaxed;
  }
  Relaxed relaxed = engine_->Solve(boxes_, cutoff_, rounds);
  if (relaxed.state == State::kTrouble && !ledger_.Stopped()) relaxed = RelaxOtherwise();
  ledger_.CountNode(relaxed.iterations);
  return relaxed;
}

// A node of which one engine proves nothing may be plain to the other.
Relaxed Worker::RelaxOtherwise() {
  if (instance_.outer_nodes) return SolveFixed({});
  if (instance_.outer == nullptr) return {};
  if (!spare_) {
    spare_.emplace(*instance_.outer, *instance_.linear, instance_.host, ledger_.budget());
  }
  return spare_->Solve(boxes_, cutoff_, kIntegralRounds);
}

void Worker::LearnFrom(const Relaxed& relaxed) {
  const Step& step = node_->step;
  if (step.variable < 0) return;
  const bool nothing = relaxed.state == State::kEmpty || relaxed.state == State::kCutoff;
  const double to = nothing ? cutoff_ : relaxed.bound.value;
  if (std::isfinite(to) && std::isfinite(step.from)) ledger_.See(step, to - step.from);
}

Worker::End Worker::Judge(Relaxed& relaxed) {
  if (relaxed.state == State::kEmpty || relaxed.state == State::kCutoff) {
    ledger_.Close(cutoff_);
    return End::kClosed;
  }
  bound_ = std::max(bound_, std::min(cutoff_, relaxed.bound.value));
  ledger_.Holds(bound_);
  if (relaxed.state == State::kPoint) return JudgePoint(relaxed);
  if (auto split = SplitAnywhere(instance_.whole, boxes_, {})) {
    return Descend(std::move(*split)) ? End::kSplit : End::kClosed;
  }
  JudgeLeaf(relaxed);
  return End::kClosed;
}

// Of a path problem where many arcs are open, their blocks are priced, too.
void Worker::NarrowByReducedCosts(const Relaxed& relaxed, double cutoff) {
  constexpr std::int64_t kMany = 64;
  const sy_problem& problem = instance_.problem();
  const auto impose = [&](const std::vector<VariableBox>& narrower) {
    for (const VariableBox& t : narrower) boxes_.Impose(t.variable, t.lower, t.upper);
  };
  const auto along_paths = [&](const NodeBound& bound) {
    return ByPathCosts(*instance_.paths, bound, cutoff, boxes_.lower(), boxes_.upper());
  };
  impose(ByReducedCosts(problem, relaxed.bound, cutoff, boxes_.lower(), boxes_.upper()));
  if (instance_.paths == nullptr || !(cutoff < kInfinity)) return;
  impose(along_paths(relaxed.bound));
  const sy_paths& paths = instance_.paths->paths();
  const auto open = std::count_if(paths.flow, paths.flow + paths.num_arcs,
                                  [&](std::int32_t j) { return boxes_.upper(j) >= 1; });
  if (open < kMany || relaxed.duals.row.empty()) return;
  const rounding::Duals priced = WithPricedBlocks(
      *instance_.paths, relaxed.duals, boxes_, *instance_.conic, instance_.host, ledger_.budget());
  impose(along_paths(BoundFrom(problem, priced, boxes_.lower(), boxes_.upper())));
}

Worker::End Worker::JudgePoint(Relaxed& relaxed) {
  NarrowByReducedCosts(relaxed, cutoff_);
  if (boxes_.contradiction()) {
    ledger_.Close(cutoff_);
    return End::kClosed;
  }
  if (FractionalIn(instance_.whole, boxes_, relaxed.x, kFeasible).empty()) {
    return JudgeIntegral(relaxed);
  }
  TryPaths(relaxed.x);
  TryRounding(relaxed.x);
  TryNear(relaxed.x);
  if (bound_ >= ledger_.cutoff()) {
    ledger_.Close(bound_);
    return End::kClosed;
  }
  if (ledger_.cutoff() < cutoff_) NarrowByReducedCosts(relaxed, ledger_.cutoff());
  if (boxes_.contradiction()) {
    ledger_.Close(ledger_.cutoff());
    return End::kClosed;
  }
  // Until there is a point, down is the way: what children would gain is asked at the root alone.
  const bool may_glance = node_->depth == 0 || ledger_.best() < kInfinity;
  const SplitContext context{instance_.whole,    instance_.options, instance_.propagator,
                             workspace_,         *engine_,          ledger_.budget(),
                             instance_.priority, instance_.paths,   !instance_.outer_nodes,
                             may_glance};
  Lookahead lookahead;
  std::optional<Split> split =
      ChooseSplit(context, boxes_, relaxed, cutoff_, ledger_.Learned(), lookahead);
  for (const Step& step : lookahead.seen) ledger_.See(step, step.from);
  if (lookahead.empty) {
    ledger_.Close(cutoff_);
    return End::kClosed;
  }
  if (lookahead.tightened || ledger_.Stopped()) return End::kAgain;
  if (!split) split = SplitAnywhere(instance_.whole, boxes_, relaxed.x);
  if (!split) return End::kAgain;  // below a point that was found now, all integers are fixed
  return Descend(std::move(*split)) ? End::kSplit : End::kClosed;
}

void Worker::GiveUp(double bound) {
  auto rest = std::make_shared<Node>();
  rest->parent = node_;
  rest->decided = Decided();
  rest->bound = bound;
  rest->depth = node_->depth;
  ledger_.GiveUp(std::move(rest));
}

bool Worker::IsFixed() const {
  const auto& integers = instance_.whole.integers();
  return std::all_of(integers.begin(), integers.end(),
                     [&](std::int32_t j) { return boxes_.IsFixed(j); });
}

// All integers are whole. Their best rest is a point; then, below what it costs, boxes are narrower
// and the relaxation is solved again. Where that still has whole integers, and is an outer one, it
// went too low: cuts.
Worker::End Worker::JudgeIntegral(Relaxed& relaxed) {
  Relaxed rest;
  if (instance_.has_continuous || instance_.problem().num_cones > 0) rest = SolveFixed(relaxed.x);
  if (rest.state == State::kPoint) {
    engine_->See(rest.x);
  } else {
    TryPoint(relaxed.x, instance_.outer_nodes ? kFeasible : kFine);
  }
  if (ledger_.cutoff() < cutoff_) return End::kAgain;
  if (IsFixed()) {
    if (rest.state == State::kTrouble) rest = RelaxOtherwise();
    JudgeLeaf(rest);
    return End::kClosed;
  }
  if (instance_.outer_nodes) {
    relaxed = engine_->Solve(boxes_, cutoff_, kIntegralRounds);
    ledger_.CountNode(relaxed.iterations);
    if (relaxed.state == State::kStopped) return End::kAgain;
    if (relaxed.state == State::kEmpty || relaxed.state == State::kCutoff) {
      ledger_.Close(cutoff_);
      return End::kClosed;
    }
    bound_ = std::max(bound_, std::min(cutoff_, relaxed.bound.value));
    ledger_.Holds(bound_);
    const bool fractional = relaxed.state == State::kPoint &&
                            !FractionalIn(instance_.whole, boxes_, relaxed.x, kFeasible).empty();
    if (fractional) return JudgePoint(relaxed);
    if (relaxed.state == State::kPoint) TryPoint(relaxed.x);
  }
  auto split = SplitAnywhere(instance_.whole, boxes_, relaxed.x);
  return Descend(std::move(*split)) ? End::kSplit : End::kClosed;
}

// The last word on a node whose integers are fixed. What the backend does not tell as finely as it
// can it may tell of the same problem in the boxes of all variables, which are other numbers to it.
void Worker::JudgeLeaf(const Relaxed& rest) {
  const auto proven_by = [&](const Relaxed& relaxed) {
    const bool nothing = relaxed.state == State::kEmpty || relaxed.state == State::kCutoff;
    return nothing ? cutoff_ : relaxed.bound.value;
  };
  double proven = std::max(bound_, proven_by(rest));
  for (const bool in_all_boxes : {false, true}) {
    if (proven >= ledger_.cutoff() || ledger_.Stopped()) break;
    const Relaxed fine = Fixed().SolveFinely(boxes_, cutoff_, in_all_boxes);
    if (fine.state == State::kPoint) TryRest(fine.x);
    proven = std::max(proven, proven_by(fine));
  }
  if (proven >= ledger_.cutoff()) {
    ledger_.Close(proven);
  } else {
    GiveUp(proven);
  }
}

// What trouble left counts where it holds finely.
void Worker::TryRest(const std::vector<double>& x) {
  TryPoint(x, Fixed().last_termination() == SY_OPTIMAL ? kFeasible : kFine);
}

ConicEngine& Worker::Fixed() {
  if (!fixed_) {
    fixed_.emplace(instance_.problem(), instance_.relaxation(), *instance_.conic, instance_.host,
                   ledger_.budget());
  }
  return *fixed_;
}

void Worker::TryPoint(std::vector<double> x, double tolerance) {
  for (const std::int32_t j : instance_.whole.integers()) x[At(j)] = std::round(x[At(j)]);
  const double objective = Objective(instance_.problem(), x.data());
  if (!(objective < ledger_.best())) return;
  if (!instance_.whole.WhatIsViolatedBy(x, tolerance).empty()) return;
  ledger_.Offer(objective, x);
}

Relaxed Worker::SolveFixed(const std::vector<double>& x) {
  const NodeBoxes::Mark mark = boxes_.Now();
  std::vector<double> integers;
  for (const std::int32_t j : instance_.whole.integers()) {
    if (x.empty()) break;
    const double whole = std::clamp(std::round(x[At(j)]), boxes_.lower(j), boxes_.upper(j));
    integers.push_back(whole);
    boxes_.Impose(j, whole, whole);
  }
  Relaxed rest;
  rest.state = State::kEmpty;
  const bool is_new = x.empty() || solved_.insert(integers).second || IsFixed();
  if (is_new && instance_.propagator.Propagate(boxes_, workspace_, cutoff_)) {
    rest = Fixed().Solve(boxes_, cutoff_, 0);
    if (rest.state == State::kPoint && !x.empty()) TryRest(rest.x);
  }
  boxes_.UndoTo(mark);
  return rest;
}

// The likeliest path of the relaxed flow, and at the root some that are drawn.
void Worker::TryPaths(const std::vector<double>& x) {
  if (instance_.paths == nullptr || instance_.options.dives == 0) return;
  const bool root = node_->depth == 0;
  constexpr std::int64_t kEvery = 4;
  if (!root && ledger_.nodes() % kEvery != 0) return;
  const std::size_t before = paths_.size();
  rounding::AddLikeliest(*instance_.paths, x, path_options_, paths_);
  if (root) {
    Random random(ledger_.budget().control().seed);
    int trials = path_options_.trials;
    rounding::SampleCandidates(*instance_.paths, x, path_options_,
                               static_cast<std::size_t>(path_options_.paths), random, trials,
                               paths_);
  }
  if (paths_.size() == before) return;
  rounding::SolveCandidates(*instance_.paths, instance_.host, path_options_, 1, ledger_.budget(),
                            paths_);
  for (std::size_t k = before; k < paths_.size(); ++k) {
    if (paths_[k].verified) ledger_.Offer(paths_[k].objective, paths_[k].x);
    paths_[k].x.clear();
  }
}

// Integers to the nearest values, each followed by propagation; then the rest.
void Worker::TryRounding(const std::vector<double>& x) {
  if (instance_.paths != nullptr || instance_.options.dives == 0) return;
  const std::int64_t every = ledger_.best() < kInfinity ? 100 : 10;
  if (ledger_.nodes() % every != 1) return;
  const NodeBoxes::Mark mark = boxes_.Now();
  std::vector<std::pair<double, std::int32_t>> order;
  for (const std::int32_t j : instance_.whole.integers()) {
    order.emplace_back(std::abs(x[At(j)] - std::round(x[At(j)])), j);
  }
  std::sort(order.begin(), order.end());
  bool left = true;
  for (const auto& [distance, j] : order) {
    if (boxes_.IsFixed(j)) continue;
    const double v = std::clamp(std::round(x[At(j)]), boxes_.lower(j), boxes_.upper(j));
    boxes_.Impose(j, v, v);
    left = instance_.propagator.Propagate(boxes_, workspace_, cutoff_);
    if (!left) break;
  }
  std::vector<double> rounded;
  if (left) {
    rounded = x;
    for (const std::int32_t j : instance_.whole.integers()) rounded[At(j)] = boxes_.lower(j);
  }
  boxes_.UndoTo(mark);
  if (left) SolveFixed(rounded);
}

// After 8, 16, 32, ... nodes, where the gap is no small one.
void Worker::TryNear(const std::vector<double>& x) {
  if (instance_.paths != nullptr || instance_.options.dives == 0) return;
  if (ledger_.nodes() < near_at_ || best_x_.empty()) return;
  near_at_ = 2 * ledger_.nodes();
  constexpr double kLarge = 1e-3;
  if (ledger_.best() - bound_ <= kLarge * std::abs(ledger_.best())) return;
  for (const Solution& found :
       SearchNear(instance_, x, best_x_, ledger_.cutoff(), ledger_.budget())) {
    TryPoint(found.x);
  }
}

// Of integers, since the node began: the continuous ones follow.
std::vector<VariableBox> Worker::Decided() const {
  std::vector<std::int32_t> changed;
  for (const VariableBox& old : boxes_.ChangesSince(mark_)) {
    if (boxes_.IsInteger(old.variable)) changed.push_back(old.variable);
  }
  std::sort(changed.begin(), changed.end());
  changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
  std::vector<VariableBox> decided;
  for (const std::int32_t j : changed) decided.push_back({j, boxes_.lower(j), boxes_.upper(j)});
  return decided;
}

bool Worker::IsWorthGoingOn() const {
  if (ledger_.in_rounds() && ledger_.nodes_of_round() >= kNodesOfARound) return false;
  if (length_ < kShortPlunge || !(cutoff_ < kInfinity)) return true;
  const double least = ledger_.Bound();
  if (!std::isfinite(least)) return true;
  return bound_ - least <= kFarFromTheBest * (cutoff_ - least);
}

// Into the child to look at first; the other is open. False: the plunge ends here, both are open.
bool Worker::Descend(Split split) {
  std::shared_ptr<const NodeBoxes> base = node_->base;
  if (node_->depth == 0 && Propagate()) {
    auto narrowed = std::make_shared<NodeBoxes>(boxes_);
    narrowed->Commit();
    base = std::move(narrowed);
  }
  const std::vector<VariableBox> decided = Decided();
  NodePointer nodes[2];
  for (const int side : {0, 1}) {
    auto child = std::make_shared<Node>();
    child->parent = node_;
    child->decided = decided;
    child->base = base;
    Child& given = split.children[side];
    child->decided.insert(child->decided.end(), given.decided.begin(), given.decided.end());
    child->bound = bound_;
    child->depth = node_->depth + 1;
    child->step = given.step;
    child->step.from = bound_;
    nodes[side] = std::move(child);
  }
  ledger_.Push(nodes[1 - split.first]);
  if (!IsWorthGoingOn()) {
    ledger_.Push(nodes[split.first]);
    return false;
  }
  ++length_;
  node_ = nodes[split.first];
  mark_ = boxes_.Now();
  for (const VariableBox& box : split.children[split.first].decided) {
    boxes_.Impose(box.variable, box.lower, box.upper);
  }
  return true;
}

}  // namespace switchyard::mip
