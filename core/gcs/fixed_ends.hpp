// core/gcs/fixed_ends.hpp - coordinates of an edge's end points that its rows leave but one value.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/gcs/term_block.hpp"
#include "switchyard/sets/convex_set.hpp"

namespace switchyard {

/// Some rows over the places of an edge: those of a block whose place k, from 1 on, is `first` + k
/// - 1 of (x_u, x_v, slacks).
struct PlacedBlock {
  const TermBlock* block;
  std::int32_t first;
};

/// Propagates boxes over the rows at scale 1, a few rounds: what ends with no width is fixed, as
/// the touching faces of two sets that an edge's ends must share are. A singleton is not a matter
/// of tolerance: no more than rounding is forgiven, so the rows still hold what they held. None
/// where the rows leave a coordinate nothing.
std::vector<FixedCoordinate> FixedEnds(const SetBox& u, const SetBox& v,
                                       std::span<const PlacedBlock> blocks);

}  // namespace switchyard
