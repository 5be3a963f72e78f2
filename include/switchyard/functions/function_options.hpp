// switchyard/functions/function_options.hpp - what a caller may say of a function of his own.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "switchyard/export.hpp"
#include "switchyard/functions/function.hpp"

namespace switchyard {

struct FunctionOptions {
  /// Calls may come from several threads at once. A function that keeps notes says false.
  bool is_thread_safe = true;
  /// Where entries can be. Needed for sparsity where a function brings its own derivatives or
  /// decides by values; then the default is every place.
  std::optional<SparsityPattern> jacobian = {};
  std::optional<SparsityPattern> hessian = {};  // its upper triangle
  /// The point where the function is looked at first, for its number of outputs and its operations.
  /// By default one with all entries different and in (0.5, 1), which most domains hold; where the
  /// function throws there, 0.
  std::optional<Eigen::VectorXd> probe = {};

  /// Throws InvalidArgument for what does not fit a function R^num_vars -> R^num_outputs.
  SWITCHYARD_EXPORT void Check(int num_vars, int num_outputs) const;
};

}  // namespace switchyard
