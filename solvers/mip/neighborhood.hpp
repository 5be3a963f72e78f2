// solvers/mip/neighborhood.hpp - better points where a good one and a relaxed one agree.
#pragma once

#include <vector>

#include "solvers/mip/incumbents.hpp"
#include "solvers/mip/instance.hpp"
#include "solvers/rounding/budget.hpp"

namespace switchyard::mip {

/// Integers that the relaxed point has at the best point's values stay there; the rest is solved by
/// branch and bound with few nodes, for points below `cutoff`. What is found has been verified in
/// the whole problem. Nothing where few or all integers would stay. (Danna, Rothberg and Le Pape,
/// Exploring relaxation induced neighborhoods, 2005.)
std::vector<Solution> SearchNear(const Instance& instance, const std::vector<double>& relaxed,
                                 const std::vector<double>& best, double cutoff,
                                 rounding::Budget& budget);

}  // namespace switchyard::mip
