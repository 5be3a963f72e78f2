#include "switchyard/sets/hpolyhedron.hpp"

#include <cmath>

#include "core/sets/scaled_rows.hpp"
#include "switchyard/error.hpp"

namespace switchyard {

HPolyhedron::HPolyhedron(const CoefficientMatrix& A, const VectorRef& b)
    : ConvexSet(static_cast<int>(A.sparse().cols())), A_(A.sparse()), b_(b) {
  Require(A_.rows() == b.size(), "hpolyhedron: A has ", A_.rows(), " rows, b ", b.size(),
          " entries");
  for (int j = 0; j < A_.outerSize(); ++j) {
    for (SparseMatrix::InnerIterator e(A_, j); e; ++e) {
      Require(std::isfinite(e.value()), "hpolyhedron: A(", e.row(), ", ", j,
              ") must be a finite number, got ", e.value());
    }
  }
  for (Eigen::Index i = 0; i < b.size(); ++i) {
    Require(b[i] > -kInfinity, "hpolyhedron: b[", i, "] must be a number or infinity, got ", b[i]);
  }
}

HPolyhedron HPolyhedron::Intersection(const HPolyhedron& other) const {
  Require(other.ambient_dimension() == ambient_dimension(), "polyhedra in R^", ambient_dimension(),
          " and R^", other.ambient_dimension(), " have no intersection");
  Eigen::MatrixXd A(A_.rows() + other.A_.rows(), A_.cols());
  A << Eigen::MatrixXd(A_), Eigen::MatrixXd(other.A_);
  Eigen::VectorXd b(A.rows());
  b << b_, other.b_;
  return {A, b};
}

HPolyhedron HPolyhedron::MakeBox(const VectorRef& lb, const VectorRef& ub) {
  Require(lb.size() == ub.size(), "box: lb has ", lb.size(), " entries, ub ", ub.size());
  const Eigen::Index n = lb.size();
  for (Eigen::Index i = 0; i < n; ++i) {
    Require(lb[i] <= ub[i], "box: lb[", i, "] = ", lb[i], " must be at most ub[", i, "] = ", ub[i]);
  }
  Eigen::MatrixXd A(2 * n, n);
  A << Eigen::MatrixXd::Identity(n, n), -Eigen::MatrixXd::Identity(n, n);
  Eigen::VectorXd b(2 * n);
  b << ub, -lb;
  return {A, b};
}

HPolyhedron HPolyhedron::MakeUnitBox(int dim) {
  return MakeBox(Eigen::VectorXd::Constant(dim, -1), Eigen::VectorXd::Ones(dim));
}

std::unique_ptr<ConvexSet> HPolyhedron::DoClone() const {
  return std::make_unique<HPolyhedron>(*this);
}

ScaledSet HPolyhedron::DoScaled() const {
  ScaledRows rows(ambient_dimension());
  std::vector<int> row_of(static_cast<std::size_t>(b_.size()), -1);
  for (Eigen::Index i = 0; i < b_.size(); ++i) {
    if (b_[i] == kInfinity) continue;
    const int row = rows.AddRow(-kInfinity, 0);
    row_of[static_cast<std::size_t>(i)] = row;
    rows.Set(row, 0, -b_[i]);
  }
  for (int j = 0; j < A_.outerSize(); ++j) {
    for (SparseMatrix::InnerIterator e(A_, j); e; ++e) {
      const int row = row_of[static_cast<std::size_t>(e.row())];
      if (row >= 0) rows.Set(row, 1 + j, e.value());
    }
  }
  return rows.Finish();
}

}  // namespace switchyard
