#include "core/trajectory/term_groups.hpp"

namespace switchyard {
namespace {

using Transcription = GraphOfConvexSets::Transcription;

std::vector<double> KeyOf(const Eigen::VectorXd& v) { return {v.data(), v.data() + v.size()}; }

void RequirePositive(const SegmentShape& shape, const std::string& call, const std::string& name,
                     const char* what) {
  Require(shape.h_min > 0, call, ": ", what, " need h_min > 0 at every segment they touch, and at ",
          name, " it is ", shape.h_min);
}

}  // namespace

SegmentGroup::SegmentGroup(std::string where, SegmentShape of)
    : name(std::move(where)), shape(of), placeholders({{of, "vertex_"}}) {}

void SegmentGroup::AddLength(const Eigen::MatrixXd& W) {
  if (!W.isZero(0)) Add(LengthCosts(shape, W));
}

void SegmentGroup::AddEnergy(const Eigen::MatrixXd& W) {
  if (!W.isZero(0)) Add(EnergyCosts(shape, W));
}

void SegmentGroup::AddBound(const DerivativeBound& bound, std::optional<double> h0) {
  const DerivativePoints points = AllDerivativePoints(shape, bound.order);
  if (bound.order == 1) {
    if (const auto rows = VelocityRows(points, bound)) Add(*rows);
  } else {
    RequirePositive(shape, "AddNonlinearDerivativeBounds of " + name, name, "derivative bounds");
    Add(DerivativeRows(points, bound, shape));
  }
  demands.bounds.push_back(bound);
  if (!h0 || bound.order == 1) return;
  if (const auto rows = SurrogateRows(points, bound, *h0)) Add(*rows);
}

void SegmentGroup::AddSurrogates(double h0) {
  for (const DerivativeBound& bound : demands.bounds) {
    if (bound.order == 1) continue;
    const auto rows = SurrogateRows(AllDerivativePoints(shape, bound.order), bound, h0);
    if (rows) Add(*rows);
  }
}

JointGroup::JointGroup(std::string where, std::string name_of_u, std::string name_of_v,
                       JointShape of)
    : name(std::move(where)),
      u_name(std::move(name_of_u)),
      v_name(std::move(name_of_v)),
      shape(of),
      placeholders({{of.u, "u_"}, {of.v, "v_"}}),
      durations(placeholders.durations()[0], placeholders.durations()[1]),
      points(placeholders.points()[0], placeholders.points()[1]) {}

GraphOfConvexSets::Edge* JointGroup::Connect(GraphOfConvexSets* graph, GraphOfConvexSets::Vertex* u,
                                             GraphOfConvexSets::Vertex* v,
                                             const Eigen::VectorXd& offset) {
  const auto [place, fresh] = joins_.try_emplace(KeyOf(offset));
  if (fresh) {
    place->second = JoinRows(shape, offset);
    place->second.evaluator->set_description("the end of one segment is the start of the next");
  }
  GraphOfConvexSets::Edge* const edge = graph->AddEdge(u, v);
  if (offsets.empty() && !offset.isZero(0)) {
    offsets.assign(edges.size(), Eigen::VectorXd::Zero(offset.size()));
  }
  if (!offsets.empty() || !offset.isZero(0)) offsets.push_back(offset);
  edges.push_back(edge);
  AddTo(edge, place->second);
  return edge;
}

void JointGroup::Hold(GraphOfConvexSets::Edge* edge, const ConvexSet& set,
                      const Eigen::VectorXd& offset) {
  const auto [place, fresh] = held_.try_emplace(KeyOf(offset));
  Held& held = place->second;
  if (fresh) {
    held.terms = SubspaceTerms(shape, set, offset, &held.num_slacks);
    for (const PlacedConstraint& term : held.terms) term.evaluator->set_description("subspace");
  }
  if (held.num_slacks > 0) edge->NewSlackVariables(held.num_slacks, "subspace");
  for (const PlacedConstraint& term : held.terms) AddTo(edge, term);
}

// u's last and v's first derivative control point, where the order is high enough.
std::vector<std::pair<DerivativePoints, const SegmentShape*>> JointGroup::Sides(const char* call,
                                                                                int k) const {
  Require(k >= 1, call, " of ", name, " needs a derivative order of 1 or more, got ", k);
  std::vector<std::pair<DerivativePoints, const SegmentShape*>> sides;
  if (k <= shape.u.order) sides.emplace_back(LastDerivativePoint(shape.u, k), &shape.u);
  if (k <= shape.v.order) {
    sides.emplace_back(FirstDerivativePoint(shape.v, k, shape.first_of_v()), &shape.v);
  }
  Require(!sides.empty(), call, " of ", name, " needs a subgraph of order ", k,
          " or more on one side, got ", shape.u.order, " and ", shape.v.order);
  return sides;
}

void JointGroup::AddBound(const char* call, const DerivativeBound& bound,
                          std::optional<double> h0) {
  const auto sides = Sides(call, bound.order);
  if (bound.order > 1) {
    for (const auto& [side, of] : sides) {
      RequirePositive(*of, Text(call, " of ", name), of == &shape.u ? u_name : v_name,
                      "derivative bounds");
    }
  }
  for (const auto& [side, of] : sides) {
    if (bound.order == 1) {
      if (const auto rows = VelocityRows(side, bound)) Add(*rows);
    } else {
      for (const PlacedConstraint& term : DerivativeRows(side, bound, *of)) Add(term);
    }
  }
  demands.bounds.push_back(bound);
  if (h0 && bound.order > 1) AddSurrogate(bound, *h0);
}

void JointGroup::AddSurrogate(const DerivativeBound& bound, double h0) {
  for (const auto& [side, of] : Sides("UseSurrogates", bound.order)) {
    if (const auto rows = SurrogateRows(side, bound, h0)) Add(*rows);
  }
}

void JointGroup::AddZero(const char* call, int k) {
  for (const auto& [side, of] : Sides(call, k)) {
    const PlacedConstraint term = ZeroRows(side);
    term.evaluator->set_description(Text("derivative ", k, " is zero"));
    Add(term);
  }
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(shape.u.num_positions);
  demands.bounds.push_back({k, zero, zero});
}

void JointGroup::AddPathContinuity(const char* call, int k) {
  Require(k >= 1, call, " of ", name, " needs an order of 1 or more, got ", k,
          ": segments join anyway");
  Require(k <= shape.u.order && k <= shape.v.order, call, " of ", name, " needs segments of order ",
          k, " or more on both sides, got ", shape.u.order, " and ", shape.v.order);
  const PlacedConstraint term = PathContinuityRows(shape, k);
  term.evaluator->set_description(Text("continuity of path derivative ", k));
  Add(term);
  demands.path_continuity.push_back(k);
}

void JointGroup::RequireTimeContinuity(const char* call, int k) const {
  Require(k >= 1, call, " of ", name, " needs an order of 1 or more, got ", k,
          ": segments join anyway");
  Require(k <= shape.u.order && k <= shape.v.order, call, " of ", name, " needs segments of order ",
          k, " or more on both sides, got ", shape.u.order, " and ", shape.v.order);
  RequirePositive(shape.u, Text(call, " of ", name), u_name, "continuity constraints");
  RequirePositive(shape.v, Text(call, " of ", name), v_name, "continuity constraints");
}

void JointGroup::AddTimeContinuity(const char* call, int k, std::optional<double> h0) {
  RequireTimeContinuity(call, k);
  const PlacedConstraint term = TimeContinuityRows(shape, k);
  term.evaluator->set_description(Text("continuity of derivative ", k));
  Add(term);
  demands.time_continuity.push_back(k);
  if (h0) Add(PathContinuityRows(shape, k, {Transcription::kRelaxation}));
}

void JointGroup::AddSurrogates(double h0) {
  for (const DerivativeBound& bound : demands.bounds) {
    const bool zero = bound.lower.isZero(0) && bound.upper.isZero(0);
    if (bound.order > 1 && !zero) AddSurrogate(bound, h0);
  }
  for (const int k : demands.time_continuity) {
    Add(PathContinuityRows(shape, k, {Transcription::kRelaxation}));
  }
}

}  // namespace switchyard
