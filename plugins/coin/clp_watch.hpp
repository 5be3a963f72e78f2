// coin/clp_watch.hpp - stops CLP when a watch says so.
#pragma once

#include <atomic>
#include <cstdint>

#include "ClpEventHandler.hpp"
#include "ClpSimplex.hpp"
#include "linear/watch.hpp"
#include "switchyard/problem.hpp"

namespace switchyard::coin {

/// One solve: CLP copies its event handlers with its models, so they share this.
struct ClpSession {
  linear::Watch& watch;
  bool counts_iterations;  // and tells of them: the solve is CLP's own, not one of many
  std::atomic<std::int64_t> iterations = 0;
  std::atomic<bool> deaf = false;  // finishes what it is at
};

class ClpWatch : public ClpEventHandler {
 public:
  explicit ClpWatch(ClpSession& session) : session_(&session) {}
  int event(Event which) override {
    constexpr int kStop = 0;
    constexpr int kGoOn = -1;
    if (session_->deaf) return kGoOn;
    linear::Watch& watch = session_->watch;
    if (which == endOfIteration) {
      ++session_->iterations;
    } else if (which == endOfFactorization) {
      if (session_->counts_iterations) {
        watch.Tell(session_->iterations, model_->objectiveValue(), -kInfinity);
      }
    } else if (which != endOfValuesPass) {
      return kGoOn;
    }
    const bool stopped =
        session_->counts_iterations ? watch.Stopped(session_->iterations) : watch.Stopped();
    return stopped ? kStop : kGoOn;
  }
  [[nodiscard]] ClpEventHandler* clone() const override { return new ClpWatch(*this); }

 private:
  ClpSession* session_;
};

}  // namespace switchyard::coin
