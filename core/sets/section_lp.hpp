// core/sets/section_lp.hpp - linear programs over a set without cones, answered here.
#pragma once

#include <optional>

#include "core/linalg/dense_lp.hpp"
#include "switchyard/sets/convex_set.hpp"

namespace switchyard {

/// Is it by rows alone, and of a size for dense algebra? Larger ones are a backend's.
bool IsSmallPolyhedron(const ScaledSet& set);

/// The rows of a set at t = 1 over (x - origin, w), free; the objective is 0.
DenseLp SectionLp(const ScaledSet& set, const Eigen::VectorXd& origin);

/// sup direction'x over the set: infinity where unbounded, -infinity where empty; none where
/// rounding leaves it undecided.
std::optional<double> SupportByLp(const ScaledSet& set, const Eigen::VectorXd& direction);
/// The same over a RecessionCone, within |x_i| <= 1.
std::optional<double> RecessionByLp(const ScaledSet& cone, const Eigen::VectorXd& direction);

/// min |y - x|_inf over points y of the set, likewise; infinity where it is empty.
std::optional<double> DistanceByLp(const ScaledSet& set, const Eigen::VectorXd& x);

/// Some point of the set, likewise.
struct PointByLp {
  bool decided = false;
  std::optional<Eigen::VectorXd> point;
};
PointByLp FeasiblePointByLp(const ScaledSet& set);

}  // namespace switchyard
