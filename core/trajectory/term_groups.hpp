// core/trajectory/term_groups.hpp - segments of one shape, and joints between segments of two: what
// is asked of all of them is asked once.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/trajectory/placeholders.hpp"
#include "core/trajectory/segment_terms.hpp"

namespace switchyard {

/// What was asked of a group beside costs; what a trajectory is held to.
struct Demands {
  std::vector<DerivativeBound> bounds;  // of every control point; of those on both sides of a joint
  std::vector<int> path_continuity;     // orders
  std::vector<int> time_continuity;
};

/// The vertices of a subgraph.
struct SegmentGroup {
  SegmentGroup(std::string where, SegmentShape of);
  template <class C>
  void Add(const PlacedTerm<C>& term);
  template <class C>
  void Add(const std::vector<PlacedTerm<C>>& terms) {
    for (const auto& term : terms) Add(term);
  }

  void AddLength(const Eigen::MatrixXd& W);
  void AddEnergy(const Eigen::MatrixXd& W);
  /// `h0`: of surrogates, if there are to be any.
  void AddBound(const DerivativeBound& bound, std::optional<double> h0);
  void AddSurrogates(double h0);

  std::string name;  // "subgraph rooms"
  SegmentShape shape;
  std::vector<GraphOfConvexSets::Vertex*> vertices;
  Placeholders placeholders;
  Demands demands;
};

/// The edges of a subgraph, or between two.
class JointGroup {
 public:
  JointGroup(std::string where, std::string name_of_u, std::string name_of_v, JointShape of);

  /// From u to v; the last point of u plus the offset is the first of v.
  GraphOfConvexSets::Edge* Connect(GraphOfConvexSets* graph, GraphOfConvexSets::Vertex* u,
                                   GraphOfConvexSets::Vertex* v, const Eigen::VectorXd& offset);
  /// The last point of u plus the offset is in the set, the same for all edges of the group.
  void Hold(GraphOfConvexSets::Edge* edge, const ConvexSet& set, const Eigen::VectorXd& offset);
  template <class C>
  void Add(const PlacedTerm<C>& term) {
    for (GraphOfConvexSets::Edge* edge : edges) AddTo(edge, term);
  }

  // They throw InvalidArgument, in a sentence that begins with `call`, where a side's order is too
  // low (both sides', for bounds and zeros), an order is below 1, or a duration may be 0 and must
  // not.
  void AddBound(const char* call, const DerivativeBound& bound, std::optional<double> h0);
  void AddZero(const char* call, int k);
  void AddPathContinuity(const char* call, int k);
  void AddTimeContinuity(const char* call, int k, std::optional<double> h0);
  void AddSurrogates(double h0);
  void RequireTimeContinuity(const char* call, int k) const;

  [[nodiscard]] Eigen::VectorXd OffsetOf(std::size_t edge) const {
    return offsets.empty() ? Eigen::VectorXd::Zero(shape.u.num_positions) : offsets[edge];
  }

  std::string name;  // "subgraph rooms", "edges from start to rooms"
  std::string u_name, v_name;
  JointShape shape;
  std::vector<GraphOfConvexSets::Edge*> edges;
  std::vector<Eigen::VectorXd> offsets;  // of each edge; none: all are 0
  Placeholders placeholders;
  /// The same as two pairs.
  std::pair<Variable, Variable> durations;
  std::pair<MatrixXDecisionVariable, MatrixXDecisionVariable> points;
  Demands demands;

 private:
  struct Held {
    std::vector<PlacedConstraint> terms;
    int num_slacks = 0;
  };
  using Key = std::vector<double>;
  template <class C>
  void AddTo(GraphOfConvexSets::Edge* edge, const PlacedTerm<C>& term);
  [[nodiscard]] std::vector<std::pair<DerivativePoints, const SegmentShape*>> Sides(
      const char* call, int k) const;
  void AddSurrogate(const DerivativeBound& bound, double h0);

  std::map<Key, PlacedConstraint> joins_;  // by offset
  std::map<Key, Held> held_;               // likewise
};

// ---- Templates ----

template <class C>
void SegmentGroup::Add(const PlacedTerm<C>& term) {
  VectorXDecisionVariable variables(static_cast<Eigen::Index>(term.places.size()));
  for (GraphOfConvexSets::Vertex* vertex : vertices) {
    const VectorXDecisionVariable& x = vertex->x();
    for (std::size_t k = 0; k < term.places.size(); ++k) {
      variables[static_cast<Eigen::Index>(k)] = x[term.places[k]];
    }
    if constexpr (std::is_base_of_v<Cost, C>) {
      vertex->AddCost(Binding<Cost>(term.evaluator, variables), term.in);
    } else {
      vertex->AddConstraint(Binding<Constraint>(term.evaluator, variables), term.in);
    }
  }
}

template <class C>
void JointGroup::AddTo(GraphOfConvexSets::Edge* edge, const PlacedTerm<C>& term) {
  const VectorXDecisionVariable &xu = edge->xu(), &xv = edge->xv();
  VectorXDecisionVariable variables(static_cast<Eigen::Index>(term.places.size()));
  for (std::size_t k = 0; k < term.places.size(); ++k) {
    const int place = term.places[k];
    variables[static_cast<Eigen::Index>(k)] = place < shape.first_of_v() ? xu[place]
                                              : place < shape.first_slack()
                                                  ? xv[place - shape.first_of_v()]
                                                  : edge->slacks()[place - shape.first_slack()];
  }
  if constexpr (std::is_base_of_v<Cost, C>) {
    edge->AddCost(Binding<Cost>(term.evaluator, variables), term.in);
  } else {
    edge->AddConstraint(Binding<Constraint>(term.evaluator, variables), term.in);
  }
}

}  // namespace switchyard
