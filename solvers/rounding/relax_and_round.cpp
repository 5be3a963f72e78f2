#include "solvers/rounding/relax_and_round.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <sstream>

#include "solvers/rounding/bound.hpp"
#include "solvers/rounding/general.hpp"
#include "solvers/rounding/path_search.hpp"
#include "solvers/rounding/tightened.hpp"
#include "solvers/rounding/verdict.hpp"
#include "solvers/rounding/vertex_hull.hpp"
#include "switchyard/plugin.hpp"
#include "switchyard/problem.hpp"

namespace switchyard::rounding {
namespace {

constexpr double kDetached = 1e-3;  // flow that no inner point leaves
constexpr double kViolated = 1e-5;  // by a cut: relative to its terms
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// One solve: what was found so far.
class Run {
 public:
  Run(const PathProblem& whole, const Options& options, const sy_host& host, Budget& budget)
      : whole_(whole),
        p_(whole.problem()),
        options_(options),
        host_(host),
        budget_(budget),
        search_(whole, options, host, budget) {}

  void Solve() {
    if (!TargetIsReached()) return Finish(SY_INFEASIBLE, "no arcs lead from source to target");
    if (budget_.Stopped()) return Finish(budget_.reason(), "");
    Relax();
    if (const auto end = EndOfRelaxation()) return Finish(*end, "");
    search_.Run(relaxed_.x, BoundsPaths() ? bound_ : -kInfinity);
    if (search_.NumTried() == 0 && budget_.Stopped()) return Finish(budget_.reason(), "");
    if (search_.NumTried() == 0) {
      return Finish(SY_NO_PATH, "the relaxed flow holds no path from source to target");
    }
    KeepTheBest();
    Finish(Verdict(), ReasonOfFailure());
  }

  void Write(sy_result& result) const;

 private:
  [[nodiscard]] bool TargetIsReached() const {
    const auto reached = Reached(whole_.arcs(), whole_.out(), whole_.paths().source);
    return reached[static_cast<std::size_t>(whole_.paths().target)] != 0;
  }

  // The relaxation; then, while its flow uses both directions between vertices as no path does, and
  // its likeliest path is not yet good enough, the same with the rows against that.
  void Relax() {
    const double begin = budget_.Seconds();
    SolveRelaxation(whole_.relaxation());
    if (options_.cut_rounds > 0 && Tightened::Serves(whole_)) Tighten();
    CloseTheBound();
    relaxation_seconds_ = budget_.Seconds() - begin;
    budget_.Tell(kNaN, bound_, nullptr);
    TellRelaxation();
  }

  void Tighten() {
    Tightened tightened(whole_);
    const VertexHull hull(whole_, host_, options_, budget_);
    for (int round = 0; round < options_.cut_rounds && CanBeTightened(); ++round) {
      const int detached = tightened.AddDetached(relaxed_.x, kDetached);
      int added = detached + tightened.AddTwoCycles(relaxed_.x, kViolated, MostDim());
      if (added == 0 && options_.hulls != 0) added = AddHulls(hull, tightened);
      if (added == 0 || LikeliestPathWillDo()) break;
      tightened.Rebuild();
      const double before = Objective(p_, relaxed_.x.data());
      if (!SolveTightened(tightened)) break;
      ++rounds_;
      const double gain = Objective(p_, relaxed_.x.data()) - before;
      if (detached == 0 && gain <= LeastGain(before)) break;
    }
  }

  // Where points have many coordinates, so has a two-cycle many rows, each of which says little:
  // the bound alone may be worth it.
  [[nodiscard]] std::int32_t MostDim() const {
    return options_.paths == 0 ? std::numeric_limits<std::int32_t>::max() : options_.cut_dimension;
  }

  int AddHulls(const VertexHull& hull, Tightened& tightened) {
    int added = 0;
    for (std::int32_t v = 0; v < whole_.paths().num_vertices && !budget_.Stopped(); ++v) {
      if (!hull.Asks(v, relaxed_.x)) continue;
      const auto row = hull.Cut(v, relaxed_.x, kViolated);
      if (row.empty()) continue;
      tightened.AddRow(row);
      ++added;
    }
    tightened.Count(added);
    return added;
  }

