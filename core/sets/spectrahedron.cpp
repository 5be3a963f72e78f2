#include "switchyard/sets/spectrahedron.hpp"

#include "core/sets/scaled_constraint.hpp"
#include "switchyard/error.hpp"
#include "switchyard/sets/scaled_rows.hpp"

namespace switchyard {

Spectrahedron::Spectrahedron(const MathematicalProgram& prog) : ConvexSet(prog.num_vars()) {
  for (int i = 0; i < prog.num_vars(); ++i) {
    Require(prog.variable_type(i) == VariableType::kContinuous,
            "a spectrahedron needs continuous variables, got ", prog.VariableName(i),
            " of another type");
  }
  for (const Binding<Constraint>& binding : prog.GetAllConstraints()) {
    RequirePerspective(*binding.evaluator());
    terms_.push_back({binding.evaluator(), prog.FindDecisionVariableIndices(binding.variables())});
  }
}

std::unique_ptr<ConvexSet> Spectrahedron::DoClone() const {
  return std::make_unique<Spectrahedron>(*this);
}

ScaledSet Spectrahedron::DoScaled() const {
  ScaledRows rows(ambient_dimension());
  for (const Term& term : terms_) {
    ScaledRows own(static_cast<int>(term.variables.size()));
    WriteScaled(*term.constraint, own);
    std::vector<ScaledRows::Combination> columns = {{{0, 1.0}}};
    for (const int i : term.variables) columns.push_back({{1 + i, 1.0}});
    rows.AddSet(own.Finish(), columns);
  }
  return rows.Finish();
}

}  // namespace switchyard
