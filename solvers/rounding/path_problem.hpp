// solvers/rounding/path_problem.hpp - a problem with the hints "sy.paths/1" and "sy.blocks/1": what
// they say, checked, and listed by block.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "switchyard/abi.h"
#include "switchyard/arcs.hpp"
#include "switchyard/hints.h"

namespace switchyard::rounding {

/// The members of each of a number of groups, ascending.
class Groups {
 public:
  /// `group[i]`: of member i; -1: of none.
  Groups(std::int32_t num_groups, std::span<const std::int32_t> group);
  [[nodiscard]] std::span<const std::int32_t> Of(std::int32_t group) const;

 private:
  std::vector<std::int32_t> start_, member_;
};

/// Does the problem say which of its variables are arcs, and their blocks?
bool IsPathProblem(const sy_problem& problem);

/// The first column of each arc's point in tail_point or, for `vertex` = head, in head_point.
std::vector<std::int32_t> FirstPoints(const sy_paths& paths, const std::int32_t* vertex);

/// Why relax-and-round does not take a problem; "" where it does.
const char* WhyNot(const sy_problem& problem);

/// The continuous relaxation, borrowing all but its bounds.
///
/// The variables of a scaled block lie in their bounds wherever its rows and cones and the coupling
/// rows hold and its flows are in [0, 1]: a backend that makes rows of bounds is better off without
/// them. Flows and scales keep the lower bound; an upper one that a row of nonnegative terms
/// implies (the degree of a vertex) goes too.
struct Relaxation {
  std::vector<double> x_lower, x_upper;
  std::vector<sy_hint> hints;  // the blocks alone
  sy_problem problem{};        // over this and what it relaxes; good where this stays
};

/// Borrows the problem and its hints, which stay in place until the next load.
class PathProblem {
 public:
  /// Throws Failure: a hint that is absent (SY_E_UNSUPPORTED) or does not fit (SY_E_ARGUMENT).
  explicit PathProblem(const sy_problem& problem);
  PathProblem(const PathProblem&) = delete;
  PathProblem& operator=(const PathProblem&) = delete;

  [[nodiscard]] const sy_problem& problem() const { return problem_; }
  [[nodiscard]] const sy_paths& paths() const { return paths_; }
  [[nodiscard]] const sy_blocks& blocks() const { return blocks_; }
  [[nodiscard]] const sy_problem& relaxation() const { return relaxation_.problem; }

  /// The arcs whose flow may be 1.
  [[nodiscard]] const Arcs& arcs() const { return arcs_; }
  [[nodiscard]] const Leaving& out() const { return out_; }
  /// Variables of each block, and of none.
  [[nodiscard]] const Groups& variables() const { return variables_; }
  [[nodiscard]] const std::vector<std::int32_t>& coupling_variables() const { return coupling_; }
  /// Scaled blocks by arc_in, and those that are always on.
  [[nodiscard]] const Groups& blocks_of_arc() const { return blocks_of_arc_; }
  [[nodiscard]] const std::vector<std::int32_t>& always_on() const { return always_on_; }
  /// Of each row of F.
  [[nodiscard]] const std::vector<std::int32_t>& cone_of_row() const { return cone_of_row_; }
  /// Where each cone's rows begin.
  [[nodiscard]] const std::vector<std::int32_t>& cone_begin() const { return cone_begin_; }
  /// Rows and cones that do not hold where all of their variables are 0.
  [[nodiscard]] const std::vector<std::int32_t>& needy_rows() const { return needy_rows_; }
  [[nodiscard]] const std::vector<std::int32_t>& needy_cones() const { return needy_cones_; }

 private:
  void ListBlocks();
  void ListCones();
  void Relax();

  sy_problem problem_;
  sy_blocks blocks_;
  sy_paths paths_;
  Arcs arcs_;
  Leaving out_;
  Groups variables_, blocks_of_arc_;
  std::vector<std::int32_t> coupling_, always_on_;
  std::vector<std::int32_t> cone_of_row_, cone_begin_, needy_rows_, needy_cones_;
  Relaxation relaxation_;
};

}  // namespace switchyard::rounding
