// core/sets/polytope_conversions.hpp - from vertices to halfspaces and back.
#pragma once

#include <optional>

#include "switchyard/sets/hpolyhedron.hpp"

namespace switchyard {

/// {x : Ax <= b}, rows of length 1.
struct Halfspaces {
  Eigen::MatrixXd A;
  Eigen::VectorXd b;
};

/// The rows of a polyhedron, without those that hold everywhere; 0 <= b with b < 0 stays as it is.
Halfspaces NormalizedRows(const HPolyhedron& polyhedron);

/// Of the hull of the columns; where it is flat, its affine hull as pairs of rows and its facets in
/// there. Flat: along an axis of the points' ellipsoid of inertia that is `tol` of the longest.
/// `points` has a column or more.
Halfspaces HalfspacesOf(const Eigen::MatrixXd& points, double tol);

/// The columns that are extreme in their hull, each point once.
Eigen::MatrixXd ExtremePointsOf(const Eigen::MatrixXd& points, double tol);

/// 0 where it is flat.
double VolumeOfHull(const Eigen::MatrixXd& points, double tol);

/// The vertices of a polyhedron as columns; none where it is empty. Throws InvalidArgument where it
/// is not bounded.
Eigen::MatrixXd VerticesOf(const HPolyhedron& polyhedron, double tol);

/// max radius : a_i'center + |a_i| radius <= b_i. Infinite where there are balls of every size;
/// negative where there is no point, and all rows would have to move out by as much.
struct InnerBall {
  Eigen::VectorXd center;
  double radius = 0;
  Eigen::VectorXd multipliers;  // of the rows, >= 0, where the radius is finite
};
/// None where a row is 0 <= b with b < 0. Throws std::runtime_error where it could not be told.
std::optional<InnerBall> LargestInnerBall(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

}  // namespace switchyard
