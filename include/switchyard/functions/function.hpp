// switchyard/functions/function.hpp - functions R^n -> R^m with sparse derivatives.
#pragma once

#include <utility>
#include <vector>

#include "switchyard/export.hpp"

namespace switchyard {

/// The places of a sparse matrix at which values may stand: entry k is at (row[k], col[k]). Each
/// place once.
struct SparsityPattern {
  int rows = 0;
  int cols = 0;
  std::vector<int> row;
  std::vector<int> col;

  [[nodiscard]] int size() const { return static_cast<int>(row.size()); }
  void Add(int i, int j) {
    row.push_back(i);
    col.push_back(j);
  }
  /// Every place, column by column.
  SWITCHYARD_EXPORT static SparsityPattern Dense(int rows, int cols);
  /// Every place (i, j) with i <= j, column by column.
  SWITCHYARD_EXPORT static SparsityPattern DenseUpperTriangle(int size);
  friend bool operator==(const SparsityPattern&, const SparsityPattern&) = default;
};

/// What one evaluation asks for; what is not wanted is null. Values that are not defined at x come
/// as NaN or infinity.
struct Evaluation {
  const double* x = nullptr;        // num_vars
  double* values = nullptr;         // num_outputs
  double* jacobian = nullptr;       // in the order of the function's Jacobian pattern
  const double* weights = nullptr;  // w, num_outputs: read where a Hessian is wanted
  double* hessian = nullptr;        // of w'f, in the order of the function's Hessian pattern
};

/// A function R^num_vars -> R^num_outputs, constant once it is made. `Evaluate` may be called from
/// several threads at once where is_thread_safe().
class SWITCHYARD_EXPORT Function {
 public:
  virtual ~Function() = default;
  Function(const Function&) = delete;
  Function& operator=(const Function&) = delete;

  [[nodiscard]] int num_vars() const { return num_vars_; }
  [[nodiscard]] int num_outputs() const { return num_outputs_; }
  [[nodiscard]] bool has_jacobian() const { return has_jacobian_; }
  [[nodiscard]] bool has_hessian() const { return has_hessian_; }
  [[nodiscard]] bool is_thread_safe() const { return is_thread_safe_; }
  /// num_outputs x num_vars.
  [[nodiscard]] const SparsityPattern& jacobian() const { return jacobian_; }
  /// num_vars x num_vars, the upper triangle (row <= col) of the Hessian of any w'f.
  [[nodiscard]] const SparsityPattern& hessian() const { return hessian_; }

  /// Writes what is asked for. Asking for a derivative that it has not is a mistake of the caller.
  /// What the user's code throws passes through.
  virtual void Evaluate(const Evaluation& wanted) const = 0;

 protected:
  Function(int num_vars, int num_outputs) : num_vars_(num_vars), num_outputs_(num_outputs) {}
  void SetJacobian(SparsityPattern pattern) {
    jacobian_ = std::move(pattern);
    has_jacobian_ = true;
  }
  void SetHessian(SparsityPattern pattern) {
    hessian_ = std::move(pattern);
    has_hessian_ = true;
  }
  void set_is_thread_safe(bool safe) { is_thread_safe_ = safe; }

 private:
  int num_vars_;
  int num_outputs_;
  bool has_jacobian_ = false;
  bool has_hessian_ = false;
  bool is_thread_safe_ = true;
  SparsityPattern jacobian_;
  SparsityPattern hessian_;
};

}  // namespace switchyard
