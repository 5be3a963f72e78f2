// solvers/rounding/budget.hpp - what a strategy may spend, and the part of it that each backend
// underneath is given.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <limits>
#include <mutex>

#include "switchyard/abi.h"

namespace switchyard::rounding {

/// Watches one solve of a strategy. Every member may be called from any thread.
class Budget {
 public:
  explicit Budget(const sy_control& control) : control_(control) {}
  Budget(const Budget&) = delete;
  Budget& operator=(const Budget&) = delete;

  [[nodiscard]] const sy_control& control() const { return control_; }
  [[nodiscard]] double Seconds() const {
    return std::chrono::duration<double>(Clock::now() - begin_).count();
  }
  /// Why the solve was asked to stop; SY_NOT_SOLVED: it was not.
  [[nodiscard]] sy_termination reason() const { return reason_; }

  /// Must the solve stop now? Asks the host and the clock.
  bool Stopped() {
    if (reason_ != SY_NOT_SOLVED) return true;
    if (control_.cancelled != nullptr && control_.cancelled(control_.context) != 0) {
      Stop(SY_CANCELLED);
    }
    if (Seconds() >= control_.seconds) Stop(SY_TIME_LIMIT);
    return reason_ != SY_NOT_SOLVED;
  }

  /// What a backend is given: the time that is left, this budget's hooks, tolerances as they came.
  /// Gaps, cutoff and target speak of the whole problem, not of the part the backend solves.
  [[nodiscard]] sy_control Part(std::int32_t threads) {
    sy_control part = control_;
    part.flags = 0;
    part.threads = threads;
    part.seconds = control_.seconds - Seconds();
    if (!(part.seconds > 0)) part.seconds = 0;
    part.iterations = part.nodes = std::numeric_limits<std::int64_t>::max();
    part.cutoff = std::numeric_limits<double>::infinity();
    part.target = -part.cutoff;
    part.absolute_gap = part.relative_gap = std::numeric_limits<double>::quiet_NaN();
    part.context = this;
    part.progress = [](void* budget, const sy_progress* progress) noexcept {
      return static_cast<Budget*>(budget)->Pass(*progress);
    };
    part.cancelled = [](void* budget) noexcept {
      return static_cast<Budget*>(budget)->Stopped() ? 1 : 0;
    };
    return part;
  }

  /// Tells the host: an incumbent where there is a new one.
  void Tell(double objective, double bound, const double* incumbent) {
    TellOfTree(objective, bound, incumbent, 0, 0);
  }
  /// Likewise, with the nodes of a tree that were looked at, and those that are open.
  void TellOfTree(double objective, double bound, const double* incumbent, std::int64_t nodes,
                  std::int64_t open) {
    sy_progress told = Nothing();
    told.nodes = nodes;
    told.open_nodes = open;
    told.objective = objective;
    told.bound = bound;
    told.incumbent = incumbent;
    Send(told);
  }

 private:
  using Clock = std::chrono::steady_clock;

  static sy_progress Nothing() {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    sy_progress told{};
    told.size = sizeof told;
    told.objective = told.primal_residual = told.dual_residual = nan;
    told.bound = -std::numeric_limits<double>::infinity();
    return told;
  }

  /// A backend's report, without what it says of its own part: neither its objective nor its bound
  /// is one of the whole problem.
  std::int32_t Pass(const sy_progress& report) {
    sy_progress told = Nothing();
    told.iteration = report.iteration;
    if (SY_HAS(&report, sy_progress, dual_residual)) {
      told.primal_residual = report.primal_residual;
      told.dual_residual = report.dual_residual;
    }
    Send(told);
    return Stopped() ? 1 : 0;
  }

  void Send(sy_progress& told) {
    if (control_.progress == nullptr) return;
    const std::lock_guard lock(telling_);
    told.seconds = Seconds();
    if (control_.progress(control_.context, &told) != 0) Stop(SY_CANCELLED);
  }

  /// The first reason stands.
  void Stop(sy_termination reason) {
    sy_termination none = SY_NOT_SOLVED;
    reason_.compare_exchange_strong(none, reason);
  }

  const sy_control control_;
  const Clock::time_point begin_ = Clock::now();
  std::atomic<sy_termination> reason_ = SY_NOT_SOLVED;
  std::mutex telling_;
};

}  // namespace switchyard::rounding
