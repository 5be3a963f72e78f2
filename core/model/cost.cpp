#include "switchyard/model/cost.hpp"

#include <algorithm>
#include <limits>

#include "core/model/checks.hpp"
#include "core/model/convexity.hpp"
#include "core/model/derivatives.hpp"

namespace switchyard {
namespace {

Eigen::VectorXd One(double value) { return Eigen::VectorXd::Constant(1, value); }

// |w|^2 / z_0 and its closure.
double PerspectiveQuadratic(const Eigen::VectorXd& z) {
  const double squares = z.tail(z.size() - 1).squaredNorm();
  if (z[0] > 0) return squares / z[0];
  if (z[0] == 0 && squares == 0) return 0;
  return z.hasNaN() ? std::numeric_limits<double>::quiet_NaN()
                    : std::numeric_limits<double>::infinity();
}

}  // namespace

LinearCost::LinearCost(const VectorRef& a, double b) : Cost(static_cast<int>(a.size())), b_(b) {
  UpdateCoefficients(a, b);
}

void LinearCost::UpdateCoefficients(const VectorRef& a, double b) {
  const std::string name = Name();
  CheckSize(name, "a", a, num_vars());
  CheckFinite(name, "a", a);
  CheckFinite(name, "b", b);
  a_ = a;
  b_ = b;
  CoefficientsChanged();
}

Eigen::VectorXd LinearCost::DoEval(const VectorRef& x) const { return One(a_.dot(x) + b_); }

SparsityPattern LinearCost::JacobianPattern() const {
  return SparsityPattern::Dense(1, num_vars());
}

SparsityPattern LinearCost::HessianPattern() const { return {num_vars(), num_vars(), {}, {}}; }

void LinearCost::DoEvaluate(const Evaluation& wanted) const {
  const Eigen::Map<const Eigen::VectorXd> x(wanted.x, num_vars());
  if (wanted.values != nullptr) *wanted.values = a_.dot(x) + b_;
  if (wanted.jacobian != nullptr) std::copy(a_.begin(), a_.end(), wanted.jacobian);
}

QuadraticCost::QuadraticCost(const CoefficientMatrix& Q, const VectorRef& b, double c,
                             std::optional<bool> is_convex)
    : Cost(static_cast<int>(b.size())) {
  UpdateCoefficients(Q, b, c, is_convex);
}

void QuadraticCost::UpdateCoefficients(const CoefficientMatrix& Q, const VectorRef& b, double c,
                                       std::optional<bool> is_convex) {
  const std::string name = Name();
  CheckSize(name, "b", b, num_vars());
  CheckShape(name, "Q", Q.sparse(), num_vars(), num_vars());
  CheckFinite(name, "Q", Q.sparse());
  CheckFinite(name, "b", b);
  CheckFinite(name, "c", c);
  Q_ = SymmetricPart(Q.sparse());
  b_ = b;
  c_ = c;
  is_convex_ = is_convex ? *is_convex : IsPositiveSemidefinite(Q_);
  CoefficientsChanged();
}

Eigen::VectorXd QuadraticCost::DoEval(const VectorRef& x) const {
  return One(0.5 * x.dot(Q_ * x) + b_.dot(x) + c_);
}

SparsityPattern QuadraticCost::JacobianPattern() const {
  return SparsityPattern::Dense(1, num_vars());
}

SparsityPattern QuadraticCost::HessianPattern() const { return UpperPatternOf(Q_); }

void QuadraticCost::DoEvaluate(const Evaluation& wanted) const {
  EvaluateQuadratic(Q_, b_, c_, wanted);
}

NormCost::NormCost(Norm norm, const CoefficientMatrix& A, const VectorRef& b)
    : Cost(static_cast<int>(A.sparse().cols())), norm_(norm) {
  CheckAndStore(A, b, A.sparse().rows());
}

void NormCost::UpdateCoefficients(const CoefficientMatrix& A, const VectorRef& b) {
  CheckAndStore(A, b, A_.rows());
  CoefficientsChanged();
}

void NormCost::CheckAndStore(const CoefficientMatrix& A, const VectorRef& b, Eigen::Index rows) {
  const std::string name = Name();
  Require(rows > 0, name, ": A needs a row, got none");
  CheckShape(name, "A", A.sparse(), rows, num_vars());
  CheckSize(name, "b", b, rows);
  CheckFinite(name, "A", A.sparse());
  CheckFinite(name, "b", b);
  A_ = A.sparse();
  b_ = b;
}

std::string NormCost::Kind() const {
  switch (norm_) {
    case Norm::kL1:
      return "L1-norm cost";
    case Norm::kL2:
      return "L2-norm cost";
    case Norm::kLInf:
      return "infinity-norm cost";
    case Norm::kPerspectiveQuadratic:
      break;
  }
  return "perspective quadratic cost";
}

Eigen::VectorXd NormCost::DoEval(const VectorRef& x) const {
  const Eigen::VectorXd z = A_ * x + b_;
  switch (norm_) {
    case Norm::kL1:
      return One(z.lpNorm<1>());
    case Norm::kL2:
      return One(z.stableNorm());
    case Norm::kLInf:
      return One(z.hasNaN() ? std::numeric_limits<double>::quiet_NaN()
                            : z.lpNorm<Eigen::Infinity>());
    case Norm::kPerspectiveQuadratic:
      break;
  }
  return One(PerspectiveQuadratic(z));
}

}  // namespace switchyard
