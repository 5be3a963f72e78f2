#include "tests/io/same_program.hpp"

#include <algorithm>
#include <tuple>
#include <vector>

#include "core/io/flat.hpp"
#include "core/io/program_json.hpp"

namespace switchyard::testing {
namespace {

using io::FlatProgram;

bool Same(const SparseMatrix& a, const SparseMatrix& b) {
  if (a.rows() != b.rows() || a.cols() != b.cols() || a.nonZeros() != b.nonZeros()) return false;
  for (int j = 0; j < a.outerSize(); ++j) {
    SparseMatrix::InnerIterator other(b, j);
    for (SparseMatrix::InnerIterator it(a, j); it; ++it, ++other) {
      if (!other || it.row() != other.row() || it.value() != other.value()) return false;
    }
  }
  return true;
}

using Term = std::tuple<int, int, double>;

// The terms (row, variable, factor) of a cone, sorted, each (row, variable) once.
std::vector<Term> TermsOf(const MathematicalProgram& program,
                          const Binding<ConeConstraint>& binding) {
  const std::vector<int> index = io::IndicesOf(program, binding);
  std::vector<Term> terms;
  const SparseMatrix& A = binding.evaluator()->A();
  for (int j = 0; j < A.outerSize(); ++j) {
    for (SparseMatrix::InnerIterator it(A, j); it; ++it) {
      terms.emplace_back(static_cast<int>(it.row()), index[static_cast<std::size_t>(j)],
                         it.value());
    }
  }
  std::sort(terms.begin(), terms.end());
  std::vector<Term> merged;
  for (const auto& [row, variable, factor] : terms) {
    if (!merged.empty() && std::get<0>(merged.back()) == row &&
        std::get<1>(merged.back()) == variable) {
      std::get<2>(merged.back()) += factor;
    } else {
      merged.emplace_back(row, variable, factor);
    }
  }
  return merged;
}

std::string DifferenceOfCones(const MathematicalProgram& a, const MathematicalProgram& b) {
  const auto& cones = a.cone_constraints();
  const auto& others = b.cone_constraints();
  if (cones.size() != others.size()) return "the number of cones";
  for (std::size_t k = 0; k < cones.size(); ++k) {
    const ConeConstraint& x = *cones[k].evaluator();
    const ConeConstraint& y = *others[k].evaluator();
    if (x.cone().kind != y.cone().kind || x.cone().dim != y.cone().dim ||
        x.cone().parameter != y.cone().parameter) {
      return Text("the kind of cone ", k);
    }
    if (x.b() != y.b()) return Text("b of cone ", k);
    if (TermsOf(a, cones[k]) != TermsOf(b, others[k])) return Text("A of cone ", k);
  }
  return "";
}

bool SameSides(const Constraint& a, const Constraint& b) {
  return a.lower_bound() == b.lower_bound() && a.upper_bound() == b.upper_bound();
}
bool SameSides(const Cost& /*a*/, const Cost& /*b*/) { return true; }

// Of functions that are tapes.
template <class C>
std::string DifferenceOfFunctions(const MathematicalProgram& a, const MathematicalProgram& b,
                                  const std::vector<Binding<C>>& some,
                                  const std::vector<Binding<C>>& others) {
  if (some.size() != others.size()) return "the number of functions";
  for (std::size_t k = 0; k < some.size(); ++k) {
    const C& x = *some[k].evaluator();
    const C& y = *others[k].evaluator();
    const Tape* const tape = TapeOf(*io::FunctionOf(x));
    const Tape* const other = TapeOf(*io::FunctionOf(y));
    if (tape == nullptr || other == nullptr || !(*tape == *other)) {
      return Text("the operations of function ", k);
    }
    if (x.is_convex() != y.is_convex()) return Text("the convexity of function ", k);
    if (!SameSides(x, y)) return Text("the sides of function ", k);
    if (io::IndicesOf(a, some[k]) != io::IndicesOf(b, others[k])) {
      return Text("the variables of function ", k);
    }
  }
  return "";
}

std::string DifferenceOfForms(const MathematicalProgram& a, const MathematicalProgram& b) {
  const auto& forms = a.quadratic_constraints();
  const auto& others = b.quadratic_constraints();
  if (forms.size() != others.size()) return "the number of quadratic constraints";
  for (std::size_t k = 0; k < forms.size(); ++k) {
    const QuadraticConstraint& x = *forms[k].evaluator();
    const QuadraticConstraint& y = *others[k].evaluator();
    if (!Same(x.Q(), y.Q()) || x.b() != y.b() || !SameSides(x, y) ||
        x.hessian_type() != y.hessian_type()) {
      return Text("quadratic constraint ", k);
    }
    if (io::IndicesOf(a, forms[k]) != io::IndicesOf(b, others[k])) {
      return Text("the variables of quadratic constraint ", k);
    }
  }
  return "";
}

}  // namespace

std::string Difference(const MathematicalProgram& a, const MathematicalProgram& b) {
  if (a.objective_sense() != b.objective_sense()) return "the sense";
  if (a.num_vars() != b.num_vars()) return Text("variables: ", a.num_vars(), ", ", b.num_vars());
  for (int j = 0; j < a.num_vars(); ++j) {
    const bool integer = a.variable_type(j) != VariableType::kContinuous;
    if (integer != (b.variable_type(j) != VariableType::kContinuous)) {
      return Text("the type of variable ", j);
    }
  }
  const FlatProgram x = io::Flattened(a);
  const FlatProgram y = io::Flattened(b);
  for (int j = 0; j < a.num_vars(); ++j) {
    if (x.lower(j) != y.lower(j)) return Text("lower[", j, "]: ", x.lower(j), ", ", y.lower(j));
    if (x.upper(j) != y.upper(j)) return Text("upper[", j, "]: ", x.upper(j), ", ", y.upper(j));
    if (x.c(j) != y.c(j)) return Text("c[", j, "]: ", x.c(j), ", ", y.c(j));
  }
  if (x.constant != y.constant) return Text("the constant: ", x.constant, ", ", y.constant);
  if (!Same(x.Q, y.Q)) return "Q";
  if (!Same(x.A, y.A)) return "A";
  if (x.row_lower != y.row_lower) return "the lower sides of rows";
  if (x.row_upper != y.row_upper) return "the upper sides of rows";
  std::string difference = DifferenceOfCones(a, b);
  if (difference.empty()) difference = DifferenceOfForms(a, b);
  if (difference.empty()) {
    difference = DifferenceOfFunctions(a, b, a.generic_costs(), b.generic_costs());
  }
  if (difference.empty()) {
    difference = DifferenceOfFunctions(a, b, a.generic_constraints(), b.generic_constraints());
  }
  return difference;
}

std::string DifferenceOfNames(const MathematicalProgram& a, const MathematicalProgram& b) {
  if (a.name() != b.name()) return Text("the name: ", a.name(), ", ", b.name());
  for (int j = 0; j < a.num_vars(); ++j) {
    if (a.VariableName(j) != b.VariableName(j)) {
      return Text("variable ", j, ": ", a.VariableName(j), ", ", b.VariableName(j));
    }
  }
  const FlatProgram x = io::Flattened(a);
  const FlatProgram y = io::Flattened(b);
  for (std::size_t i = 0; i < x.row_names.size(); ++i) {
    if (x.row_names[i] != y.row_names[i]) {
      return Text("row ", i, ": ", x.row_names[i], ", ", y.row_names[i]);
    }
  }
  return "";
}

}  // namespace switchyard::testing
