// Copies of vertices and edges. Their terms name variables of the original: each is bound anew to
// the copy's.
#include <algorithm>

#include "switchyard/error.hpp"
#include "switchyard/gcs/graph_of_convex_sets.hpp"

namespace switchyard {
namespace {

using Vertex = GraphOfConvexSets::Vertex;
using Edge = GraphOfConvexSets::Edge;

/// Variables that stand for others, in groups of equal length.
class Twins {
 public:
  void Pair(const VectorXDecisionVariable& from, const VectorXDecisionVariable& to) {
    groups_.push_back({from, to});
  }
  template <class Terms>
  void TakeOver(const Terms& from, Terms& to) const {
    for (const auto& term : from) {
      VectorXDecisionVariable variables = term.binding.variables();
      for (Variable& v : variables) v = Of(v);
      to.push_back({{term.binding.evaluator(), variables}, term.in});
    }
  }

 private:
  struct Group {
    const VectorXDecisionVariable& from;
    const VectorXDecisionVariable& to;
  };
  [[nodiscard]] Variable Of(Variable variable) const {
    for (const Group& group : groups_) {
      const auto place = std::find(group.from.begin(), group.from.end(), variable);
      if (place != group.from.end()) return group.to[place - group.from.begin()];
    }
    return variable;
  }

  std::vector<Group> groups_;
};

}  // namespace

Vertex* GraphOfConvexSets::AddVertexFromTemplate(const Vertex& template_vertex) {
  Vertex* const copy = AddVertex(template_vertex.shared_set(), template_vertex.name_);
  Twins twins;
  twins.Pair(template_vertex.x_, copy->x_);
  twins.TakeOver(template_vertex.costs_, copy->costs_);
  twins.TakeOver(template_vertex.constraints_, copy->constraints_);
  return copy;
}

Edge* GraphOfConvexSets::AddEdgeFromTemplate(Vertex* u, Vertex* v, const Edge& template_edge) {
  Require(u != nullptr && v != nullptr,
          "AddEdgeFromTemplate needs two vertices, got a null pointer");
  RequireValid(*u, "AddEdgeFromTemplate");
  RequireValid(*v, "AddEdgeFromTemplate");
  const auto match = [&](const char* end, const VectorXDecisionVariable& x, const Vertex& to) {
    Require(x.size() == to.x_.size(), "AddEdgeFromTemplate: ", end, " of edge ",
            template_edge.name(), " has ", x.size(), " entries, vertex ", to.name(), " has ",
            to.x_.size());
  };
  match("xu", template_edge.xu(), *u);
  match("xv", template_edge.xv(), *v);
  Require(template_edge.u_ != template_edge.v_ || u == v, "AddEdgeFromTemplate: edge ",
          template_edge.name(), " is a loop, whose terms do not say which of ", u->name(), " and ",
          v->name(), " they mean");
  Edge* const copy = AddEdge(u, v, template_edge.name_);
  copy->NewSlackVariables(static_cast<int>(template_edge.slacks_.size()));
  copy->phi_value_ = template_edge.phi_value_;
  Twins twins;
  twins.Pair(template_edge.xu(), copy->xu());
  twins.Pair(template_edge.xv(), copy->xv());
  twins.Pair(template_edge.slacks_, copy->slacks_);
  twins.TakeOver(template_edge.costs_, copy->costs_);
  twins.TakeOver(template_edge.constraints_, copy->constraints_);
  return copy;
}

// What was removed leaves its place empty, so that ids are the same.
std::unique_ptr<GraphOfConvexSets> GraphOfConvexSets::Clone() const {
  auto clone = std::make_unique<GraphOfConvexSets>();
  const auto place = [](VertexId id) { return static_cast<std::size_t>(id.value); };
  for (const Vertex* vertex : Vertices()) {
    clone->vertices_.resize(place(vertex->id_));
    clone->AddVertexFromTemplate(*vertex);
  }
  for (const Edge* edge : Edges()) {
    clone->edges_.resize(static_cast<std::size_t>(edge->id_.value));
    clone->AddEdgeFromTemplate(clone->vertices_[place(edge->u_->id_)].get(),
                               clone->vertices_[place(edge->v_->id_)].get(), *edge);
  }
  clone->vertices_.resize(vertices_.size());
  clone->edges_.resize(edges_.size());
  return clone;
}

}  // namespace switchyard
