#include "core/gcs/restriction.hpp"

#include <unordered_set>

#include "switchyard/error.hpp"

namespace switchyard {
namespace {

using Transcription = GraphOfConvexSets::Transcription;

template <class Element>
void AddTerms(const Element& element, MathematicalProgram& program) {
  for (const auto& cost : element.costs()) {
    if (cost.in.contains(Transcription::kRestriction)) program.AddCost(cost.binding);
  }
  for (const auto& constraint : element.constraints()) {
    if (constraint.in.contains(Transcription::kRestriction)) {
      program.AddConstraint(constraint.binding);
    }
  }
}

}  // namespace

std::vector<const GraphOfConvexSets::Vertex*> VerticesOf(
    const std::vector<const GraphOfConvexSets::Edge*>& edges) {
  Require(!edges.empty(), "a path needs an edge, got none");
  std::vector<const GraphOfConvexSets::Vertex*> vertices = {&edges.front()->u()};
  for (const GraphOfConvexSets::Edge* edge : edges) {
    Require(&edge->u() == vertices.back(), "the edges are no path: ", edge->name(),
            " does not begin at ", vertices.back()->name());
    vertices.push_back(&edge->v());
  }
  return vertices;
}

std::unique_ptr<MathematicalProgram> RestrictionOf(
    const std::vector<const GraphOfConvexSets::Vertex*>& vertices,
    const std::vector<const GraphOfConvexSets::Edge*>& edges) {
  auto program = std::make_unique<MathematicalProgram>();
  std::unordered_set<const GraphOfConvexSets::Vertex*> seen;
  for (const GraphOfConvexSets::Vertex* v : vertices) {
    if (!seen.insert(v).second) continue;
    program->AddDecisionVariables(v->x());
    v->set().AddPointInSetConstraints(program.get(), v->x());
    AddTerms(*v, *program);
  }
  for (const GraphOfConvexSets::Edge* edge : edges) {
    program->AddDecisionVariables(edge->slacks());
    AddTerms(*edge, *program);
  }
  return program;
}

}  // namespace switchyard
