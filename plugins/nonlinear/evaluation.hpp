// nonlinear/evaluation.hpp - the functions of a sy_nlp as a solver calls them: points numbered,
// refusals remembered.
#pragma once

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <vector>

#include "switchyard/abi.h"

namespace switchyard::nonlinear {

/// Numbers for sy_evaluation.point. Solves of one problem follow each other, and instances share
/// functions: a number that came again for another x would call up what was cached for the first.
inline std::uint64_t NextPoint() {
  static std::atomic<std::uint64_t> last = 0;
  return ++last;
}

/// Calls evaluate of one nlp during one solve, from one thread at a time. After SY_ABORT it is
/// never called again: every later call answers SY_ABORT at once, so that the solver runs out of
/// steps and returns. Values that are not finite answer SY_UNDEFINED.
class Evaluation {
 public:
  Evaluation(const sy_nlp& nlp, std::int32_t num_vars)
      : nlp_(nlp), x_(static_cast<std::size_t>(num_vars)) {}

  [[nodiscard]] const sy_nlp& nlp() const { return nlp_; }
  [[nodiscard]] bool aborted() const { return aborted_; }
  /// Was a point that the solver tried outside the domain of the functions?
  [[nodiscard]] bool met_undefined() const { return met_undefined_; }
  [[nodiscard]] std::int64_t calls() const { return calls_; }

  sy_verdict Objective(const double* x, double* value) {
    return Call(x, SY_OBJECTIVE, &sy_evaluation::objective, value, 1);
  }
  /// `gradient`: num_vars, written whole.
  sy_verdict Gradient(const double* x, double* gradient) {
    return Call(x, SY_GRADIENT, &sy_evaluation::gradient, gradient, x_.size());
  }
  sy_verdict Constraints(const double* x, double* values) {
    return Call(x, SY_CONSTRAINTS, &sy_evaluation::constraints, values,
                static_cast<std::size_t>(nlp_.num_constraints));
  }
  /// In the order of nlp().jacobian.
  sy_verdict Jacobian(const double* x, double* values) {
    return Call(x, SY_JACOBIAN, &sy_evaluation::jacobian, values, Entries(nlp_.jacobian));
  }
  /// Of weight f + multipliers'c, in the order of nlp().hessian.
  sy_verdict Hessian(const double* x, double weight, const double* multipliers, double* values) {
    return Call(x, SY_HESSIAN, &sy_evaluation::hessian, values, Entries(nlp_.hessian), weight,
                multipliers);
  }

 private:
  static std::size_t Entries(const sy_csc& pattern) {
    return static_cast<std::size_t>(pattern.start[pattern.cols]);
  }

  /// Asks for one thing, `count` values at `to`.
  sy_verdict Call(const double* x, std::uint32_t want, double* sy_evaluation::*output, double* to,
                  std::size_t count, double weight = 0, const double* multipliers = nullptr) {
    if (aborted_) return SY_ABORT;
    if (point_ == 0 || !std::equal(x_.begin(), x_.end(), x)) {
      std::copy(x, x + x_.size(), x_.begin());
      point_ = NextPoint();
    }
    sy_evaluation e{};
    e.size = sizeof e;
    e.want = want;
    e.point = point_;
    e.x = x_.data();
    e.weight = weight;
    e.multipliers = multipliers;
    e.*output = to;
    ++calls_;
    sy_verdict verdict = nlp_.evaluate(nlp_.context, &e);
    const auto finite = [](double v) { return std::isfinite(v); };
    if (verdict == SY_EVALUATED && !std::all_of(to, to + count, finite)) verdict = SY_UNDEFINED;
    aborted_ = verdict == SY_ABORT;
    met_undefined_ = met_undefined_ || verdict == SY_UNDEFINED;
    return verdict;
  }

  const sy_nlp& nlp_;
  std::vector<double> x_;
  std::uint64_t point_ = 0;
  std::int64_t calls_ = 0;
  bool aborted_ = false;
  bool met_undefined_ = false;
};

}  // namespace switchyard::nonlinear
