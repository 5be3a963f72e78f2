#include <algorithm>

#include "switchyard/model/program.hpp"

namespace switchyard {

std::unique_ptr<MathematicalProgram> MathematicalProgram::Clone() const {
  return std::unique_ptr<MathematicalProgram>(new MathematicalProgram(*this));
}

double MathematicalProgram::EvalCosts(const VectorRef& x) const {
  Require(x.size() == num_vars(), "evaluation: x needs ", num_vars(), " entries, got ", x.size());
  double sum = 0;
  const auto add = [&](const auto& costs) {
    for (const auto& cost : costs) sum += EvalBinding(cost, x)[0];
  };
  add(linear_costs());
  add(quadratic_costs());
  add(norm_costs());
  add(generic_costs());
  return sum;
}

bool MathematicalProgram::CheckSatisfied(const Binding<Constraint>& binding, const VectorRef& x,
                                         double tolerance) const {
  return binding.evaluator()->CheckSatisfied(ValuesOf(binding.variables(), x), tolerance);
}

bool MathematicalProgram::CheckSatisfied(const std::vector<Binding<Constraint>>& bindings,
                                         const VectorRef& x, double tolerance) const {
  return std::all_of(bindings.begin(), bindings.end(), [&](const Binding<Constraint>& binding) {
    return CheckSatisfied(binding, x, tolerance);
  });
}

}  // namespace switchyard
