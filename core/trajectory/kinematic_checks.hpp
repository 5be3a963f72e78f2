// core/trajectory/kinematic_checks.hpp - what the arguments of trajectory optimization must be.
#pragma once

#include <string>

#include "switchyard/model/evaluator.hpp"
#include "switchyard/trajectory/bspline_basis.hpp"

namespace switchyard {

/// Throws InvalidArgument, in a sentence that begins with `call`, where v has another size or is
/// NaN somewhere.
inline void CheckVectorOfBounds(const std::string& call, const char* what, const VectorRef& v,
                                int size) {
  Require(v.size() == size, call, ": ", what, " needs ", size, size == 1 ? " entry" : " entries",
          ", one for each position, got ", v.size());
  for (int i = 0; i < size; ++i) {
    Require(v[i] == v[i], call, ": ", what, "[", i, "] needs to be a number, got ", v[i]);
  }
}

/// On the same knots, shifted and scaled to parameters from 0 to 1.
BsplineBasis<double> NormalizedBasis(const BsplineBasis<double>& basis);

}  // namespace switchyard
