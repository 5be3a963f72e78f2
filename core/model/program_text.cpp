// Programs and bindings in words.
#include <cmath>

#include "switchyard/model/program.hpp"
#include "switchyard/symbolic/variable_names.hpp"

namespace switchyard {
namespace {

using Variables = VectorXDecisionVariable;

std::vector<Expression> Affine(const SparseMatrix& A, const Eigen::VectorXd* b,
                               const Variables& variables) {
  std::vector<Expression> rows(static_cast<std::size_t>(A.rows()));
  for (int j = 0; j < A.outerSize(); ++j) {
    for (SparseMatrix::InnerIterator entry(A, j); entry; ++entry) {
      rows[static_cast<std::size_t>(entry.row())].Add(entry.value(), variables[j]);
    }
  }
  for (std::size_t i = 0; b != nullptr && i < rows.size(); ++i) {
    rows[i] += (*b)[static_cast<Eigen::Index>(i)];
  }
  return rows;
}

Expression Quadratic(const SparseMatrix& Q, const Eigen::VectorXd& b, double c,
                     const Variables& x) {
  Expression sum = c;
  for (int j = 0; j < x.size(); ++j) sum.Add(b[j], x[j]);
  for (int j = 0; j < Q.outerSize(); ++j) {
    for (SparseMatrix::InnerIterator entry(Q, j); entry && entry.row() <= j; ++entry) {
      const double weight = entry.row() == j ? 0.5 : 1;
      sum += weight * entry.value() * (Expression(x[entry.row()]) * Expression(x[j]));
    }
  }
  return sum;
}

std::string List(const std::vector<Expression>& some) {
  std::string text;
  for (const Expression& e : some) text += (text.empty() ? "" : ", ") + e.to_string();
  return "(" + text + ")";
}

std::string Bounded(const std::string& body, double lower, double upper) {
  if (lower == upper) return Text(body, " = ", lower);
  std::string text = body;
  if (std::isfinite(lower)) text = Text(lower, " <= ", text);
  if (std::isfinite(upper)) text = Text(text, " <= ", upper);
  return text;
}

/// The value of the function, in an expression where it has one; a row each.
std::vector<std::string> Bodies(const EvaluatorBase& evaluator, const Variables& x) {
  std::vector<std::string> bodies;
  if (const auto* linear = dynamic_cast<const LinearConstraint*>(&evaluator)) {
    for (const Expression& row : Affine(linear->get_sparse_A(), nullptr, x)) {
      bodies.push_back(row.to_string());
    }
    return bodies;
  }
  if (const auto* form = dynamic_cast<const QuadraticConstraint*>(&evaluator)) {
    return {Quadratic(form->Q(), form->b(), 0, x).to_string()};
  }
  if (const auto* cost = dynamic_cast<const LinearCost*>(&evaluator)) {
    Expression sum = cost->b();
    for (Eigen::Index j = 0; j < x.size(); ++j) sum.Add(cost->a()[j], x[j]);
    return {sum.to_string()};
  }
  if (const auto* cost = dynamic_cast<const QuadraticCost*>(&evaluator)) {
    return {Quadratic(cost->Q(), cost->b(), cost->c(), x).to_string()};
  }
  if (const auto* norm = dynamic_cast<const NormCost*>(&evaluator)) {
    return {"of " + List(Affine(norm->A(), &norm->b(), x))};
  }
  std::string arguments;
  for (const Variable v : x) arguments += (arguments.empty() ? "" : ", ") + NameOf(v);
  for (int i = 0; i < evaluator.num_outputs(); ++i) {
    const std::string which = evaluator.num_outputs() == 1 ? "" : Text("[", i, "]");
    bodies.push_back(evaluator.Name() + which + "(" + arguments + ")");
  }
  return bodies;
}

template <class C>
void Append(const std::vector<Binding<C>>& bindings, std::string& text) {
  for (const auto& binding : bindings) text += "  " + binding.to_string() + "\n";
}

}  // namespace

std::string DescribeBinding(const EvaluatorBase& evaluator, const Variables& variables) {
  if (const auto* cone = dynamic_cast<const ConeConstraint*>(&evaluator)) {
    return cone->Name() + ": " + List(Affine(cone->A(), &cone->b(), variables));
  }
  const auto* constraint = dynamic_cast<const Constraint*>(&evaluator);
  std::string text = evaluator.Name() + ": ";
  const std::vector<std::string> bodies = Bodies(evaluator, variables);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (i > 0) text += "\n    ";
    const auto row = static_cast<Eigen::Index>(i);
    text += constraint == nullptr ? bodies[i]
                                  : Bounded(bodies[i], constraint->lower_bound()[row],
                                            constraint->upper_bound()[row]);
  }
  return text;
}

std::string MathematicalProgram::to_string() const {
  std::string text = name_.empty() ? "" : name_ + "\n";
  text += Text(num_vars(), num_vars() == 1 ? " variable" : " variables");
  int integers = 0;
  for (int j = 0; j < num_vars(); ++j) {
    if (variable_type(j) != VariableType::kContinuous) ++integers;
  }
  if (integers > 0) text += Text(", ", integers, " of them integer");
  text += "\n";
  text += objective_sense() == ObjectiveSense::kMaximize ? "maximize\n" : "minimize\n";
  Append(GetAllCosts(), text);
  text += "subject to\n";
  Append(GetAllConstraints(), text);
  return text;
}

}  // namespace switchyard
