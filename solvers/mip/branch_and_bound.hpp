// solvers/mip/branch_and_bound.hpp - mixed-integer convex problems to proven optimality.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "solvers/mip/incumbents.hpp"
#include "solvers/mip/options.hpp"
#include "solvers/rounding/integer_problem.hpp"
#include "solvers/rounding/path_problem.hpp"
#include "switchyard/abi.h"

namespace switchyard::mip {

/// A strategy for switchyard/plugin.hpp, over linear objectives, rows and cones of all kinds: a
/// tree of boxes, each bounded by a relaxation that a backend of the host solves. Nodes are conic
/// relaxations, or linear ones with cuts (second-order cones); see Options. One without integer
/// variables has its relaxation's answer.
///
/// What it answers:
///   SY_OPTIMAL    the best point's objective is within the gap of the bound; a gap below 1e-6
///                 relative counts as that, since relaxations are solved to a finite accuracy
///   SY_INFEASIBLE proven, by propagation and by certificates that were checked here
///   SY_CUTOFF     proven: no point below the cutoff
///   SY_TARGET, a limit's  with the best point and the bound
///   SY_INFEASIBLE_OR_UNBOUNDED  the relaxation is unbounded
///   SY_NUMERICAL_TROUBLE  nodes were left of which nothing could be proven: with the best point,
///   and
///                 a bound that counts them
/// Every bound is the formula of safe_bound.hpp on proven boxes, and every point keeps to rows,
/// cones, bounds and integers to 1e-6, relative, its objective computed here. (Land and Doig, 1960;
/// Achterberg, Constraint Integer Programming, 2007; Duran and Grossmann, 1986, and Quesada and
/// Grossmann, 1992, for outer approximation.)
class BranchAndBound {
 public:
  static sy_solver Describe();
  static void Supports(const sy_host& host, const sy_problem& problem);
  explicit BranchAndBound(const sy_host& host) : host_(host) {}

  void SetOption(std::string_view name, const sy_value& value) { options_.Set(name, value); }
  void Load(const sy_problem& problem, std::uint64_t updates);
  /// Integers alone will do: the rest is solved.
  void WarmStart(const sy_start& start);
  void Solve(const sy_control& control, sy_result& result);
  /// "sy.pool/1".
  static const void* Extension(const char* id);
  /// The best points of the last solve after its answer, the best first.
  [[nodiscard]] const std::vector<Solution>& pool() const { return pool_; }

 private:
  const sy_host& host_;
  Options options_;
  std::optional<rounding::IntegerProblem> whole_;
  std::optional<rounding::PathProblem> paths_;
  std::vector<double> start_;  // empty: none
  std::vector<Solution> pool_;
};

}  // namespace switchyard::mip
