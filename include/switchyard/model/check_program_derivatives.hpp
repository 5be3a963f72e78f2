// switchyard/model/check_program_derivatives.hpp - are the derivatives of a program's functions
// those of their values?
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "switchyard/export.hpp"
#include "switchyard/functions/check_derivatives.hpp"
#include "switchyard/model/program.hpp"

namespace switchyard {

/// An evaluator as a Function, which shares it.
SWITCHYARD_EXPORT std::shared_ptr<const Function> AsFunction(
    std::shared_ptr<const EvaluatorBase> evaluator);

/// An entry of a derivative of one term beside what differences say of it, in the program's names.
struct TermMismatch {
  std::string row;     // of a Jacobian: the constraint's row, or the cost; of a Hessian: a variable
  std::string column;  // the variable
  std::string term;    // the cost or constraint
  bool is_missing = false;  // the pattern has no place for it
  DerivativeMismatch entry;
};

struct ProgramDerivativeReport {
  std::vector<TermMismatch> wrong;
  /// Functions that are not defined at the point, or have no derivatives to be checked.
  std::vector<std::string> notes;
  int num_terms = 0;  // checked
  double worst_error = 0;

  [[nodiscard]] bool agrees() const { return wrong.empty(); }
};

/// Compares the first and second derivatives of every cost and constraint that is a function or a
/// quadratic form at a point with differences: see CheckDerivatives of a Function.
SWITCHYARD_EXPORT ProgramDerivativeReport CheckDerivatives(const MathematicalProgram& program,
                                                           const Eigen::VectorXd& x,
                                                           double tolerance = 1e-6);

/// A line for each wrong entry and each note, or that all agree and how far.
SWITCHYARD_EXPORT std::string to_string(const ProgramDerivativeReport& report);

}  // namespace switchyard
