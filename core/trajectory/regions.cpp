#include "core/trajectory/regions.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "switchyard/sets/cartesian_product.hpp"
#include "switchyard/sets/geodesic_convexity.hpp"
#include "switchyard/sets/hyperrectangle.hpp"
#include "switchyard/sets/intersection.hpp"
#include "switchyard/sets/pairwise_intersections.hpp"
#include "switchyard/sets/point.hpp"

namespace switchyard {
namespace {

using Range = std::pair<double, double>;

/// {x : x + offset in the set}.
ConvexSetPointer MovedBack(const ConvexSet& set, const Eigen::VectorXd& offset) {
  if (offset.isZero(0)) return set;
  if (const auto point = set.MaybeGetPoint()) return Point(*point - offset);
  const auto n = offset.size();
  return CartesianProduct(MakeConvexSets(set), Eigen::MatrixXd::Identity(n, n), offset);
}

/// The points of a region that are in the subspace, of two sets that meet.
ConvexSetPointer Common(const ConvexSet& region, const ConvexSetPointer& subspace) {
  if (subspace->MaybeGetPoint()) return subspace;
  const auto* box = dynamic_cast<const Hyperrectangle*>(&region);
  const auto* other = dynamic_cast<const Hyperrectangle*>(&*subspace);
  if (box != nullptr && other != nullptr) {
    if (const auto both = box->MaybeGetIntersection(*other)) return *both;
  }
  return Intersection(region, *subspace);
}

void CheckPairs(const std::string& call, const RegionPairs& pairs, std::size_t from,
                std::size_t to) {
  const auto is_one_of = [](int k, std::size_t count) {
    return k >= 0 && static_cast<std::size_t>(k) < count;
  };
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto [i, j] = pairs[k];
    Require(is_one_of(i, from) && is_one_of(j, to), call, ": edge ", k, " is from region ", i,
            " of ", from, " to region ", j, " of ", to, "; regions count from 0");
  }
}

/// Multiples of 2 pi on the joints, 0 elsewhere.
void CheckOffsets(const std::string& call, const std::vector<Eigen::VectorXd>& offsets,
                  std::size_t count, int n, const std::vector<int>& joints) {
  constexpr double kRounding = 1e-9;
  Require(offsets.size() == count, call, " needs an offset for each of ", count, " edges, got ",
          offsets.size());
  for (std::size_t k = 0; k < count; ++k) {
    Require(offsets[k].size() == n, call, ": the offset of edge ", k, " needs ", n,
            " entries, got ", offsets[k].size());
    for (int i = 0; i < n; ++i) {
      const double rounds = offsets[k][i] / (2 * std::numbers::pi);
      const bool turns = std::find(joints.begin(), joints.end(), i) != joints.end();
      const bool fits =
          turns ? std::abs(rounds - std::round(rounds)) < kRounding : offsets[k][i] == 0;
      Require(fits, call, ": the offset of edge ", k, " needs ",
              turns ? "a multiple of 2 pi at the continuous revolute joint " : "a 0 at joint ", i,
              ", got ", offsets[k][i]);
    }
  }
}

std::vector<std::vector<Range>> RangesOf(const ConvexSets& sets, const std::vector<int>& joints) {
  std::vector<std::vector<Range>> ranges;
  for (const auto& set : sets) {
    ranges.push_back(GetMinimumAndMaximumValueAlongDimension(*set, joints));
  }
  return ranges;
}

std::vector<Eigen::VectorXd> OffsetsByRanges(const ConvexSets& from, const ConvexSets& to,
                                             const RegionPairs& pairs,
                                             const std::vector<int>& joints) {
  const int n = from.front()->ambient_dimension();
  std::vector<Eigen::VectorXd> offsets(pairs.size(), Eigen::VectorXd::Zero(n));
  if (joints.empty()) return offsets;
  const auto of_from = RangesOf(from, joints), of_to = RangesOf(to, joints);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    offsets[k] = ComputeOffsetContinuousRevoluteJoints(
        n, joints, of_from[static_cast<std::size_t>(pairs[k].first)],
        of_to[static_cast<std::size_t>(pairs[k].second)]);
  }
  return offsets;
}

Connections Given(const std::string& call, const ConvexSets& from, const ConvexSets& to,
                  const std::vector<int>& joints, const ConnectionWish& wish) {
  CheckPairs(call, *wish.pairs, from.size(), to.size());
  if (wish.offsets == nullptr) {
    return {*wish.pairs, OffsetsByRanges(from, to, *wish.pairs, joints), {}};
  }
  CheckOffsets(call, *wish.offsets, wish.pairs->size(), from.front()->ambient_dimension(), joints);
  return {*wish.pairs, *wish.offsets, {}};
}

/// The parts of some regions that are in a subspace.
struct Parts {
  std::vector<int> part_of;  // by region; -1: it misses the subspace
  std::vector<int> region;   // by part
  std::vector<Eigen::VectorXd> offset;
  ConvexSets sets;
};

