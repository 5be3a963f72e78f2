// linear/watch.hpp - the budget of one solve: when to stop, why, and the hooks of the host.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <limits>
#include <mutex>

#include "switchyard/abi.h"

namespace switchyard::linear {

/// Watches one solve. Every member may be called from any thread.
class Watch {
 public:
  explicit Watch(const sy_control& control) : control_(control) {}

  [[nodiscard]] double Seconds() const {
    return std::chrono::duration<double>(Clock::now() - begin_).count();
  }
  [[nodiscard]] double Left() const {
    const double left = control_.seconds - Seconds();
    return left > 0 ? left : 0;
  }
  [[nodiscard]] const sy_control& control() const { return control_; }

  /// Why the solve was asked to stop; SY_NOT_SOLVED: it was not.
  [[nodiscard]] sy_termination reason() const { return reason_; }

  /// Asks the solve to stop; the first reason stands.
  void Stop(sy_termination reason) {
    sy_termination none = SY_NOT_SOLVED;
    reason_.compare_exchange_strong(none, reason);
  }

  /// Must the solve stop now? Asks the clock and the host: meant for every iteration.
  bool Stopped() {
    if (reason_ != SY_NOT_SOLVED) return true;
    if (control_.cancelled != nullptr && control_.cancelled(control_.context) != 0) {
      Stop(SY_CANCELLED);
    }
    if (Seconds() >= control_.seconds) Stop(SY_TIME_LIMIT);
    return reason_ != SY_NOT_SOLVED;
  }

  /// The same, of a solve that counts its iterations.
  bool Stopped(std::int64_t iterations) {
    if (iterations >= control_.iterations) Stop(SY_ITERATION_LIMIT);
    return Stopped();
  }

  /// Tells the host how far it is: each incumbent, and of the rest as much as a reader can use.
  void Tell(std::int64_t iteration, double objective, double bound, std::int64_t nodes = 0,
            std::int64_t open_nodes = 0, const double* incumbent = nullptr) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    Send({sizeof(sy_progress), 0, iteration, 0, objective, bound, nan, nan, incumbent, nodes,
          open_nodes});
  }

  /// The same, of a solver that knows its residuals and no bound.
  void TellResiduals(std::int64_t iteration, double objective, double primal, double dual) {
    constexpr double none = -std::numeric_limits<double>::infinity();
    Send({sizeof(sy_progress), 0, iteration, 0, objective, none, primal, dual, nullptr, 0, 0});
  }

 private:
  using Clock = std::chrono::steady_clock;

  void Send(sy_progress progress) {
    if (control_.progress == nullptr) return;
    const std::lock_guard lock(telling_);
    progress.seconds = Seconds();
    if (progress.incumbent == nullptr && progress.seconds < next_) return;
    next_ = progress.seconds + kPeriod;
    if (control_.progress(control_.context, &progress) != 0) Stop(SY_CANCELLED);
  }

  static constexpr double kPeriod = 0.02;  // seconds between two reports without an incumbent

  const sy_control control_;
  const Clock::time_point begin_ = Clock::now();
  std::atomic<sy_termination> reason_ = SY_NOT_SOLVED;
  std::mutex telling_;
  double next_ = 0;
};

}  // namespace switchyard::linear
