#include "switchyard/model/constraint.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/model/checks.hpp"
#include "core/model/derivatives.hpp"

namespace switchyard {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

SparseMatrix Identity(Eigen::Index size) {
  SparseMatrix I(size, size);
  I.setIdentity();
  return I;
}

bool IsIdentity(const SparseMatrix& A) {
  if (A.nonZeros() != A.cols()) return false;
  for (int j = 0; j < A.outerSize(); ++j) {
    if (A.coeff(j, j) != 1) return false;
  }
  return true;
}

}  // namespace

double Constraint::Violation(const VectorRef& x) const {
  Eigen::VectorXd y;
  Eval(x, &y);
  return y.hasNaN() ? std::numeric_limits<double>::quiet_NaN() : ViolationOf(y);
}

void Constraint::SetBounds(std::string_view name, const VectorRef& lower, const VectorRef& upper) {
  CheckSize(name, "lower", lower, num_constraints());
  CheckSize(name, "upper", upper, num_constraints());
  for (Eigen::Index i = 0; i < lower.size(); ++i) {
    const double l = lower[i];
    const double u = upper[i];
    if (l <= u && l < kInfinity && u > -kInfinity) continue;
    Require(l == l, name, ": bounds: lower[", i, "] needs to be a number, got ", l);
    Require(u == u, name, ": bounds: upper[", i, "] needs to be a number, got ", u);
    Require(l <= u, name, ": bounds: lower[", i, "] = ", l, " is above upper[", i, "] = ", u);
    Require(l < kInfinity, name, ": bounds: lower[", i, "] needs to be below infinity, got ", l);
    Refuse(name, ": bounds: upper[", i, "] needs to be above -infinity, got ", u);
  }
  lower_ = lower;
  upper_ = upper;
}

void Constraint::set_row_names(std::vector<std::string> names) {
  Require(names.empty() || names.size() == static_cast<std::size_t>(num_constraints()), Name(),
          ": row names: there are ", num_constraints(), " rows, got ", names.size(), " names");
  row_names_ = std::move(names);
}

std::string Constraint::RowName(int i) const {
  Require(i >= 0 && i < num_constraints(), Name(), ": row ", i, ": there are ", num_constraints());
  if (!row_names_.empty()) return row_names_[static_cast<std::size_t>(i)];
  return Text(Name(), "[", i, "]");
}

LinearConstraint::LinearConstraint(CoefficientMatrix A, const VectorRef& lower,
                                   const VectorRef& upper)
    : LinearConstraint("linear constraint", std::move(A), lower, upper) {}

LinearConstraint::LinearConstraint(std::string_view kind, CoefficientMatrix A,
                                   const VectorRef& lower, const VectorRef& upper)
    : Constraint(static_cast<int>(A.sparse().cols()), static_cast<int>(A.sparse().rows())) {
  CheckAndStore(kind, std::move(A), lower, upper);
}

void LinearConstraint::UpdateCoefficients(CoefficientMatrix A, const VectorRef& lower,
                                          const VectorRef& upper) {
  CheckShape(Name(), "A", A.sparse(), num_constraints(), num_vars());
  CheckSize(Name(), "lower", lower, num_constraints());
  CheckSize(Name(), "upper", upper, num_constraints());
  CheckForm(A.sparse(), lower, upper);
  CheckAndStore(Name(), std::move(A), lower, upper);
  CoefficientsChanged();
}

void LinearConstraint::CheckAndStore(std::string_view name, CoefficientMatrix A,
                                     const VectorRef& lower, const VectorRef& upper) {
  CheckFinite(name, "A", A.sparse());
  SetBounds(name, lower, upper);
  std::move(A).MoveInto(&A_);
}

SparsityPattern LinearConstraint::JacobianPattern() const { return PatternOf(A_); }

SparsityPattern LinearConstraint::HessianPattern() const {
  return {num_vars(), num_vars(), {}, {}};
}

void LinearConstraint::DoEvaluate(const Evaluation& wanted) const {
  EvaluateAffine(A_, nullptr, wanted);
}

double LinearConstraint::ViolationOf(const Eigen::VectorXd& y) const {
  return BoxViolation(y, lower_bound(), upper_bound());
}

void LinearEqualityConstraint::CheckForm(const SparseMatrix&, const VectorRef& lower,
                                         const VectorRef& upper) const {
  for (Eigen::Index i = 0; i < lower.size(); ++i) {
    Require(lower[i] == upper[i], Name(), ": row ", i,
            " of an equality needs two equal sides, got ", lower[i], " and ", upper[i]);
  }
}

BoundingBoxConstraint::BoundingBoxConstraint(const VectorRef& lower, const VectorRef& upper)
    : LinearConstraint("bounding box constraint", Identity(lower.size()), lower, upper) {}

void BoundingBoxConstraint::UpdateBounds(const VectorRef& lower, const VectorRef& upper) {
  SetBounds(Name(), lower, upper);
  CoefficientsChanged();
}

void BoundingBoxConstraint::CheckForm(const SparseMatrix& A, const VectorRef&,
                                      const VectorRef&) const {
  Require(IsIdentity(A), Name(), ": A of a bounding box is the identity, got another matrix");
}

}  // namespace switchyard
