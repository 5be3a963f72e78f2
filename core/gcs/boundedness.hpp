// core/gcs/boundedness.hpp - vertices at which a flow of 0 leaves their point free.
#pragma once

#include <vector>

#include "core/gcs/pruning.hpp"
#include "core/gcs/term_block.hpp"

namespace switchyard {

/// The vertices with edges whose set, cut by their constraints, is not known to be bounded.
std::vector<const GraphOfConvexSets::Vertex*> UnboundedVertices(const PrunedGraph& graph,
                                                                TermBlocks& blocks);

}  // namespace switchyard
