// What a search found, in the placeholders of vertices and edges.
#include <algorithm>
#include <cmath>

#include "core/gcs/restriction.hpp"
#include "core/gcs/search.hpp"
#include "core/lower/lowering.hpp"
#include "core/solve/check.hpp"
#include "switchyard/error.hpp"

namespace switchyard {
namespace {

bool HasPoint(const sy_result& raw) {
  return raw.primal == SY_FEASIBLE || raw.primal == SY_NEARLY_FEASIBLE;
}

}  // namespace

void Search::Recover() {
  if (failed_) return;
  const auto start = std::chrono::steady_clock::now();
  const sy_result& raw = raw_->raw;
  result().termination = static_cast<Termination>(raw.termination);
  result().message = raw_->text.data();
  result().iterations = raw.iterations;
  result().nodes = raw.nodes;
  JudgeByTags();
  if (std::isfinite(raw.relaxed)) RecoverFlow();
  if (as_ == Transcription::kMIP) {
    RecoverWhole();
  } else if (!tried_.empty()) {
    RecoverBestTried();
  } else if (HasPoint(raw)) {
    RecoverPath(PathIn(pruned_, *transcription_, raw_->vectors.x));
  } else if (std::isfinite(raw.relaxed) && relaxation_ended_ && !rounds()) {
    RecoverRelaxation();
  }
  result().seconds.recover += Since(start);
}

// Of terms that restrictions lack, or costs that they alone have, nothing follows for paths.
void Search::JudgeByTags() {
  const sy_result& raw = raw_->raw;
  const char* what = as_ == Transcription::kMIP ? "mixed-integer program" : "relaxation";
  if (tags_.bounds) {
    if (std::isfinite(raw.bound)) result().bound = raw.bound;
    return;
  }
  result().notes.push_back(
      tags_.relaxes ? Text("no bound: a cost of the restriction that is not one of the ", what,
                           " may be negative")
                    : Text("no bound: a term of the ", what, " is not one of the restriction"));
  if (result().termination == Termination::kOptimal) {
    result().termination = Termination::kLocallyOptimal;
  }
  const bool alone = as_ == Transcription::kRelaxation && !rounds();
  if (result().termination != Termination::kInfeasible || tags_.relaxes || alone) return;
  result().termination = Termination::kNoPath;
  result().message += Text("; the ", what, " is infeasible, by terms that no path has");
}

void Search::RecoverFlow() {
  if (relaxation_ended_) answer_.relaxation_cost = raw_->raw.relaxed;
  answer_.relaxed_flow.assign(static_cast<std::size_t>(graph_.num_edges()), 0);
  for (std::size_t a = 0; a < pruned_.edges.size(); ++a) {
    answer_.relaxed_flow[static_cast<std::size_t>(pruned_.place[a])] =
        relaxed_[static_cast<std::size_t>(transcription_->flow(a))];
  }
}

// The path that the integers say; its points are those of its restriction, which counts what only a
// restriction has and knows nothing of what lies beside the path.
void Search::RecoverWhole() {
  if (!HasPoint(raw_->raw)) return;
  const PathPoints path = PathIn(pruned_, *transcription_, raw_->vectors.x);
  if (path.edges.empty()) return RecoverPath(path);
  const double cost = raw_->raw.objective;
  Tried tried = SolveRestriction(
      path.edges, options_.restriction_solver_options.value_or(options_.solver_options),
      guide_.get());
  answer_.rounded.push_back(
      {path.edges, tried.result.objective, tried.result.termination, tried.result.message});
  if (tried.result.termination == Termination::kNoBackend) return RecoverPath(path);
  if (tried.result.primal != PointKind::kFeasible) {
    result().termination = Termination::kRestrictionsFailed;
    result().message =
        Text("the path that the integers say has no point: ", to_string(tried.result.termination),
             ": ", tried.result.message);
    return;
  }
  tried_.insert_or_assign(path.edges, std::move(tried));
  RecoverBestTried();
  if (result().termination == Termination::kOptimal) SupportOptimum(cost);
}

// An optimal path costs what the mixed-integer program says, and no more than its bound but for the
// gap that was asked for.
void Search::SupportOptimum(double cost) {
  const SolverOptions& asked = options_.solver_options;
  const auto known = [](double gap, double own) { return std::isnan(gap) ? own : gap; };
  const double size = std::abs(result().objective);
  const double allowed = std::max({known(asked.relative_gap, 1e-4) * size,
                                   known(asked.absolute_gap, 0), kSupported * (1 + size)});
  const auto doubt = [this](double above, const char* what) {
    result().termination = Termination::kLocallyOptimal;
    result().notes.push_back(Text("the path costs ", above, " more than ", what));
  };
  const double above = result().objective - cost;
  if (above > allowed) return doubt(above, "the mixed-integer program says");
  const double apart = result().objective - result().bound;
  if (apart > allowed) doubt(apart, "the bound of whoever calls it optimal");
}

void Search::RecoverPath(const PathPoints& path, const Tried* tried) {
  if (path.edges.empty()) {
    result().termination = Termination::kNumericalTrouble;
    result().notes.emplace_back("the flows of the answer form no path");
    return;
  }
  answer_.edges = path.edges;
  answer_.points = path.points;
  SetPathPoint(graph_, path, result());
  const double violation = CheckPath(path, tried);
  result().primal = violation <= kSupported ? PointKind::kFeasible : PointKind::kNearlyFeasible;
  if (violation <= kSupported) return CapRelaxation();
  result().notes.push_back(Text("our check finds the path's points violated by ",
                                result().violation.rows, " in rows and ", result().violation.cones,
                                " in cones, ", violation, " relative to their terms"));
  result().termination = Termination::kNumericalTrouble;
}

// Cost and violation of the path's points in the graph's own terms; the latter in units of
// kSupported too. What a set is said with beside its point stands in the program of the path where
// there is one, else in the whole: its rows are checked there.
double Search::CheckPath(const PathPoints& path, const Tried* tried) {
  const std::vector<const Vertex*> vertices = VerticesOf(path.edges);
  const auto check = [&](const MathematicalProgram& of, const MathematicalProgramResult& point) {
    Eigen::VectorXd x(of.num_vars());
    for (int j = 0; j < of.num_vars(); ++j) x[j] = point.GetSolution(of.decision_variable(j));
    result().violation = ViolationOf(of, x);
    result().objective = of.EvalCosts(x);
    const Lowering lowering(of);
    return RelativeViolation(lowering.problem().view(), lowering.Extend(of, x));
  };
  if (tried != nullptr) return check(*tried->program, tried->result);
  const auto program = RestrictionOf(vertices, path.edges, SetsOf::kWithoutVariables);
  const double worst = check(*program, result());
  const bool all = std::all_of(vertices.begin(), vertices.end(),
                               [](const Vertex* v) { return v->set().scaled().num_aux == 0; });
  if (all) return worst;
  sy_problem whole = transcription_->problem().view();
  whole.integer = nullptr;
  return std::max(worst, RelativeViolation(whole, raw_->vectors.x));
}

// A path's points are points of the relaxation too, so its optimum is no higher than the path's
// cost, whatever an inexact solve of it says.
void Search::CapRelaxation() {
  if (!(answer_.relaxation_cost > result().objective) || !tags_.bounds) return;
  const double above = answer_.relaxation_cost - result().objective;
  answer_.relaxation_cost = result().objective;
  if (above <= kSupported * (1 + std::abs(result().objective))) return;
  result().notes.push_back(Text("the relaxation was solved inexactly: its point costs ", above,
                                " more than the path, which is one of its points"));
}

// The restriction as the front end means it: the best of those that were solved here.
void Search::RecoverBestTried() {
  const Tried* best = nullptr;
  const std::vector<const Edge*>* edges = nullptr;
  for (const auto& [path, tried] : tried_) {
    if (tried.result.primal != PointKind::kFeasible) continue;
    if (best != nullptr && tried.result.objective >= best->result.objective) continue;
    best = &tried;
    edges = &path;
  }
  if (best == nullptr) return;
  PathPoints path{*edges, {}, {}};
  for (const Vertex* v : VerticesOf(*edges)) {
    path.points.push_back(best->result.GetSolution(v->x()));
  }
  for (const Edge* edge : *edges) path.slacks.push_back(best->result.GetSolution(edge->slacks()));
  RecoverPath(path, best);
}

void Search::RecoverRelaxation() {
  SetFlowPoint(graph_, pruned_, *transcription_, relaxed_, result());
  sy_problem relaxation = transcription_->problem().view();
  relaxation.integer = nullptr;
  const bool feasible = RelativeViolation(relaxation, relaxed_) <= kSupported;
  result().primal = feasible ? PointKind::kFeasible : PointKind::kNearlyFeasible;
  result().objective = answer_.relaxation_cost;
  const double apart = std::abs(result().objective - raw_->raw.bound);
  const bool supported = apart <= kSupported * (1 + std::abs(result().objective));
  if (result().termination != Termination::kNotSolved) return;
  result().termination =
      feasible && supported ? Termination::kOptimal : Termination::kNumericalTrouble;
  result().dual = supported ? PointKind::kFeasible : PointKind::kInfeasible;
  if (supported) return;
  result().notes.push_back(
      Text("the relaxation's cost is supported only to the bound ", raw_->raw.bound));
}

}  // namespace switchyard
