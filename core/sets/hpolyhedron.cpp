#include "switchyard/sets/hpolyhedron.hpp"

#include <cmath>

#include "core/sets/polytope_conversions.hpp"
#include "switchyard/error.hpp"
#include "switchyard/sets/scaled_rows.hpp"
#include "switchyard/sets/spectrahedron.hpp"
#include "switchyard/sets/vpolytope.hpp"

namespace switchyard {
namespace {

constexpr int kMostL1Dimensions = 20;
constexpr double kFlat = 1e-12;  // a polyhedron thinner than this has no volume

}  // namespace

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

HPolyhedron::HPolyhedron(const VPolytope& vpoly, double tol)
    : ConvexSet(vpoly.ambient_dimension()) {
  Require(vpoly.vertices().cols() > 0, "hpolyhedron: a vpolytope needs a vertex, got none");
  Halfspaces rows = HalfspacesOf(vpoly.vertices(), tol);
  A_ = rows.A.sparseView(1.0, 0.0);
  b_ = std::move(rows.b);
}

HPolyhedron::HPolyhedron(const MathematicalProgram& prog) : ConvexSet(prog.num_vars()) {
  for (const Binding<Constraint>& binding : prog.GetAllConstraints()) {
    Require(dynamic_cast<const LinearConstraint*>(binding.evaluator().get()) != nullptr,
            "hpolyhedron: a program needs linear constraints alone, got ",
            binding.evaluator()->Name());
  }
  const ScaledSet set = Spectrahedron(prog).scaled();
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<double> sides;
  const Csc by_rows = Transpose(set.A.View());
  for (std::size_t i = 0; i < set.lower.size(); ++i) {
    for (const double sign : {1.0, -1.0}) {
      if (!std::isfinite(sign > 0 ? set.upper[i] : set.lower[i])) continue;
      const auto row = static_cast<int>(sides.size());
      sides.push_back(0);
      for (auto k = static_cast<std::size_t>(by_rows.start[i]);
           k < static_cast<std::size_t>(by_rows.start[i + 1]); ++k) {
        const double value = sign * by_rows.value[k];
        if (by_rows.row[k] == 0) sides.back() = -value;
        if (by_rows.row[k] > 0) entries.emplace_back(row, by_rows.row[k] - 1, value);
      }
    }
  }
  A_.resize(static_cast<Eigen::Index>(sides.size()), prog.num_vars());
  A_.setFromTriplets(entries.begin(), entries.end());
  b_ = Eigen::VectorXd::Map(sides.data(), A_.rows());
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

// Row k has the signs of the bits of k.
HPolyhedron HPolyhedron::MakeL1Ball(int dim) {
  Require(0 <= dim && dim <= kMostL1Dimensions, "an L1 ball by its halfspaces has at most ",
          kMostL1Dimensions, " dimensions, got ", dim);
  Eigen::MatrixXd A(Eigen::Index{1} << dim, dim);
  for (Eigen::Index k = 0; k < A.rows(); ++k) {
    for (Eigen::Index i = 0; i < dim; ++i) A(k, i) = (k >> i) % 2 == 0 ? 1 : -1;
  }
  return {A, Eigen::VectorXd::Ones(A.rows())};
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

std::optional<double> HPolyhedron::DoCalcVolume() const {
  if (!IsBounded()) return std::nullopt;
  if (ambient_dimension() == 0) return IsEmpty() ? 0.0 : 1.0;
  return VolumeOfHull(VerticesOf(*this, kFlat), kFlat);
}

}  // namespace switchyard
