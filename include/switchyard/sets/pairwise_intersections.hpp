// switchyard/sets/pairwise_intersections.hpp - which sets of a collection meet.
#pragma once

#include <utility>
#include <vector>

#include "switchyard/model/parallelism.hpp"
#include "switchyard/sets/convex_set.hpp"
#include "switchyard/sets/hyperrectangle.hpp"

namespace switchyard {

/// The pairs (i, j), ascending, for which set i moved by the offset tau meets set j, and the tau of
/// each pair, in R^n: x + tau is a point of set j for some point x of set i. tau is a multiple of
/// 2 pi along continuous revolute joints, as ComputeOffsetContinuousRevoluteJoints has it, and 0
/// elsewhere.
using PairwiseIntersections =
    std::pair<std::vector<std::pair<int, int>>, std::vector<Eigen::VectorXd>>;

/// Sets of A that meet sets of B. Sets that miss each other by no more than 1e-9, relative to their
/// coordinates, meet; where a backend decides, by no more than its accuracy.
///
/// Along the joints each set must be narrower than pi. `preprocess_bbox`: pairs whose bounding
/// boxes are apart are left out first, by a sweep along the axis with the fewest overlaps; without,
/// all are looked at. The answer is the same, for any number of threads. Points, boxes and balls
/// are compared in closed form, polyhedra by small linear programs, the rest by IntersectsWith.
///
/// Throws InvalidArgument where dimensions differ, the list of joints is not valid, or a set is not
/// narrower than pi along a joint; std::runtime_error where no backend could tell.
SWITCHYARD_EXPORT PairwiseIntersections ComputePairwiseIntersections(
    const ConvexSets& convex_sets_A, const ConvexSets& convex_sets_B,
    const std::vector<int>& continuous_revolute_joints, bool preprocess_bbox = true,
    Parallelism parallelism = Parallelism::Max());
/// The same with boxes that are known to contain the sets, one for each.
SWITCHYARD_EXPORT PairwiseIntersections ComputePairwiseIntersections(
    const ConvexSets& convex_sets_A, const ConvexSets& convex_sets_B,
    const std::vector<int>& continuous_revolute_joints, const std::vector<Hyperrectangle>& bboxes_A,
    const std::vector<Hyperrectangle>& bboxes_B, Parallelism parallelism = Parallelism::Max());

/// Within one collection: with each pair (i, j) also (j, i), whose tau is the opposite; no (i, i).
SWITCHYARD_EXPORT PairwiseIntersections ComputePairwiseIntersections(
    const ConvexSets& convex_sets, const std::vector<int>& continuous_revolute_joints,
    bool preprocess_bbox = true, Parallelism parallelism = Parallelism::Max());
SWITCHYARD_EXPORT PairwiseIntersections ComputePairwiseIntersections(
    const ConvexSets& convex_sets, const std::vector<int>& continuous_revolute_joints,
    const std::vector<Hyperrectangle>& bboxes, Parallelism parallelism = Parallelism::Max());

}  // namespace switchyard
