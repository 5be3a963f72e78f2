// core/symbolic/quadratic.hpp - which nonlinear terms have a quadratic form.
#pragma once

#include "core/symbolic/node.hpp"

namespace switchyard {

/// A product of two affine expressions, or the square of one?
bool HasQuadraticForm(const ExpressionNode& node);
bool IsSquareOfAffine(const ExpressionNode& node);

}  // namespace switchyard
