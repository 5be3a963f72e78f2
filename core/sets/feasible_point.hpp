// core/sets/feasible_point.hpp - some point of a set.
#pragma once

#include "switchyard/sets/convex_set.hpp"

namespace switchyard {

/// None where the set is proven empty. Throws std::runtime_error where no backend could tell.
std::optional<Eigen::VectorXd> FeasiblePoint(const ConvexSet& set);

}  // namespace switchyard
