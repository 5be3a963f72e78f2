// switchyard/sets/hpolyhedron.hpp - {x : Ax <= b}.
#pragma once

#include "switchyard/sets/convex_set.hpp"

namespace switchyard {

/// A polyhedron by its halfspaces.
class SWITCHYARD_EXPORT HPolyhedron final : public ConvexSet {
 public:
  HPolyhedron() : HPolyhedron(Eigen::MatrixXd(0, 0), Eigen::VectorXd()) {}
  /// A is rows x dimension. Throws InvalidArgument where sizes differ, a coefficient is not finite,
  /// or an entry of b is NaN or -inf (+inf: no halfspace).
  HPolyhedron(const CoefficientMatrix& A, const VectorRef& b);
  [[nodiscard]] Eigen::MatrixXd A() const { return A_; }
  [[nodiscard]] const SparseMatrix& sparse_A() const { return A_; }
  [[nodiscard]] const Eigen::VectorXd& b() const { return b_; }
  [[nodiscard]] HPolyhedron Intersection(const HPolyhedron& other) const;
  /// Throws InvalidArgument where sizes differ or lb[i] > ub[i].
  [[nodiscard]] static HPolyhedron MakeBox(const VectorRef& lb, const VectorRef& ub);
  [[nodiscard]] static HPolyhedron MakeUnitBox(int dim);
  [[nodiscard]] std::string Kind() const override { return "hpolyhedron"; }

 private:
  [[nodiscard]] std::unique_ptr<ConvexSet> DoClone() const override;
  [[nodiscard]] ScaledSet DoScaled() const override;
  SparseMatrix A_;
  Eigen::VectorXd b_;
};

}  // namespace switchyard
