#include "judge.hpp"

#include <cmath>

#include "refine.hpp"

namespace switchyard::nlopt {
namespace {

// How near to a side a constraint has a multiplier.
constexpr double kActive = 1e-6;
// From which residual on Newton's method is of use, and for how long.
constexpr double kNearlyStationary = 1e-3;
constexpr int kNewtonSteps = 3;

}  // namespace

bool Judge::IsStationary(const Measured& m) const {
  return IsFeasible(m) && m.multipliers && m.multipliers->residual <= optimal_ &&
         m.multipliers->gap <= optimal_ * (1 + std::abs(m.objective));
}

void Judge::Keep(const std::vector<double>& x, Measured& point) {
  if (x.size() != functions_.x().size() || !functions_.MoveTo(x.data())) return;
  Measured m{true, x, functions_.objective(), functions_.Violation(), std::nullopt};
  if (IsFeasible(m) && functions_.has_gradients()) {
    m.multipliers = EstimateMultipliers(functions_, kActive, stop_);
  }
  if (!point.known || IsBetter(m, point)) point = std::move(m);
}

bool Judge::IsBetter(const Measured& a, const Measured& b) const {
  if (IsFeasible(a) != IsFeasible(b)) return IsFeasible(a);
  if (!IsFeasible(a)) return a.violation < b.violation;
  if (IsStationary(a) != IsStationary(b)) return IsStationary(a);
  if (!IsStationary(a) && a.multipliers && b.multipliers) {
    return a.multipliers->residual < b.multipliers->residual;
  }
  return a.objective <= b.objective;
}

void Judge::Refine(Measured& point) {
  for (int k = 0; k < kNewtonSteps; ++k) {
    if (!point.multipliers || IsStationary(point)) return;
    const double before = point.multipliers->residual;
    if (before > kNearlyStationary) return;
    const auto x = NewtonStep(functions_, point.x, *point.multipliers, stop_);
    if (x) Keep(*x, point);
    if (!x || !point.multipliers || !(point.multipliers->residual < before)) return;
  }
}

}  // namespace switchyard::nlopt
