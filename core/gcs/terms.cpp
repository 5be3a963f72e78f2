// Costs and constraints of vertices and edges.
#include <algorithm>

#include "switchyard/error.hpp"
#include "switchyard/gcs/graph_of_convex_sets.hpp"
#include "switchyard/model/parse.hpp"

namespace switchyard {
namespace {

using Vertex = GraphOfConvexSets::Vertex;
using Edge = GraphOfConvexSets::Edge;
using TranscriptionSet = GraphOfConvexSets::TranscriptionSet;

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

/// What a parser says of an expression, behind the words that say where it stands.
template <class Parse>
auto At(const char* what, const std::string& name, Parse parse) {
  try {
    return parse();
  } catch (const InvalidArgument& e) {
    Refuse(what, " ", name, ": ", e.what());
  }
}

}  // namespace

// ---- Vertex ----

void GraphOfConvexSets::Vertex::CheckVariables(const EvaluatorBase& evaluator,
                                               const VectorXDecisionVariable& variables) const {
  for (const Variable v : variables) {
    if (Among(v, x_)) continue;
    Refuse(evaluator.Name(), " at vertex ", name_, " needs variables of its x, got ",
           graph_->NameOfPlaceholder(v));
  }
}

Binding<Cost> Vertex::AddCost(const Expression& e, TranscriptionSet in) {
  RequireLive("AddCost");
  return AddCost(At("AddCost at vertex", name_, [&] { return ParseCost(e); }), in);
}

Binding<Cost> Vertex::AddCost(const Binding<Cost>& binding, TranscriptionSet in) {
  RequireLive("AddCost");
  CheckVariables(*binding.evaluator(), binding.variables());
  costs_.push_back({binding, in});
  return binding;
}

Binding<Constraint> Vertex::AddConstraint(const FormulaList& formula, TranscriptionSet in) {
  RequireLive("AddConstraint");
  return AddConstraint(
      At("AddConstraint at vertex", name_, [&] { return ParseConstraint(formula); }), in);
}

Binding<Constraint> Vertex::AddConstraint(const Binding<Constraint>& binding, TranscriptionSet in) {
  RequireLive("AddConstraint");
  CheckVariables(*binding.evaluator(), binding.variables());
  constraints_.push_back({binding, in});
  return binding;
}

std::vector<Binding<Cost>> Vertex::GetCosts(TranscriptionSet in) const {
  return Untagged(costs(), in);
}

std::vector<Binding<Constraint>> Vertex::GetConstraints(TranscriptionSet in) const {
  return Untagged(constraints(), in);
}

// ---- Edge ----

void GraphOfConvexSets::Edge::CheckVariables(const EvaluatorBase& evaluator,
                                             const VectorXDecisionVariable& variables) const {
  for (const Variable v : variables) {
    if (Among(v, u_->x_) || Among(v, v_->x_) || Among(v, slacks_)) continue;
    Refuse(evaluator.Name(), " at edge ", name(), " needs variables of its xu, xv and slacks, got ",
           u_->graph_->NameOfPlaceholder(v));
  }
}

Binding<Cost> Edge::AddCost(const Expression& e, TranscriptionSet in) {
  Live("AddCost");
  return AddCost(At("AddCost at edge", name(), [&] { return ParseCost(e); }), in);
}

Binding<Cost> Edge::AddCost(const Binding<Cost>& binding, TranscriptionSet in) {
  Live("AddCost").CheckVariables(*binding.evaluator(), binding.variables());
  costs_.push_back({binding, in});
  return binding;
}

Binding<Constraint> Edge::AddConstraint(const FormulaList& formula, TranscriptionSet in) {
  Live("AddConstraint");
  return AddConstraint(
      At("AddConstraint at edge", name(), [&] { return ParseConstraint(formula); }), in);
}

Binding<Constraint> Edge::AddConstraint(const Binding<Constraint>& binding, TranscriptionSet in) {
  Live("AddConstraint").CheckVariables(*binding.evaluator(), binding.variables());
  constraints_.push_back({binding, in});
  return binding;
}

std::vector<Binding<Cost>> Edge::GetCosts(TranscriptionSet in) const {
  return Untagged(costs(), in);
}

std::vector<Binding<Constraint>> Edge::GetConstraints(TranscriptionSet in) const {
  return Untagged(constraints(), in);
}

}  // namespace switchyard
