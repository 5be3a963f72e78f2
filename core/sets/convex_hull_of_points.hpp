// core/sets/convex_hull_of_points.hpp - facets, vertices and volume of the hull of points that span
// their space.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace switchyard {

struct HullOfPoints {
  Eigen::MatrixXd normals;   // a row for each facet, of length 1, outward
  Eigen::VectorXd offsets;   // normals x <= offsets, at every point and by the tightest
  std::vector<int> extreme;  // which points are vertices, ascending
  double volume = 0;
};

/// Of the columns of `points` in R^n, n >= 1, that lie in no hyperplane. Thread-safe. Throws
/// InvalidArgument, with Qhull's own words, where they are flat to rounding.
HullOfPoints ConvexHullOfPoints(const Eigen::MatrixXd& points);

}  // namespace switchyard
