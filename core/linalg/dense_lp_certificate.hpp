// core/linalg/dense_lp_certificate.hpp - what proves an answer of a linear program, in plain
// arithmetic over the data as given.
#pragma once

#include "core/linalg/dense_lp.hpp"

namespace switchyard {

/// How much of a sum its terms' sizes may leave unexplained: a row a'x against a side b misses it
/// by less than this part of |b| + sum |a_j x_j|, likewise columns and the gap of the objectives.
inline constexpr double kDenseLpTolerance = 1e-9;

/// Is x feasible?
bool IsFeasible(const DenseLp& lp, const std::vector<double>& x);
/// Do x, row_dual and x_dual prove an optimum?
bool CertifiesOptimum(const DenseLp& lp, const DenseLpAnswer& answer);
/// Do row_dual and x_dual prove that no x is feasible? With A'y + z = r and each multiplier's side
/// s, no feasible x has r'x < sum of y s: the r here is rounding, the sum is above its own.
bool CertifiesInfeasibility(const DenseLp& lp, const DenseLpAnswer& answer);
/// Do x and ray prove that c'x has no lower bound?
bool CertifiesUnboundedness(const DenseLp& lp, const DenseLpAnswer& answer);

}  // namespace switchyard
