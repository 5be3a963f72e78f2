// core/model/quadratic_cone.hpp - a convex quadratic constraint as a rotated Lorentz cone.
#pragma once

#include "switchyard/model/evaluator.hpp"

namespace switchyard {

/// z = Ax + b with z_0 z_1 >= z_2^2 + ...
struct RotatedCone {
  SparseMatrix A;
  Eigen::VectorXd b;
};

/// 1/2 x'Qx + b'x <= upper with Q = S'S: z = (1, upper - b'x, S x / sqrt 2). Throws InvalidArgument
/// with a negative eigenvalue of Q where it is not positive semidefinite.
RotatedCone RotatedConeOf(const SparseMatrix& Q, const Eigen::VectorXd& b, double upper);

}  // namespace switchyard
