// What vertices and edges read from a result.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "switchyard/arcs.hpp"
#include "switchyard/error.hpp"
#include "switchyard/gcs/graph_of_convex_sets.hpp"

namespace switchyard {
namespace {

constexpr double kNoFlow = 1e-7;  // what an interior point leaves of 0

using Vertex = GraphOfConvexSets::Vertex;
using Edge = GraphOfConvexSets::Edge;

double FlowOf(const Edge& edge, const MathematicalProgramResult& result) {
  return result.Knows(edge.phi()) ? result.GetSolution(edge.phi()) : 0;
}

double FlowThrough(const Vertex& v, const MathematicalProgramResult& result) {
  double out = 0;
  double in = 0;
  for (const Edge* e : v.outgoing_edges()) out += FlowOf(*e, result);
  for (const Edge* e : v.incoming_edges()) in += FlowOf(*e, result);
  return std::max(out, in);
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

double Evaluate(const Cost& cost, const Eigen::VectorXd& x) {
  Eigen::VectorXd y;
  cost.Eval(x, &y);
  return y[0];
}

template <class Terms>
bool Carries(const Terms& terms, const Binding<Cost>& cost) {
  return std::any_of(terms.begin(), terms.end(),
                     [&](const auto& term) { return term.binding == cost; });
}

}  // namespace

std::optional<Eigen::VectorXd> GraphOfConvexSets::Vertex::GetSolution(
    const MathematicalProgramResult& result) const {
  Eigen::VectorXd x(x_.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    if (!result.Knows(x_[i])) return std::nullopt;
    x[i] = result.GetSolution(x_[i]);
    if (std::isnan(x[i])) return std::nullopt;
  }
  if (x.size() == 0 && FlowThrough(*this, result) <= kNoFlow) return std::nullopt;
  return x;
}

// The cost stands once for each edge out of the vertex (in, at the target), at that edge's point.
std::optional<double> GraphOfConvexSets::Vertex::GetSolutionCost(
    const MathematicalProgramResult& result, const Binding<Cost>& cost) const {
  Require(Carries(costs_, cost), cost.evaluator()->Name(), " is no cost of vertex ", name_);
  const auto sum_over = [&](const std::vector<Edge*>& edges, bool tail) {
    double sum = 0;
    bool any = false;
    for (const Edge* edge : edges) {
      const double phi = FlowOf(*edge, result);
      if (phi <= kNoFlow) continue;
      const auto scaled = tail ? edge->GetSolutionPhiXu(result) : edge->GetSolutionPhiXv(result);
      if (!scaled.has_value()) continue;
      Eigen::VectorXd x(cost.variables().size());
      for (Eigen::Index i = 0; i < x.size(); ++i) {
        x[i] = (*scaled)[cost.variables()[i].get_id() - x_[0].get_id()] / phi;
      }
      sum += phi * Evaluate(*cost.evaluator(), x);
      any = true;
    }
    return any ? std::optional<double>(sum) : std::nullopt;
  };
  const auto out = sum_over(outgoing_, true);
  return out.has_value() ? out : sum_over(incoming_, false);
}

std::optional<double> GraphOfConvexSets::Vertex::GetSolutionCost(
    const MathematicalProgramResult& result) const {
  if (FlowThrough(*this, result) <= kNoFlow) return std::nullopt;
  double sum = 0;
  for (const auto& cost : costs_) {
    sum += GetSolutionCost(result, cost.binding).value_or(0);
  }
  return sum;
}

std::optional<Eigen::VectorXd> GraphOfConvexSets::Edge::GetSolutionPhiXu(
    const MathematicalProgramResult& result) const {
  return Values(first_id_ + 1, u_->ambient_dimension(), result);
}

std::optional<Eigen::VectorXd> GraphOfConvexSets::Edge::GetSolutionPhiXv(
    const MathematicalProgramResult& result) const {
  return Values(first_id_ + 1 + u_->ambient_dimension(), v_->ambient_dimension(), result);
}

std::optional<double> GraphOfConvexSets::Edge::GetSolutionCost(
    const MathematicalProgramResult& result, const Binding<Cost>& cost) const {
  Require(Carries(costs_, cost), cost.evaluator()->Name(), " is no cost of edge ", name());
  if (!result.Knows(phi())) return std::nullopt;
  const double phi = FlowOf(*this, result);
  if (phi <= kNoFlow) return 0;
  const auto y = GetSolutionPhiXu(result);
  const auto z = GetSolutionPhiXv(result);
  if (!y.has_value() || !z.has_value()) return std::nullopt;
  Eigen::VectorXd x(cost.variables().size());
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const Variable v = cost.variables()[i];
    const auto in = [&](const VectorXDecisionVariable& some) {
      const auto place = std::find(some.begin(), some.end(), v);
      return place == some.end() ? Eigen::Index{-1} : place - some.begin();
    };
    if (const Eigen::Index k = in(xu()); k >= 0) {
      x[i] = (*y)[k] / phi;
    } else if (const Eigen::Index m = in(xv()); m >= 0) {
      x[i] = (*z)[m] / phi;
    } else {
      x[i] = result.GetSolution(v) / phi;
    }
  }
  return phi * Evaluate(*cost.evaluator(), x);
}

std::optional<double> GraphOfConvexSets::Edge::GetSolutionCost(
    const MathematicalProgramResult& result) const {
  if (!result.Knows(phi())) return std::nullopt;
  double sum = 0;
  for (const auto& cost : costs_) sum += GetSolutionCost(result, cost.binding).value_or(0);
  return sum;
}

std::vector<const GraphOfConvexSets::Edge*> GraphOfConvexSets::GetSolutionPath(
    const Vertex& source, const Vertex& target, const MathematicalProgramResult& result,
    double tolerance) const {
  Require(IsValid(source) && IsValid(target), "GetSolutionPath needs vertices of this graph");
  std::vector<const Edge*> path;
  for (const Vertex* at = &source; at != &target;) {
    const auto& out = at->outgoing_edges();
    const auto next = std::find_if(out.begin(), out.end(), [&](const Edge* edge) {
      return FlowOf(*edge, result) >= 1 - tolerance;
    });
    if (next == out.end() || path.size() > edges_.size()) {
      throw std::runtime_error(
          Text("the flows form no path: none of at least ", 1 - tolerance, " leaves ", at->name()));
    }
    path.push_back(*next);
    at = &(*next)->v();
  }
  return path;
}

std::vector<std::vector<const GraphOfConvexSets::Edge*>> GraphOfConvexSets::SamplePaths(
    const Vertex& source, const Vertex& target,
    const std::unordered_map<const Edge*, double>& flows,
    const GraphOfConvexSetsOptions& options) const {
  Require(IsValid(source) && IsValid(target), "SamplePaths needs vertices of this graph");
  std::unordered_map<const switchyard::GraphOfConvexSets::Vertex*, std::int32_t> index;
  for (const Vertex* v : Vertices()) index.emplace(v, static_cast<std::int32_t>(index.size()));
  const std::vector<const Edge*> edges = Edges();
  std::vector<std::int32_t> tail, head;
  std::vector<double> flow;
  for (const Edge* edge : edges) {
    tail.push_back(index.at(&edge->u()));
    head.push_back(index.at(&edge->v()));
    const auto given = flows.find(edge);
    flow.push_back(given == flows.end() ? 0 : given->second);
  }
  const Arcs arcs{num_vertices(), tail, head};
  const Leaving out(arcs);
  Random random(static_cast<std::uint64_t>(options.rounding_seed));
  std::vector<std::vector<std::int32_t>> drawn;
  const auto wanted = static_cast<std::size_t>(options.max_rounded_paths.value_or(10));
  for (int k = 0; k < options.max_rounding_trials && drawn.size() < wanted; ++k) {
    const auto path = SamplePath(arcs, out, flow, options.flow_tolerance, index.at(&source),
                                 index.at(&target), random);
    if (!path.has_value()) break;
    if (std::find(drawn.begin(), drawn.end(), *path) == drawn.end()) drawn.push_back(*path);
  }
  std::vector<std::vector<const Edge*>> paths;
  for (const auto& path : drawn) {
    std::vector<const Edge*>& one = paths.emplace_back();
    for (const std::int32_t a : path) one.push_back(edges[static_cast<std::size_t>(a)]);
  }
  return paths;
}

std::vector<std::vector<const GraphOfConvexSets::Edge*>> GraphOfConvexSets::SamplePaths(
    const Vertex& source, const Vertex& target, const MathematicalProgramResult& result,
    const GraphOfConvexSetsOptions& options) const {
  std::unordered_map<const Edge*, double> flows;
  for (const Edge* edge : Edges()) flows.emplace(edge, FlowOf(*edge, result));
  return SamplePaths(source, target, flows, options);
}

}  // namespace switchyard
