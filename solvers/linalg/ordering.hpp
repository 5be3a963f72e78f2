// solvers/linalg/ordering.hpp - in which order to eliminate, so that little fills in.
#pragma once

#include <vector>

#include "solvers/linalg/symmetric_pattern.hpp"

namespace switchyard::linalg {

/// By approximate minimum degree (Amestoy, Davis and Duff, SIAM J. Matrix Anal. Appl. 17, 1996):
/// order[k] is the k-th to go.
std::vector<Index> MinimumDegreeOrder(const SymmetricPattern& pattern);

/// By nested dissection (Karypis and Kumar, SIAM J. Sci. Comput. 20, 1998); the same on every run.
/// Empty where there is none to be had.
std::vector<Index> NestedDissectionOrder(const SymmetricPattern& pattern);

/// The order in which each column of group 1 waits for its neighbours of group 0, and goes when the
/// last of them has gone.
std::vector<Index> Delayed(const SymmetricPattern& pattern, const std::vector<Index>& group,
                           const std::vector<Index>& order);

}  // namespace switchyard::linalg
