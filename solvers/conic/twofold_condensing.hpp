// solvers/conic/twofold_condensing.hpp - between a step's equations and the condensed ones, with
// numbers of twice the digits: what is condensed weighs up to 1 / r, by which rounding errors would
// grow.
#pragma once

#include "solvers/conic/kkt.hpp"

namespace switchyard::conic {

/// `workers`, if any, share the rows and columns.
/// condensed = (a + G'(H + r)^-1 c, b, 0), of the variables, equations and whatever is kept.
void CondenseTwofold(const Form& form, const KktWeights& weights, const Triple& right,
                     std::size_t kept, linalg::Workers* workers,
                     const linalg::NumbersOf<double>& condensed);

/// dx and dy from the solution, and dz = (H + r)^-1 (c - G dx).
void ExpandTwofold(const Form& form, const KktWeights& weights, const Triple& right,
                   const linalg::Numbers& solution, linalg::Workers* workers, KktStep& step);

}  // namespace switchyard::conic
