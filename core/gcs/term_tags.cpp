#include "core/gcs/term_tags.hpp"

#include <algorithm>
#include <cmath>

namespace switchyard {
namespace {

using Vertex = GraphOfConvexSets::Vertex;
using Edge = GraphOfConvexSets::Edge;
using Transcription = GraphOfConvexSets::Transcription;

/// A variable's range by the boxes of some vertices; none where it is a slack.
std::pair<double, double> RangeOf(Variable variable, std::initializer_list<const Vertex*> at) {
  for (const Vertex* v : at) {
    const auto place = std::find(v->x().begin(), v->x().end(), variable);
    if (place == v->x().end()) continue;
    const SetBox& box = v->set().bounding_box();
    return {box.lower[place - v->x().begin()], box.upper[place - v->x().begin()]};
  }
  return {-kInfinity, kInfinity};
}

/// a'x + b >= 0 over the boxes?
bool IsNonnegative(const Eigen::VectorXd& a, double b, const VectorXDecisionVariable& x,
                   std::initializer_list<const Vertex*> at) {
  for (Eigen::Index i = 0; i < a.size(); ++i) {
    if (a[i] == 0) continue;
    const auto [lower, upper] = RangeOf(x[i], at);
    b += std::min(a[i] * lower, a[i] * upper);
  }
  return b >= 0;
}

/// Is the cost known to be at least 0 at points of the vertices' sets?
bool IsNonnegative(const Binding<Cost>& binding, std::initializer_list<const Vertex*> at) {
  const Cost& cost = *binding.evaluator();
  if (dynamic_cast<const NormCost*>(&cost) != nullptr) return true;
  if (const auto* linear = dynamic_cast<const LinearCost*>(&cost)) {
    return IsNonnegative(linear->a(), linear->b(), binding.variables(), at);
  }
  const auto* quadratic = dynamic_cast<const QuadraticCost*>(&cost);
  return quadratic != nullptr && quadratic->is_convex() &&
         IsNonnegative(quadratic->b(), quadratic->c(), binding.variables(), at);
}

template <class Element>
void Read(const Element& element, Transcription as, std::initializer_list<const Vertex*> at,
          TermTags& tags) {
  const auto see = [&](GraphOfConvexSets::TranscriptionSet in) {
    const bool here = in.contains(as), there = in.contains(Transcription::kRestriction);
    tags.same &= here == there;
    tags.relaxes &= !here || there;
    return there && !here;
  };
  for (const auto& cost : element.costs()) {
    if (see(cost.in)) tags.bounds = tags.bounds && IsNonnegative(cost.binding, at);
  }
  for (const auto& constraint : element.constraints()) see(constraint.in);
}

}  // namespace

TermTags TagsOf(const PrunedGraph& graph, Transcription as) {
  TermTags tags;
  for (const Vertex* v : graph.vertices) Read(*v, as, {v}, tags);
  for (const Edge* e : graph.edges) Read(*e, as, {&e->u(), &e->v()}, tags);
  tags.bounds = tags.bounds && tags.relaxes;
  return tags;
}

}  // namespace switchyard
