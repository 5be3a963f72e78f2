// solvers/presolve/presolve.hpp - a problem made smaller, and the way back.
#pragma once

#include <memory>
#include <vector>

#include "solvers/presolve/answer.hpp"
#include "solvers/presolve/draft.hpp"
#include "switchyard/problem.hpp"

namespace switchyard::presolve {

/// The reduced problem has rows and cones that are none of rows; no integers, no nlp, no hints.
class Presolve {
 public:
  /// Borrows the problem, for the way back.
  Presolve(const ProblemData& problem, const Limits& limits);

  [[nodiscard]] const ProblemData& reduced() const { return reduced_; }
  /// Of each variable and row of the reduced problem: its number in the whole one. Rows: a row of
  /// A, or ~ a row of F that stands in it.
  [[nodiscard]] const std::vector<Index>& variables() const { return variable_; }
  [[nodiscard]] const std::vector<Index>& rows() const { return row_; }

  /// From an answer to the reduced problem to one of the whole. Of a certificate the other side's
  /// vectors may be empty.
  [[nodiscard]] Answer Back(const Answer& reduced) const;
  /// The other way, as good as it can be: what the reductions took away is lost, and the duals of
  /// bounds are what the others leave of stationarity.
  [[nodiscard]] Answer Forth(const Answer& whole) const;

 private:
  void Reduce();
  void Compact();

  const ProblemData& whole_;
  Draft draft_;
  ProblemData reduced_;
  std::vector<Index> variable_;
  std::vector<Index> row_;
  std::vector<Index> draft_row_;  // the same, as the draft counts
};

}  // namespace switchyard::presolve
