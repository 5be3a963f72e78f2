#include "solvers/mip/incumbents.hpp"

#include <algorithm>
#include <cmath>

namespace switchyard::mip {

bool Incumbents::Offer(double objective, const std::vector<double>& x) {
  const auto same = [&](const Solution& s) { return s.objective == objective && s.x == x; };
  if (std::any_of(all_.begin(), all_.end(), same)) return false;
  const auto place = std::find_if(all_.begin(), all_.end(),
                                  [&](const Solution& s) { return objective < s.objective; });
  const bool best = place == all_.begin();
  if (place == all_.end() && all_.size() >= capacity_) return false;
  all_.insert(place, {objective, x});
  if (all_.size() > capacity_) all_.pop_back();
  return best;
}

double Threshold(const sy_control& control, double best) {
  if (!(best < kInfinity)) return control.cutoff;
  const double asked = std::isnan(control.relative_gap) ? 1e-4 : control.relative_gap;
  const double relative = std::max(asked, kLeastGap);
  const double absolute = std::isnan(control.absolute_gap) ? 0 : control.absolute_gap;
  const double gap = std::max(relative * std::max(1e-10, std::abs(best)), absolute);
  constexpr double kInside = 0.99;  // so that it is within the gap, computed anew, too
  return std::min(control.cutoff, best - kInside * gap);
}

}  // namespace switchyard::mip
