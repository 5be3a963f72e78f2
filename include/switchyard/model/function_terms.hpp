// switchyard/model/function_terms.hpp - costs and constraints that are neither affine nor a cone:
// functions in a box, function costs, quadratic forms in an interval.
#pragma once

#include <memory>
#include <optional>

#include "switchyard/functions/function.hpp"
#include "switchyard/model/constraint.hpp"
#include "switchyard/model/cost.hpp"

namespace switchyard {

/// f(x).
class SWITCHYARD_EXPORT FunctionCost final : public Cost {
 public:
  /// `is_convex`: the caller knows f to be convex where it is defined; then a local optimum of a
  /// program that is convex otherwise is one, and is reported so. Throws InvalidArgument where the
  /// function has more than one output.
  explicit FunctionCost(std::shared_ptr<const Function> function, bool is_convex = false);
  [[nodiscard]] const std::shared_ptr<const Function>& function() const { return function_; }
  [[nodiscard]] bool is_convex() const override { return is_convex_; }
  [[nodiscard]] std::string Kind() const override { return "function cost"; }
  [[nodiscard]] bool has_jacobian() const override { return function_->has_jacobian(); }
  [[nodiscard]] bool has_hessian() const override { return function_->has_hessian(); }
  [[nodiscard]] bool is_thread_safe() const override { return function_->is_thread_safe(); }
  [[nodiscard]] SparsityPattern JacobianPattern() const override { return function_->jacobian(); }
  [[nodiscard]] SparsityPattern HessianPattern() const override { return function_->hessian(); }

 private:
  [[nodiscard]] Eigen::VectorXd DoEval(const VectorRef& x) const override;
  void DoEvaluate(const Evaluation& wanted) const override { function_->Evaluate(wanted); }
  std::shared_ptr<const Function> function_;
  bool is_convex_;
};

/// lower <= f(x) <= upper, row by row; infinite sides are free.
class SWITCHYARD_EXPORT FunctionConstraint final : public Constraint {
 public:
  /// `is_convex`: the caller knows f_i to be convex where upper[i] is finite and concave where
  /// lower[i] is (affine where both are).
  FunctionConstraint(std::shared_ptr<const Function> function, const VectorRef& lower,
                     const VectorRef& upper, bool is_convex = false);
  [[nodiscard]] const std::shared_ptr<const Function>& function() const { return function_; }
  [[nodiscard]] bool is_convex() const override { return is_convex_; }
  void UpdateBounds(const VectorRef& lower, const VectorRef& upper);
  [[nodiscard]] std::string Kind() const override { return "function constraint"; }
  [[nodiscard]] bool has_jacobian() const override { return function_->has_jacobian(); }
  [[nodiscard]] bool has_hessian() const override { return function_->has_hessian(); }
  [[nodiscard]] bool is_thread_safe() const override { return function_->is_thread_safe(); }
  [[nodiscard]] SparsityPattern JacobianPattern() const override { return function_->jacobian(); }
  [[nodiscard]] SparsityPattern HessianPattern() const override { return function_->hessian(); }

 private:
  [[nodiscard]] Eigen::VectorXd DoEval(const VectorRef& x) const override;
  void DoEvaluate(const Evaluation& wanted) const override { function_->Evaluate(wanted); }
  [[nodiscard]] double ViolationOf(const Eigen::VectorXd& y) const override;
  std::shared_ptr<const Function> function_;
  bool is_convex_;
};

/// lower <= 1/2 x'Qx + b'x <= upper, one row. Q is stored symmetric: (Q + Q')/2 of what was given.
/// Convex ones become a rotated cone where nothing else of the program is nonlinear.
class SWITCHYARD_EXPORT QuadraticConstraint final : public Constraint {
 public:
  enum class HessianType { kPositiveSemidefinite, kNegativeSemidefinite, kIndefinite };
  /// `hessian_type` where the caller knows; else found by factorizations, as that of QuadraticCost.
  QuadraticConstraint(const CoefficientMatrix& Q, const VectorRef& b, double lower, double upper,
                      std::optional<HessianType> hessian_type = std::nullopt);
  [[nodiscard]] const SparseMatrix& Q() const { return Q_; }
  [[nodiscard]] const Eigen::VectorXd& b() const { return b_; }
  [[nodiscard]] HessianType hessian_type() const { return hessian_type_; }
  /// Is the set convex: Q positive semidefinite without a lower side, or negative semidefinite
  /// without an upper one?
  [[nodiscard]] bool is_convex() const override;
  void UpdateCoefficients(const CoefficientMatrix& Q, const VectorRef& b, double lower,
                          double upper, std::optional<HessianType> hessian_type = std::nullopt);
  [[nodiscard]] std::string Kind() const override { return "quadratic constraint"; }
  [[nodiscard]] bool has_jacobian() const override { return true; }
  [[nodiscard]] bool has_hessian() const override { return true; }
  [[nodiscard]] SparsityPattern JacobianPattern() const override;
  [[nodiscard]] SparsityPattern HessianPattern() const override;

 private:
  [[nodiscard]] Eigen::VectorXd DoEval(const VectorRef& x) const override;
  void DoEvaluate(const Evaluation& wanted) const override;
  [[nodiscard]] double ViolationOf(const Eigen::VectorXd& y) const override;
  void CheckAndStore(const CoefficientMatrix& Q, const VectorRef& b, double lower, double upper,
                     std::optional<HessianType> hessian_type);
  SparseMatrix Q_;
  Eigen::VectorXd b_;
  HessianType hessian_type_ = HessianType::kIndefinite;
};

}  // namespace switchyard
