#include "core/gcs/path_point.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace switchyard {
namespace {

constexpr double kNoFlow = 1e-7;

using Vertex = GraphOfConvexSets::Vertex;
using Edge = GraphOfConvexSets::Edge;

std::size_t At(std::int32_t i) { return static_cast<std::size_t>(i); }

/// Values by variable, put in order at the end.
class Values {
 public:
  explicit Values(const GraphOfConvexSets& graph) {
    values_.reserve(static_cast<std::size_t>(4 * graph.num_edges() + 2 * graph.num_vertices()));
  }
  void Set(Variable::Id first, const Eigen::VectorXd& x) {
    for (Eigen::Index i = 0; i < x.size(); ++i) values_.emplace_back(first + i, x[i]);
  }
  void SetVertex(const Vertex& v, const Eigen::VectorXd& x) {
    if (x.size() > 0) Set(v.x()[0].get_id(), x);
  }
  void SetEdge(const Edge& e, double phi, const Eigen::VectorXd& y, const Eigen::VectorXd& z) {
    const Variable::Id first = e.phi().get_id();
    values_.emplace_back(first, phi);
    Set(first + 1, y);
    Set(first + 1 + y.size(), z);
  }
  void SetSlack(Variable variable, double value) { values_.emplace_back(variable.get_id(), value); }
  void Write(MathematicalProgramResult& result) {
    std::sort(values_.begin(), values_.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<Variable> variables;
    Eigen::VectorXd x(static_cast<Eigen::Index>(values_.size()));
    variables.reserve(values_.size());
    for (const auto& [id, value] : values_) {
      x[static_cast<Eigen::Index>(variables.size())] = value;
      variables.emplace_back(id);
    }
    result.SetPoint(std::move(variables), std::move(x));
  }

 private:
  std::vector<std::pair<Variable::Id, double>> values_;
};

}  // namespace

PathPoints PathIn(const PrunedGraph& graph, const GcsTranscription& transcription,
                  const std::vector<double>& x) {
  std::vector<std::int32_t> next(graph.vertices.size(), -1);
  for (std::size_t a = 0; a < graph.edges.size(); ++a) {
    if (x[At(transcription.flow(a))] > 0.5) {
      next[At(graph.tail[a])] = static_cast<std::int32_t>(a);
    }
  }
  PathPoints path;
  std::int32_t at = graph.source;
  while (at != graph.target) {
    const std::int32_t arc = next[At(at)];
    if (arc < 0 || path.edges.size() > graph.edges.size()) return {};
    const Edge& edge = *graph.edges[At(arc)];
    const double phi = x[At(transcription.flow(At(arc)))];
    const std::int32_t slack = transcription.slack(At(arc));
    path.edges.push_back(&edge);
    path.slacks.emplace_back(edge.slacks().size());
    for (Eigen::Index i = 0; i < edge.slacks().size(); ++i) {
      path.slacks.back()[i] = x[At(slack) + static_cast<std::size_t>(i)] / phi;
    }
    path.points.emplace_back(transcription.TailOf(At(arc), x) / phi);
    at = graph.head[At(arc)];
    if (at == graph.target) path.points.emplace_back(transcription.HeadOf(At(arc), x) / phi);
  }
  return path;
}

void SetPathPoint(const GraphOfConvexSets& graph, const PathPoints& path,
                  MathematicalProgramResult& result) {
  std::unordered_map<const Vertex*, const Eigen::VectorXd*> point;
  std::unordered_map<const Edge*, std::size_t> place;
  for (std::size_t k = 0; k < path.edges.size(); ++k) {
    place.emplace(path.edges[k], k);
    point.emplace(&path.edges[k]->u(), &path.points[k]);
    point.emplace(&path.edges[k]->v(), &path.points[k + 1]);
  }
  Values values(graph);
  for (const Vertex* v : graph.Vertices()) {
    const auto found = point.find(v);
    const int n = v->ambient_dimension();
    values.SetVertex(
        *v, found != point.end() ? *found->second : Eigen::VectorXd::Constant(n, std::nan("")));
  }
  for (const Edge* e : graph.Edges()) {
    const auto found = place.find(e);
    if (found == place.end()) {
      values.SetEdge(*e, 0, Eigen::VectorXd::Zero(e->u().ambient_dimension()),
                     Eigen::VectorXd::Zero(e->v().ambient_dimension()));
    } else {
      values.SetEdge(*e, 1, path.points[found->second], path.points[found->second + 1]);
    }
    for (Eigen::Index i = 0; i < e->slacks().size(); ++i) {
      values.SetSlack(e->slacks()[i], found == place.end() ? 0 : path.slacks[found->second][i]);
    }
  }
  values.Write(result);
}

void SetFlowPoint(const GraphOfConvexSets& graph, const PrunedGraph& pruned,
                  const GcsTranscription& transcription, const std::vector<double>& x,
                  MathematicalProgramResult& result) {
  const std::vector<const Edge*> edges = graph.Edges();
  std::vector<std::int32_t> arc_of(edges.size(), -1);
  for (std::size_t a = 0; a < pruned.place.size(); ++a) {
    arc_of[At(pruned.place[a])] = static_cast<std::int32_t>(a);
  }
  std::vector<double> flow(pruned.vertices.size(), 0);
  std::vector<Eigen::VectorXd> sum;
  for (const Vertex* v : pruned.vertices) {
    sum.emplace_back(Eigen::VectorXd::Zero(v->ambient_dimension()));
  }
  Values values(graph);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const Edge& edge = *edges[e];
    double phi = 0;
    Eigen::VectorXd y = Eigen::VectorXd::Zero(edge.u().ambient_dimension());
    Eigen::VectorXd z = Eigen::VectorXd::Zero(edge.v().ambient_dimension());
    const std::int32_t slack = arc_of[e] >= 0 ? transcription.slack(At(arc_of[e])) : -1;
    if (arc_of[e] >= 0) {
      const auto a = At(arc_of[e]);
      phi = x[At(transcription.flow(a))];
      y = transcription.TailOf(a, x);
      z = transcription.HeadOf(a, x);
      flow[At(pruned.tail[a])] += phi;
      sum[At(pruned.tail[a])] += y;
      if (pruned.head[a] == pruned.target) {
        flow[At(pruned.target)] += phi;
        sum[At(pruned.target)] += z;
      }
    }
    values.SetEdge(edge, phi, y, z);
    for (Eigen::Index i = 0; i < edge.slacks().size(); ++i) {
      values.SetSlack(edge.slacks()[i],
                      slack >= 0 ? x[At(slack) + static_cast<std::size_t>(i)] : 0);
    }
  }
  for (std::size_t v = 0; v < sum.size(); ++v) {
    const bool passed = flow[v] > kNoFlow;
    values.SetVertex(*pruned.vertices[v],
                     passed ? Eigen::VectorXd(sum[v] / flow[v])
                            : Eigen::VectorXd::Constant(sum[v].size(), std::nan("")));
  }
  values.Write(result);
}

}  // namespace switchyard
