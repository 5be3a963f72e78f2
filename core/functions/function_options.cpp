#include "switchyard/functions/function_options.hpp"

#include "core/functions/pattern_index.hpp"
#include "switchyard/error.hpp"

namespace switchyard {

void FunctionOptions::Check(int num_vars, int num_outputs) const {
  if (jacobian) CheckPattern("Jacobian", *jacobian, num_outputs, num_vars);
  if (!hessian) return;
  CheckPattern("Hessian", *hessian, num_vars, num_vars);
  for (int k = 0; k < hessian->size(); ++k) {
    Require(hessian->row[k] <= hessian->col[k], "Hessian: the declared pattern is of the upper ",
            "triangle, and has row ", hessian->row[k], " and column ", hessian->col[k]);
  }
}

}  // namespace switchyard
