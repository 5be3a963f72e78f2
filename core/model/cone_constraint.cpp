#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "core/model/checks.hpp"
#include "core/model/derivatives.hpp"
#include "switchyard/cones.hpp"
#include "switchyard/model/constraint.hpp"

namespace switchyard {
namespace {

using FrameRow = ConeConstraint::FrameRow;

constexpr double kSqrt2 = std::numbers::sqrt2;
constexpr int kLargestMatrix = 46340;  // the largest n with n^2 < 2^31

std::vector<FrameRow> IdentityFrame(int rows) {
  std::vector<FrameRow> frame(static_cast<std::size_t>(rows));
  for (int i = 0; i < rows; ++i) frame[static_cast<std::size_t>(i)] = {i, 1};
  return frame;
}

// z_0 z_1 >= |w|^2 is 2 s_0 s_1 >= |s_w|^2 at s = (z_0, z_1, sqrt(2) w).
std::vector<FrameRow> RotatedFrame(int rows) {
  std::vector<FrameRow> frame = IdentityFrame(rows);
  for (std::size_t i = 2; i < frame.size(); ++i) frame[i].scale = kSqrt2;
  return frame;
}

// The upper triangle of the n x n matrix z by columns, off-diagonals times sqrt(2).
std::vector<FrameRow> SvecFrame(int n) {
  std::vector<FrameRow> frame;
  frame.reserve(static_cast<std::size_t>(n) * static_cast<std::size_t>(n + 1) / 2);
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i <= j; ++i) frame.push_back({i + j * n, i == j ? 1 : kSqrt2});
  }
  return frame;
}

int RowsOf(const CoefficientMatrix& A) { return static_cast<int>(A.sparse().rows()); }

// `rows`, where there are at least so many.
int AtLeast(int needed, const char* kind, int rows) {
  Require(rows >= needed, kind, ": A needs at least ", needed, needed == 1 ? " row" : " rows",
          ", got ", rows);
  return rows;
}

int Three(const char* kind, int rows) {
  Require(rows == 3, kind, ": A needs 3 rows, got ", rows);
  return rows;
}

int MatrixRows(const char* kind, Eigen::Index rows) {
  Require(rows >= 1 && rows <= kLargestMatrix, kind, ": the matrix needs 1 to ", kLargestMatrix,
          " rows, got ", rows);
  return static_cast<int>(rows);
}

SparseMatrix Identity(int size) {
  SparseMatrix I(size, size);
  I.setIdentity();
  return I;
}

sy_cone PsdCone(int n) { return {SY_CONE_PSD, n * (n + 1) / 2, 0}; }

constexpr const char* kMatrixInequality = "linear matrix inequality";

// Throws where F_k is not square, of `rows` rows, finite, and symmetric up to the tolerance.
void CheckSymmetric(const Eigen::MatrixXd& F, std::size_t k, Eigen::Index rows, double tolerance) {
  Require(F.rows() == rows && F.cols() == rows, kMatrixInequality, ": F[", k, "] needs to be ",
          rows, " x ", rows, ", got ", F.rows(), " x ", F.cols());
  for (Eigen::Index j = 0; j < rows; ++j) {
    for (Eigen::Index i = 0; i < rows; ++i) {
      Require(std::isfinite(F(i, j)), kMatrixInequality, ": F[", k, "](", i, ",", j,
              ") needs to be finite, got ", F(i, j));
    }
  }
  const double allowed = tolerance * F.cwiseAbs().maxCoeff();
  for (Eigen::Index j = 0; j < rows; ++j) {
    for (Eigen::Index i = 0; i < j; ++i) {
      Require(std::abs(F(i, j) - F(j, i)) <= allowed, kMatrixInequality, ": F[", k,
              "] needs to be symmetric, got (", i, ",", j, ") = ", F(i, j), " and (", j, ",", i,
              ") = ", F(j, i));
    }
  }
}

// The rows of the matrices F_0, F_1, ..., all of which have passed CheckSymmetric.
Eigen::Index CheckedRows(const std::vector<Eigen::MatrixXd>& F, double tolerance) {
  Require(!F.empty(), kMatrixInequality, ": needs F[0], got no matrix");
  const int rows = MatrixRows(kMatrixInequality, F[0].rows());
  for (std::size_t k = 0; k < F.size(); ++k) CheckSymmetric(F[k], k, rows, tolerance);
  return rows;
}

// (F + F')/2 column by column.
Eigen::VectorXd Stacked(const Eigen::MatrixXd& F) {
  const Eigen::MatrixXd symmetric = 0.5 * F + 0.5 * F.transpose();
  return symmetric.reshaped();
}

// Column k is F_{k+1}, stacked.
CoefficientMatrix StackedColumns(const std::vector<Eigen::MatrixXd>& F, double tolerance) {
  const Eigen::Index rows = CheckedRows(F, tolerance);
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t k = 1; k < F.size(); ++k) {
    const Eigen::VectorXd column = Stacked(F[k]);
    for (Eigen::Index i = 0; i < column.size(); ++i) {
      if (column[i] != 0) {
        entries.emplace_back(static_cast<int>(i), static_cast<int>(k) - 1, column[i]);
      }
    }
  }
  SparseMatrix A(rows * rows, static_cast<Eigen::Index>(F.size()) - 1);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

}  // namespace

