// solvers/rounding/verdict.hpp - what the best point that was found and a bound come to.
#pragma once

#include <algorithm>
#include <cmath>

#include <optional>

#include "solvers/rounding/backend.hpp"
#include "solvers/rounding/budget.hpp"

namespace switchyard::rounding {

/// Is an objective within the gaps that were asked for (1e-4 relative where none was)?
inline bool IsWithinTheGap(const sy_control& control, double objective, double bound) {
  const double gap = std::max(0.0, objective - bound);
  const double relative = std::isnan(control.relative_gap) ? 1e-4 : control.relative_gap;
  const double absolute = std::isnan(control.absolute_gap) ? 0 : control.absolute_gap;
  return gap <= relative * std::max(1e-10, std::abs(objective)) || gap <= absolute;
}

inline bool IsPoint(sy_point_kind kind) { return kind != SY_NO_POINT && kind != SY_CERTIFICATE; }

/// The answer where a relaxation that is not infeasible leaves nothing to round. What a limit or
/// numerical trouble leaves of a relaxed point is as good a guide as any.
inline std::optional<sy_termination> EndOf(const Answer& relaxed, double bound, Budget& budget) {
  if (budget.Stopped()) return budget.reason();
  if (relaxed.termination == SY_UNBOUNDED) return SY_INFEASIBLE_OR_UNBOUNDED;
  if (bound >= budget.control().cutoff) return SY_CUTOFF;
  if (IsPoint(relaxed.primal)) return std::nullopt;
  return relaxed.termination == SY_OPTIMAL ? SY_NUMERICAL_TROUBLE : relaxed.termination;
}

/// The answer with a best objective, or none (NULL).
inline sy_termination Verdict(const Budget& budget, const double* best, double bound) {
  if (best != nullptr) {
    if (IsWithinTheGap(budget.control(), *best, bound)) return SY_OPTIMAL;
    if (*best <= budget.control().target) return SY_TARGET;
  }
  if (budget.reason() != SY_NOT_SOLVED) return budget.reason();
  return best != nullptr ? SY_LOCALLY_OPTIMAL : SY_RESTRICTIONS_FAILED;
}

}  // namespace switchyard::rounding
