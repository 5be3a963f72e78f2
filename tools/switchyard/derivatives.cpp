#include "derivatives.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>

#include "switchyard/model/check_program_derivatives.hpp"

namespace switchyard::cli {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

Eigen::VectorXd GuessWithinBounds(const MathematicalProgram& program) {
  Eigen::VectorXd lower = Eigen::VectorXd::Constant(program.num_vars(), -kInf);
  Eigen::VectorXd upper = -lower;
  for (const auto& box : program.bounding_box_constraints()) {
    const auto index = program.FindDecisionVariableIndices(box.variables());
    for (std::size_t k = 0; k < index.size(); ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      lower[index[k]] = std::max(lower[index[k]], box.evaluator()->lower_bound()[i]);
      upper[index[k]] = std::min(upper[index[k]], box.evaluator()->upper_bound()[i]);
    }
  }
  Eigen::VectorXd x = program.initial_guess();
  for (int j = 0; j < program.num_vars(); ++j) {
    if (!std::isnan(x[j])) continue;
    const double middle = 0.5 * lower[j] + 0.5 * upper[j];
    x[j] = std::isfinite(middle) ? middle : std::min(std::max(0.0, lower[j]), upper[j]);
  }
  return x;
}

template <class C>
bool AllDefined(const MathematicalProgram& program, const std::vector<Binding<C>>& terms,
                const Eigen::VectorXd& x) {
  return std::all_of(terms.begin(), terms.end(), [&](const Binding<C>& term) {
    return program.EvalBinding(term, x).allFinite();
  });
}

}  // namespace

bool CheckDerivativesAtGuess(const MathematicalProgram& program, bool quiet) {
  const Eigen::VectorXd x = GuessWithinBounds(program);
  const ProgramDerivativeReport report = CheckDerivatives(program, x);
  if (!quiet) {
    const bool none = report.num_terms == 0 && report.notes.empty();
    std::cout << (none ? "the program has no functions\n" : to_string(report));
  }
  return report.agrees() && AllDefined(program, program.generic_costs(), x) &&
         AllDefined(program, program.generic_constraints(), x);
}

}  // namespace switchyard::cli
