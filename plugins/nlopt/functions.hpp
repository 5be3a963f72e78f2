// functions.hpp - objective and constraints of a program at one point, and their derivatives.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "nonlinear/evaluation.hpp"
#include "switchyard/abi.h"
#include "switchyard/problem.hpp"

namespace switchyard::nlopt {

/// f(x) + 1/2 x'Px + q'x + offset, and the constraints: the rows Ax, then c(x). What is linear or
/// quadratic comes from the data, the rest from the nlp, asked for once at each point.
class Functions {
 public:
  /// Borrows the problem, which has all its bounds and q.
  explicit Functions(const sy_problem& problem);

  [[nodiscard]] const sy_problem& problem() const { return p_; }
  [[nodiscard]] std::int32_t num_constraints() const { return p_.num_rows + num_nonlinear(); }
  [[nodiscard]] double lower(std::int32_t i) const { return Side(i, p_.row_lower, lower_); }
  [[nodiscard]] double upper(std::int32_t i) const { return Side(i, p_.row_upper, upper_); }
  [[nodiscard]] bool has_gradients() const { return has_gradients_; }
  /// Is it known which variables a constraint depends on?
  [[nodiscard]] bool HasPattern(std::int32_t i) const {
    return i < p_.num_rows || (p_.nlp->provides & SY_JACOBIAN) != 0;
  }
  /// Has evaluate said that it will not go on?
  [[nodiscard]] bool aborted() const { return evaluation_ && evaluation_->aborted(); }

  /// Goes to x (all variables). False where objective or constraints are not defined there: then
  /// the values are of no use.
  bool MoveTo(const double* x);
  /// The derivatives at the point. False where they are not defined there.
  bool Differentiate();
  /// The derivatives at x, without the values: these are then those of nowhere.
  bool DifferentiateAt(const double* x);

  /// The second derivatives at the point, of the objective less multipliers'constraints. Nothing
  /// where a nonlinear function provides none, or they are not defined there.
  std::optional<Eigen::MatrixXd> Hessian(const std::vector<double>& multipliers);

  [[nodiscard]] const std::vector<double>& x() const { return x_; }
  [[nodiscard]] double objective() const { return objective_; }
  [[nodiscard]] double value(std::int32_t i) const { return value_[std::size_t(i)]; }
  [[nodiscard]] const std::vector<double>& gradient() const { return gradient_; }
  /// num_vars x num_constraints: column i is the gradient of constraint i. Its pattern stands
  /// before any point is there, and so do the columns of rows. Those of nonlinear constraints are
  /// empty where these have no derivatives.
  [[nodiscard]] const Csc& normals() const { return normals_; }

  /// How far constraint i is outside its sides, relative to 1 + its largest term (of a row) or its
  /// side (of a nonlinear one).
  [[nodiscard]] double Violation(std::int32_t i) const;
  /// The largest one. The bounds are kept by whoever chooses the points.
  [[nodiscard]] double Violation() const;

 private:
  [[nodiscard]] std::int32_t num_nonlinear() const {
    return p_.nlp != nullptr ? p_.nlp->num_constraints : 0;
  }
  [[nodiscard]] double Side(std::int32_t i, const double* rows, const double* nonlinear) const {
    return i < p_.num_rows ? rows[i] : nonlinear[i - p_.num_rows];
  }
  void GoTo(const double* x);
  bool Evaluate();
  bool EvaluateDerivatives();

  enum class State { kUnknown, kDefined, kUndefined };

  const sy_problem& p_;
  const double* lower_ = nullptr;  // of the nonlinear constraints
  const double* upper_ = nullptr;
  std::optional<nonlinear::Evaluation> evaluation_;
  bool has_objective_ = false;  // of the nlp
  bool has_gradients_ = true;
  Csc normals_;
  std::vector<std::int32_t> place_;  // in normals_, of each entry of the nlp's Jacobian
  std::vector<double> entries_;      // of that Jacobian
  State state_ = State::kUnknown;
  State derivatives_ = State::kUnknown;
  std::vector<double> x_;
  double objective_ = 0;
  std::vector<double> value_, size_;  // size: the largest term of a row
  std::vector<double> gradient_;
};

}  // namespace switchyard::nlopt
