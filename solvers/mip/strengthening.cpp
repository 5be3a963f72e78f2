#include "solvers/mip/strengthening.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "solvers/mip/integer_cuts.hpp"
#include "solvers/mip/mir_cuts.hpp"
#include "solvers/mip/perspectives.hpp"
#include "solvers/mip/propagation.hpp"
#include "solvers/rounding/backend.hpp"
#include "solvers/rounding/diving.hpp"
#include "solvers/rounding/verdict.hpp"

namespace switchyard::mip {
namespace {

constexpr double kViolated = 1e-5;   // relative: a row that is asked for
constexpr double kFarEnough = 1e-4;  // likewise, of a row's length
constexpr double kSlack = 1e-6;      // relative: a row that is kept
constexpr double kProgress = 0.015;  // of what all rounds gained, in a round that was worth it
constexpr double kShare = 0.1;       // of the gap, that rows must close
constexpr double kLittle = 1e-5;     // of the objective: no gain worth a row
constexpr double kTime = 0.1;        // of what there is
constexpr double kNothing = 1e-6;    // of the objective: no gain

std::vector<sy_hint> HintsOfVariables(const sy_problem& problem) {
  std::vector<sy_hint> hints;
  for (const sy_hint* hint = problem.hints; hint != nullptr && hint->id != nullptr; ++hint) {
    const std::string_view id = hint->id;
    if (id == "sy.sos1/1" || id == "sy.branching/1") hints.push_back(*hint);
  }
  hints.push_back({});
  return hints;
}

void Append(const std::vector<Row>& rows, Problem& problem) {
  problem.Change([&](ProblemData& d) {
    rounding::Rows entries;
    for (const Row& row : rows) {
      entries.push_back(row.entries);
      std::sort(entries.back().begin(), entries.back().end(),
                [](const auto& a, const auto& b) { return a.variable < b.variable; });
      d.row_lower.push_back(row.lower);
      d.row_upper.push_back(kInfinity);
    }
    d.A = StackRows(d.A, rounding::ByColumns(entries, d.num_vars));
  });
}

class Rounds {
 public:
  Rounds(const Problem& problem, const NodeBoxes& boxes, const Options& options,
         const sy_host& host, rounding::Budget& budget)
      : problem_(problem),
        cuts_(problem.view(), boxes),
        mir_(problem.view(), boxes),
        options_(options),
        host_(host),
        budget_(budget) {}

  /// Is there nothing that a row could be made of?
  [[nodiscard]] bool empty() const { return cuts_.empty() && mir_.empty(); }

  /// Rows that are tight at the end, where they close a share of the gap; else none.
  std::vector<Row> Run(const rounding::IntegerProblem& whole) {
    double gained = 0;
    for (int round = 0; round < options_.cut_rounds && !IsLate(); ++round) {
      if (!Solve()) break;
      const double objective = Objective(problem_.view(), x_.data());
      if (round == 0) {
        first_ = objective;
        first_x_ = x_;
      }
      const double before = std::exchange(gained, objective - first_);
      const double worth = kProgress * gained + kNothing * std::abs(objective);
      if (round > 0 && gained - before <= worth) break;
      std::vector<Row> more;
      cuts_.Separate(x_, kViolated, more);
      for (const Row& row : more) mir_.Know(row);
      mir_.Separate(x_, kFarEnough, more);
      if (more.empty()) break;
      KeepTight();
      rows_.insert(rows_.end(), more.begin(), more.end());
    }
    KeepTight();
    const bool little = gained <= kLittle * std::abs(first_);
    if (little || (!rows_.empty() && !PaysOff(whole, gained))) rows_.clear();
    return std::move(rows_);
  }

 private:
  bool Solve() {
    Problem relaxation = problem_;
    Append(rows_, relaxation);
    sy_problem view = relaxation.view();
    view.integer = nullptr;
    if (solver_ == nullptr) {
      const char* names = options_.solver.empty() ? nullptr : options_.solver.c_str();
      solver_ = &rounding::FindBackend(host_, view, names, 1);
    }
    rounding::Answer answer = rounding::SolveBy(*solver_, host_, view, budget_.Part(1));
    if (!rounding::IsPoint(answer.primal)) return false;
    x_ = std::move(answer.x);
    return true;
  }
  [[nodiscard]] bool IsLate() {
    const bool late = budget_.Seconds() > kTime * budget_.control().seconds;
    return budget_.Stopped() || (late && options_.deterministic == 0);
  }
  // Rows make every node dearer. The gap is the one to a rounded point; where there is none, it is
  // not known to be small.
  bool PaysOff(const rounding::IntegerProblem& whole, double gained) {
    rounding::Domain domain(whole);
    if (!domain.Propagate()) return false;
    sy_problem relaxation = whole.problem();
    relaxation.integer = nullptr;
    relaxation.x_lower = domain.boxes().lower.data();
    relaxation.x_upper = domain.boxes().upper.data();
    const rounding::Root root{whole, relaxation, domain, first_x_, *solver_, host_};
    const rounding::Try found = rounding::RoundToNearest(root, budget_);
    return found.feasible && gained >= kShare * (found.objective - first_);
  }
  void KeepTight() {
    std::erase_if(rows_, [&](const Row& row) { return x_.empty() || !IsTight(row); });
  }
  [[nodiscard]] bool IsTight(const Row& row) const {
    double sum = 0, scale = 1;
    for (const rounding::Entry& e : row.entries) {
      const double term = e.value * x_[static_cast<std::size_t>(e.variable)];
      sum += term;
      scale = std::max(scale, std::abs(term));
    }
    return sum <= row.lower + kSlack * scale;
  }

  const Problem& problem_;
  IntegerCuts cuts_;
  MirCuts mir_;
  const Options& options_;
  const sy_host& host_;
  rounding::Budget& budget_;
  const sy_solver* solver_ = nullptr;
  std::vector<double> x_;  // of the last relaxation
  std::vector<double> first_x_;
  double first_ = 0;  // its objective
  std::vector<Row> rows_;
};

}  // namespace

std::optional<Strengthened> Strengthen(const rounding::IntegerProblem& whole,
                                       const Options& options, const sy_host& host,
                                       rounding::Budget& budget) {
  const Propagator propagator(whole.problem());
  Workspace workspace(propagator);
  NodeBoxes boxes = propagator.Bounds();
  if (!propagator.Propagate(boxes, workspace)) return std::nullopt;  // the search says so
  Strengthened result{Problem(whole.problem()), HintsOfVariables(whole.problem())};
  result.problem.Change([&](ProblemData& d) { d.hints = result.hints.data(); });
  result.perspectives = TakePerspectives(result.problem, boxes);
  Rounds rounds(result.problem, boxes, options, host, budget);
  if (!rounds.empty() && options.cut_rounds > 0) {
    const std::vector<Row> rows = rounds.Run(whole);
    result.cuts = static_cast<std::int32_t>(rows.size());
    if (!rows.empty()) Append(rows, result.problem);
  }
  if (result.perspectives + result.cuts == 0) return std::nullopt;
  return result;
}

}  // namespace switchyard::mip
