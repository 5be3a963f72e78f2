#include "switchyard/model/evaluator.hpp"

#include <algorithm>

#include "core/model/checks.hpp"

namespace switchyard {

SparsityPattern EvaluatorBase::JacobianPattern() const {
  return SparsityPattern::Dense(num_outputs_, num_vars_);
}

SparsityPattern EvaluatorBase::HessianPattern() const {
  return SparsityPattern::DenseUpperTriangle(num_vars_);
}

void EvaluatorBase::DoEvaluate(const Evaluation& wanted) const {
  Require(wanted.jacobian == nullptr && wanted.hessian == nullptr, Name(),
          ": it has no derivatives");
  if (wanted.values == nullptr) return;
  const Eigen::VectorXd y = DoEval(Eigen::Map<const Eigen::VectorXd>(wanted.x, num_vars_));
  CheckSize(Name(), "the value", y, num_outputs_);
  std::copy(y.begin(), y.end(), wanted.values);
}

SparseMatrix EvaluatorBase::EvalJacobian(VectorRef x) const {
  CheckSize(Name(), "x", x, num_vars_);
  Require(has_jacobian(), Name(), ": it has no Jacobian");
  const SparsityPattern pattern = JacobianPattern();
  std::vector<double> value(static_cast<std::size_t>(pattern.size()));
  Evaluate({.x = x.data(), .jacobian = value.data()});
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t k = 0; k < value.size(); ++k) {
    entries.emplace_back(pattern.row[k], pattern.col[k], value[k]);
  }
  SparseMatrix J(num_outputs_, num_vars_);
  J.setFromTriplets(entries.begin(), entries.end());
  return J;
}

SparseMatrix EvaluatorBase::EvalHessian(VectorRef x, VectorRef weights) const {
  CheckSize(Name(), "x", x, num_vars_);
  CheckSize(Name(), "the weights", weights, num_outputs_);
  Require(has_hessian(), Name(), ": it has no Hessian");
  const SparsityPattern pattern = HessianPattern();
  std::vector<double> value(static_cast<std::size_t>(pattern.size()));
  Evaluate({.x = x.data(), .weights = weights.data(), .hessian = value.data()});
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t k = 0; k < value.size(); ++k) {
    entries.emplace_back(pattern.row[k], pattern.col[k], value[k]);
    if (pattern.row[k] != pattern.col[k]) {
      entries.emplace_back(pattern.col[k], pattern.row[k], value[k]);
    }
  }
  SparseMatrix H(num_vars_, num_vars_);
  H.setFromTriplets(entries.begin(), entries.end());
  return H;
}

}  // namespace switchyard
