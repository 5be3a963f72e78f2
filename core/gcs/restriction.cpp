#include "core/gcs/restriction.hpp"

#include <cmath>
#include <unordered_map>
#include <unordered_set>

#include "core/gcs/flow.hpp"
#include "switchyard/error.hpp"

namespace switchyard {
namespace {

using Vertex = GraphOfConvexSets::Vertex;
using Edge = GraphOfConvexSets::Edge;
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

std::vector<const Vertex*> VerticesOf(const std::vector<const Edge*>& edges) {
  Require(!edges.empty(), "a path needs an edge, got none");
  std::vector<const Vertex*> vertices = {&edges.front()->u()};
  for (const Edge* edge : edges) {
    Require(&edge->u() == vertices.back(), "the edges are no path: edge ", edge->name(),
            " does not begin at vertex ", vertices.back()->name());
    vertices.push_back(&edge->v());
  }
  return vertices;
}

std::unique_ptr<MathematicalProgram> RestrictionOf(const std::vector<const Vertex*>& vertices,
                                                   const std::vector<const Edge*>& edges,
                                                   SetsOf sets) {
  auto program = std::make_unique<MathematicalProgram>();
  std::unordered_set<const void*> seen;
  for (const Vertex* v : vertices) {
    if (!seen.insert(v).second) continue;
    program->AddDecisionVariables(v->x());
    if (sets == SetsOf::kAll || v->set().scaled().num_aux == 0) {
      v->set().AddPointInSetConstraints(program.get(), v->x());
    }
    AddTerms(*v, *program);
  }
  for (const Edge* edge : edges) {
    if (!seen.insert(edge).second) continue;
    program->AddDecisionVariables(edge->slacks());
    AddTerms(*edge, *program);
  }
  return program;
}

Eigen::VectorXd StartFrom(const MathematicalProgramResult& result,
                          const MathematicalProgram& program,
                          const std::vector<const Edge*>& edges) {
  std::unordered_map<Variable, double> flow_of;  // by slack
  for (const Edge* edge : edges) {
    const bool known = result.Knows(edge->phi());
    for (const Variable s : edge->slacks()) {
      flow_of.emplace(s, known ? result.GetSolution(edge->phi()) : 1);
    }
  }
  Eigen::VectorXd start = Eigen::VectorXd::Constant(program.num_vars(), std::nan(""));
  for (int j = 0; j < program.num_vars(); ++j) {
    const Variable v = program.decision_variable(j);
    if (!result.Knows(v)) continue;
    const auto slack = flow_of.find(v);
    const double phi = slack == flow_of.end() ? 1 : slack->second;
    if (phi > kNoFlow) start[j] = result.GetSolution(v) / phi;
  }
  return start;
}

}  // namespace switchyard
