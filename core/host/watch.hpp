// core/host/watch.hpp - the budget of one solve, kept for backends that do not keep it themselves.
#pragma once

#include <atomic>
#include <chrono>

#include "core/host/turn.hpp"
#include "switchyard/abi.h"

namespace switchyard {

/// Stands between a backend and the caller's hooks during one solve. Limits that the backend does
/// not honor are watched here: the deadline whenever the backend asks or reports, the others where
/// it reports what they speak of.
class Watch {
 public:
  /// While a hook is served, its thread counts as inside the backend of `queue`.
  Watch(const sy_control& asked, const sy_solver& backend, const TurnQueue& queue);
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

  /// What the backend is given; refers to this object.
  [[nodiscard]] sy_control control();
  /// Which limit stopped it from here; SY_NOT_SOLVED: none did.
  [[nodiscard]] sy_termination stopped_by() const { return reason_.load(); }

 private:
  [[nodiscard]] bool PastDeadline() const;
  bool Stop(sy_termination reason);
  int OnProgress(const sy_progress& progress);
  int OnCancelled();

  const sy_control asked_;
  const std::uint64_t honors_;
  const bool gives_bound_;
  const TurnQueue& queue_;
  const std::chrono::steady_clock::time_point start_;
  std::atomic<sy_termination> reason_ = SY_NOT_SOLVED;
};

}  // namespace switchyard
