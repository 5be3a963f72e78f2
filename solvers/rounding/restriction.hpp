// solvers/rounding/restriction.hpp - a path problem with its flows fixed to one path.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "solvers/rounding/path_problem.hpp"
#include "switchyard/problem.hpp"

namespace switchyard::rounding {

/// What is left of the problem where the flows on a path are 1 and all others 0: blocks that are
/// off are gone with their variables, rows and cones, fixed variables are in sides, g, q and
/// offset, and rows that are left without entries are checked and gone.
struct Restriction {
  ProblemData problem;
  std::vector<std::int32_t> variables;  // of the whole problem, ascending: the restriction's
  std::vector<std::int32_t> ones;       // of the whole problem: those fixed at 1
  std::string contradiction;            // why no point can be on this path; "": none was found
};

/// The restriction to a path, in time linear in what is on it and in the dimensions of the whole.
Restriction Restrict(const PathProblem& whole, std::span<const std::int32_t> path);

/// A point of the restriction as one of the whole problem: what is off is 0.
std::vector<double> InWhole(const PathProblem& whole, const Restriction& restriction,
                            std::span<const double> x);

}  // namespace switchyard::rounding
