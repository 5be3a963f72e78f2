// switchyard/model/constraint.hpp - the constraints that a program stores: affine in a box, and
// affine in a cone.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "switchyard/abi.h"
#include "switchyard/model/evaluator.hpp"

namespace switchyard {

class SWITCHYARD_EXPORT Constraint : public EvaluatorBase {
 public:
  [[nodiscard]] int num_constraints() const { return num_outputs(); }
  /// Of each row; infinite for the rows of a cone.
  [[nodiscard]] const Eigen::VectorXd& lower_bound() const { return lower_; }
  [[nodiscard]] const Eigen::VectorXd& upper_bound() const { return upper_; }

  /// Is each component known to be convex where its upper side is finite, concave where its lower
  /// side is? (Affine rows and cones are.)
  [[nodiscard]] virtual bool is_convex() const { return false; }

  /// Is Violation(x) <= tolerance?
  [[nodiscard]] bool CheckSatisfied(const VectorRef& x, double tolerance = 1e-6) const {
    return Violation(x) <= tolerance;
  }
  /// How far x is from satisfying it, absolute, in the unit of the rows (of a cone: as
  /// cones.hpp measures); 0 where it does, NaN where a row is NaN.
  [[nodiscard]] double Violation(const VectorRef& x) const;

  /// Names of the rows, as a file gives them; empty: none.
  void set_row_names(std::vector<std::string> names);
  [[nodiscard]] const std::vector<std::string>& row_names() const { return row_names_; }
  /// The name of row i, or the constraint's name with the index behind it.
  [[nodiscard]] std::string RowName(int i) const;

 protected:
  Constraint(int num_vars, int num_constraints) : EvaluatorBase(num_vars, num_constraints) {}
  /// Checks and stores. `name` is what a message calls the constraint: a constructor cannot ask the
  /// class that derives from it.
  void SetBounds(std::string_view name, const VectorRef& lower, const VectorRef& upper);
  [[nodiscard]] virtual double ViolationOf(const Eigen::VectorXd& y) const = 0;

 private:
  Eigen::VectorXd lower_;
  Eigen::VectorXd upper_;
  std::vector<std::string> row_names_;
};

/// lower <= Ax <= upper, row by row; infinite sides are free.
class SWITCHYARD_EXPORT LinearConstraint : public Constraint {
 public:
  /// A is num_constraints x num_vars. Throws where dimensions differ, a number is NaN, a
  /// coefficient is infinite, lower > upper, lower = inf or upper = -inf.
  LinearConstraint(CoefficientMatrix A, const VectorRef& lower, const VectorRef& upper);
  [[nodiscard]] const SparseMatrix& get_sparse_A() const { return A_; }
  [[nodiscard]] Eigen::MatrixXd GetDenseA() const { return A_; }
  /// Of the same dimensions. Also refuses what the derived class cannot be: a box with another A
  /// than the identity, an equality with two sides that differ.
  void UpdateCoefficients(CoefficientMatrix A, const VectorRef& lower, const VectorRef& upper);
  [[nodiscard]] std::string Kind() const override { return "linear constraint"; }
  [[nodiscard]] bool is_convex() const override { return true; }
  [[nodiscard]] bool has_jacobian() const override { return true; }
  [[nodiscard]] bool has_hessian() const override { return true; }
  [[nodiscard]] SparsityPattern JacobianPattern() const override;
  [[nodiscard]] SparsityPattern HessianPattern() const override;

 protected:
  LinearConstraint(std::string_view kind, CoefficientMatrix A, const VectorRef& lower,
                   const VectorRef& upper);

 private:
  virtual void CheckForm(const SparseMatrix&, const VectorRef&, const VectorRef&) const {}
  void CheckAndStore(std::string_view name, CoefficientMatrix A, const VectorRef& lower,
                     const VectorRef& upper);
  [[nodiscard]] Eigen::VectorXd DoEval(const VectorRef& x) const final { return A_ * x; }
  void DoEvaluate(const Evaluation& wanted) const final;
  [[nodiscard]] double ViolationOf(const Eigen::VectorXd& y) const final;
  SparseMatrix A_;
};

/// Ax = b.
class SWITCHYARD_EXPORT LinearEqualityConstraint final : public LinearConstraint {
 public:
  LinearEqualityConstraint(CoefficientMatrix A, const VectorRef& b)
      : LinearConstraint("linear equality constraint", std::move(A), b, b) {}
  void UpdateCoefficients(CoefficientMatrix A, const VectorRef& b) {
    LinearConstraint::UpdateCoefficients(std::move(A), b, b);
  }
  [[nodiscard]] std::string Kind() const override { return "linear equality constraint"; }

 private:
  void CheckForm(const SparseMatrix& A, const VectorRef& lower,
                 const VectorRef& upper) const override;
};

/// lower <= x <= upper.
class SWITCHYARD_EXPORT BoundingBoxConstraint final : public LinearConstraint {
 public:
  BoundingBoxConstraint(const VectorRef& lower, const VectorRef& upper);
  void UpdateBounds(const VectorRef& lower, const VectorRef& upper);
  [[nodiscard]] std::string Kind() const override { return "bounding box constraint"; }