  /// Is the path that the flow draws most often within the gap of the bound? It stays a candidate.
  bool LikeliestPathWillDo() {
    if (options_.paths == 0 || whole_.paths().solve_path != nullptr) return false;
    const Candidate* likeliest = search_.TryLikeliest(relaxed_.x);
    return likeliest != nullptr && likeliest->feasible && IsWithinTheGap(likeliest->objective);
  }

  /// What a round must add to the relaxation for another one to be worth it: where there is a path,
  /// a part of what lies between.
  [[nodiscard]] double LeastGain(double relaxed) const {
    constexpr double kOfValue = 1e-5, kOfGap = 0.05;
    double least = kOfValue * (1 + std::abs(relaxed));
    for (const Candidate& c : search_.candidates()) {
      if (c.feasible) least = std::max(least, kOfGap * (c.objective - relaxed));
    }
    return least;
  }

  [[nodiscard]] bool IsWithinTheGap(double objective) const {
    return rounding::IsWithinTheGap(budget_.control(), objective, bound_);
  }

  void SolveRelaxation(const sy_problem& relaxation) {
    const char* names = options_.solver.empty() ? nullptr : options_.solver.c_str();
    const sy_solver& solver = FindBackend(host_, relaxation, names, 1);
    relaxation_id_ = solver.id;
    relaxed_ = SolveBy(solver, host_, relaxation, budget_.Part(budget_.control().threads));
    if (relaxed_.dual != SY_CERTIFICATE) bound_ = ProvenBound(p_, relaxed_, kInfinity);
  }

  /// What a front end's own restrictions cost may be less than what this problem says.
  [[nodiscard]] bool BoundsPaths() const {
    return whole_.paths().solve_path == nullptr || (whole_.paths().flags & SY_PATHS_BOUND) != 0;
  }

  [[nodiscard]] bool CanBeTightened() {
    return IsPoint(relaxed_.primal) && relaxed_.termination == SY_OPTIMAL && !budget_.Stopped();
  }

  /// What a limit or trouble leaves of a tightened relaxation is no better than what was there; but
  /// its bound may be.
  bool SolveTightened(const Tightened& tightened) {
    const Problem problem(tightened.problem());
    const char* names = options_.solver.empty() ? nullptr : options_.solver.c_str();
    const sy_solver& solver = FindBackend(host_, tightened.relaxation(), names, 1);
    Answer answer = SolveBy(solver, host_, tightened.relaxation(),
                            budget_.Part(budget_.control().threads), &relaxed_);
    answer.iterations += relaxed_.iterations;
    if (answer.dual == SY_CERTIFICATE) return JudgeTightened(problem.view(), answer);
    bound_ = std::max(bound_, ProvenBound(problem.view(), answer, kInfinity));
    if (!IsPoint(answer.primal) || answer.termination != SY_OPTIMAL) return false;
    num_cuts_ = tightened.num_cuts();
    relaxed_ = std::move(answer);
    tightened_ = problem;
    return true;
  }

  // No path keeps rows that every path keeps: there is none. The certificate speaks of more rows
  // than the problem has, so it is judged here and goes no further.
  bool JudgeTightened(const sy_problem& problem, const Answer& certificate) {
    if (!ProvesInfeasible(problem, certificate)) return false;
    relaxed_.termination = SY_INFEASIBLE;
    relaxed_.dual = SY_NO_POINT;
    relaxed_.text = "the relaxation with the rows against two-cycles is infeasible, proven";
    contradiction_ = true;
    return false;
  }

  void TellRelaxation() const {
    const sy_paths& paths = whole_.paths();
    if (paths.tried == nullptr) return;
    std::string text = relaxation_id_;
    sy_result told{};
    told.size = sizeof told;
    told.termination = relaxed_.termination;
    told.objective = kNaN;
    told.relaxed = IsPoint(relaxed_.primal) ? Objective(p_, relaxed_.x.data()) : kNaN;
    std::vector<double> point;
    if (IsPoint(relaxed_.primal)) {
      point.assign(relaxed_.x.begin(), relaxed_.x.begin() + p_.num_vars);  // without cuts'
      told.relaxed_x = point.data();
    }
    told.bound = bound_;
    told.iterations = relaxed_.iterations;
    told.seconds = relaxation_seconds_;
    told.text = text.data();
    told.text_size = text.size() + 1;
    paths.tried(paths.context, nullptr, 0, &told);
  }

