#include "switchyard/gcs/graph_of_convex_sets.hpp"

#include <algorithm>
#include <thread>

#include "switchyard/error.hpp"
#include "switchyard/model/new_ids.hpp"

namespace switchyard {
namespace {

using TranscriptionSet = GraphOfConvexSets::TranscriptionSet;

VectorXDecisionVariable Consecutive(Variable::Id first, int count) {
  VectorXDecisionVariable x(count);
  for (int i = 0; i < count; ++i) x[i] = Variable(first + i);
  return x;
}

bool Among(Variable variable, const VectorXDecisionVariable& some) {
  return std::find(some.begin(), some.end(), variable) != some.end();
}

template <class B>
std::vector<B> Untagged(const std::vector<GraphOfConvexSets::Tagged<B>>& terms,
                        TranscriptionSet in) {
  std::vector<B> found;
  for (const auto& term : terms) {
    if (term.in.meets(in)) found.push_back(term.binding);
  }
  return found;
}

}  // namespace

// ---- Vertex ----

GraphOfConvexSets::Vertex::Vertex(VertexId id, std::shared_ptr<const ConvexSet> set,
                                  std::string name)
    : id_(id),
      set_(std::move(set)),
      name_(std::move(name)),
      x_(Consecutive(NewVariableIds(set_->ambient_dimension()), set_->ambient_dimension())) {}

Binding<Cost> GraphOfConvexSets::Vertex::AddCost(const Binding<Cost>& binding,
                                                 TranscriptionSet in) {
  for (const Variable v : binding.variables()) {
    Require(Among(v, x_), binding.evaluator()->Name(), " at vertex ", name_,
            " needs variables of its x, got the variable with id ", v.get_id());
  }
  costs_.push_back({binding, in});
  return binding;
}

Binding<Constraint> GraphOfConvexSets::Vertex::AddConstraint(const Binding<Constraint>& binding,
                                                             TranscriptionSet in) {
  for (const Variable v : binding.variables()) {
    Require(Among(v, x_), binding.evaluator()->Name(), " at vertex ", name_,
            " needs variables of its x, got the variable with id ", v.get_id());
  }
  constraints_.push_back({binding, in});
  return binding;
}

std::vector<Binding<Cost>> GraphOfConvexSets::Vertex::GetCosts(TranscriptionSet in) const {
  return Untagged(costs_, in);
}

std::vector<Binding<Constraint>> GraphOfConvexSets::Vertex::GetConstraints(
    TranscriptionSet in) const {
  return Untagged(constraints_, in);
}

// ---- Edge ----

GraphOfConvexSets::Edge::Edge(EdgeId id, Vertex* u, Vertex* v, std::string name)
    : id_(id),
      u_(u),
      v_(v),
      name_(std::move(name)),
      first_id_(NewVariableIds(1 + u->ambient_dimension() + v->ambient_dimension())) {}

std::string GraphOfConvexSets::Edge::name() const {
  return name_.empty() ? Text("(", u_->name(), ", ", v_->name(), ")") : name_;
}

VectorXDecisionVariable GraphOfConvexSets::Edge::NewSlackVariables(int rows, const std::string&) {
  Require(rows >= 0, "NewSlackVariables needs a number of rows, got ", rows);
  const VectorXDecisionVariable added = Consecutive(NewVariableIds(rows), rows);
  VectorXDecisionVariable all(slacks_.size() + rows);
  all << slacks_, added;
  slacks_ = all;
  return added;
}

void GraphOfConvexSets::Edge::CheckVariables(const EvaluatorBase& evaluator,
                                             const VectorXDecisionVariable& variables) const {
  for (const Variable v : variables) {
    Require(Among(v, xu()) || Among(v, xv()) || Among(v, slacks_), evaluator.Name(), " at edge ",
            name(), " needs variables of xu, xv and its slacks, got the variable with id ",
            v.get_id());
  }
}

Binding<Cost> GraphOfConvexSets::Edge::AddCost(const Binding<Cost>& binding, TranscriptionSet in) {
  CheckVariables(*binding.evaluator(), binding.variables());
  costs_.push_back({binding, in});
  return binding;
}

Binding<Constraint> GraphOfConvexSets::Edge::AddConstraint(const Binding<Constraint>& binding,
                                                           TranscriptionSet in) {
  CheckVariables(*binding.evaluator(), binding.variables());
  constraints_.push_back({binding, in});
  return binding;
}

std::vector<Binding<Cost>> GraphOfConvexSets::Edge::GetCosts(TranscriptionSet in) const {
  return Untagged(costs_, in);
}

std::vector<Binding<Constraint>> GraphOfConvexSets::Edge::GetConstraints(
    TranscriptionSet in) const {
  return Untagged(constraints_, in);
}

// ---- Graph ----

GraphOfConvexSets::~GraphOfConvexSets() = default;

GraphOfConvexSets::Vertex* GraphOfConvexSets::AddVertex(const ConvexSet& set, std::string name) {
  return AddVertex(std::shared_ptr<const ConvexSet>(set.Clone()), std::move(name));
}

GraphOfConvexSets::Vertex* GraphOfConvexSets::AddVertex(std::shared_ptr<const ConvexSet> set,
                                                        std::string name) {
  Require(set != nullptr, "a vertex needs a set, got a null pointer");
  const VertexId id{next_vertex_++};
  if (name.empty()) name = Text("v", id.value);
  std::unique_ptr<Vertex> vertex(new Vertex(id, std::move(set), std::move(name)));
  return vertices_.emplace_hint(vertices_.end(), id, std::move(vertex))->second.get();
}

GraphOfConvexSets::Edge* GraphOfConvexSets::AddEdge(Vertex* u, Vertex* v, std::string name) {
  Require(u != nullptr && v != nullptr, "an edge needs two vertices, got a null pointer");
  Require(IsValid(*u) && IsValid(*v), "an edge needs vertices of this graph; ",
          (IsValid(*u) ? v : u)->name(), " is not of it");
  const EdgeId id{next_edge_++};
  std::unique_ptr<Edge> edge(new Edge(id, u, v, std::move(name)));
  u->outgoing_.push_back(edge.get());
  v->incoming_.push_back(edge.get());
  return edges_.emplace_hint(edges_.end(), id, std::move(edge))->second.get();
}

void GraphOfConvexSets::RemoveVertex(Vertex* vertex) {
  Require(vertex != nullptr && IsValid(*vertex), "RemoveVertex needs a vertex of this graph");
  const auto touching = [&](const auto& entry) {
    return &entry.second->u() == vertex || &entry.second->v() == vertex;
  };
  for (const auto& [id, edge] : edges_) {
    if (!touching(std::pair<EdgeId, const std::unique_ptr<Edge>&>(id, edge))) continue;
    std::erase(edge->u_->outgoing_, edge.get());
    std::erase(edge->v_->incoming_, edge.get());
  }
  std::erase_if(edges_, touching);
  vertices_.erase(vertex->id());
}

void GraphOfConvexSets::RemoveEdge(Edge* edge) {
  Require(edge != nullptr && IsValid(*edge), "RemoveEdge needs an edge of this graph");
  std::erase(edge->u_->outgoing_, edge);
  std::erase(edge->v_->incoming_, edge);
  edges_.erase(edge->id());
}

const GraphOfConvexSets::Vertex* GraphOfConvexSets::GetVertexByName(const std::string& name) const {
  for (const auto& [id, vertex] : vertices_) {
    if (vertex->name() == name) return vertex.get();
  }
  return nullptr;
}

GraphOfConvexSets::Vertex* GraphOfConvexSets::GetMutableVertexByName(const std::string& name) {
  return const_cast<Vertex*>(GetVertexByName(name));
}

const GraphOfConvexSets::Edge* GraphOfConvexSets::GetEdgeByName(const std::string& name) const {
  for (const auto& [id, edge] : edges_) {
    if (edge->name() == name) return edge.get();
  }
  return nullptr;
}

GraphOfConvexSets::Edge* GraphOfConvexSets::GetMutableEdgeByName(const std::string& name) {
  return const_cast<Edge*>(GetEdgeByName(name));
}

std::vector<GraphOfConvexSets::Vertex*> GraphOfConvexSets::Vertices() {
  std::vector<Vertex*> all;
  all.reserve(vertices_.size());
  for (const auto& [id, vertex] : vertices_) all.push_back(vertex.get());
  return all;
}

std::vector<const GraphOfConvexSets::Vertex*> GraphOfConvexSets::Vertices() const {
  std::vector<const Vertex*> all;
  all.reserve(vertices_.size());
  for (const auto& [id, vertex] : vertices_) all.push_back(vertex.get());
  return all;
}

std::vector<GraphOfConvexSets::Edge*> GraphOfConvexSets::Edges() {
  std::vector<Edge*> all;
  all.reserve(edges_.size());
  for (const auto& [id, edge] : edges_) all.push_back(edge.get());
  return all;
}

std::vector<const GraphOfConvexSets::Edge*> GraphOfConvexSets::Edges() const {
  std::vector<const Edge*> all;
  all.reserve(edges_.size());
  for (const auto& [id, edge] : edges_) all.push_back(edge.get());
  return all;
}

bool GraphOfConvexSets::IsValid(const Vertex& v) const {
  const auto place = vertices_.find(v.id());
  return place != vertices_.end() && place->second.get() == &v;
}

bool GraphOfConvexSets::IsValid(const Edge& e) const {
  const auto place = edges_.find(e.id());
  return place != edges_.end() && place->second.get() == &e;
}

void GraphOfConvexSets::ClearAllPhiConstraints() {
  for (const auto& [id, edge] : edges_) edge->ClearPhiConstraints();
}

// Bindings name variables of their graph: each is bound anew to the clone's.
std::unique_ptr<GraphOfConvexSets> GraphOfConvexSets::Clone() const {
  auto clone = std::make_unique<GraphOfConvexSets>();
  std::unordered_map<Variable, Variable> twin;
  std::unordered_map<const Vertex*, Vertex*> vertex_of;
  const auto pair_up = [&twin](const VectorXDecisionVariable& from,
                               const VectorXDecisionVariable& to) {
    for (Eigen::Index i = 0; i < from.size(); ++i) twin[from[i]] = to[i];
  };
  const auto take_terms = [&twin](const auto& from, auto& to) {
    for (const auto& term : from) {
      VectorXDecisionVariable variables = term.binding.variables();
      for (Variable& v : variables) v = twin.at(v);
      to.push_back({{term.binding.evaluator(), variables}, term.in});
    }
  };
  for (const auto& [id, vertex] : vertices_) {
    Vertex* copy = clone->AddVertex(vertex->set_, vertex->name_);
    vertex_of[vertex.get()] = copy;
    pair_up(vertex->x_, copy->x_);
    take_terms(vertex->costs_, copy->costs_);
    take_terms(vertex->constraints_, copy->constraints_);
  }
  for (const auto& [id, edge] : edges_) {
    Edge* copy = clone->AddEdge(vertex_of.at(edge->u_), vertex_of.at(edge->v_), edge->name_);
    pair_up(edge->slacks_, copy->NewSlackVariables(static_cast<int>(edge->slacks_.size())));
    copy->phi_value_ = edge->phi_value_;
    take_terms(edge->costs_, copy->costs_);
    take_terms(edge->constraints_, copy->constraints_);
  }
  return clone;
}

}  // namespace switchyard
