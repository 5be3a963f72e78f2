#include "solvers/rounding/general.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <exception>
#include <limits>
#include <optional>
#include <sstream>
#include <thread>

#include "solvers/rounding/bound.hpp"
#include "solvers/rounding/diving.hpp"
#include "solvers/rounding/verdict.hpp"
#include "switchyard/cones.hpp"
#include "switchyard/plugin.hpp"

namespace switchyard::rounding {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Rows and linear terms alone: a vertex of the relaxation is less fractional than its middle.
bool IsLinear(const sy_problem& p) {
  return p.P == nullptr && std::all_of(p.cones, p.cones + p.num_cones, [](const sy_cone& cone) {
           return cone.kind == SY_CONE_ZERO || cone.kind == SY_CONE_NONNEGATIVE;
         });
}

// What runs side by side: it knows the best point of what ran before.
constexpr int kWave = 4;

/// Of try k > 0 (0 is rounding to nearest), from the best point so far, its objective and the
/// bound. Rules, batches and what is asked of the objective go round at different paces, so that no
/// two tries are alike: below the best point's by so much of its distance from the bound.
DiveOptions PlanOf(std::size_t k, const std::vector<double>& guide, double objective,
                   double bound) {
  constexpr std::array kRules = {
      DiveRule::kFractional, DiveRule::kCoefficient, DiveRule::kDrawn, DiveRule::kGuided,
      DiveRule::kDrawn,      DiveRule::kCoefficient, DiveRule::kGuided};
  constexpr std::array kShares = {0.0, 0.1, 0.3, 0.5};
  constexpr double kLeast = 1e-6;
  DiveOptions dive;
  dive.rule = kRules[(k - 1) % kRules.size()];
  dive.noise = k > kWave ? 1 : 0;
  dive.batch = k % 3 == 1;
  if (guide.empty()) {
    if (dive.rule == DiveRule::kGuided) dive.rule = DiveRule::kDrawn;
    return dive;
  }
  dive.guide = &guide;
  dive.near_guide = k % 2 == 0;
  dive.cutoff = objective - kLeast * (1 + std::abs(objective));
  if (bound > -kInfinity) {
    dive.cutoff -= kShares[k % kShares.size()] * std::max(0.0, dive.cutoff - bound);
  }
  return dive;
}

/// One solve: what was found so far.
class GeneralRun {
 public:
  GeneralRun(const IntegerProblem& whole, const Options& options, const sy_host& host,
             const sy_control& control)
      : whole_(whole),
        p_(whole.problem()),
        options_(options),
        host_(host),
        budget_(control),
        domain_(whole) {}

  void Solve() {
    if (!Propagate()) return Finish(SY_INFEASIBLE, "no point: " + domain_.Contradiction());
    if (budget_.Stopped()) return Finish(budget_.reason(), "");
    Relax();
    if (whole_.integers().empty()) return Finish(TerminationOfRelaxation(), "");
    if (const auto end = EndOfRelaxation()) return Finish(*end, "");
    while (CanGoOn()) TryAWave();
    CloseTheBound();
    Finish(Verdict(), best_ < 0 ? ReasonOfFailure() : "");
  }

  void Write(sy_result& result);

 private:
  // Boxes that hold every integer point. Continuous problems are left as they are: their
  // contradictions have certificates.
  bool Propagate() {
    boxed_ = relaxation_ = p_;
    relaxation_.integer = nullptr;
    const bool some_point = domain_.Propagate();
    if (whole_.integers().empty()) return true;
    if (!some_point) return false;
    const Boxes& boxes = domain_.boxes();
    boxed_.x_lower = boxes.lower.data();
    boxed_.x_upper = boxes.upper.data();
    const auto n = static_cast<std::size_t>(p_.num_vars);
    x_lower_.assign(n, -kInfinity);
    x_upper_.assign(n, kInfinity);
    if (p_.x_lower != nullptr) x_lower_.assign(p_.x_lower, p_.x_lower + p_.num_vars);
    if (p_.x_upper != nullptr) x_upper_.assign(p_.x_upper, p_.x_upper + p_.num_vars);
    for (const std::int32_t j : whole_.integers()) {
      x_lower_[static_cast<std::size_t>(j)] = domain_.lower(j);
      x_upper_[static_cast<std::size_t>(j)] = domain_.upper(j);
    }
    relaxation_.x_lower = x_lower_.data();
    relaxation_.x_upper = x_upper_.data();
    return true;
  }

