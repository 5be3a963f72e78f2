#include "core/functions/probe.hpp"

#include <cmath>

#include "switchyard/error.hpp"

namespace switchyard {

// 0.5 + (the fractional part of i times the golden ratio) / 2: no two multiples are near each
// other.
Eigen::VectorXd GenericPoint(int num_vars) {
  constexpr double kGolden = 0.6180339887498949;
  Eigen::VectorXd x(num_vars);
  for (int i = 0; i < num_vars; ++i) {
    const double multiple = (i + 1) * kGolden;
    x[i] = 0.5 + 0.5 * (multiple - std::floor(multiple));
  }
  return x;
}

void CheckProbe(int num_vars, const FunctionOptions& options) {
  Require(num_vars >= 0, "function: the number of variables needs to be at least 0, got ",
          num_vars);
  Require(!options.probe || options.probe->size() == num_vars, "function: the probe needs ",
          num_vars, " entries, got ", options.probe ? options.probe->size() : 0);
}

}  // namespace switchyard
