// functions.hpp - the nonlinear functions of a problem as Ipopt asks for them.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "linear/watch.hpp"
#include "nonlinear/evaluation.hpp"
#include "shape.hpp"
#include "switchyard/abi.h"

namespace switchyard::ipopt {

/// f and c of one solve, f = 0 where the problem has none. They are asked for within the bounds of
/// the variables alone. What fails was asked for outside their domain, after a function ended the
/// solve, or with the budget spent: Ipopt then shortens its step until it stops.
class Functions {
 public:
  /// Borrows both; the problem has all its bounds.
  Functions(const sy_problem& problem, linear::Watch& watch)
      : p_(problem), watch_(watch), x_(static_cast<std::size_t>(problem.num_vars)) {
    if (HasFunctions(p_)) evaluation_.emplace(*p_.nlp, p_.num_vars);
    if (HasObjective(p_)) gradient_.resize(x_.size());
    if (!HasConstraints(p_)) return;
    c_.resize(static_cast<std::size_t>(p_.nlp->num_constraints));
    const sy_csc& pattern = p_.nlp->jacobian;
    jacobian_.resize(static_cast<std::size_t>(pattern.start[pattern.cols]));
  }

  /// Has a function ended the solve?
  [[nodiscard]] bool ended() const { return evaluation_ && evaluation_->aborted(); }
  /// Was a point outside their domain?
  [[nodiscard]] bool met_undefined() const { return evaluation_ && evaluation_->met_undefined(); }

  /// No more runs: what is asked from here on is answered though the budget is spent.
  void Finish() { finished_ = true; }

  bool AddObjective(const double* x, double& sum) {
    if (!HasObjective(p_)) return true;
    double value = 0;
    if (!IsOpen() || !Holds(evaluation_->Objective(Inside(x), &value))) return false;
    sum += value;
    return true;
  }
  bool AddGradient(const double* x, double* sum) {
    if (!HasObjective(p_)) return true;
    if (!IsOpen() || !Holds(evaluation_->Gradient(Inside(x), gradient_.data()))) return false;
    for (std::size_t j = 0; j < gradient_.size(); ++j) sum[j] += gradient_[j];
    return true;
  }
  /// c(x), of a problem that has constraints; null where that fails.
  const double* Constraints(const double* x) {
    return IsOpen() && Holds(evaluation_->Constraints(Inside(x), c_.data())) ? c_.data() : nullptr;
  }
  /// Its derivatives in the order of nlp->jacobian, likewise.
  const double* Jacobian(const double* x) {
    return IsOpen() && Holds(evaluation_->Jacobian(Inside(x), jacobian_.data())) ? jacobian_.data()
                                                                                 : nullptr;
  }
  /// Of weight f + multipliers'c, in the order of nlp->hessian.
  bool Hessian(const double* x, double weight, const double* multipliers, double* values) {
    return IsOpen() && Holds(evaluation_->Hessian(Inside(x), weight, multipliers, values));
  }

 private:
  static bool Holds(sy_verdict verdict) { return verdict == SY_EVALUATED; }
  bool IsOpen() { return finished_ || !watch_.Stopped(); }

  // Ipopt may leave the bounds by a rounding error.
  const double* Inside(const double* x) {
    for (std::size_t j = 0; j < x_.size(); ++j) {
      x_[j] = std::clamp(x[j], p_.x_lower[j], p_.x_upper[j]);
    }
    return x_.data();
  }

  const sy_problem& p_;
  linear::Watch& watch_;
  std::optional<nonlinear::Evaluation> evaluation_;
  std::vector<double> x_, gradient_, c_, jacobian_;
  bool finished_ = false;
};

}  // namespace switchyard::ipopt
