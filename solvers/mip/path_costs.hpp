// solvers/mip/path_costs.hpp - reduced costs along whole paths.
#pragma once

#include <vector>

#include "solvers/mip/node_bound.hpp"
#include "solvers/rounding/path_problem.hpp"

namespace switchyard::mip {

/// What points with an objective of at most `cutoff` keep to, in [lower, upper], for which the
/// bound is: arcs that they cannot use are closed. With w the slopes of the flows, where positive,
/// a point with the path P costs at least value + sum_{a in P} w_a, as each of its arcs has the
/// flow 1 and the other slopes add what is not negative; and a path through a from u to v has at
/// least d(source, u) + w_a + d(v, target), d the shortest distances in w along open arcs.
/// Potentials that were shared out badly among a path's arcs cancel in this sum, as they do not in
/// one arc's.
std::vector<VariableBox> ByPathCosts(const rounding::PathProblem& paths, const NodeBound& bound,
                                     double cutoff, const std::vector<double>& lower,
                                     const std::vector<double>& upper);

}  // namespace switchyard::mip
