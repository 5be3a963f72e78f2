// core/symbolic/terms.hpp - adding up linear terms of the same variable.
#pragma once

#include <vector>

#include "switchyard/symbolic/expression.hpp"

namespace switchyard {

/// Each variable once, where it first stands; those whose coefficients add up to 0 are left out.
std::vector<Expression::LinearTerm> Merged(std::vector<Expression::LinearTerm> terms);

}  // namespace switchyard
