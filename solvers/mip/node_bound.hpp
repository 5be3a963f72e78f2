// solvers/mip/node_bound.hpp - what duals of any quality prove of the points in a box.
#pragma once

#include <vector>

#include "solvers/mip/node_boxes.hpp"
#include "solvers/rounding/exact_duals.hpp"
#include "switchyard/abi.h"
#include "switchyard/problem.hpp"

namespace switchyard::mip {

struct NodeBound {
  /// No point of the box has a smaller objective; -infinity: nothing is proven.
  double value = -kInfinity;
  /// Of each variable, a number of the sign of its reduced cost and not above it in size: the
  /// objective is at least value + slope (x - lower) for slope > 0, value + slope (x - upper) for
  /// slope < 0. Empty where nothing is proven.
  std::vector<double> slope;
};

/// The bound of safe_bound.hpp over [lower, upper], for a linear objective, with the duals changed
/// by MakeExact first, and where that leaves columns open by CloseColumns and ProjectColumns.
NodeBound BoundFrom(const sy_problem& problem, rounding::Duals duals,
                    const std::vector<double>& lower, const std::vector<double>& upper);

/// Is the box proven to hold no feasible point: is the bound of the objective 0 above 0?
bool ProvesEmpty(const sy_problem& problem, rounding::Duals duals, const std::vector<double>& lower,
                 const std::vector<double>& upper);

/// Ends that points with an objective of at most `cutoff` keep to, by their slopes: only those that
/// are narrower by a share that matters (an integer's: by one).
std::vector<VariableBox> ByReducedCosts(const sy_problem& problem, const NodeBound& bound,
                                        double cutoff, const std::vector<double>& lower,
                                        const std::vector<double>& upper);

}  // namespace switchyard::mip