ConeConstraint::ConeConstraint(std::string_view kind, CoefficientMatrix&& A, const VectorRef& b,
                               sy_cone cone, std::vector<FrameRow> frame)
    : Constraint(static_cast<int>(A.sparse().cols()), RowsOf(A)),
      cone_(cone),
      frame_(std::move(frame)) {
  CheckAndStore(kind, std::move(A), b);
  const double infinity = std::numeric_limits<double>::infinity();
  SetBounds(kind, Eigen::VectorXd::Constant(num_constraints(), -infinity),
            Eigen::VectorXd::Constant(num_constraints(), infinity));
}

void ConeConstraint::UpdateCoefficients(CoefficientMatrix A, const VectorRef& b) {
  CheckAndStore(Name(), std::move(A), b);
  CoefficientsChanged();
}

void ConeConstraint::CheckAndStore(std::string_view name, CoefficientMatrix A, const VectorRef& b) {
  CheckShape(name, "A", A.sparse(), num_constraints(), num_vars());
  CheckSize(name, "b", b, num_constraints());
  CheckFinite(name, "A", A.sparse());
  CheckFinite(name, "b", b);
  std::move(A).MoveInto(&A_);
  b_ = b;
}

SparsityPattern ConeConstraint::JacobianPattern() const { return PatternOf(A_); }

SparsityPattern ConeConstraint::HessianPattern() const { return {num_vars(), num_vars(), {}, {}}; }

void ConeConstraint::DoEvaluate(const Evaluation& wanted) const { EvaluateAffine(A_, &b_, wanted); }

Eigen::VectorXd ConeConstraint::DualInUserFrame(const VectorRef& abi_dual) const {
  CheckSize(Name(), "the dual", abi_dual, static_cast<Eigen::Index>(frame_.size()));
  const bool is_matrix = cone_.kind == SY_CONE_PSD;
  const int n = is_matrix ? static_cast<int>(std::lround(std::sqrt(num_constraints()))) : 1;
  Eigen::VectorXd y = Eigen::VectorXd::Zero(num_constraints());
  for (std::size_t k = 0; k < frame_.size(); ++k) {
    const auto [row, scale] = frame_[k];
    const double dual = abi_dual[static_cast<Eigen::Index>(k)];
    if (is_matrix) {  // <Y, Z> counts an off-diagonal entry twice: 2 Y_ij Z_ij = dual sqrt(2) Z_ij
      y[row] = y[row % n * n + row / n] = dual / scale;
    } else {
      y[row] = dual * scale;
    }
  }
  return y;
}

double ConeConstraint::ViolationOf(const Eigen::VectorXd& y) const {
  Eigen::VectorXd s(static_cast<Eigen::Index>(frame_.size()));
  for (std::size_t k = 0; k < frame_.size(); ++k) {
    s[static_cast<Eigen::Index>(k)] = frame_[k].scale * y[frame_[k].row];
  }
  return FactsOf(cone_.kind).violation(s.data(), cone_.dim, cone_.parameter);
}

LorentzConeConstraint::LorentzConeConstraint(CoefficientMatrix A, const VectorRef& b)
    : ConeConstraint("Lorentz cone constraint", std::move(A), b,
                     {SY_CONE_SECOND_ORDER, AtLeast(1, "Lorentz cone constraint", RowsOf(A)), 0},
                     IdentityFrame(RowsOf(A))) {}

RotatedLorentzConeConstraint::RotatedLorentzConeConstraint(CoefficientMatrix A, const VectorRef& b)
    : ConeConstraint("rotated Lorentz cone constraint", std::move(A), b,
                     {SY_CONE_ROTATED, AtLeast(2, "rotated Lorentz cone constraint", RowsOf(A)), 0},
                     RotatedFrame(RowsOf(A))) {}

// z_0 >= z_1 exp(z_2 / z_1) is s_1 exp(s_0 / s_1) <= s_2 at s = (z_2, z_1, z_0).
ExponentialConeConstraint::ExponentialConeConstraint(CoefficientMatrix A, const VectorRef& b)
    : ConeConstraint("exponential cone constraint", std::move(A), b,
                     {SY_CONE_EXPONENTIAL, Three("exponential cone constraint", RowsOf(A)), 0},
                     {{2, 1}, {1, 1}, {0, 1}}) {}

PowerConeConstraint::PowerConeConstraint(CoefficientMatrix A, const VectorRef& b, double alpha)
    : ConeConstraint("power cone constraint", std::move(A), b,
                     {SY_CONE_POWER, Three("power cone constraint", RowsOf(A)), alpha},
                     IdentityFrame(3)) {
  Require(alpha > 0 && alpha < 1, "power cone constraint: alpha needs to be in (0, 1), got ",
          alpha);
}

// Braces evaluate what stands in them from left to right: the check of the size comes first.
PositiveSemidefiniteConstraint::PositiveSemidefiniteConstraint(int rows)
    : ConeConstraint{"positive semidefinite constraint",
                     Identity(MatrixRows("positive semidefinite constraint", rows) * rows),
                     Eigen::VectorXd::Zero(Eigen::Index{rows} * rows), PsdCone(rows),
                     SvecFrame(rows)},
      rows_(rows) {}

LinearMatrixInequalityConstraint::LinearMatrixInequalityConstraint(
    const std::vector<Eigen::MatrixXd>& F, double tolerance)
    : ConeConstraint{kMatrixInequality, StackedColumns(F, tolerance), Stacked(F[0]),
                     PsdCone(static_cast<int>(F[0].rows())),
                     SvecFrame(static_cast<int>(F[0].rows()))},
      rows_(static_cast<int>(F[0].rows())) {}

}  // namespace switchyard
