// Random graphs of convex sets, small enough for all their simple paths to be solved.
#pragma once

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "switchyard/gcs/graph_of_convex_sets.hpp"
#include "tests/gcs/random_terms.hpp"
#include "tests/gcs/random_vertex_sets.hpp"

namespace switchyard::testing {

struct RandomGraphKind {
  bool polyhedral = false;  // sets, costs and constraints that linear rows say
  bool negative = false;    // many costs are below 0, so that cycles may be
  bool forced = false;      // an edge or two must be on the path
  bool tagged = false;      // some terms count in some transcriptions

  /// Each with each other, in turn.
  static RandomGraphKind Of(unsigned seed) {
    return {.polyhedral = seed % 2 == 0,
            .negative = seed % 3 == 0,
            .forced = seed % 5 == 0,
            .tagged = seed % 7 == 0};
  }
};

/// Up to 10 vertices, of dimensions 0 to 3, most of them on some way from source to target; edges
/// both ways, parallel ones, loops, edges into the source and out of the target. Most constraints
/// hold at a point that is drawn in each set; some need not.
class RandomGraph {
 public:
  using Vertex = GraphOfConvexSets::Vertex;
  using Edge = GraphOfConvexSets::Edge;
  using Transcription = GraphOfConvexSets::Transcription;

  explicit RandomGraph(unsigned seed) : kind(RandomGraphKind::Of(seed)), draw(seed) {
    const int n = draw.Integer(3, 10);
    for (int v = 0; v < n; ++v) AddVertex();
    AddBackbone();
    if (kind.negative && n > 4) AddRing();
    if (draw.Chance(0.3)) AddHub();
    const bool dense = draw.Chance(0.4);
    for (int more = draw.Integer(0, dense ? 2 * n : n + 2); more > 0; --more) {
      AddEdge(draw.Integer(0, n - 1), draw.Integer(0, n - 1));
    }
    const std::vector<Edge*> some = graph.Edges();
    for (const Edge* edge : some) {
      const int u = IndexOf(edge->u()), v = IndexOf(edge->v());
      if (draw.Chance(dense ? 0.6 : 0.2)) AddEdge(v, u);
      if (draw.Chance(0.08)) AddEdge(u, v);
    }
    FixFlows();
  }

  [[nodiscard]] const Vertex& source() const { return *vertices.front(); }
  [[nodiscard]] const Vertex& target() const { return *vertices.back(); }

  /// What a second search finds changed: numbers of the linear costs.
  void ChangeCosts() {
    for (const auto& cost : linear_) {
      cost->UpdateCoefficients(-0.5 * cost->a(), cost->b() + draw.Uniform(-0.2, 0.2));
    }
  }

  const RandomGraphKind kind;
  Draw draw;
  GraphOfConvexSets graph;
  std::vector<Vertex*> vertices;

 private:
  void AddVertex() {
    const int n = draw.Chance(0.1) ? 0 : draw.Chance(0.5) ? 2 : draw.Integer(1, 3);
    const Eigen::VectorXd inside = draw.Vector(n);
    const auto set = sets_.Any(inside, kind.polyhedral);
    Vertex* v = graph.AddVertex(set);
    vertices.push_back(v);
    inside_.push_back(inside);
    if (dynamic_cast<const AffineSubspace*>(set.get()) != nullptr) {
      const Eigen::VectorXd one = Eigen::VectorXd::Ones(n);
      v->AddConstraint(Binding<Constraint>(
          std::make_shared<BoundingBoxConstraint>(inside - one, inside + one), v->x()));
    }
    if (draw.Chance(0.3)) AddCost(*v, v->x(), inside);
    if (draw.Chance(0.2)) AddConstraint(*v, v->x(), inside);
  }

  /// A way from the first vertex to the last, through some of the others.
  void AddBackbone() {
    const int last = static_cast<int>(vertices.size()) - 1;
    int at = 0;
    for (int v = 1; v <= last; ++v) {
      if (v < last && draw.Chance(0.4)) continue;
      if (!draw.Chance(0.98)) return;  // there may be none
      AddEdge(at, v);
      at = v;
    }
  }

  /// A cycle that is dear to enter, and that costs less than nothing.
  void AddRing() {
    const int last = static_cast<int>(vertices.size()) - 1;
    for (int v = 1; v <= 3; ++v) AddEdge(v, v % 3 + 1)->AddCost(-1.5);
    AddEdge(0, last);
    if (Edge* in = AddEdge(0, 1)) in->AddCost(4);
    if (Edge* out = AddEdge(3, last)) out->AddCost(1);
  }