  /// The answer where the relaxation leaves nothing to round.
  std::optional<sy_termination> EndOfRelaxation() {
    if (relaxed_.termination == SY_INFEASIBLE) return JudgeContradiction();
    if (const auto end = EndOf(relaxed_, bound_, budget_)) return end;
    if (options_.paths == 0) return SY_NOT_SOLVED;
    return std::nullopt;
  }

  /// A contradiction is believed where it is proven here, or where its certificate goes along for
  /// whoever reads the answer.
  sy_termination JudgeContradiction() {
    if (contradiction_ || relaxed_.dual == SY_CERTIFICATE || ProvesInfeasible(p_, relaxed_)) {
      return SY_INFEASIBLE;
    }
    relaxed_.text += " (a contradiction without a proof)";
    return SY_NUMERICAL_TROUBLE;
  }

  // In the order of the paths, whatever the order in which they were solved.
  void KeepTheBest() {
    for (const Candidate& c : search_.candidates()) {
      if (!c.tried) continue;
      if (c.feasible && (best_ == nullptr || c.objective < best_->objective)) {
        best_ = &c;
        budget_.Tell(c.objective, bound_, c.verified ? c.x.data() : nullptr);
      }
      TellFrontEnd(c);
    }
  }

  void TellFrontEnd(const Candidate& c) const {
    const sy_paths& paths = whole_.paths();
    if (paths.tried == nullptr) return;
    std::string text = c.text;
    sy_result told{};
    told.size = sizeof told;
    told.termination = c.termination;
    told.primal = c.feasible ? SY_FEASIBLE : SY_NO_POINT;
    told.objective = c.feasible ? c.objective : kNaN;
    told.relaxed = kNaN;
    told.bound = -kInfinity;
    told.iterations = c.iterations;
    told.text = text.data();
    told.text_size = text.size() + 1;
    paths.tried(paths.context, c.path.data(), static_cast<std::int32_t>(c.path.size()), &told);
  }

  // What costs no more than the relaxed point lies in narrower boxes, or in finite ones; what costs
  // more is bounded by that. Where the duals are good, the bound needs none of that.
  void CloseTheBound() {
    constexpr double kGood = 5e-7, kSlack = 1e-6;
    if (!IsPoint(relaxed_.primal) || relaxed_.dual == SY_CERTIFICATE) return;
    const double relaxed = Objective(p_, relaxed_.x.data());
    const double size = 1 + std::abs(relaxed);
    if (relaxed - bound_ <= kGood * size) return;
    const sy_problem& problem = num_cuts_ > 0 ? tightened_.view() : p_;
    bound_ = std::max(bound_, ProvenBound(problem, relaxed_, relaxed + kSlack * size));
  }

  [[nodiscard]] sy_termination Verdict() const {
    return rounding::Verdict(budget_, best_ != nullptr ? &best_->objective : nullptr, bound_);
  }

  [[nodiscard]] std::string ReasonOfFailure() const {
    if (best_ != nullptr) return "";
    const auto& all = search_.candidates();
    const auto found =
        std::find_if(all.begin(), all.end(), [](const Candidate& c) { return c.tried; });
    const Candidate& first = *found;
    return "the first path: " + (first.text.empty() ? "no feasible point" : first.text);
  }

  void Finish(sy_termination termination, const std::string& why) {
    termination_ = termination;
    std::ostringstream text;
    if (!relaxation_id_.empty()) {
      text << "relaxation by " << relaxation_id_ << " in " << relaxation_seconds_ << " s";
      if (num_cuts_ > 0) text << " with " << num_cuts_ << " cuts in " << rounds_ << " rounds";
      if (const std::size_t tried = search_.NumTried(); tried > 0) {
        text << "; " << search_.NumFeasible() << " of " << tried << " paths feasible";
        const std::size_t compared = search_.candidates().size() - tried;
        if (compared > 0) text << ", " << compared << " more compared";
      } else if (!relaxed_.text.empty()) {
        text << ": " << relaxed_.text;
      }
    }
    if (!why.empty()) text << (text.tellp() > 0 ? "; " : "") << why;
    text_ = text.str();
  }

