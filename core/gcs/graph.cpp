// The graph as a container.
#include <algorithm>

#include "core/gcs/name_index.hpp"
#include "switchyard/error.hpp"
#include "switchyard/gcs/graph_of_convex_sets.hpp"
#include "switchyard/model/new_ids.hpp"
#include "switchyard/symbolic/variable_names.hpp"

namespace switchyard {
namespace {

using Vertex = GraphOfConvexSets::Vertex;
using Edge = GraphOfConvexSets::Edge;

VectorXDecisionVariable Consecutive(Variable::Id first, int count) {
  VectorXDecisionVariable x(count);
  for (int i = 0; i < count; ++i) x[i] = Variable(first + i);
  return x;
}

/// From a list by ascending id.
void Erase(const Edge* edge, std::vector<Edge*>& edges) {
  const auto place =
      std::lower_bound(edges.begin(), edges.end(), edge,
                       [](const Edge* a, const Edge* b) { return a->id() < b->id(); });
  edges.erase(place);
}

template <class Kept, class Element>
std::vector<Kept*> Valid(const std::vector<std::unique_ptr<Element>>& all, int count,
                         const GraphOfConvexSets& graph) {
  std::vector<Kept*> valid;
  valid.reserve(static_cast<std::size_t>(count));
  for (const auto& element : all) {
    if (element != nullptr && graph.IsValid(*element)) valid.push_back(element.get());
  }
  return valid;
}

}  // namespace

// ---- Vertices and edges ----

GraphOfConvexSets::Vertex::Vertex(GraphOfConvexSets* graph, VertexId id,
                                  std::shared_ptr<const ConvexSet> set, std::string name)
    : graph_(graph),
      id_(id),
      set_(std::move(set)),
      name_(std::move(name)),
      x_(Consecutive(NewVariableIds(set_->ambient_dimension()), set_->ambient_dimension())) {}

void GraphOfConvexSets::Vertex::RefuseRemoved(const char* call) const {
  Refuse("Vertex::", call, ": vertex ", name_, " was removed from its graph");
}

GraphOfConvexSets::Edge::Edge(EdgeId id, Vertex* u, Vertex* v, std::string name)
    : id_(id),
      u_(u),
      v_(v),
      name_(std::move(name)),
      first_id_(NewVariableIds(1 + u->ambient_dimension() + v->ambient_dimension())) {}

std::string GraphOfConvexSets::Edge::name() const {
  return name_.empty() ? "(" + u_->name() + ", " + v_->name() + ")" : name_;
}

void GraphOfConvexSets::Edge::RefuseRemoved(const char* call) const {
  Refuse("Edge::", call, ": edge ", name(), " was removed from its graph");
}

VectorXDecisionVariable GraphOfConvexSets::Edge::NewSlackVariables(int rows,
                                                                   const std::string& name) {
  Live("NewSlackVariables");
  Require(rows >= 0, "NewSlackVariables of edge ", this->name(), " needs a number of rows, got ",
          rows);
  const VectorXDecisionVariable added = Consecutive(NewVariableIds(rows), rows);
  VectorXDecisionVariable all(slacks_.size() + rows);
  all << slacks_, added;
  slacks_ = all;
  u_->graph_->NameVariables(added, this->name() + "." + name);
  return added;
}

void GraphOfConvexSets::Edge::AddPhiConstraint(bool phi_value) {
  Live("AddPhiConstraint").phi_value_ = phi_value;
}

void GraphOfConvexSets::Edge::ClearPhiConstraints() {
  Live("ClearPhiConstraints").phi_value_.reset();
}

// ---- Graph ----

GraphOfConvexSets::GraphOfConvexSets() : names_(std::make_unique<Names>()) {}
GraphOfConvexSets::~GraphOfConvexSets() = default;

Vertex* GraphOfConvexSets::AddVertex(const ConvexSet& set, std::string name) {
  return AddVertex(std::shared_ptr<const ConvexSet>(set.Clone()), std::move(name));
}

Vertex* GraphOfConvexSets::AddVertex(std::shared_ptr<const ConvexSet> set, std::string name) {
  const VertexId id{static_cast<int>(vertices_.size())};
  if (name.empty()) name = "v" + std::to_string(id.value);
  Require(set != nullptr, "vertex ", name, " needs a set, got a null pointer");
  vertices_.push_back(
      std::unique_ptr<Vertex>(new Vertex(this, id, std::move(set), std::move(name))));
  ++num_vertices_;
  Vertex* const vertex = vertices_.back().get();
  NameVariables(vertex->x_, vertex->name_ + ".x");
  return vertex;
}

Edge* GraphOfConvexSets::AddEdge(Vertex* u, Vertex* v, std::string name) {
  Require(u != nullptr && v != nullptr, "AddEdge needs two vertices, got a null pointer");
  RequireValid(*u, "AddEdge");
  RequireValid(*v, "AddEdge");
  const EdgeId id{static_cast<int>(edges_.size())};
  edges_.push_back(std::unique_ptr<Edge>(new Edge(id, u, v, std::move(name))));
  ++num_edges_;
  Edge* const edge = edges_.back().get();
  u->outgoing_.push_back(edge);
  v->incoming_.push_back(edge);
  return edge;
}

void GraphOfConvexSets::RemoveVertex(Vertex* vertex) {
  Require(vertex != nullptr, "RemoveVertex needs a vertex, got a null pointer");
  RequireValid(*vertex, "RemoveVertex");
  for (Edge* edge : vertex->outgoing_) {
    if (edge->v_ != vertex) Erase(edge, edge->v_->incoming_);
    Bury(*edge);
  }
  for (Edge* edge : vertex->incoming_) {
    if (edge->u_ == vertex) continue;  // a loop went with the outgoing ones
    Erase(edge, edge->u_->outgoing_);
    Bury(*edge);
  }
  names_->vertices.Forget(*vertex);
  vertex->set_.reset();
  vertex->costs_ = {};
  vertex->constraints_ = {};
  vertex->incoming_ = {};
  vertex->outgoing_ = {};
  --num_vertices_;
}

void GraphOfConvexSets::RemoveEdge(Edge* edge) {
  Require(edge != nullptr, "RemoveEdge needs an edge, got a null pointer");
  RequireValid(*edge, "RemoveEdge");
  Erase(edge, edge->u_->outgoing_);
  Erase(edge, edge->v_->incoming_);
  Bury(*edge);
}

void GraphOfConvexSets::Bury(Edge& edge) {
  names_->edges.Forget(edge);
  edge.removed_ = true;
  edge.slacks_.resize(0);
  edge.costs_ = {};
  edge.constraints_ = {};
  --num_edges_;
}

const Vertex* GraphOfConvexSets::GetVertexByName(const std::string& name) const {
  const std::lock_guard lock(names_->mutex);
  return names_->vertices.First(name, vertices_, *this);
}

Vertex* GraphOfConvexSets::GetMutableVertexByName(const std::string& name) {
  return const_cast<Vertex*>(GetVertexByName(name));
}

const Edge* GraphOfConvexSets::GetEdgeByName(const std::string& name) const {
  const std::lock_guard lock(names_->mutex);
  return names_->edges.First(name, edges_, *this);
}

Edge* GraphOfConvexSets::GetMutableEdgeByName(const std::string& name) {
  return const_cast<Edge*>(GetEdgeByName(name));
}

std::vector<Vertex*> GraphOfConvexSets::Vertices() {
  return Valid<Vertex>(vertices_, num_vertices_, *this);
}

std::vector<const Vertex*> GraphOfConvexSets::Vertices() const {
  return Valid<const Vertex>(vertices_, num_vertices_, *this);
}

std::vector<Edge*> GraphOfConvexSets::Edges() { return Valid<Edge>(edges_, num_edges_, *this); }

std::vector<const Edge*> GraphOfConvexSets::Edges() const {
  return Valid<const Edge>(edges_, num_edges_, *this);
}

bool GraphOfConvexSets::IsValid(const Vertex& v) const {
  return v.graph_ == this && v.set_ != nullptr;
}

bool GraphOfConvexSets::IsValid(const Edge& e) const { return e.u_->graph_ == this && !e.removed_; }

void GraphOfConvexSets::RequireValid(const Vertex& v, const char* caller) const {
  if (IsValid(v)) return;
  Refuse(caller, ": vertex ", v.name(),
         v.graph_ == this ? " was removed from this graph" : " is not of this graph");
}

void GraphOfConvexSets::RequireValid(const Edge& e, const char* caller) const {
  if (IsValid(e)) return;
  Refuse(caller, ": edge ", e.name(),
         e.u_->graph_ == this ? " was removed from this graph" : " is not of this graph");
}

void GraphOfConvexSets::ClearAllPhiConstraints() {
  for (const auto& edge : edges_) {
    if (edge != nullptr) edge->phi_value_.reset();
  }
}

// ---- Names of variables ----

void GraphOfConvexSets::NameVariables(const VectorXDecisionVariable& x, const std::string& base) {
  if (x.size() == 0) return;
  const auto names =
      std::make_shared<const NameBlock>(NameBlock::Shaped(base, static_cast<int>(x.size()), 0));
  RegisterNames(x[0].get_id(), names);
  variable_names_.push_back(names);
}

// Flows have no entries in the table of names: there are many, and none stands in a term.
std::string GraphOfConvexSets::NameOfPlaceholder(Variable variable) const {
  for (const auto& edge : edges_) {
    if (edge != nullptr && edge->first_id_ == variable.get_id()) {
      return "phi of edge " + edge->name();
    }
  }
  return NameOf(variable);
}

}  // namespace switchyard
