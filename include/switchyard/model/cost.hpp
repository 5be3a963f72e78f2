// switchyard/model/cost.hpp - the costs that a program stores: linear, quadratic and norms.
#pragma once

#include <optional>

#include "switchyard/model/evaluator.hpp"

namespace switchyard {

class SWITCHYARD_EXPORT Cost : public EvaluatorBase {
 public:
  /// Is it known to be convex where it is defined?
  [[nodiscard]] virtual bool is_convex() const { return false; }

 protected:
  explicit Cost(int num_vars) : EvaluatorBase(num_vars, 1) {}
};

/// a'x + b.
class SWITCHYARD_EXPORT LinearCost final : public Cost {
 public:
  explicit LinearCost(const VectorRef& a, double b = 0);
  [[nodiscard]] const Eigen::VectorXd& a() const { return a_; }
  [[nodiscard]] double b() const { return b_; }
  void UpdateCoefficients(const VectorRef& a, double b = 0);
  [[nodiscard]] std::string Kind() const override { return "linear cost"; }
  [[nodiscard]] bool is_convex() const override { return true; }
  [[nodiscard]] bool has_jacobian() const override { return true; }
  [[nodiscard]] bool has_hessian() const override { return true; }
  [[nodiscard]] SparsityPattern JacobianPattern() const override;
  [[nodiscard]] SparsityPattern HessianPattern() const override;

 private:
  [[nodiscard]] Eigen::VectorXd DoEval(const VectorRef& x) const override;
  void DoEvaluate(const Evaluation& wanted) const override;
  Eigen::VectorXd a_;
  double b_;
};

/// 1/2 x'Qx + b'x + c. Q is stored symmetric: (Q + Q')/2 of what was given.
class SWITCHYARD_EXPORT QuadraticCost final : public Cost {
 public:
  /// `is_convex` where the caller knows; else found by a factorization: each connected component of
  /// Q's pattern counts as positive semidefinite where no pivot is below -1e-12 times its largest
  /// entry.
  QuadraticCost(const CoefficientMatrix& Q, const VectorRef& b, double c = 0,
                std::optional<bool> is_convex = std::nullopt);
  [[nodiscard]] const SparseMatrix& Q() const { return Q_; }
  [[nodiscard]] const Eigen::VectorXd& b() const { return b_; }
  [[nodiscard]] double c() const { return c_; }
  [[nodiscard]] bool is_convex() const override { return is_convex_; }
  void UpdateCoefficients(const CoefficientMatrix& Q, const VectorRef& b, double c = 0,
                          std::optional<bool> is_convex = std::nullopt);
  [[nodiscard]] std::string Kind() const override { return "quadratic cost"; }
  [[nodiscard]] bool has_jacobian() const override { return true; }
  [[nodiscard]] bool has_hessian() const override { return true; }
  [[nodiscard]] SparsityPattern JacobianPattern() const override;
  [[nodiscard]] SparsityPattern HessianPattern() const override;

 private:
  [[nodiscard]] Eigen::VectorXd DoEval(const VectorRef& x) const override;
  void DoEvaluate(const Evaluation& wanted) const override;
  SparseMatrix Q_;
  Eigen::VectorXd b_;
  double c_ = 0;
  bool is_convex_ = false;
};

/// A convex function of z = Ax + b that lowering writes with a cone: see NormCost::Norm. Where it
/// has a kink its derivative is one of the subgradients there, its second derivative 0.
class SWITCHYARD_EXPORT NormCost : public Cost {
 public:
  enum class Norm {
    kL1,                    // |z|_1
    kL2,                    // |z|_2
    kLInf,                  // max |z_i|
    kPerspectiveQuadratic,  // (z_1^2 + z_2^2 + ...) / z_0, z_0 >= 0
  };
  [[nodiscard]] Norm norm() const { return norm_; }
  [[nodiscard]] const SparseMatrix& A() const { return A_; }
  [[nodiscard]] const Eigen::VectorXd& b() const { return b_; }
  /// Of the same dimensions.
  void UpdateCoefficients(const CoefficientMatrix& A, const VectorRef& b);
  [[nodiscard]] std::string Kind() const override;
  [[nodiscard]] bool is_convex() const override { return true; }
  [[nodiscard]] bool has_jacobian() const override { return true; }
  [[nodiscard]] bool has_hessian() const override { return true; }
  [[nodiscard]] SparsityPattern JacobianPattern() const override;
  [[nodiscard]] SparsityPattern HessianPattern() const override;

 protected:
  NormCost(Norm norm, const CoefficientMatrix& A, const VectorRef& b);

 private:
  [[nodiscard]] Eigen::VectorXd DoEval(const VectorRef& x) const override;
  void DoEvaluate(const Evaluation& wanted) const override;
  void CheckAndStore(const CoefficientMatrix& A, const VectorRef& b, Eigen::Index rows);
  Norm norm_;
  SparseMatrix A_;
  Eigen::VectorXd b_;
};

/// |Ax + b|_1.
class SWITCHYARD_EXPORT L1NormCost final : public NormCost {
 public:
  L1NormCost(const CoefficientMatrix& A, const VectorRef& b) : NormCost(Norm::kL1, A, b) {}
};
/// |Ax + b|_2.
class SWITCHYARD_EXPORT L2NormCost final : public NormCost {
 public:
  L2NormCost(const CoefficientMatrix& A, const VectorRef& b) : NormCost(Norm::kL2, A, b) {}
};
/// max_i |(Ax + b)_i|.
class SWITCHYARD_EXPORT LInfNormCost final : public NormCost {
 public:
  LInfNormCost(const CoefficientMatrix& A, const VectorRef& b) : NormCost(Norm::kLInf, A, b) {}
};
/// (z_1^2 + ... + z_m^2) / z_0 for z = Ax + b with z_0 > 0; at z_0 = 0 its closure: 0 where all z
/// are 0, else infinity, as for z_0 < 0.
class SWITCHYARD_EXPORT PerspectiveQuadraticCost final : public NormCost {
 public:
  PerspectiveQuadraticCost(const CoefficientMatrix& A, const VectorRef& b)
      : NormCost(Norm::kPerspectiveQuadratic, A, b) {}
};

}  // namespace switchyard
