#include "core/host/watch.hpp"

#include <cmath>

#include "switchyard/plugin.hpp"
#include "switchyard/problem.hpp"

namespace switchyard {

Watch::Watch(const sy_control& asked, const sy_solver& backend, const TurnQueue& queue)
    : asked_(asked),
      honors_(backend.honors),
      gives_bound_((backend.traits & SY_GIVES_BOUND) != 0),
      queue_(queue),
      start_(std::chrono::steady_clock::now()) {}

sy_control Watch::control() {
  sy_control control = asked_;
  control.context = this;
  control.progress = [](void* context, const sy_progress* progress) noexcept {
    return static_cast<std::int32_t>(
        static_cast<Watch*>(context)->OnProgress(plugin::Whole(*progress)));
  };
  control.cancelled = [](void* context) noexcept {
    return static_cast<std::int32_t>(static_cast<Watch*>(context)->OnCancelled());
  };
  return control;
}

bool Watch::PastDeadline() const {
  if ((honors_ & SY_HONORS_SECONDS) != 0 || !std::isfinite(asked_.seconds)) return false;
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start_;
  return spent.count() >= asked_.seconds;
}

bool Watch::Stop(sy_termination reason) {
  sy_termination none = SY_NOT_SOLVED;
  reason_.compare_exchange_strong(none, reason);
  return true;
}

int Watch::OnCancelled() {
  const Inside inside(queue_);
  if (reason_.load() != SY_NOT_SOLVED) return 1;
  if (asked_.cancelled != nullptr && asked_.cancelled(asked_.context) != 0) {
    return Stop(SY_CANCELLED) ? 1 : 0;
  }
  return PastDeadline() && Stop(SY_TIME_LIMIT) ? 1 : 0;
}

int Watch::OnProgress(const sy_progress& progress) {
  const Inside inside(queue_);
  const auto watched = [&](std::uint64_t field) { return (honors_ & field) == 0; };
  if (asked_.progress != nullptr && asked_.progress(asked_.context, &progress) != 0) {
    return Stop(SY_CANCELLED) ? 1 : 0;
  }
  if (watched(SY_HONORS_TARGET) && asked_.target > -kInfinity && progress.incumbent != nullptr &&
      progress.objective <= asked_.target) {
    return Stop(SY_TARGET) ? 1 : 0;
  }
  // Of a backend that promises no bound the field is not one, whatever it holds.
  if (watched(SY_HONORS_CUTOFF) && gives_bound_ && asked_.cutoff < kInfinity &&
      progress.bound >= asked_.cutoff) {
    return Stop(SY_CUTOFF) ? 1 : 0;
  }
  if (watched(SY_HONORS_ITERATIONS) && progress.iteration >= asked_.iterations) {
    return Stop(SY_ITERATION_LIMIT) ? 1 : 0;
  }
  if (watched(SY_HONORS_NODES) && progress.nodes >= asked_.nodes) {
    return Stop(SY_NODE_LIMIT) ? 1 : 0;
  }
  return OnCancelled();
}

}  // namespace switchyard
