// switchyard/model/evaluator.hpp - functions of a vector that a program binds to its variables.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <cstdint>
#include <string>
#include <utility>

#include "switchyard/error.hpp"
#include "switchyard/export.hpp"
#include "switchyard/functions/function.hpp"

namespace switchyard {

using SparseMatrix = Eigen::SparseMatrix<double>;
using VectorRef = Eigen::Ref<const Eigen::VectorXd>;

/// The argument "a matrix of coefficients", dense or sparse; stored sparse. Exact
/// zeros are left out of a dense one; a sparse one keeps its pattern, so that it can be kept while
/// numbers change.
class CoefficientMatrix {
 public:
  // NOLINTBEGIN(google-explicit-constructor): an argument type, made to convert
  template <class Derived>
  CoefficientMatrix(const Eigen::MatrixBase<Derived>& dense)
      : sparse_(dense.template cast<double>().sparseView(1.0, 0.0)) {}
  CoefficientMatrix(const SparseMatrix& sparse) : sparse_(sparse) { sparse_.makeCompressed(); }
  CoefficientMatrix(SparseMatrix&& sparse) {
    sparse_.swap(sparse);
    sparse_.makeCompressed();
  }
  template <class Derived>
  CoefficientMatrix(const Eigen::SparseMatrixBase<Derived>& sparse) : sparse_(sparse) {
    sparse_.makeCompressed();
  }
  // NOLINTEND(google-explicit-constructor)

  // Moved by swapping: an Eigen::SparseMatrix of version 3.4 has no move of its own.
  CoefficientMatrix(const CoefficientMatrix&) = default;
  CoefficientMatrix(CoefficientMatrix&& other) { sparse_.swap(other.sparse_); }
  CoefficientMatrix& operator=(CoefficientMatrix other) {
    sparse_.swap(other.sparse_);
    return *this;
  }

  [[nodiscard]] const SparseMatrix& sparse() const { return sparse_; }
  /// Moves the matrix into `target`.
  void MoveInto(SparseMatrix* target) && { target->swap(sparse_); }

 private:
  SparseMatrix sparse_;
};

/// A function R^num_vars -> R^num_outputs. Evaluation is const and may happen from several threads
/// at once where is_thread_safe(), which is so for all but functions of the user's that say
/// otherwise; the Update... members are for one thread while no other reads.
class SWITCHYARD_EXPORT EvaluatorBase {
 public:
  EvaluatorBase(const EvaluatorBase&) = delete;
  EvaluatorBase& operator=(const EvaluatorBase&) = delete;
  virtual ~EvaluatorBase() = default;

  [[nodiscard]] int num_vars() const { return num_vars_; }
  [[nodiscard]] int num_outputs() const { return num_outputs_; }

  /// y = f(x). Throws InvalidArgument where x has another size than num_vars().
  void Eval(VectorRef x, Eigen::VectorXd* y) const {
    if (x.size() != num_vars_) {  // Name() is made only where it is said
      Refuse("Eval of ", Name(), ": x needs ", num_vars_, " entries, got ", x.size());
    }
    *y = DoEval(x);
  }

  // ---- Derivatives, exact where there are any ----

  [[nodiscard]] virtual bool has_jacobian() const { return false; }
  [[nodiscard]] virtual bool has_hessian() const { return false; }
  [[nodiscard]] virtual bool is_thread_safe() const { return true; }
  /// Where the Jacobian (num_outputs x num_vars) may differ from 0; everywhere, if nothing is said.
  [[nodiscard]] virtual SparsityPattern JacobianPattern() const;
  /// Where the upper triangle (row <= col) of the Hessian of any w'f may.
  [[nodiscard]] virtual SparsityPattern HessianPattern() const;
  /// Writes what is asked for, in the order of the patterns. Sizes are the caller's business.
  void Evaluate(const Evaluation& wanted) const { DoEvaluate(wanted); }
  /// num_outputs x num_vars. Throws InvalidArgument where x has another size than num_vars(), and
  /// where there is no Jacobian.
  [[nodiscard]] SparseMatrix EvalJacobian(VectorRef x) const;
  /// The Hessian of weights'f, num_vars x num_vars, both triangles. Throws likewise.
  [[nodiscard]] SparseMatrix EvalHessian(VectorRef x, VectorRef weights) const;

  /// Grows with every change of coefficients.
  [[nodiscard]] std::uint64_t version() const { return version_; }

  /// What messages call it.
  void set_description(std::string description) { description_ = std::move(description); }
  [[nodiscard]] const std::string& get_description() const { return description_; }
  /// The description, or the kind of function where there is none.
  [[nodiscard]] std::string Name() const { return description_.empty() ? Kind() : description_; }
  [[nodiscard]] virtual std::string Kind() const = 0;

 protected:
  EvaluatorBase(int num_vars, int num_outputs) : num_vars_(num_vars), num_outputs_(num_outputs) {}
  void CoefficientsChanged() { ++version_; }
  [[nodiscard]] virtual Eigen::VectorXd DoEval(const VectorRef& x) const = 0;
  /// A class with derivatives writes all that is wanted; one without them leaves this as it is.
  virtual void DoEvaluate(const Evaluation& wanted) const;

 private:
  int num_vars_;
  int num_outputs_;
  std::string description_;
  std::uint64_t version_ = 0;
};

}  // namespace switchyard