  [[nodiscard]] const sy_solver& Backend(std::int64_t instances, std::uint64_t updates) const {
    const char* names = options_.solver.empty() ? nullptr : options_.solver.c_str();
    const bool vertex = names == nullptr && !whole_.integers().empty() && IsLinear(p_);
    return FindBackend(host_, relaxation_, names, instances, updates,
                       vertex ? std::uint64_t{SY_GIVES_BASIS} : 0);
  }

  void Relax() {
    const double begin = budget_.Seconds();
    const sy_solver& solver = Backend(1, 0);
    relaxation_id_ = solver.id;
    relaxed_ = SolveBy(solver, host_, relaxation_, budget_.Part(budget_.control().threads));
    if (relaxed_.dual != SY_CERTIFICATE) {
      bound_ =
          std::max(ProvenBound(p_, relaxed_, kInfinity), ProvenBound(boxed_, relaxed_, kInfinity));
    }
    relaxation_seconds_ = budget_.Seconds() - begin;
    budget_.Tell(kNaN, bound_, nullptr);
  }

  [[nodiscard]] sy_termination TerminationOfRelaxation() {
    return relaxed_.termination == SY_INFEASIBLE ? JudgeContradiction() : relaxed_.termination;
  }

  /// The answer where the relaxation leaves nothing to round.
  std::optional<sy_termination> EndOfRelaxation() {
    if (relaxed_.termination == SY_INFEASIBLE) return JudgeContradiction();
    if (const auto end = EndOf(relaxed_, bound_, budget_)) return end;
    if (options_.dives == 0) return SY_NOT_SOLVED;
    return std::nullopt;
  }

  /// Only what is proven here is believed. A certificate goes along where it speaks of the problem
  /// as it came; it may need the propagated boxes.
  sy_termination JudgeContradiction() {
    const bool of_the_problem = ProvesInfeasible(p_, relaxed_);
    if (!of_the_problem) relaxed_.dual = SY_NO_POINT;
    if (of_the_problem || ProvesInfeasible(boxed_, relaxed_)) return SY_INFEASIBLE;
    relaxed_.text += " (a contradiction without a proof)";
    return SY_NUMERICAL_TROUBLE;
  }

  [[nodiscard]] bool CanGoOn() {
    if (static_cast<int>(tries_.size()) >= options_.dives || budget_.Stopped()) return false;
    if (best_ < 0) return true;
    const double objective = Best().objective;
    return !IsWithinTheGap(objective) && objective > budget_.control().target;
  }

  // In the order of the tries, whatever the order in which they end.
  void TryAWave() {
    const std::size_t first = tries_.size();
    const auto count =
        static_cast<std::size_t>(std::min(kWave, options_.dives - static_cast<int>(first)));
    tries_.resize(first + count);
    const sy_solver& solver = Backend(kWave, SY_UPDATES_BOUNDS);
    const Root root{whole_, relaxation_, domain_, relaxed_.x, solver, host_};
    const std::vector<double> guide = best_ < 0 ? std::vector<double>() : Best().x;
    const double objective = best_ < 0 ? kInfinity : Best().objective;
    std::atomic<std::size_t> next = first;
    const auto work = [&] {
      for (std::size_t k = next++; k < first + count; k = next++) {
        tries_[k] = TryOne(root, k, guide, objective);
      }
    };
    const auto workers =
        std::min(count, static_cast<std::size_t>(std::max(1, budget_.control().threads)));
    {
      std::vector<std::jthread> others;
      for (std::size_t w = 1; w < workers; ++w) others.emplace_back(work);
      work();
    }
    for (std::size_t k = first; k < tries_.size(); ++k) KeepTheBest(k);
  }

  /// Never throws: what fails is the try's reason.
  Try TryOne(const Root& root, std::size_t k, const std::vector<double>& guide,
             double objective) noexcept {
    try {
      if (k == 0) return RoundToNearest(root, budget_);
      DiveOptions dive = PlanOf(k, guide, objective, bound_);
      dive.seed = budget_.control().seed + k;
      return Dive(root, dive, budget_);
    } catch (const std::exception& e) {
      Try failed;
      failed.text = e.what();
      return failed;
    }
  }

  // Of all points only the best one stays.
  void KeepTheBest(std::size_t k) {
    Try& one = tries_[k];
    if (!one.feasible) return;
    ++num_feasible_;
    if (best_ >= 0 && one.objective >= Best().objective) return one.x.clear();
    if (best_ >= 0) tries_[static_cast<std::size_t>(best_)].x.clear();
    best_ = static_cast<std::int64_t>(k);
    budget_.Tell(one.objective, bound_, one.x.data());
  }

  [[nodiscard]] const Try& Best() const { return tries_[static_cast<std::size_t>(best_)]; }

