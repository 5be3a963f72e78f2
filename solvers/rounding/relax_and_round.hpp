// solvers/rounding/relax_and_round.hpp - a mixed-integer convex problem by its relaxation. Of a
// shortest path through convex sets the relaxed flow is sampled for paths, each is solved with its
// flows fixed, the best one is kept; of any other problem the relaxation is rounded and dived in.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "solvers/rounding/backend.hpp"
#include "solvers/rounding/budget.hpp"
#include "solvers/rounding/candidates.hpp"
#include "solvers/rounding/integer_problem.hpp"
#include "solvers/rounding/options.hpp"
#include "solvers/rounding/path_problem.hpp"
#include "switchyard/abi.h"

namespace switchyard::rounding {

/// A strategy for switchyard/plugin.hpp, over convex problems with rows and cones of all kinds:
/// path problems have "sy.paths/1" and "sy.blocks/1". One without integer variables has its
/// relaxation's answer.
///
/// What it answers:
///   SY_OPTIMAL              the best point's objective is within the gap of the proven bound
///   SY_LOCALLY_OPTIMAL      a path, or the integers of a point, optimal on its own, farther than
///                           the gap from the bound
///   SY_TARGET, SY_CUTOFF    as sy_control has it; the bound alone proves a cutoff
///   SY_INFEASIBLE           the target is not reached along arcs, or the relaxation is infeasible;
///                           without paths, only where that is proven here
///   SY_INFEASIBLE_OR_UNBOUNDED  the relaxation is unbounded
///   SY_NO_PATH              the relaxed flow holds no path above the flow tolerance
///   SY_RESTRICTIONS_FAILED  paths, or dives, were tried, none has a point that holds; the text
///                           says why
///   a limit's               with the best path and the bound, where there are any
///   SY_NOT_SOLVED           with paths = 0, or dives = 0: relaxed, relaxed_x and bound alone
/// `bound` is proven by the formula of abi.h from the relaxation's duals, never taken on trust.
/// Where the front end solves paths itself (solve_path) and its answer is no point of this problem,
/// the objective stands and primal is SY_NO_POINT.
class RelaxAndRound {
 public:
  static sy_solver Describe();
  static void Supports(const sy_host& host, const sy_problem& problem);
  explicit RelaxAndRound(const sy_host& host) : host_(host) {}

  void SetOption(std::string_view name, const sy_value& value) { options_.Set(name, value); }
  void Load(const sy_problem& problem, std::uint64_t updates);
  void Solve(const sy_control& control, sy_result& result);

 private:
  const sy_host& host_;
  Options options_;
  std::optional<PathProblem> paths_;  // one of these, once loaded
  std::optional<IntegerProblem> general_;
};

}  // namespace switchyard::rounding
