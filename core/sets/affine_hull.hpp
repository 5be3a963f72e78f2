// core/sets/affine_hull.hpp - the smallest affine subspace that holds a set.
#pragma once

#include "switchyard/sets/convex_set.hpp"

namespace switchyard {

inline constexpr double kAffineHullTolerance = 1e-6;

struct AffineHull {
  Eigen::VectorXd point;
  Eigen::MatrixXd basis;  // orthonormal columns
};

/// Throws InvalidArgument for a set without points; `tol` as in AffineSubspace.
AffineHull AffineHullOf(const ConvexSet& set, double tol);

}  // namespace switchyard
