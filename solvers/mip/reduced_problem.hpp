// solvers/mip/reduced_problem.hpp - what is left of a problem where many of its variables are
// fixed.
#pragma once

#include <cstdint>
#include <vector>

#include "solvers/rounding/backend.hpp"
#include "switchyard/abi.h"
#include "switchyard/hints.h"
#include "switchyard/problem.hpp"

namespace switchyard::mip {

/// A problem with a linear objective without the variables that a box fixes: they go into sides,
/// g and the offset. Rows and cones of which no variable is left go where they hold. A part of a
/// tree keeps what was fixed above it, so this is loaded once for many nodes. Nothing rests on its
/// roundings: its duals, and 0 for what is gone, are duals of the whole problem.
class ReducedProblem {
 public:
  /// Borrows the problem. Its integers and its hints but "sy.blocks/1" are not there.
  ReducedProblem(const sy_problem& whole, const std::vector<double>& lower,
                 const std::vector<double>& upper);
  ReducedProblem(const ReducedProblem&) = delete;
  ReducedProblem& operator=(const ReducedProblem&) = delete;

  [[nodiscard]] const sy_problem& view() const { return view_; }
  [[nodiscard]] std::size_t num_vars() const { return variable_.size(); }
  /// Does a box fix all that is gone, where it was?
  [[nodiscard]] bool Covers(const std::vector<double>& lower,
                            const std::vector<double>& upper) const;
  /// Of the variables that are left.
  [[nodiscard]] std::vector<double> Kept(const std::vector<double>& v) const;
  [[nodiscard]] rounding::Answer Back(const rounding::Answer& reduced) const;

 private:
  void FixVariables(const std::vector<double>& lower, const std::vector<double>& upper);
  void KeepRows(const std::vector<std::uint8_t>& used);
  void KeepCones(const std::vector<std::uint8_t>& used);
  void KeepBlocks();

  const sy_problem whole_;
  std::vector<double> value_;  // of each variable that is gone, NaN: it is left
  std::vector<double> row_fixed_, cone_row_fixed_;       // what those add
  std::vector<std::int32_t> variable_, row_, cone_row_;  // that are left
  std::vector<std::int32_t> cone_;
  ProblemData data_;
  std::vector<std::int32_t> block_of_variable_, block_of_row_, block_of_cone_;
  sy_blocks blocks_{};
  sy_csc A_{}, F_{};
  std::vector<sy_hint> hints_;
  sy_problem view_{};
};

}  // namespace switchyard::mip
