// switchyard/functions/evaluation_counts.hpp - how often functions were evaluated.
#pragma once

#include <cstdint>

namespace switchyard {

/// Of all functions of a program together, during one solve; answers from a cache are not counted.
struct EvaluationCounts {
  std::int64_t objective = 0;
  std::int64_t gradient = 0;
  std::int64_t constraints = 0;
  std::int64_t jacobian = 0;
  std::int64_t hessian = 0;
};

}  // namespace switchyard
