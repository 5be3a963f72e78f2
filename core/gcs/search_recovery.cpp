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
  if (Bounds() && std::isfinite(raw.bound)) {
    result().bound = raw.bound;
  } else if (!Bounds()) {
    result().notes.emplace_back("no bound: a term of the relaxation is not one of the restriction");
  }
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
  const Termination whole = result().termination;
  const double cost = raw_->raw.objective;
  Tried tried = SolveRestriction(
      path.edges, options_.restriction_solver_options.value_or(options_.solver_options));
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
  const double above = result().objective - cost;
  const double relative = std::isnan(options_.solver_options.relative_gap)
                              ? 1e-4
                              : options_.solver_options.relative_gap;
  const double allowed = std::max(relative * std::abs(cost), kSupported * (1 + std::abs(cost)));
  if (whole != Termination::kOptimal || above <= allowed || !SameTerms()) return;
  result().termination = Termination::kLocallyOptimal;
  result().notes.push_back(
      Text("the path costs ", above, " more than the mixed-integer program says"));
}

void Search::RecoverPath(const PathPoints& path) {
  if (path.edges.empty()) {
    result().termination = Termination::kNumericalTrouble;
    result().notes.emplace_back("the flows of the answer form no path");
    return;
  }
  answer_.edges = path.edges;
  answer_.points = path.points;
  SetPathPoint(graph_, path, result());
  const double violation = CheckPath(path);
  result().primal = violation <= kSupported ? PointKind::kFeasible : PointKind::kNearlyFeasible;
  if (violation <= kSupported) return CapRelaxation();
  result().notes.push_back(Text("our check finds the path's points violated by ",
                                result().violation.rows, " in rows and ", result().violation.cones,
                                " in cones"));
  result().termination = Termination::kNumericalTrouble;
}

// Cost and violation of the path's points in the graph's own terms; the latter in units of
// kSupported too. A set that is said with variables of its own is asked how far its point is from
// it, relative to the point.
double Search::CheckPath(const PathPoints& path) {
  const std::vector<const Vertex*> vertices = VerticesOf(path.edges);
  const auto program = RestrictionOf(vertices, path.edges, SetsOf::kWithoutVariables);
  Eigen::VectorXd x(program->num_vars());
  for (int j = 0; j < program->num_vars(); ++j) {
    x[j] = result().GetSolution(program->decision_variable(j));
  }
  result().objective = program->EvalCosts(x);
  result().violation = ViolationOf(*program, x);
  const Lowering lowering(*program);
  double worst = RelativeViolation(lowering.problem().view(), lowering.Extend(*program, x));
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    const ConvexSet& set = vertices[k]->set();
    if (set.scaled().num_aux == 0) continue;
    const double apart = set.Violation(path.points[k]);
    result().violation.rows = std::max(result().violation.rows, apart);
    worst = std::max(worst, apart / (1 + path.points[k].lpNorm<Eigen::Infinity>()));
  }
  return worst;
}

// A path's points are points of the relaxation too, so its optimum is no higher than the path's
// cost, whatever an inexact solve of it says.
void Search::CapRelaxation() {
  if (!(answer_.relaxation_cost > result().objective) || !Bounds()) return;
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
  RecoverPath(path);
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
