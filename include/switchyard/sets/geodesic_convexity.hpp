// switchyard/sets/geodesic_convexity.hpp - sets of configurations with continuous revolute joints.
//
// Coordinates that are angles of joints without limits are the same modulo 2 pi. A set narrower
// than pi along each of them is geodesically convex: its segments are shortest ways.
#pragma once

#include <utility>
#include <vector>

#include "switchyard/sets/convex_set.hpp"

namespace switchyard {

/// The least and the largest value of coordinate `dimension` over the set. Throws InvalidArgument
/// where there is no such coordinate, the set is empty, or it is unbounded along it.
SWITCHYARD_EXPORT std::pair<double, double> GetMinimumAndMaximumValueAlongDimension(
    const ConvexSet& region, int dimension);
SWITCHYARD_EXPORT std::vector<std::pair<double, double>> GetMinimumAndMaximumValueAlongDimension(
    const ConvexSet& region, const std::vector<int>& dimensions);

/// Throws InvalidArgument where an index is not in [0, num_positions) or stands twice.
SWITCHYARD_EXPORT void ThrowsForInvalidContinuousJointsList(
    int num_positions, const std::vector<int>& continuous_revolute_joints);

/// The offset tau in R^num_positions, multiples of 2 pi along the joints and 0 elsewhere, that
/// takes a set with ranges `continuous_bbox_A` along the joints next to one with
/// `continuous_bbox_B`: tau = 2 pi floor((ub_B - lb_A + 1e-9) / 2 pi), the largest for which A +
/// tau does not begin above B's end. Radians, one range for each joint, in the order of the list.
/// Throws InvalidArgument where the list is not valid, sizes differ, or a range is not finite.
SWITCHYARD_EXPORT Eigen::VectorXd ComputeOffsetContinuousRevoluteJoints(
    int num_positions, const std::vector<int>& continuous_revolute_joints,
    const std::vector<std::pair<double, double>>& continuous_bbox_A,
    const std::vector<std::pair<double, double>>& continuous_bbox_B);

/// Is the set narrower than pi along each of the joints? Throws as
/// GetMinimumAndMaximumValueAlongDimension does.
SWITCHYARD_EXPORT bool CheckIfSatisfiesConvexityRadius(
    const ConvexSet& convex_set, const std::vector<int>& continuous_revolute_joints);

/// Sets whose union is `convex_set`, each at most pi - epsilon wide along the joints: the set
/// itself where it is, else its intersections with boxes that overlap by epsilon radians; those
/// without points are left out. Throws InvalidArgument where epsilon is not in (0, pi / 2), or the
/// set is unbounded along a joint.
SWITCHYARD_EXPORT ConvexSets PartitionConvexSet(const ConvexSet& convex_set,
                                                const std::vector<int>& continuous_revolute_joints,
                                                double epsilon = 1e-5);
/// The parts of each set, in their order.
SWITCHYARD_EXPORT ConvexSets PartitionConvexSet(const ConvexSets& convex_sets,
                                                const std::vector<int>& continuous_revolute_joints,
                                                double epsilon = 1e-5);

}  // namespace switchyard
