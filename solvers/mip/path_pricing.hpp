// solvers/mip/path_pricing.hpp - what the blocks of arcs cost at given prices of what couples them.
#pragma once

#include "solvers/mip/node_boxes.hpp"
#include "solvers/rounding/budget.hpp"
#include "solvers/rounding/exact_duals.hpp"
#include "solvers/rounding/path_problem.hpp"
#include "switchyard/abi.h"

namespace switchyard::mip {

/// An interior point method leaves a closed arc's own rows duals from the middle of all that are
/// optimal; its reduced cost is largest at others. At duals y, s of the coupling rows and cones,
/// the largest is the least of (q - A'y - F's)_b'x_b over the block's rows and cones at scale 1,
/// and the duals of that minimum are the block's. All blocks of open arcs are priced as one
/// problem, which falls apart, by the backend of the relaxations: it costs about as much as one of
/// these.
///
/// The duals, those of open blocks replaced. Any duals give a bound, so nothing is believed; as
/// they came where the backend has no optimum. A budget that ends ends this, too.
rounding::Duals WithPricedBlocks(const rounding::PathProblem& paths, rounding::Duals duals,
                                 const NodeBoxes& boxes, const sy_solver& solver,
                                 const sy_host& host, rounding::Budget& budget);

}  // namespace switchyard::mip