  /// Edges both ways between the second vertex and others: too many for it to count transitions.
  void AddHub() {
    const int last = static_cast<int>(vertices.size()) - 1;
    for (int v = 2; v <= std::min(5, last); ++v) {
      AddEdge(1, v);
      AddEdge(v, 1);
    }
    AddEdge(0, 1);
  }

  /// None: one in five loops that are drawn is added.
  Edge* AddEdge(int u, int v) {
    if (u == v && !draw.Chance(0.2)) return nullptr;
    Edge* edge =
        graph.AddEdge(vertices[static_cast<std::size_t>(u)], vertices[static_cast<std::size_t>(v)]);
    const int slacks = draw.Chance(0.2) ? draw.Integer(1, 2) : 0;
    const VectorXDecisionVariable s = edge->NewSlackVariables(slacks);
    const Eigen::VectorXd &p = inside_[static_cast<std::size_t>(u)],
                          &q = inside_[static_cast<std::size_t>(v)];
    VectorXDecisionVariable x(p.size() + (u == v ? 0 : q.size()) + slacks);
    Eigen::VectorXd at = Eigen::VectorXd::Zero(x.size());
    x.head(p.size()) = edge->xu();
    at.head(p.size()) = p;
    if (u != v) {
      x.segment(p.size(), q.size()) = edge->xv();
      at.segment(p.size(), q.size()) = q;
    }
    x.tail(slacks) = s;
    if (slacks > 0) {
      edge->AddConstraint(Binding<Constraint>(
          std::make_shared<BoundingBoxConstraint>(Eigen::VectorXd::Constant(slacks, -1),
                                                  Eigen::VectorXd::Constant(slacks, 2)),
          s));
    }
    const bool alike = u != v && p.size() == q.size() && p.size() > 0;
    if (alike && draw.Chance(0.7)) {
      const auto distance = terms_.Distance(static_cast<int>(p.size()), kind.polyhedral);
      edge->AddCost(Binding<Cost>(distance, x.head(2 * p.size())), Tags());
    } else {
      for (int k = draw.Integer(1, 2); k > 0; --k) AddCost(*edge, x, at);
    }
    if (draw.Chance(0.4)) AddConstraint(*edge, x, at);
    return edge;
  }

  template <class Element>
  void AddCost(Element& element, const VectorXDecisionVariable& x, const Eigen::VectorXd& at) {
    auto cost = kind.negative && draw.Chance(0.7) ? terms_.LinearWith(-1, at)
                                                  : terms_.AnyCost(at, kind.polyhedral);
    if (auto linear = std::dynamic_pointer_cast<LinearCost>(cost)) linear_.push_back(linear);
    element.AddCost(Binding<Cost>(cost, x), Tags());
  }
  template <class Element>
  void AddConstraint(Element& element, const VectorXDecisionVariable& x,
                     const Eigen::VectorXd& at) {
    if (x.size() == 0) return;
    const Eigen::VectorXd off = draw.Chance(0.1) ? draw.Vector(static_cast<int>(x.size()), 1.5)
                                                 : Eigen::VectorXd::Zero(x.size());
    element.AddConstraint(Binding<Constraint>(terms_.AnyConstraint(at + off, kind.polyhedral), x),
                          Tags());
  }

  GraphOfConvexSets::TranscriptionSet Tags() {
    using T = Transcription;
    if (!kind.tagged || !draw.Chance(0.3)) return {};
    switch (draw.Integer(0, 3)) {
      case 0:
        return {T::kRestriction};
      case 1:
        return {T::kMIP, T::kRestriction};
      case 2:
        return {T::kRelaxation, T::kRestriction};
      default:
        return {T::kMIP, T::kRelaxation};
    }
  }

  void FixFlows() {
    const std::vector<Edge*> edges = graph.Edges();
    for (Edge* edge : edges) {
      if (draw.Chance(0.05)) edge->AddPhiConstraint(false);
    }
    if (!kind.forced || edges.empty()) return;
    for (int k = draw.Integer(1, 2); k > 0; --k) {
      edges[static_cast<std::size_t>(draw.Integer(0, static_cast<int>(edges.size()) - 1))]
          ->AddPhiConstraint(true);
    }
  }

  [[nodiscard]] static int IndexOf(const Vertex& v) { return v.id().value; }

  RandomVertexSets sets_{draw};
  RandomTerms terms_{draw};
  std::vector<Eigen::VectorXd> inside_;
  std::vector<std::shared_ptr<LinearCost>> linear_;
};

}  // namespace switchyard::testing
