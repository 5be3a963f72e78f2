#include "switchyard/model/function_terms.hpp"

#include <limits>
#include <utility>

#include "core/model/checks.hpp"
#include "core/model/convexity.hpp"
#include "core/model/derivatives.hpp"

namespace switchyard {
namespace {

using HessianType = QuadraticConstraint::HessianType;

const Function& Given(const std::shared_ptr<const Function>& function, const char* what) {
  Require(function != nullptr, what, ": needs a function, got a null pointer");
  return *function;
}

Eigen::VectorXd Values(const Function& function, const VectorRef& x) {
  Eigen::VectorXd y(function.num_outputs());
  const Eigen::VectorXd point = x;  // in one piece, whatever x is a part of
  function.Evaluate({.x = point.data(), .values = y.data()});
  return y;
}

Eigen::VectorXd One(double value) { return Eigen::VectorXd::Constant(1, value); }

HessianType TypeOf(const SparseMatrix& Q) {
  if (IsPositiveSemidefinite(Q)) return HessianType::kPositiveSemidefinite;
  const SparseMatrix negative = -Q;
  return IsPositiveSemidefinite(negative) ? HessianType::kNegativeSemidefinite
                                          : HessianType::kIndefinite;
}

}  // namespace

FunctionCost::FunctionCost(std::shared_ptr<const Function> function, bool is_convex)
    : Cost(Given(function, "function cost").num_vars()),
      function_(std::move(function)),
      is_convex_(is_convex) {
  Require(function_->num_outputs() == 1, "function cost: the function needs 1 output, got ",
          function_->num_outputs());
}

Eigen::VectorXd FunctionCost::DoEval(const VectorRef& x) const { return Values(*function_, x); }

FunctionConstraint::FunctionConstraint(std::shared_ptr<const Function> function,
                                       const VectorRef& lower, const VectorRef& upper,
                                       bool is_convex)
    : Constraint(Given(function, "function constraint").num_vars(), function->num_outputs()),
      function_(std::move(function)),
      is_convex_(is_convex) {
  SetBounds("function constraint", lower, upper);
}

void FunctionConstraint::UpdateBounds(const VectorRef& lower, const VectorRef& upper) {
  SetBounds(Name(), lower, upper);
  CoefficientsChanged();
}

Eigen::VectorXd FunctionConstraint::DoEval(const VectorRef& x) const {
  return Values(*function_, x);
}

double FunctionConstraint::ViolationOf(const Eigen::VectorXd& y) const {
  return BoxViolation(y, lower_bound(), upper_bound());
}

QuadraticConstraint::QuadraticConstraint(const CoefficientMatrix& Q, const VectorRef& b,
                                         double lower, double upper,
                                         std::optional<HessianType> hessian_type)
    : Constraint(static_cast<int>(b.size()), 1) {
  CheckAndStore(Q, b, lower, upper, hessian_type);
}

void QuadraticConstraint::UpdateCoefficients(const CoefficientMatrix& Q, const VectorRef& b,
                                             double lower, double upper,
                                             std::optional<HessianType> hessian_type) {
  CheckAndStore(Q, b, lower, upper, hessian_type);
  CoefficientsChanged();
}

void QuadraticConstraint::CheckAndStore(const CoefficientMatrix& Q, const VectorRef& b,
                                        double lower, double upper,
                                        std::optional<HessianType> hessian_type) {
  const std::string name = Name();
  CheckSize(name, "b", b, num_vars());
  CheckShape(name, "Q", Q.sparse(), num_vars(), num_vars());
  CheckFinite(name, "Q", Q.sparse());
  CheckFinite(name, "b", b);
  SetBounds(name, One(lower), One(upper));
  Q_ = SymmetricPart(Q.sparse());
  b_ = b;
  hessian_type_ = hessian_type ? *hessian_type : TypeOf(Q_);
}

bool QuadraticConstraint::is_convex() const {
  const bool below = lower_bound()[0] > -std::numeric_limits<double>::infinity();
  const bool above = upper_bound()[0] < std::numeric_limits<double>::infinity();
  const bool flat = Q_.nonZeros() == 0;
  return (!below && (flat || hessian_type_ == HessianType::kPositiveSemidefinite)) ||
         (!above && (flat || hessian_type_ == HessianType::kNegativeSemidefinite));
}

Eigen::VectorXd QuadraticConstraint::DoEval(const VectorRef& x) const {
  return One(0.5 * x.dot(Q_ * x) + b_.dot(x));
}

double QuadraticConstraint::ViolationOf(const Eigen::VectorXd& y) const {
  return BoxViolation(y, lower_bound(), upper_bound());
}

SparsityPattern QuadraticConstraint::JacobianPattern() const {
  SparsityPattern pattern{1, num_vars(), {}, {}};
  for (int j = 0; j < num_vars(); ++j) {
    const bool curved = static_cast<bool>(SparseMatrix::InnerIterator(Q_, j));
    if (curved || b_[j] != 0) pattern.Add(0, j);
  }
  return pattern;
}

SparsityPattern QuadraticConstraint::HessianPattern() const { return UpperPatternOf(Q_); }

void QuadraticConstraint::DoEvaluate(const Evaluation& wanted) const {
  Evaluation rest = wanted;
  rest.jacobian = nullptr;
  EvaluateQuadratic(Q_, b_, 0, rest);
  if (wanted.jacobian == nullptr) return;
  const Eigen::Map<const Eigen::VectorXd> x(wanted.x, num_vars());
  double* to = wanted.jacobian;
  for (int j = 0; j < num_vars(); ++j) {
    double slope = b_[j];
    bool curved = false;
    for (SparseMatrix::InnerIterator entry(Q_, j); entry; ++entry, curved = true) {
      slope += entry.value() * x[entry.row()];
    }
    if (curved || b_[j] != 0) *to++ = slope;
  }
}

}  // namespace switchyard