  const PathProblem& whole_;
  const sy_problem& p_;
  const Options& options_;
  const sy_host& host_;
  Budget& budget_;

  Answer relaxed_;
  std::string relaxation_id_;
  double relaxation_seconds_ = 0;
  Problem tightened_;  // the last one that was solved
  int num_cuts_ = 0, rounds_ = 0;
  bool contradiction_ = false;  // proven, of the tightened relaxation
  double bound_ = -kInfinity;
  PathSearch search_;
  const Candidate* best_ = nullptr;
  sy_termination termination_ = SY_NOT_SOLVED;
  std::string text_;
};

void Put(const std::vector<double>& from, double* to) {
  if (to != nullptr) std::copy(from.begin(), from.end(), to);
}

void Run::Write(sy_result& result) const {
  result.termination = termination_;
  result.primal = result.dual = SY_NO_POINT;
  result.objective = result.relaxed = kNaN;
  result.bound = bound_;
  result.iterations = relaxed_.iterations;
  result.nodes = 0;
  for (const Candidate& c : search_.candidates()) result.iterations += c.iterations;
  if (best_ != nullptr) result.objective = best_->objective;
  if (best_ != nullptr && best_->verified) {
    result.primal = SY_FEASIBLE;
    Put(best_->x, result.x);
  }
  if (IsPoint(relaxed_.primal)) {
    result.relaxed = Objective(p_, relaxed_.x.data());
    Put({relaxed_.x.begin(), relaxed_.x.begin() + p_.num_vars}, result.relaxed_x);  // without cuts'
  }
  if (termination_ == SY_INFEASIBLE && relaxed_.dual == SY_CERTIFICATE) {
    result.dual = SY_CERTIFICATE;
    Put(relaxed_.x_dual, result.x_dual);
    Put(relaxed_.row_dual, result.row_dual);
    Put(relaxed_.cone_dual, result.cone_dual);
  }
  if (result.text != nullptr && result.text_size > 0) {
    std::snprintf(result.text, result.text_size, "%s", text_.c_str());
  }
  result.seconds = budget_.Seconds();
}

}  // namespace

void RelaxAndRound::Supports(const sy_host&, const sy_problem& problem) {
  if (const char* why = WhyNot(problem); *why != '\0') throw plugin::Failure(SY_E_UNSUPPORTED, why);
}

void RelaxAndRound::Load(const sy_problem& problem, std::uint64_t) {
  if (const char* why = WhyNot(problem); *why != '\0') {
    throw plugin::Failure(SY_E_UNSUPPORTED, why);
  }
  paths_.reset();
  general_.reset();
  if (IsPathProblem(problem)) {
    paths_.emplace(problem);
  } else {
    general_.emplace(problem);
  }
}

void RelaxAndRound::Solve(const sy_control& control, sy_result& result) {
  if (general_) return SolveGeneral(*general_, options_, host_, control, result);
  Budget budget(control);
  Run run(*paths_, options_, host_, budget);
  run.Solve();
  run.Write(result);
}

sy_solver RelaxAndRound::Describe() {
  constexpr std::uint64_t kAllCones = (std::uint64_t{1} << (SY_CONE_ROTATED + 1)) - 1;
  sy_solver t = {};
  t.id = "org.switchyard.relax-and-round";
  t.name = "relax-and-round";
  t.version = "1.0";
  t.license = "BSD-3-Clause";
  t.accepts =
      SY_ACCEPTS_BOUNDS | SY_ACCEPTS_ROWS | SY_ACCEPTS_QUADRATIC_OBJECTIVE | SY_ACCEPTS_INTEGER;
  t.cones = kAllCones;
  t.integer_accepts = t.accepts;
  t.integer_cones = t.cones;
  t.traits = SY_STRATEGY | SY_GIVES_BOUND;
  t.honors = SY_HONORS_THREADS | SY_HONORS_SECONDS | SY_HONORS_CUTOFF | SY_HONORS_TARGET |
             SY_HONORS_FEASIBILITY | SY_HONORS_OPTIMALITY | SY_HONORS_ABSOLUTE_GAP |
             SY_HONORS_RELATIVE_GAP | SY_HONORS_SEED | SY_HONORS_VERBOSITY | SY_HONORS_CANCELLED;
  t.options = OptionTable();
  return t;
}

}  // namespace switchyard::rounding