 private:
  void CheckForm(const SparseMatrix& A, const VectorRef& lower,
                 const VectorRef& upper) const override;
};

/// z = Ax + b in a cone, in the coordinates that users know; each derived class says which.
/// `frame()` takes z to the cone of the ABI: s[i] = frame()[i].scale * z[frame()[i].row].
class SWITCHYARD_EXPORT ConeConstraint : public Constraint {
 public:
  struct FrameRow {
    int row;
    double scale;
  };
  [[nodiscard]] const SparseMatrix& A() const { return A_; }
  [[nodiscard]] Eigen::MatrixXd A_dense() const { return A_; }
  [[nodiscard]] const Eigen::VectorXd& b() const { return b_; }
  [[nodiscard]] const sy_cone& cone() const { return cone_; }
  [[nodiscard]] const std::vector<FrameRow>& frame() const { return frame_; }
  /// The dual in z's coordinates from the dual in the ABI's: <y, z> = <y_abi, s>. Of a matrix cone
  /// it is the symmetric matrix itself, column by column.
  [[nodiscard]] Eigen::VectorXd DualInUserFrame(const VectorRef& abi_dual) const;
  /// Of the same dimensions.
  void UpdateCoefficients(CoefficientMatrix A, const VectorRef& b);
  [[nodiscard]] bool is_convex() const override { return true; }
  [[nodiscard]] bool has_jacobian() const override { return true; }
  [[nodiscard]] bool has_hessian() const override { return true; }
  [[nodiscard]] SparsityPattern JacobianPattern() const override;
  [[nodiscard]] SparsityPattern HessianPattern() const override;

 protected:
  ConeConstraint(std::string_view kind, CoefficientMatrix&& A, const VectorRef& b, sy_cone cone,
                 std::vector<FrameRow> frame);

 private:
  [[nodiscard]] Eigen::VectorXd DoEval(const VectorRef& x) const final { return A_ * x + b_; }
  void DoEvaluate(const Evaluation& wanted) const final;
  [[nodiscard]] double ViolationOf(const Eigen::VectorXd& y) const final;
  void CheckAndStore(std::string_view name, CoefficientMatrix A, const VectorRef& b);
  SparseMatrix A_;
  Eigen::VectorXd b_;
  sy_cone cone_;
  std::vector<FrameRow> frame_;
};

/// z_0 >= |z_1..m|_2.
class SWITCHYARD_EXPORT LorentzConeConstraint final : public ConeConstraint {
 public:
  LorentzConeConstraint(CoefficientMatrix A, const VectorRef& b);
  [[nodiscard]] std::string Kind() const override { return "Lorentz cone constraint"; }
};

/// z_0 z_1 >= z_2^2 + ... + z_m^2, z_0 >= 0, z_1 >= 0.
class SWITCHYARD_EXPORT RotatedLorentzConeConstraint final : public ConeConstraint {
 public:
  RotatedLorentzConeConstraint(CoefficientMatrix A, const VectorRef& b);
  [[nodiscard]] std::string Kind() const override { return "rotated Lorentz cone constraint"; }
};

/// z_0 >= z_1 exp(z_2 / z_1), z_1 > 0, and its closure.
class SWITCHYARD_EXPORT ExponentialConeConstraint final : public ConeConstraint {
 public:
  ExponentialConeConstraint(CoefficientMatrix A, const VectorRef& b);
  [[nodiscard]] std::string Kind() const override { return "exponential cone constraint"; }
};

/// z_0^alpha z_1^(1 - alpha) >= |z_2|, z_0 >= 0, z_1 >= 0, 0 < alpha < 1.
class SWITCHYARD_EXPORT PowerConeConstraint final : public ConeConstraint {
 public:
  PowerConeConstraint(CoefficientMatrix A, const VectorRef& b, double alpha);
  [[nodiscard]] std::string Kind() const override { return "power cone constraint"; }
};

/// A symmetric matrix of variables is positive semidefinite; the variables are its entries column
/// by column (rows^2 of them), of which the upper triangle is read.
class SWITCHYARD_EXPORT PositiveSemidefiniteConstraint final : public ConeConstraint {
 public:
  explicit PositiveSemidefiniteConstraint(int rows);
  [[nodiscard]] int matrix_rows() const { return rows_; }
  [[nodiscard]] std::string Kind() const override { return "positive semidefinite constraint"; }

 private:
  int rows_;
};

/// F_0 + x_1 F_1 + ... + x_n F_n is positive semidefinite; all F_i symmetric of one size.
class SWITCHYARD_EXPORT LinearMatrixInequalityConstraint final : public ConeConstraint {
 public:
  /// `tolerance`: how far an F_i may be from symmetric, relative to its largest entry.
  explicit LinearMatrixInequalityConstraint(const std::vector<Eigen::MatrixXd>& F,
                                            double tolerance = 1e-10);
  [[nodiscard]] int matrix_rows() const { return rows_; }
  [[nodiscard]] std::string Kind() const override { return "linear matrix inequality"; }

 private:
  int rows_;
};

}  // namespace switchyard
