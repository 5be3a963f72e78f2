#include "solvers/mip/strengthening.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "solvers/mip/integer_cuts.hpp"
#include "solvers/mip/perspectives.hpp"
#include "solvers/mip/propagation.hpp"
#include "solvers/rounding/backend.hpp"
#include "solvers/rounding/verdict.hpp"

namespace switchyard::mip {
namespace {

constexpr double kViolated = 1e-5;  // relative: a row that is asked for
constexpr double kSlack = 1e-4;     // relative: a row that is kept at the end
constexpr double kProgress = 0.05;  // of what all rounds gained, in a round that was worth it
constexpr double kNothing = 1e-6;   // of the objective: no gain

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
  Rounds(const Problem& problem, const IntegerCuts& cuts, const Options& options,
         const sy_host& host, rounding::Budget& budget)
      : problem_(problem), cuts_(cuts), options_(options), host_(host), budget_(budget) {}

  /// Rows that are nearly tight at the end.
  std::vector<Row> Run() {
    double first = 0, before = 0;
    for (int round = 0; round < options_.cut_rounds && !budget_.Stopped(); ++round) {
      if (!Solve()) break;
      const double objective = Objective(problem_.view(), x_.data());
      if (round == 0) first = before = objective;
      const double worth = kProgress * (objective - first) + kNothing * std::abs(objective);
      if (round > 0 && objective - before <= worth) break;
      before = objective;
      std::vector<Row> more;
      cuts_.Separate(x_, kViolated, more);
      if (more.empty()) break;
      rows_.insert(rows_.end(), more.begin(), more.end());
    }
    std::erase_if(rows_, [&](const Row& row) { return x_.empty() || !IsTight(row); });
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
  const IntegerCuts& cuts_;
  const Options& options_;
  const sy_host& host_;
  rounding::Budget& budget_;
  const sy_solver* solver_ = nullptr;
  std::vector<double> x_;  // of the last relaxation
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
  const IntegerCuts cuts(result.problem.view(), boxes);
  if (!cuts.empty() && options.cut_rounds > 0) {
    const std::vector<Row> rows = Rounds(result.problem, cuts, options, host, budget).Run();
    result.cuts = static_cast<std::int32_t>(rows.size());
    if (!rows.empty()) Append(rows, result.problem);
  }
  if (result.perspectives + result.cuts == 0) return std::nullopt;
  return result;
}

}  // namespace switchyard::mip
