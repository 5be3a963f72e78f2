// core/sets/cone_constraint_of.hpp - a cone of the ABI as the constraint that users know.
#pragma once

#include <memory>

#include "switchyard/model/constraint.hpp"

namespace switchyard {

/// s = Ax + b in the cone, s in the ABI's coordinates.
std::shared_ptr<Constraint> ConeConstraintOf(const sy_cone& cone, const SparseMatrix& A,
                                             const VectorRef& b);

}  // namespace switchyard
