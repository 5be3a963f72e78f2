// core/lower/nonlinear.hpp - the terms of a program that are neither affine nor a cone, as one
// sy_nlp.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <exception>
#include <memory>
#include <mutex>
#include <vector>

#include "core/lower/scatter.hpp"
#include "switchyard/abi.h"
#include "switchyard/functions/evaluation_counts.hpp"
#include "switchyard/model/program.hpp"

namespace switchyard {

/// What the terms are, where each stands, and how each is evaluated: the same as long as no term is
/// added or changes its pattern. Const use from any number of threads, as far as the user's
/// functions permit it.
class NonlinearTerms {
 public:
  /// Quadratic constraints, then generic ones. `num_vars`: of the lowered problem.
  NonlinearTerms(const MathematicalProgram& program, std::int32_t num_vars);

  [[nodiscard]] std::int32_t num_rows() const { return num_rows_; }
  [[nodiscard]] const Csc& jacobian() const { return jacobian_.pattern; }
  [[nodiscard]] const Csc& hessian() const { return hessian_.pattern; }
  [[nodiscard]] std::uint32_t provides() const { return provides_; }
  [[nodiscard]] bool thread_safe() const { return thread_safe_; }
  [[nodiscard]] std::int32_t FirstRow(std::size_t constraint) const {
    return rows_[constraint].first_row;
  }
  /// Are the patterns of the terms what they were?
  [[nodiscard]] bool SamePatterns() const;

  [[nodiscard]] double Objective(const double* x) const;
  void Gradient(const double* x, double* gradient) const;
  void Constraints(const double* x, double* values) const;
  void Jacobian(const double* x, double* values) const;
  void Hessian(const double* x, double weight, const double* multipliers, double* values) const;

 private:
  struct Term {
    std::shared_ptr<const EvaluatorBase> evaluator;
    std::vector<int> index;  // of its variables in the problem
    std::int32_t first_row = -1;
    std::size_t first_jacobian = 0;  // its places among all
    std::size_t first_hessian = 0;
    SparsityPattern jacobian;
    SparsityPattern hessian;
    /// Entries of the Hessian that meet on the diagonal because one variable is bound twice count
    /// twice.
    std::vector<std::uint8_t> folded;
  };
  /// Places that are still to be scattered.
  struct Places {
    std::vector<std::int32_t> row;
    std::vector<std::int32_t> col;
  };

  template <class C>
  void Add(const MathematicalProgram& program, const Binding<C>& binding, bool is_cost);
  void AddHessianPlaces(Term& term, Places& places);
  void LookAtDerivatives(const EvaluatorBase& evaluator);

  std::vector<Term> costs_;
  std::vector<Term> rows_;
  std::int32_t num_rows_ = 0;
  std::uint32_t provides_ = SY_OBJECTIVE | SY_GRADIENT | SY_CONSTRAINTS | SY_JACOBIAN | SY_HESSIAN;
  bool thread_safe_ = true;
  double sign_ = 1;  // -1 where the program maximizes
  Scatter jacobian_;
  Scatter hessian_;
};

/// The sy_nlp over such terms: their bounds, a cache of the last point, what the user's functions
/// threw, and the counts. It stays in place.
class NonlinearPart {
 public:
  NonlinearPart(std::shared_ptr<const NonlinearTerms> terms, const MathematicalProgram& program);
  NonlinearPart(const NonlinearPart&) = delete;
  NonlinearPart& operator=(const NonlinearPart&) = delete;

  [[nodiscard]] const sy_nlp& record() const { return record_; }
  [[nodiscard]] const std::shared_ptr<const NonlinearTerms>& terms() const { return terms_; }
  [[nodiscard]] const std::vector<double>& lower() const { return lower_; }
  [[nodiscard]] const std::vector<double>& upper() const { return upper_; }

  [[nodiscard]] EvaluationCounts counts() const;
  void ClearCounts();
  /// What the user's function threw during a solve, once that is over.
  void RethrowWhatWasThrown();

 private:
  enum Kind { kObjective, kGradient, kConstraints, kJacobian, kHessian, kNumKinds };
  /// What is known at the last point.
  struct Cache {
    std::vector<double> x;
    std::array<bool, kNumKinds> known = {};
    double objective = 0;
    std::vector<double> gradient, constraints, jacobian;
  };

  static sy_verdict Evaluate(void* context, sy_evaluation* wanted) noexcept;
  sy_verdict Answer(const sy_evaluation& wanted);
  bool FromCache(const sy_evaluation& wanted);
  bool Afresh(const sy_evaluation& wanted);
  void Count(Kind kind) { counts_[kind].fetch_add(1, std::memory_order_relaxed); }

  std::shared_ptr<const NonlinearTerms> terms_;
  std::vector<double> lower_;
  std::vector<double> upper_;
  sy_nlp record_{};
  std::mutex caching_;
  Cache cache_;
  std::array<std::atomic<std::int64_t>, kNumKinds> counts_ = {};
  std::mutex throwing_;
  std::exception_ptr thrown_;
};

/// Do all functions that the program's terms need belong into an nlp: are there functions, or
/// quadratic constraints that are not convex?
bool NeedsNonlinearPart(const MathematicalProgram& program);

}  // namespace switchyard
