#include "core/functions/tape_function.hpp"

#include <algorithm>
#include <atomic>
#include <utility>

#include "switchyard/error.hpp"

namespace switchyard {
namespace {

std::uint64_t NextSerial() {
  static std::atomic<std::uint64_t> last = 0;
  return ++last;
}

// Kept by each thread and shared by all functions, so it has the size of the largest. A function
// that finds its own constants in it, because it was the last to use it, need not write them.
struct SharedWorkspace {
  std::vector<double> numbers;
  std::uint64_t last_user = 0;
};
thread_local SharedWorkspace shared_workspace;

void Compute(std::span<const DerivativeStep> steps, double* s) {
  for (const DerivativeStep& step : steps) {
    step.compute(s[step.a], s[step.b], s[step.v], s + step.d);
  }
}

}  // namespace

TapeFunction::TapeFunction(const Tape& tape, const PlanOptions& options)
    : Function(tape.num_inputs(), static_cast<int>(tape.outputs().size())),
      tape_(tape),
      graph_(tape),
      weights_(graph_.num_slots),
      jacobian_(&graph_, weights_ + num_outputs(), options.jacobian),
      hessian_(&graph_, weights_, jacobian_.end(), options.most_hessian_terms),
      constants_(hessian_.end()),
      tangents_(constants_ + static_cast<int>(graph_.constants.values().size())),
      size_(tangents_ + jacobian_.num_tangents()),
      serial_(NextSerial()) {
  graph_.StoreConstants(constants_);
  jacobian_.StoreConstants(constants_);
  hessian_.StoreConstants(constants_);
  SetJacobian(std::move(jacobian_.pattern));
  if (hessian_.is_planned) SetHessian(std::move(hessian_.pattern));
}

double* TapeFunction::Workspace() const {
  SharedWorkspace& shared = shared_workspace;
  if (shared.last_user != serial_) {
    if (std::ssize(shared.numbers) < size_) shared.numbers.resize(size_);
    std::ranges::copy(graph_.constants.values(), shared.numbers.begin() + constants_);
    shared.last_user = serial_;
  }
  return shared.numbers.data();
}

void TapeFunction::Evaluate(const Evaluation& wanted) const {
  double* const s = Workspace();
  std::copy_n(wanted.x, num_vars(), s);
  double* v = s + num_vars();
  for (const ValueStep& step : graph_.values) *v++ = step.value(s[step.a], s[step.b], s[step.c]);
  if (wanted.values != nullptr) {
    for (int i = 0; i < num_outputs(); ++i) wanted.values[i] = s[graph_.outputs[i]];
  }
  if (wanted.jacobian == nullptr && wanted.hessian == nullptr) return;
  Compute(graph_.first, s);
  if (wanted.jacobian != nullptr) jacobian_.Run(graph_, s, s + tangents_, wanted.jacobian);
  if (wanted.hessian == nullptr) return;
  Require(has_hessian(), "function: its Hessian is too large, so it has none");
  Compute(graph_.second, s);
  std::copy_n(wanted.weights, num_outputs(), s + weights_);
  hessian_.Run(graph_, s, wanted.hessian);
}

PlannedWork TapeFunction::Work() const {
  return {.values = std::ssize(graph_.values),
          .derivatives = std::ssize(graph_.first) + std::ssize(graph_.second),
          .jacobian = jacobian_.num_products(),
          .hessian = hessian_.num_products(),
          .jacobian_is_forward = jacobian_.is_forward()};
}

std::shared_ptr<const Function> CompileTape(const Tape& tape) {
  return std::make_shared<TapeFunction>(tape);
}

const Tape* TapeOf(const Function& f) {
  const auto* const of_tape = dynamic_cast<const OfTape*>(&f);
  return of_tape != nullptr ? &of_tape->tape() : nullptr;
}

}  // namespace switchyard
