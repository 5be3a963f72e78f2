// solvers/mip/implied_integers.hpp - continuous variables that are integers whenever the integers
// are.
#pragma once

#include <cstdint>
#include <vector>

#include "switchyard/abi.h"

namespace switchyard::mip {

/// x_variable is an integer at every feasible point, as the equality `row` shows.
struct ImpliedInteger {
  std::int32_t variable;
  std::int32_t row;
};

/// Variables that rows show to be integers, each by integers of the problem, by variables that
/// stand earlier in the list, and by ones fixed to an integer; in time linear in the nonzeros.
///
/// A row a_j x_j + sum_k a_k x_k = b gives x_j = b/a_j - sum_k (a_k/a_j) x_k. Where b/a_j and every
/// a_k/a_j are integers and all x_k are, so is x_j. That a quotient of two doubles is an integer is
/// known exactly: their fmod, which is never rounded, is 0.
std::vector<ImpliedInteger> ImpliedIntegers(const sy_problem& problem);

/// The variables of the list, ascending.
std::vector<std::int32_t> VariablesOf(const std::vector<ImpliedInteger>& implied);

}  // namespace switchyard::mip
