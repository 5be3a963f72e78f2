#include "core/trajectory/kinematic_rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/model/checks.hpp"

namespace switchyard {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Side {
  Eigen::Index row;  // of A
  double b;
  double low;
  double high;
};

std::vector<Side> Wanted(const VectorRef& lower, const VectorRef& upper, SideRows::Sides sides) {
  using Sides = SideRows::Sides;
  const auto wants = [sides](Sides kind) { return sides == Sides::kAll || sides == kind; };
  std::vector<Side> wanted;
  for (Eigen::Index i = 0; i < lower.size(); ++i) {
    if (lower[i] == upper[i]) {
      if (wants(Sides::kEqual)) wanted.push_back({i, lower[i], 0, 0});
      continue;
    }
    if (std::isfinite(lower[i]) && wants(Sides::kLower)) {
      wanted.push_back({i, lower[i], 0, kInfinity});
    }
    if (std::isfinite(upper[i]) && wants(Sides::kUpper)) {
      wanted.push_back({i, upper[i], -kInfinity, 0});
    }
  }
  return wanted;
}

}  // namespace

SideRows::SideRows(const SparseMatrix& A, const VectorRef& lower, const VectorRef& upper,
                   const SparseMatrix& W, Sides sides) {
  const std::vector<Side> wanted = Wanted(lower, upper, sides);
  const auto count = static_cast<Eigen::Index>(wanted.size());
  SparseMatrix chosen(count, A.rows());
  for (Eigen::VectorXd* v : {&b, &low, &high}) v->resize(count);
  std::vector<Eigen::Triplet<double>> ones;
  for (Eigen::Index k = 0; k < count; ++k) {
    const Side& side = wanted[static_cast<std::size_t>(k)];
    ones.emplace_back(k, side.row, 1);
    b[k] = side.b;
    low[k] = side.low;
    high[k] = side.high;
  }
  chosen.setFromTriplets(ones.begin(), ones.end());
  D = chosen * (A * W).eval();
}

std::shared_ptr<LinearConstraint> SideRows::OfDuration() const {
  SparseMatrix all(D.rows(), D.cols() + 1);
  all.leftCols(D.cols()) = D;
  all.rightCols(1) = (-b).sparseView(1.0, 0.0);
  return std::make_shared<LinearConstraint>(std::move(all), low, high);
}

PowerRows::PowerRows(const SideRows& rows, int k, double T_0)
    : Constraint(static_cast<int>(rows.D.cols()) + 1, static_cast<int>(rows.D.rows())),
      k_(k),
      scale_(1),
      D_(rows.D),
      b_(rows.b) {
  SetBounds(Kind(), rows.low, rows.high);
  Rescale(T_0);
}

void PowerRows::Rescale(double T_0) {
  const double scale = std::pow(T_0, -k_);
  D_ *= scale / scale_;
  b_ *= scale / scale_;
  scale_ = scale;
  CoefficientsChanged();
}

SparsityPattern PowerRows::JacobianPattern() const {
  SparsityPattern pattern{num_constraints(), num_vars(), {}, {}};
  for (int i = 0; i < D_.rows(); ++i) {
    for (RowMajor::InnerIterator e(D_, i); e; ++e) pattern.Add(i, static_cast<int>(e.col()));
  }
  for (int i = 0; i < D_.rows(); ++i) pattern.Add(i, num_vars() - 1);
  return pattern;
}

SparsityPattern PowerRows::HessianPattern() const {
  SparsityPattern pattern{num_vars(), num_vars(), {}, {}};
  pattern.Add(num_vars() - 1, num_vars() - 1);
  return pattern;
}

Eigen::VectorXd PowerRows::DoEval(const VectorRef& x) const {
  return D_ * x.head(D_.cols()) - std::pow(x[D_.cols()], k_) * b_;
}

void PowerRows::DoEvaluate(const Evaluation& wanted) const {
  const Eigen::Map<const Eigen::VectorXd> x(wanted.x, num_vars());
  const double T = x[D_.cols()];
  if (wanted.values != nullptr) {
    Eigen::Map<Eigen::VectorXd> values(wanted.values, D_.rows());
    values = std::pow(T, k_) * -b_;
    values.noalias() += D_ * x.head(D_.cols());
  }
  if (wanted.jacobian != nullptr) {
    double* to = std::copy_n(D_.valuePtr(), D_.nonZeros(), wanted.jacobian);
    Eigen::Map<Eigen::VectorXd>(to, b_.size()) = -k_ * std::pow(T, k_ - 1) * b_;
  }
  if (wanted.hessian != nullptr) {
    const Eigen::Map<const Eigen::VectorXd> w(wanted.weights, b_.size());
    *wanted.hessian = -k_ * (k_ - 1) * std::pow(T, k_ - 2) * b_.dot(w);
  }
}

double PowerRows::ViolationOf(const Eigen::VectorXd& y) const {
  return BoxViolation(y, lower_bound(), upper_bound());
}

}  // namespace switchyard
