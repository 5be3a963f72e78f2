// core/trajectory/regions.hpp - the set of a region's segment, and which regions an edge joins.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/trajectory/segment_terms.hpp"

namespace switchyard {

using RegionPairs = std::vector<std::pair<int, int>>;

/// region^{order+1} x [h_min, h_max], as leanly as a program can say it: a box where the region is
/// a box or a point, else a product, whose box is its factors'.
std::shared_ptr<const ConvexSet> SegmentSet(const ConvexSetPointer& region,
                                            const SegmentShape& shape);

/// Throws InvalidArgument, in a sentence that begins with `call`, where there is no region, or one
/// is empty, has another dimension, or is not narrower than pi along a joint.
void CheckRegions(const std::string& call, const ConvexSets& regions, int num_positions,
                  const std::vector<int>& joints);

/// Edges to be: pairs of regions; of each tau, and where there is a subspace sigma: the last point
/// of the first segment plus tau is the first of the second, and plus sigma in the subspace.
struct Connections {
  RegionPairs pairs;
  std::vector<Eigen::VectorXd> offsets;
  std::vector<Eigen::VectorXd> to_subspace;  // none without a subspace
};

/// What a caller may say of them.
struct ConnectionWish {
  const ConvexSet* subspace = nullptr;
  const RegionPairs* pairs = nullptr;                     // nullptr: those that meet
  const std::vector<Eigen::VectorXd>* offsets = nullptr;  // of these pairs; nullptr: by ranges
};
/// Throws InvalidArgument, in a sentence that begins with `call`, for pairs and offsets that do not
/// fit. `same`: the two collections are one, and no region goes to itself.
Connections Connect(const std::string& call, const ConvexSets& from, const ConvexSets& to,
                    bool same, const std::vector<int>& joints, const ConnectionWish& wish);

}  // namespace switchyard
