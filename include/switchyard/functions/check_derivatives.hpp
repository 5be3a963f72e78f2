// switchyard/functions/check_derivatives.hpp - are the derivatives of a function those of its
// values?
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "switchyard/export.hpp"
#include "switchyard/functions/function.hpp"

namespace switchyard {

/// An entry of a derivative beside what differences say of it.
struct DerivativeMismatch {
  enum class Kind : std::uint8_t { kJacobian, kHessian };
  Kind kind = Kind::kJacobian;
  int row = 0;
  int col = 0;
  double ours = 0;  // 0 where the pattern has no such entry
  double by_differences = 0;
  /// |ours - by_differences| / max(1, |by_differences|, the largest entry of ours in the row).
  double relative_error = 0;
};

struct DerivativeReport {
  std::vector<DerivativeMismatch> disagreeing;
  std::vector<DerivativeMismatch> missing;  // nonzero where the pattern has no place
  double worst_error = 0;                   // the largest relative error of all entries

  [[nodiscard]] bool agrees() const { return disagreeing.empty() && missing.empty(); }
};

/// Compares the Jacobian at x with differences of the values, and the Hessian of w'f with
/// differences of J'w. An entry is wrong where its relative error is above `tolerance`, or where
/// one of both is not finite.
///
/// Differences are central, (f(x + h e_j) - f(x - h e_j)) / 2h for h halved from
/// 0.01 max(1, |x_j|), and extrapolated to h = 0 (Ridders 1982); of the extrapolations the one is
/// taken that differs least from its neighbours. Where f is smooth that is right to about 1e-10.
/// Next to a kink differences are no derivative. Empty weights are ones.
SWITCHYARD_EXPORT DerivativeReport CheckDerivatives(const Function& f, const Eigen::VectorXd& x,
                                                    Eigen::VectorXd weights = {},
                                                    double tolerance = 1e-6);

/// A line for each wrong entry, or that there is none.
SWITCHYARD_EXPORT std::string to_string(const DerivativeReport& report);

}  // namespace switchyard
