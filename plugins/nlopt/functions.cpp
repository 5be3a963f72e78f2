#include "functions.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace switchyard::nlopt {
namespace {

bool AllFinite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

}  // namespace

Functions::Functions(const sy_problem& problem)
    : p_(problem),
      x_(static_cast<std::size_t>(problem.num_vars)),
      value_(static_cast<std::size_t>(num_constraints())),
      size_(static_cast<std::size_t>(problem.num_rows)),
      gradient_(x_.size()) {
  Csc all = p_.A != nullptr ? Csc(*p_.A) : Csc(0, p_.num_vars);
  if (p_.nlp != nullptr) {
    const sy_nlp& nlp = *p_.nlp;
    lower_ = nlp.lower;
    upper_ = nlp.upper;
    evaluation_.emplace(nlp, p_.num_vars);
    has_objective_ = (nlp.provides & SY_OBJECTIVE) != 0;
    has_gradients_ = (!has_objective_ || (nlp.provides & SY_GRADIENT) != 0) &&
                     (nlp.num_constraints == 0 || (nlp.provides & SY_JACOBIAN) != 0);
  }
  if (num_nonlinear() > 0 && (p_.nlp->provides & SY_JACOBIAN) == 0) {
    all = StackRows(all, Csc(num_nonlinear(), p_.num_vars));
  } else if (num_nonlinear() > 0) {
    // The place of each entry, as the value that the transposition carries along.
    Csc jacobian(p_.nlp->jacobian);
    jacobian.value.resize(jacobian.row.size());
    std::iota(jacobian.value.begin(), jacobian.value.end(), 0.0);
    all = StackRows(all, jacobian);
    entries_.resize(jacobian.row.size());
    place_.resize(jacobian.row.size());
  }
  normals_ = Transpose(all.View());
  normals_.value.resize(normals_.row.size());
  for (auto k = static_cast<std::size_t>(normals_.start[static_cast<std::size_t>(p_.num_rows)]);
       k < normals_.value.size(); ++k) {
    place_[static_cast<std::size_t>(normals_.value[k])] = static_cast<std::int32_t>(k);
    normals_.value[k] = 0;
  }
}

void Functions::GoTo(const double* x) {
  if (std::equal(x_.begin(), x_.end(), x)) return;
  std::copy(x, x + x_.size(), x_.begin());
  state_ = derivatives_ = State::kUnknown;
}

bool Functions::MoveTo(const double* x) {
  GoTo(x);
  if (state_ == State::kUnknown) state_ = Evaluate() ? State::kDefined : State::kUndefined;
  return state_ == State::kDefined;
}

bool Functions::DifferentiateAt(const double* x) {
  GoTo(x);
  return Differentiate();
}

bool Functions::Evaluate() {
  const double* x = x_.data();
  std::fill(value_.begin(), value_.end(), 0.0);
  std::fill(size_.begin(), size_.end(), 0.0);
  for (std::int32_t j = 0; p_.A != nullptr && j < p_.num_vars; ++j) {
    for (std::int32_t k = p_.A->start[j]; k < p_.A->start[j + 1]; ++k) {
      const auto i = static_cast<std::size_t>(p_.A->row[k]);
      const double term = p_.A->value[k] * x[j];
      value_[i] += term;
      size_[i] = std::max(size_[i], std::abs(term));
    }
  }
  objective_ = Objective(p_, x);
  if (has_objective_) {
    double nonlinear = 0;
    if (evaluation_->Objective(x, &nonlinear) != SY_EVALUATED) return false;
    objective_ += nonlinear;
  }
  if (num_nonlinear() > 0 &&
      evaluation_->Constraints(x, value_.data() + p_.num_rows) != SY_EVALUATED) {
    return false;
  }
  return std::isfinite(objective_) && AllFinite(value_);
}

bool Functions::Differentiate() {
  if (derivatives_ == State::kUnknown) {
    derivatives_ = EvaluateDerivatives() ? State::kDefined : State::kUndefined;
  }
  return derivatives_ == State::kDefined;
}

bool Functions::EvaluateDerivatives() {
  const double* x = x_.data();
  std::fill(gradient_.begin(), gradient_.end(), 0.0);
  if (has_objective_ && evaluation_->Gradient(x, gradient_.data()) != SY_EVALUATED) return false;
  for (std::int32_t j = 0; j < p_.num_vars; ++j) gradient_[static_cast<std::size_t>(j)] += p_.q[j];
  if (p_.P != nullptr) SymmetricMultiplyAdd(*p_.P, 1, x, gradient_.data());
  if (num_nonlinear() > 0) {
    if (evaluation_->Jacobian(x, entries_.data()) != SY_EVALUATED) return false;
    for (std::size_t k = 0; k < entries_.size(); ++k) {
      normals_.value[static_cast<std::size_t>(place_[k])] = entries_[k];
    }
  }
  return AllFinite(gradient_) && AllFinite(entries_);
}

std::optional<Eigen::MatrixXd> Functions::Hessian(const std::vector<double>& multipliers) {
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(p_.num_vars, p_.num_vars);
  const auto add = [&H](const sy_csc& upper, const double* values) {
    for (std::int32_t j = 0; j < upper.cols; ++j) {
      for (std::int32_t k = upper.start[j]; k < upper.start[j + 1]; ++k) {
        const std::int32_t i = upper.row[k];
        H(i, j) += values[k];
        if (i != j) H(j, i) += values[k];
      }
    }
  };
  if (p_.P != nullptr) add(*p_.P, p_.P->value);
  if (!has_objective_ && num_nonlinear() == 0) return H;
  if ((p_.nlp->provides & SY_HESSIAN) == 0) return std::nullopt;
  std::vector<double> negative(multipliers.begin() + p_.num_rows, multipliers.end());
  for (double& y : negative) y = -y;
  const sy_csc& pattern = p_.nlp->hessian;
  std::vector<double> values(static_cast<std::size_t>(pattern.start[pattern.cols]));
  if (evaluation_->Hessian(x_.data(), 1, negative.data(), values.data()) != SY_EVALUATED) {
    return std::nullopt;
  }
  add(pattern, values.data());
  return H;
}

double Functions::Violation(std::int32_t i) const {
  const auto at = static_cast<std::size_t>(i);
  const double outside = std::max(lower(i) - value_[at], value_[at] - upper(i));
  if (!(outside > 0)) return 0;
  const double side = value_[at] < lower(i) ? lower(i) : upper(i);
  return outside / (1 + (i < p_.num_rows ? size_[at] : std::abs(side)));
}

double Functions::Violation() const {
  double worst = 0;
  for (std::int32_t i = 0; i < num_constraints(); ++i) worst = std::max(worst, Violation(i));
  return worst;
}

}  // namespace switchyard::nlopt
