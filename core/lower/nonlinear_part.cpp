#include <algorithm>
#include <cmath>
#include <utility>

#include "core/lower/nonlinear.hpp"

namespace switchyard {
namespace {

bool AllFinite(const double* values, std::size_t count) {
  return std::all_of(values, values + count, [](double v) { return std::isfinite(v); });
}

bool Wants(const sy_evaluation& e, std::uint32_t bit, const void* buffer) {
  return (e.want & bit) != 0 && buffer != nullptr;
}

}  // namespace

NonlinearPart::NonlinearPart(std::shared_ptr<const NonlinearTerms> terms,
                             const MathematicalProgram& program)
    : terms_(std::move(terms)) {
  const auto add = [&](const auto& bindings) {
    for (const auto& binding : bindings) {
      const Eigen::VectorXd& lower = binding.evaluator()->lower_bound();
      const Eigen::VectorXd& upper = binding.evaluator()->upper_bound();
      lower_.insert(lower_.end(), lower.begin(), lower.end());
      upper_.insert(upper_.end(), upper.begin(), upper.end());
    }
  };
  add(program.quadratic_constraints());
  add(program.generic_constraints());
  record_.size = sizeof record_;
  record_.flags = terms_->thread_safe() ? std::uint32_t{SY_NLP_CONCURRENT} : 0;
  record_.provides = terms_->provides();
  record_.num_constraints = terms_->num_rows();
  record_.lower = lower_.data();
  record_.upper = upper_.data();
  record_.jacobian = terms_->jacobian().View();
  record_.hessian = terms_->hessian().View();
  record_.context = this;
  record_.evaluate = &NonlinearPart::Evaluate;
  cache_.gradient.resize(static_cast<std::size_t>(terms_->jacobian().cols));
  cache_.constraints.resize(lower_.size());
  cache_.jacobian.resize(static_cast<std::size_t>(terms_->jacobian().nonzeros()));
}

sy_verdict NonlinearPart::Evaluate(void* context, sy_evaluation* wanted) noexcept {
  auto* self = static_cast<NonlinearPart*>(context);
  try {
    return self->Answer(*wanted);
  } catch (...) {
    const std::lock_guard lock(self->throwing_);
    if (self->thrown_ == nullptr) self->thrown_ = std::current_exception();
    return SY_ABORT;
  }
}

// One caller at a time has the cache; others, where the functions may be called at once, do
// without.
sy_verdict NonlinearPart::Answer(const sy_evaluation& wanted) {
  std::unique_lock lock(caching_, std::try_to_lock);
  if (!lock.owns_lock() && !terms_->thread_safe()) lock.lock();
  const bool defined = lock.owns_lock() ? FromCache(wanted) : Afresh(wanted);
  return defined ? SY_EVALUATED : SY_UNDEFINED;
}

bool NonlinearPart::FromCache(const sy_evaluation& e) {
  const auto n = cache_.gradient.size();
  if (cache_.x.size() != n || !std::equal(cache_.x.begin(), cache_.x.end(), e.x)) {
    cache_.x.assign(e.x, e.x + n);
    cache_.known = {};
  }
  const auto need = [&](Kind kind, auto&& compute) {
    if (cache_.known[kind]) return;
    Count(kind);
    compute();
    cache_.known[kind] = true;
  };
  const double* x = cache_.x.data();
  bool defined = true;
  if (Wants(e, SY_OBJECTIVE, e.objective)) {
    need(kObjective, [&] { cache_.objective = terms_->Objective(x); });
    *e.objective = cache_.objective;
    defined = defined && std::isfinite(cache_.objective);
  }
  const auto copy = [&](const std::vector<double>& from, double* to) {
    std::copy(from.begin(), from.end(), to);
    defined = defined && AllFinite(from.data(), from.size());
  };
  if (Wants(e, SY_GRADIENT, e.gradient)) {
    need(kGradient, [&] { terms_->Gradient(x, cache_.gradient.data()); });
    copy(cache_.gradient, e.gradient);
  }
  if (Wants(e, SY_CONSTRAINTS, e.constraints)) {
    need(kConstraints, [&] { terms_->Constraints(x, cache_.constraints.data()); });
    copy(cache_.constraints, e.constraints);
  }
  if (Wants(e, SY_JACOBIAN, e.jacobian)) {
    need(kJacobian, [&] { terms_->Jacobian(x, cache_.jacobian.data()); });
    copy(cache_.jacobian, e.jacobian);
  }
  if (!Wants(e, SY_HESSIAN, e.hessian)) return defined;
  Count(kHessian);
  terms_->Hessian(x, e.weight, e.multipliers, e.hessian);
  return defined && AllFinite(e.hessian, static_cast<std::size_t>(terms_->hessian().nonzeros()));
}

bool NonlinearPart::Afresh(const sy_evaluation& e) {
  bool defined = true;
  const auto see = [&](Kind kind, const double* values, std::size_t count) {
    Count(kind);
    defined = defined && AllFinite(values, count);
  };
  if (Wants(e, SY_OBJECTIVE, e.objective)) {
    *e.objective = terms_->Objective(e.x);
    see(kObjective, e.objective, 1);
  }
  if (Wants(e, SY_GRADIENT, e.gradient)) {
    terms_->Gradient(e.x, e.gradient);
    see(kGradient, e.gradient, cache_.gradient.size());
  }
  if (Wants(e, SY_CONSTRAINTS, e.constraints)) {
    terms_->Constraints(e.x, e.constraints);
    see(kConstraints, e.constraints, lower_.size());
  }
  if (Wants(e, SY_JACOBIAN, e.jacobian)) {
    terms_->Jacobian(e.x, e.jacobian);
    see(kJacobian, e.jacobian, cache_.jacobian.size());
  }
  if (Wants(e, SY_HESSIAN, e.hessian)) {
    terms_->Hessian(e.x, e.weight, e.multipliers, e.hessian);
    see(kHessian, e.hessian, static_cast<std::size_t>(terms_->hessian().nonzeros()));
  }
  return defined;
}

EvaluationCounts NonlinearPart::counts() const {
  const auto count = [&](Kind kind) { return counts_[kind].load(std::memory_order_relaxed); };
  return {count(kObjective), count(kGradient), count(kConstraints), count(kJacobian),
          count(kHessian)};
}

void NonlinearPart::ClearCounts() {
  for (auto& count : counts_) count = 0;
}

void NonlinearPart::RethrowWhatWasThrown() {
  if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
}

}  // namespace switchyard
