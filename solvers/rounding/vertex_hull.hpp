// solvers/rounding/vertex_hull.hpp - a cut at a vertex from the hull of its transitions.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solvers/rounding/budget.hpp"
#include "solvers/rounding/options.hpp"
#include "solvers/rounding/path_problem.hpp"
#include "solvers/rounding/tightened.hpp"
#include "switchyard/abi.h"

namespace switchyard::rounding {

/// A path leaves a vertex v by an arc f other than the one that it came by, e, at the same point of
/// its set: with nonnegative multiples of points, (lambda_ef, w_ef) in the cone over X_v,
///
///   (phi_e, z_e) = sum_f (lambda_ef, w_ef),   (phi_f, y_f) = sum_e (lambda_ef, w_ef)
///
/// What a relaxed flow lacks of that is the least sum of slacks with which it holds; the
/// multipliers (a_e, c_e) and (b_f, d_f) of these equations make the row
///
///   sum_e a_e phi_e + c_e'z_e + sum_f b_f phi_f + d_f'y_f >= 0
///
/// that is violated by as much. It is valid iff a_e + b_f + min over X_v of (c_e + d_f)'x >= 0 for
/// every pair; a_e is raised until a proven lower bound of that minimum says so. Arcs without flow
/// have c_e = 0, d_f = 0.
class VertexHull {
 public:
  VertexHull(const PathProblem& whole, const sy_host& host, const Options& options, Budget& budget);

  /// Are both sides of v used by more than one arc in the flow of x, and is its set known?
  [[nodiscard]] bool Asks(std::int32_t v, std::span<const double> x) const;
  /// A row that x violates by more than `tolerance` beside its largest number, or nothing; nothing
  /// where the set is not known to be bounded.
  [[nodiscard]] std::vector<Tightened::Entry> Cut(std::int32_t v, std::span<const double> x,
                                                  double tolerance) const;

 private:
  class Separation;

  const PathProblem& whole_;
  const sy_host& host_;
  const Options& options_;
  Budget& budget_;
  Leaving in_;
  std::vector<std::int32_t> tail_first_, head_first_;
};

}  // namespace switchyard::rounding
