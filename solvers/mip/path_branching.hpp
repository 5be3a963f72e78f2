// solvers/mip/path_branching.hpp - a path problem's nodes: which arcs are open, and how those that
// leave a vertex are split.
#pragma once

#include <optional>
#include <vector>

#include "solvers/mip/branching.hpp"
#include "solvers/mip/node_boxes.hpp"
#include "solvers/rounding/path_problem.hpp"

namespace switchyard::mip {

/// The arcs that leave a vertex, or enter it, in two parts of about the same flow: one part or the
/// other is closed in each child. Every simple path uses at most one of them, so it is in one of
/// the children; paths that avoid the vertex are in both. The vertex with the most flow through it,
/// and that the most evenly divided. Nothing where the flow is along one path.
std::optional<Split> SplitOfArcs(const rounding::PathProblem& paths, const NodeBoxes& boxes,
                                 const std::vector<double>& x);

/// Closes arcs that are on no simple path from source to target along open ones. False: no path is
/// left.
bool PropagatePaths(const rounding::PathProblem& paths, NodeBoxes& boxes);

}  // namespace switchyard::mip
