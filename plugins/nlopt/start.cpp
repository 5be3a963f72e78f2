#include "start.hpp"

#include <algorithm>
#include <cmath>

namespace switchyard::nlopt {
namespace {

/// The value nearest to v that is `push` inside of the bounds, relative to their size; where they
/// are closer than that, their middle.
double Inside(double v, double lower, double upper, double push) {
  double from = lower + push * std::max(1.0, std::abs(lower));
  double to = upper - push * std::max(1.0, std::abs(upper));
  if (from > to) from = to = lower + 0.5 * (upper - lower);
  return std::clamp(v, from, to);
}

bool IsDefined(const std::vector<double>& x, Functions& functions) {
  return functions.MoveTo(x.data()) && (!functions.has_gradients() || functions.Differentiate());
}

}  // namespace

bool MoveToStart(std::vector<double> x, Functions& functions) {
  const sy_problem& p = functions.problem();
  x.resize(static_cast<std::size_t>(p.num_vars), 0.0);
  for (std::size_t j = 0; j < x.size(); ++j) {
    x[j] = std::clamp(std::isnan(x[j]) ? 0.0 : x[j], p.x_lower[j], p.x_upper[j]);
  }
  if (IsDefined(x, functions)) return true;
  const std::vector<double> first = x;
  const auto moved = [&](double push, double shift) {
    for (std::size_t j = 0; j < x.size(); ++j) {
      x[j] = Inside(first[j] + shift, p.x_lower[j], p.x_upper[j], push);
    }
    return IsDefined(x, functions);
  };
  for (const double push : {1e-6, 1e-2, 0.1, 1.0}) {
    for (const double shift : {0.0, push, -push}) {
      if (functions.aborted()) return false;
      if (moved(push, shift)) return true;
    }
  }
  functions.MoveTo(first.data());
  return false;
}

}  // namespace switchyard::nlopt
