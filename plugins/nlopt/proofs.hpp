// proofs.hpp - proofs that a program has no solution, from its linear part.
#pragma once

#include <optional>
#include <vector>

#include "least_squares.hpp"
#include "linear/duals.hpp"
#include "switchyard/abi.h"

namespace switchyard::nlopt {

/// A Farkas certificate of the rows and bounds, sought from x, where they do not hold.
std::optional<linear::Duals> SeekFarkas(const sy_problem& problem, const std::vector<double>& x,
                                        const Stop& stop);

/// A direction in which bounds and rows recede, Pd = 0 and q'd < 0, of a problem without an nlp.
std::optional<std::vector<double>> SeekRay(const sy_problem& problem, const Stop& stop);

}  // namespace switchyard::nlopt
