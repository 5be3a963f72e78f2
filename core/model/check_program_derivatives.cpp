#include "switchyard/model/check_program_derivatives.hpp"

#include <algorithm>
#include <cmath>

#include "switchyard/error.hpp"

namespace switchyard {
namespace {

class EvaluatorFunction final : public Function {
 public:
  explicit EvaluatorFunction(std::shared_ptr<const EvaluatorBase> evaluator)
      : Function(evaluator->num_vars(), evaluator->num_outputs()),
        evaluator_(std::move(evaluator)) {
    if (evaluator_->has_jacobian()) SetJacobian(evaluator_->JacobianPattern());
    if (evaluator_->has_hessian()) SetHessian(evaluator_->HessianPattern());
    set_is_thread_safe(evaluator_->is_thread_safe());
  }
  void Evaluate(const Evaluation& wanted) const override { evaluator_->Evaluate(wanted); }

 private:
  std::shared_ptr<const EvaluatorBase> evaluator_;
};

class Check {
 public:
  Check(const MathematicalProgram& program, const Eigen::VectorXd& x, double tolerance)
      : program_(program), x_(x), tolerance_(tolerance) {}

  template <class C>
  void Terms(const std::vector<Binding<C>>& bindings) {
    for (const auto& binding : bindings) Term(binding);
  }
  [[nodiscard]] const ProgramDerivativeReport& report() const { return report_; }

 private:
  template <class C>
  void Term(const Binding<C>& binding) {
    const auto& evaluator = *binding.evaluator();
    const std::string name = evaluator.Name();
    const Eigen::VectorXd values = program_.ValuesOf(binding.variables(), x_);
    if (!evaluator.has_jacobian()) {
      report_.notes.push_back(name + " has no derivatives");
      return;
    }
    if (!evaluator.has_hessian()) report_.notes.push_back(name + " has no second derivatives");
    if (!program_.EvalBinding(binding, x_).allFinite()) {
      report_.notes.push_back(name + " is not defined at the point");
      return;
    }
    ++report_.num_terms;
    const auto function = AsFunction(binding.evaluator());
    const DerivativeReport found = CheckDerivatives(*function, values, {}, tolerance_);
    report_.worst_error = std::max(report_.worst_error, found.worst_error);
    for (const auto& entry : found.disagreeing) Add(binding, entry, false);
    for (const auto& entry : found.missing) Add(binding, entry, true);
  }

  template <class C>
  void Add(const Binding<C>& binding, const DerivativeMismatch& entry, bool missing) {
    const auto variable = [&](int j) {
      return program_.VariableName(program_.FindDecisionVariableIndex(binding.variables()[j]));
    };
    const std::string name = binding.evaluator()->Name();
    std::string row = name;
    if (entry.kind == DerivativeMismatch::Kind::kHessian) {
      row = variable(entry.row);
    } else if (const auto* constraint =
                   dynamic_cast<const Constraint*>(binding.evaluator().get())) {
      row = constraint->RowName(entry.row);
    }
    report_.wrong.push_back({row, variable(entry.col), name, missing, entry});
  }

  const MathematicalProgram& program_;
  const Eigen::VectorXd& x_;
  double tolerance_;
  ProgramDerivativeReport report_;
};

}  // namespace

std::shared_ptr<const Function> AsFunction(std::shared_ptr<const EvaluatorBase> evaluator) {
  Require(evaluator != nullptr, "AsFunction needs an evaluator, got a null pointer");
  return std::make_shared<EvaluatorFunction>(std::move(evaluator));
}

ProgramDerivativeReport CheckDerivatives(const MathematicalProgram& program,
                                         const Eigen::VectorXd& x, double tolerance) {
  Require(x.size() == program.num_vars(), "CheckDerivatives: x needs ", program.num_vars(),
          " entries, got ", x.size());
  Check check(program, x, tolerance);
  check.Terms(program.generic_costs());
  check.Terms(program.quadratic_constraints());
  check.Terms(program.generic_constraints());
  return check.report();
}

std::string to_string(const ProgramDerivativeReport& report) {
  std::string text;
  for (const TermMismatch& one : report.wrong) {
    const bool second = one.entry.kind == DerivativeMismatch::Kind::kHessian;
    text += second ? Text("second derivative of ", one.term, " by ", one.row, " and ", one.column)
                   : Text("derivative of ", one.row, " by ", one.column);
    text += one.is_missing ? Text(": the pattern has no place for it, differences say ",
                                  one.entry.by_differences, "\n")
                           : Text(" is ", one.entry.ours, ", differences say ",
                                  one.entry.by_differences, "\n");
  }
  for (const std::string& note : report.notes) text += note + "\n";
  if (report.wrong.empty() && report.num_terms > 0) {
    text +=
        Text("the derivatives of ", report.num_terms, report.num_terms == 1 ? " term" : " terms",
             " agree with differences to ", report.worst_error, "\n");
  }
  return text;
}

}  // namespace switchyard
