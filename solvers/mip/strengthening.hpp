// solvers/mip/strengthening.hpp - a problem with the same integer points, and a tighter relaxation.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "solvers/mip/options.hpp"
#include "solvers/rounding/budget.hpp"
#include "solvers/rounding/integer_problem.hpp"
#include "switchyard/abi.h"
#include "switchyard/hints.h"
#include "switchyard/problem.hpp"

namespace switchyard::mip {

struct Strengthened {
  Problem problem;
  std::vector<sy_hint> hints;  // of the problem: those that speak of variables alone
  std::int32_t perspectives = 0, cuts = 0;
};

/// The problem with perspectives (perspectives.hpp), then with rows (integer_cuts.hpp,
/// mir_cuts.hpp) that its relaxation violates, in rounds. Nothing where there are neither. What is
/// proven of it is proven of the whole.
std::optional<Strengthened> Strengthen(const rounding::IntegerProblem& whole,
                                       const Options& options, const sy_host& host,
                                       rounding::Budget& budget);

}  // namespace switchyard::mip