Parts PartsIn(const ConvexSet& subspace, const ConvexSets& regions,
              const std::vector<int>& joints) {
  Parts parts;
  parts.part_of.assign(regions.size(), -1);
  const auto [pairs, offsets] =
      ComputePairwiseIntersections(regions, MakeConvexSets(subspace), joints);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto i = static_cast<std::size_t>(pairs[k].first);
    parts.part_of[i] = static_cast<int>(k);
    parts.region.push_back(pairs[k].first);
    parts.offset.push_back(offsets[k]);
    parts.sets.push_back(Common(*regions[i], MovedBack(subspace, offsets[k])));
  }
  return parts;
}

/// Those of `all` where the part of the first region meets the second.
Connections ThroughSubspace(const Connections& all, const Parts& parts, const ConvexSets& to) {
  Connections kept;
  for (std::size_t k = 0; k < all.pairs.size(); ++k) {
    const auto [i, j] = all.pairs[k];
    const int part = parts.part_of[static_cast<std::size_t>(i)];
    if (part < 0) continue;
    const auto p = static_cast<std::size_t>(part);
    const ConvexSets target = {MovedBack(*to[static_cast<std::size_t>(j)], all.offsets[k])};
    if (ComputePairwiseIntersections({parts.sets[p]}, target, {}).first.empty()) continue;
    kept.pairs.push_back(all.pairs[k]);
    kept.offsets.push_back(all.offsets[k]);
    kept.to_subspace.push_back(parts.offset[p]);
  }
  return kept;
}

Connections ThatMeet(const ConvexSets& from, const ConvexSets& to, bool same,
                     const std::vector<int>& joints) {
  auto [pairs, offsets] = same ? ComputePairwiseIntersections(from, joints)
                               : ComputePairwiseIntersections(from, to, joints);
  return {std::move(pairs), std::move(offsets), {}};
}

/// A part is in its region, both narrower than pi along joints: where it meets the other region, it
/// does by the offset by which its region does.
Connections ThatMeetIn(const Parts& parts, const ConvexSets& to, bool same,
                       const std::vector<int>& joints) {
  const auto [pairs, offsets] = ComputePairwiseIntersections(parts.sets, to, joints);
  Connections found;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto part = static_cast<std::size_t>(pairs[k].first);
    if (same && parts.region[part] == pairs[k].second) continue;
    found.pairs.emplace_back(parts.region[part], pairs[k].second);
    found.offsets.push_back(offsets[k]);
    found.to_subspace.push_back(parts.offset[part]);
  }
  return found;
}

}  // namespace

std::shared_ptr<const ConvexSet> SegmentSet(const ConvexSetPointer& region,
                                            const SegmentShape& shape) {
  const auto* box = dynamic_cast<const Hyperrectangle*>(&*region);
  const auto* point = dynamic_cast<const Point*>(&*region);
  if (box != nullptr || point != nullptr) {
    Eigen::VectorXd lower(shape.size()), upper(shape.size());
    lower << (box != nullptr ? box->lb() : point->x()).replicate(shape.order + 1, 1), shape.h_min;
    upper << (box != nullptr ? box->ub() : point->x()).replicate(shape.order + 1, 1), shape.h_max;
    return std::make_shared<Hyperrectangle>(lower, upper);
  }
  ConvexSets factors(static_cast<std::size_t>(shape.order) + 1, region);
  factors.push_back(Hyperrectangle(Eigen::VectorXd::Constant(1, shape.h_min),
                                   Eigen::VectorXd::Constant(1, shape.h_max)));
  return std::make_shared<CartesianProduct>(std::move(factors));
}

void CheckRegions(const std::string& call, const ConvexSets& regions, int num_positions,
                  const std::vector<int>& joints) {
  Require(!regions.empty(), call, " needs a region or more, got none");
  for (std::size_t k = 0; k < regions.size(); ++k) {
    const ConvexSet& region = *regions[k];
    Require(region.ambient_dimension() == num_positions, call, ": region ", k, ", a ",
            region.Kind(), ", needs to be in R^", num_positions, ", got one in R^",
            region.ambient_dimension());
    Require(!region.bounding_box().empty, call, ": region ", k, ", a ", region.Kind(),
            ", has no point");
    for (const int joint : joints) {
      const auto [low, high] = GetMinimumAndMaximumValueAlongDimension(region, joint);
      Require(high - low < std::numbers::pi, call, ": region ", k, ", a ", region.Kind(), ", is ",
              high - low, " wide along the continuous revolute joint ", joint,
              ": it must be narrower than pi, see PartitionConvexSet");
    }
  }
}

Connections Connect(const std::string& call, const ConvexSets& from, const ConvexSets& to,
                    bool same, const std::vector<int>& joints, const ConnectionWish& wish) {
  Require(wish.offsets == nullptr || wish.pairs != nullptr, call,
          " needs the edges to which its offsets belong");
  const int n = from.front()->ambient_dimension();
  if (wish.subspace == nullptr) {
    return wish.pairs != nullptr ? Given(call, from, to, joints, wish)
                                 : ThatMeet(from, to, same, joints);
  }
  Require(wish.subspace->ambient_dimension() == n, call, ": the subspace, a ",
          wish.subspace->Kind(), ", needs to be in R^", n, ", got one in R^",
          wish.subspace->ambient_dimension());
  const Parts parts = PartsIn(*wish.subspace, from, joints);
  if (wish.pairs != nullptr) {
    return ThroughSubspace(Given(call, from, to, joints, wish), parts, to);
  }
  return ThatMeetIn(parts, to, same, joints);
}

}  // namespace switchyard
