#include "switchyard/model/program.hpp"

namespace switchyard {

Eigen::VectorXd MathematicalProgram::ValuesOf(const VectorXDecisionVariable& variables,
                                              const VectorRef& x) const {
  Require(x.size() == num_vars(), "evaluation: x needs ", num_vars(), " entries, got ", x.size());
  Eigen::VectorXd values(variables.size());
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    values[i] = x[FindDecisionVariableIndex(variables[i])];
  }
  return values;
}

double MathematicalProgram::EvalCosts(const VectorRef& x) const {
  Require(x.size() == num_vars(), "evaluation: x needs ", num_vars(), " entries, got ", x.size());
  double sum = 0;
  const auto add = [&](const auto& costs) {
    for (const auto& cost : costs) sum += EvalBinding(cost, x)[0];
  };
  add(linear_costs_);
  add(quadratic_costs_);
  add(norm_costs_);
  return sum;
}

bool MathematicalProgram::CheckSatisfied(const Binding<Constraint>& binding, const VectorRef& x,
                                         double tolerance) const {
  return binding.evaluator()->CheckSatisfied(ValuesOf(binding.variables(), x), tolerance);
}

}  // namespace switchyard
