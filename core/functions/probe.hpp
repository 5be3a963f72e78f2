// core/functions/probe.hpp - the point where a caller's function is looked at first.
#pragma once

#include <Eigen/Core>
#include <exception>

#include "switchyard/functions/function_options.hpp"

namespace switchyard {

/// Entries in (0.5, 1), no two equal.
Eigen::VectorXd GenericPoint(int num_vars);

/// Throws InvalidArgument for a number of variables below 0 or a probe of another length.
void CheckProbe(int num_vars, const FunctionOptions& options);

/// What `look` gives at the probe of the options; where there is none, at a generic point or, if it
/// throws there, at 0. What it throws at both is what it threw first.
template <class Look>
auto AtProbe(int num_vars, const FunctionOptions& options, Look&& look) {
  CheckProbe(num_vars, options);
  if (options.probe) return look(*options.probe);
  std::exception_ptr thrown;
  try {
    return look(GenericPoint(num_vars));
  } catch (...) {
    thrown = std::current_exception();
  }
  try {
    return look(Eigen::VectorXd(Eigen::VectorXd::Zero(num_vars)));
  } catch (...) {
    std::rethrow_exception(thrown);
  }
}

}  // namespace switchyard