  // The best objective makes boxes narrower, or finite.
  void CloseTheBound() {
    if (best_ < 0 || IsWithinTheGap(Best().objective)) return;
    bound_ = std::max(bound_, ProvenBound(boxed_, relaxed_, Best().objective));
  }

  [[nodiscard]] bool IsWithinTheGap(double objective) const {
    return rounding::IsWithinTheGap(budget_.control(), objective, bound_);
  }

  [[nodiscard]] sy_termination Verdict() const {
    return rounding::Verdict(budget_, best_ >= 0 ? &Best().objective : nullptr, bound_);
  }

  [[nodiscard]] std::string ReasonOfFailure() const {
    if (tries_.empty()) return "";
    return "rounding: " + tries_.front().text +
           (tries_.size() > 1 ? "; the last dive: " + tries_.back().text : "");
  }

  void Finish(sy_termination termination, const std::string& why) {
    termination_ = termination;
    std::ostringstream text;
    if (!relaxation_id_.empty()) {
      text << "relaxation by " << relaxation_id_ << " in " << relaxation_seconds_ << " s";
      if (!tries_.empty()) {
        text << "; " << num_feasible_ << " of " << tries_.size()
             << (tries_.size() == 1 ? " try" : " tries") << " (rounding, then dives) gave a point";
      } else if (!relaxed_.text.empty()) {
        text << ": " << relaxed_.text;
      }
    }
    if (!why.empty()) text << (text.tellp() > 0 ? "; " : "") << why;
    text_ = text.str();
  }

  void WriteDuals(sy_result& result) const;

  const IntegerProblem& whole_;
  const sy_problem& p_;
  const Options& options_;
  const sy_host& host_;
  Budget budget_;

  Domain domain_;
  std::vector<double> x_lower_, x_upper_;  // of the relaxation, where there are integers
  sy_problem relaxation_{};
  sy_problem boxed_{};  // the problem with the propagated boxes for bounds
  Answer relaxed_;
  std::string relaxation_id_;
  double relaxation_seconds_ = 0;
  double bound_ = -kInfinity;
  std::vector<Try> tries_;
  std::int64_t best_ = -1;  // of tries_
  int num_feasible_ = 0;
  sy_termination termination_ = SY_NOT_SOLVED;
  std::string text_;
};

void Put(const std::vector<double>& from, double* to) {
  if (to != nullptr) std::copy(from.begin(), from.end(), to);
}

void GeneralRun::Write(sy_result& result) {
  result.termination = termination_;
  result.primal = result.dual = SY_NO_POINT;
  result.objective = result.relaxed = kNaN;
  result.bound = bound_;
  result.iterations = relaxed_.iterations;
  result.nodes = 0;
  for (const Try& one : tries_) {
    result.iterations += one.iterations;
    result.nodes += one.relaxations;
  }
  if (best_ >= 0) {
    result.primal = SY_FEASIBLE;
    result.objective = Best().objective;
    Put(Best().x, result.x);
  }
  if (IsPoint(relaxed_.primal) && !whole_.integers().empty()) {
    result.relaxed = Objective(p_, relaxed_.x.data());
    Put(relaxed_.x, result.relaxed_x);
  }
  WriteDuals(result);
  if (result.text != nullptr && result.text_size > 0) {
    std::snprintf(result.text, result.text_size, "%s", text_.c_str());
  }
  result.seconds = budget_.Seconds();
}

/// A certificate, and all of the relaxation's answer where the problem is its relaxation.
void GeneralRun::WriteDuals(sy_result& result) const {
  const bool continuous = whole_.integers().empty();
  if (continuous) {
    result.primal = relaxed_.primal;
    if (IsPoint(relaxed_.primal)) result.objective = Objective(p_, relaxed_.x.data());
    if (relaxed_.primal != SY_NO_POINT) Put(relaxed_.x, result.x);
  }
  const bool certificate = termination_ == SY_INFEASIBLE && relaxed_.dual == SY_CERTIFICATE;
  if (!continuous && !certificate) return;
  result.dual = relaxed_.dual;
  if (relaxed_.dual == SY_NO_POINT) return;
  Put(relaxed_.x_dual, result.x_dual);
  Put(relaxed_.row_dual, result.row_dual);
  Put(relaxed_.cone_dual, result.cone_dual);
}

}  // namespace

void SolveGeneral(const IntegerProblem& whole, const Options& options, const sy_host& host,
                  const sy_control& control, sy_result& result) {
  GeneralRun run(whole, options, host, control);
  run.Solve();
  run.Write(result);
}

}  // namespace switchyard::rounding
