// tools/switchyard/outline.hpp - the shadow of a convex set on the plane of its first two
// coordinates.
#pragma once

#include <optional>
#include <vector>

#include "switchyard/sets/convex_set.hpp"

namespace switchyard::cli {

/// A rectangle with sides along the axes; empty before the first point is added.
struct Frame {
  Eigen::Vector2d lower = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector2d upper = -lower;

  void Add(const Eigen::Vector2d& p) {
    lower = lower.cwiseMin(p);
    upper = upper.cwiseMax(p);
  }
  [[nodiscard]] bool empty() const { return !(lower.array() <= upper.array()).all(); }
  [[nodiscard]] Eigen::Vector2d Center() const { return 0.5 * (lower + upper); }
};

/// {center + R(angle) (a cos t, b sin t)}, the angle in degrees, counterclockwise.
struct Ellipse {
  Eigen::Vector2d center;
  Eigen::Vector2d radii;
  double angle;
};

struct Outline {
  std::vector<Eigen::Vector2d> corners;  // of a convex polygon, counterclockwise; one: a point
  std::optional<Ellipse> ellipse;        // instead of corners
  bool exact = true;                     // false: a box that the shadow is in

  [[nodiscard]] Eigen::Vector2d Center() const;
};

/// The coordinates that are drawn of a point: the first two, 0 for those that it has not.
Eigen::Vector2d Shadow(const Eigen::VectorXd& x);

/// The range of the shadow, as far as it is finite.
Frame FrameOf(const ConvexSet& set);

/// The shadow within `frame`, which is finite. In the plane it is exact: a set that is not an
/// ellipse is its bounding box, cut by its rows and by tangents of its second-order cones until no
/// corner is outside by more than what a picture shows. An ellipsoid's is an ellipse, a box's or a
/// point's a box, in any dimension; else it is the bounding box. Without corners: the set is empty.
Outline OutlineOf(const ConvexSet& set, const Frame& frame);

}  // namespace switchyard::cli
