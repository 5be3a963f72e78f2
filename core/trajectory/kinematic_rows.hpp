// core/trajectory/kinematic_rows.hpp - rows D p against b T^k: bounds of a derivative of q.
#pragma once

#include <memory>
#include <string>

#include "switchyard/model/constraint.hpp"

namespace switchyard {

/// lower <= A x <= upper, x a derivative of q in time, as rows D p - b T^k of its control points:
/// one for each side that is finite, one for both where they are equal.
struct SideRows {
  enum class Sides { kAll, kLower, kUpper, kEqual };

  /// D = A W where T^k x = W p.
  SideRows(const SparseMatrix& A, const VectorRef& lower, const VectorRef& upper,
           const SparseMatrix& W, Sides sides = Sides::kAll);
  [[nodiscard]] bool empty() const { return b.size() == 0; }
  /// For k = 1, of (p, T).
  [[nodiscard]] std::shared_ptr<LinearConstraint> OfDuration() const;

  SparseMatrix D;
  Eigen::VectorXd b;
  Eigen::VectorXd low, high;  // of D p - b T^k: 0 or infinite
};

/// T_0^-k low <= T_0^-k (D p - b T^k) <= T_0^-k high, of the variables (p, T) and k >= 2. Where T
/// is near T_0 the rows are in the units of D p / T^k, whatever the unit of time.
///
/// The Jacobian is T_0^-k D beside -k b T_0^-k T^{k-1}: only its last column depends on the point,
/// and of the Hessian only the entry (T, T) is not 0.
class PowerRows final : public Constraint {
 public:
  PowerRows(const SideRows& rows, int k, double T_0);
  /// For another T_0.
  void Rescale(double T_0);
  [[nodiscard]] std::string Kind() const override { return "bounds of a derivative"; }
  [[nodiscard]] bool has_jacobian() const override { return true; }
  [[nodiscard]] bool has_hessian() const override { return true; }
  [[nodiscard]] SparsityPattern JacobianPattern() const override;
  [[nodiscard]] SparsityPattern HessianPattern() const override;

 private:
  using RowMajor = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  [[nodiscard]] Eigen::VectorXd DoEval(const VectorRef& x) const override;
  void DoEvaluate(const Evaluation& wanted) const override;
  [[nodiscard]] double ViolationOf(const Eigen::VectorXd& y) const override;

  int k_;
  double scale_;       // T_0^-k
  RowMajor D_;         // scaled
  Eigen::VectorXd b_;  // likewise
};

}  // namespace switchyard
