// What vertices and edges read from a result.
#include <algorithm>
#include <cmath>

#include "core/gcs/flow.hpp"
#include "switchyard/error.hpp"
#include "switchyard/gcs/graph_of_convex_sets.hpp"

namespace switchyard {
namespace {

using Vertex = GraphOfConvexSets::Vertex;
using Edge = GraphOfConvexSets::Edge;
using Transcription = GraphOfConvexSets::Transcription;

double FlowOver(const std::vector<Edge*>& edges, const MathematicalProgramResult& result) {
  double flow = 0;
  for (const Edge* e : edges) flow += FlowOf(*e, result);
  return flow;
}

double FlowThrough(const Vertex& v, const MathematicalProgramResult& result) {
  return std::max(FlowOver(v.outgoing_edges(), result), FlowOver(v.incoming_edges(), result));
}

/// Flows of a path are 0 and 1 exactly; a relaxation's are as a solver leaves them. Where it leaves
/// just these, a vertex has one point as on a path.
bool IsOfPath(double phi) { return phi == 0 || phi == 1; }

bool OnPath(const Vertex& v, const MathematicalProgramResult& result) {
  const auto whole = [&](const Edge* e) { return IsOfPath(FlowOf(*e, result)); };
  return std::all_of(v.outgoing_edges().begin(), v.outgoing_edges().end(), whole) &&
         std::all_of(v.incoming_edges().begin(), v.incoming_edges().end(), whole);
}

Transcription Counted(bool on_path) {
  return on_path ? Transcription::kRestriction : Transcription::kRelaxation;
}

std::optional<Eigen::VectorXd> Values(Variable::Id first, Eigen::Index count,
                                      const MathematicalProgramResult& result) {
  Eigen::VectorXd values(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Variable v(first + i);
    if (!result.Knows(v)) return std::nullopt;
    values[i] = result.GetSolution(v);
  }
  return values;
}

/// g(x), each entry of x as `value` says for its variable.
template <class Value>
double Evaluate(const Binding<Cost>& cost, Value value) {
  Eigen::VectorXd x(cost.variables().size());
  for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = value(cost.variables()[i]);
  Eigen::VectorXd y;
  cost.evaluator()->Eval(x, &y);
  return y[0];
}

template <class Terms>
bool Carries(const Terms& terms, const Binding<Cost>& cost) {
  return std::any_of(terms.begin(), terms.end(),
                     [&](const auto& term) { return term.binding == cost; });
}

/// The place of a variable among consecutive ones; -1: not among them.
Eigen::Index PlaceIn(const VectorXDecisionVariable& consecutive, Variable variable) {
  if (consecutive.size() == 0) return -1;
  const Variable::Id place = variable.get_id() - consecutive[0].get_id();
  return place >= 0 && place < consecutive.size() ? place : -1;
}

}  // namespace

// ---- Vertex ----

std::optional<Eigen::VectorXd> Vertex::GetSolution(const MathematicalProgramResult& result) const {
  RequireLive("GetSolution");
  if (x_.size() == 0) {
    return FlowThrough(*this, result) > kNoFlow ? std::optional(Eigen::VectorXd()) : std::nullopt;
  }
  auto x = Values(x_[0].get_id(), x_.size(), result);
  return x.has_value() && x->hasNaN() ? std::nullopt : x;
}

std::optional<double> Vertex::CostOver(const std::vector<Edge*>& edges, const Binding<Cost>& cost,
                                       const MathematicalProgramResult& result) const {
  double sum = 0;
  bool any = false;
  for (const Edge* edge : edges) {
    const double phi = FlowOf(*edge, result);
    if (phi <= kNoFlow) continue;
    const auto y =
        edge->u_ == this ? edge->GetSolutionPhiXu(result) : edge->GetSolutionPhiXv(result);
    if (!y.has_value()) continue;
    sum += phi * Evaluate(cost, [&](Variable v) { return (*y)[PlaceIn(x_, v)] / phi; });
    any = true;
  }
  return any ? std::optional(sum) : std::nullopt;
}

std::optional<double> Vertex::GetSolutionCost(const MathematicalProgramResult& result,
                                              const Binding<Cost>& cost) const {
  RequireLive("GetSolutionCost");
  Require(Carries(costs_, cost), cost.evaluator()->Name(), " is not a cost of vertex ", name_);
  if (OnPath(*this, result)) {
    const auto x = GetSolution(result);
    if (!x.has_value()) return std::nullopt;
    return Evaluate(cost, [&](Variable v) { return (*x)[PlaceIn(x_, v)]; });
  }
  const auto out = CostOver(outgoing_, cost, result);
  return out.has_value() ? out : CostOver(incoming_, cost, result);
}

std::optional<double> Vertex::GetSolutionCost(const MathematicalProgramResult& result) const {
  RequireLive("GetSolutionCost");
  const bool on_path = OnPath(*this, result);
  const bool passed =
      on_path ? GetSolution(result).has_value() : FlowThrough(*this, result) > kNoFlow;
  if (!passed) return std::nullopt;
  double sum = 0;
  for (const auto& cost : costs_) {
    if (!cost.in.contains(Counted(on_path))) continue;
    sum += GetSolutionCost(result, cost.binding).value_or(0);
  }
  return sum;
}

// ---- Edge ----

std::optional<Eigen::VectorXd> Edge::GetSolutionPhiXu(
    const MathematicalProgramResult& result) const {
  if (!result.Knows(phi())) return std::nullopt;
  return Values(first_id_ + 1, u_->x_.size(), result);
}

std::optional<Eigen::VectorXd> Edge::GetSolutionPhiXv(
    const MathematicalProgramResult& result) const {
  if (!result.Knows(phi())) return std::nullopt;
  return Values(first_id_ + 1 + u_->x_.size(), v_->x_.size(), result);
}

double Edge::ValueOver(double phi, Variable variable,
                       const MathematicalProgramResult& result) const {
  const Eigen::Index in_u = PlaceIn(u_->x_, variable);
  const Eigen::Index in_v = PlaceIn(v_->x_, variable);
  Variable stored = variable;  // a slack stands for itself
  if (in_u >= 0) {
    stored = Variable(first_id_ + 1 + in_u);
  } else if (in_v >= 0) {
    stored = Variable(first_id_ + 1 + u_->x_.size() + in_v);
  }
  return result.GetSolution(stored) / phi;
}

std::optional<double> Edge::GetSolutionCost(const MathematicalProgramResult& result,
                                            const Binding<Cost>& cost) const {
  Live("GetSolutionCost");
  Require(Carries(costs_, cost), cost.evaluator()->Name(), " is not a cost of edge ", name());
  if (!result.Knows(phi())) return std::nullopt;
  const double phi = FlowOf(*this, result);
  if (phi <= kNoFlow) return 0;
  return phi * Evaluate(cost, [&](Variable v) { return ValueOver(phi, v, result); });
}

std::optional<double> Edge::GetSolutionCost(const MathematicalProgramResult& result) const {
  if (!result.Knows(phi())) return std::nullopt;
  const bool on_path = IsOfPath(FlowOf(*this, result));
  double sum = 0;
  for (const auto& cost : costs_) {
    if (!cost.in.contains(Counted(on_path))) continue;
    sum += GetSolutionCost(result, cost.binding).value_or(0);
  }
  return sum;
}

}  // namespace switchyard
