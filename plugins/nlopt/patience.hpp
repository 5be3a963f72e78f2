// patience.hpp - when a run of NLopt goes nowhere: some of its algorithms go on for ever.
#pragma once

#include <cmath>
#include <cstdint>

#include "switchyard/problem.hpp"

namespace switchyard::nlopt {

/// Counts the evaluations of one run. The augmented Lagrangian can come back to one point for ever;
/// LN_COBYLA and LD_MMA can go on around it.
class Patience {
 public:
  Patience() = default;
  /// A global search has no gain for long, and is not to be ended for it.
  Patience(std::size_t num_vars, bool global)
      : endless_(global), most_idle_(kIdleByVariable * static_cast<std::int64_t>(num_vars + 1)) {}

  /// The next evaluation is at the same point as the last one, or at another.
  void Count(bool same) {
    standing_ = same ? standing_ + 1 : 0;
    ++idle_;
  }
  /// It found this.
  void See(double objective, double violation, bool feasible) {
    double& least = feasible ? least_objective_ : least_violation_;
    const double value = feasible ? objective : violation;
    const double step = feasible ? kGain * (1 + std::abs(objective)) : kCloser * violation;
    if (least < kInfinity && value >= least - step) return;
    least = value;
    idle_ = 0;
  }
  [[nodiscard]] bool stands() const { return !endless_ && standing_ >= kStanding; }
  [[nodiscard]] bool idles() const { return !endless_ && idle_ >= most_idle_; }

 private:
  static constexpr std::int64_t kIdleByVariable = 2000;
  static constexpr int kStanding = 20;
  // What counts as a gain, relative: of the objective, and of the violation.
  static constexpr double kGain = 1e-12;
  static constexpr double kCloser = 1e-3;

  bool endless_ = true;
  std::int64_t most_idle_ = 0;
  std::int64_t idle_ = 0;               // evaluations without a gain
  int standing_ = 0;                    // evaluations at the same point
  double least_objective_ = kInfinity;  // of feasible points
  double least_violation_ = kInfinity;  // of the others
};

}  // namespace switchyard::nlopt
