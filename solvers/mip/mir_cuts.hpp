// solvers/mip/mir_cuts.hpp - rows of integers, rounded.
#pragma once

#include <cstdint>
#include <vector>

#include "solvers/mip/integer_cuts.hpp"
#include "solvers/mip/node_boxes.hpp"
#include "switchyard/abi.h"

namespace switchyard::mip {

/// sum of entries <= side, at all feasible points.
struct Inequality {
  std::vector<rounding::Entry> entries;
  double side = 0;
};

/// x_variable <= factor z, of a binary z; z -1: there is none.
struct VariableUpper {
  std::int32_t z = -1;
  double factor = kInfinity;
};

/// Mixed-integer rounding of the problem's rows. Written over y, s >= 0, distances of integers and
/// of continuous variables from one of their bounds, sum a_j y_j + sum c_j s_j <= b, and divided by
/// some delta > 0, a row says
///
///   sum F(a_j / delta) y_j + sum_{c_j < 0} c_j / (delta (1 - f)) s_j <= floor(b / delta),
///   F(a) = floor(a) + max(0, a - floor(a) - f) / (1 - f),  f = b / delta - floor(b / delta)
///
/// (Nemhauser and Wolsey, 1990). The bound of a continuous variable may be a binary's multiple.
/// Which bounds, and which delta, is decided at the point to cut off (Marchand and Wolsey,
/// Aggregation and mixed integer rounding to solve MIPs, 2001).
///
/// What a row says is also rounded together with others: while it has a continuous variable away
/// from its bounds, a row that is tight at the point and bounds that variable from the other side
/// is added.
///
/// Every coefficient is rounded down and every side up, as y, s and binaries are at least 0, and F
/// does not fall: the row that is given holds as the numbers it is written in (Cook, Dash, Fukasawa
/// and Goycoolea, Numerically safe Gomory mixed-integer cuts, 2009).
class MirCuts {
 public:
  /// Copies what it needs; `boxes`: where all feasible points are.
  MirCuts(const sy_problem& problem, const NodeBoxes& boxes);

  [[nodiscard]] bool empty() const { return bases_.empty(); }
  /// A row that holds at all feasible points, for sums with others.
  void Know(const Row& row);
  /// Appends rows that x violates, by at least `tolerance` of their length; the farthest first, and
  /// of those that are nearly parallel one.
  void Separate(const std::vector<double>& x, double tolerance, std::vector<Row>& rows) const;

 private:
  friend class Adder;
  friend class Rounder;

  void Know(Inequality row);
  void FindVariableUppers(const sy_problem& problem, const Csc& by_rows);

  std::vector<double> lower_, upper_;
  std::vector<std::uint8_t> integer_;
  std::vector<VariableUpper> variable_upper_;
  std::vector<Inequality> bases_;
  std::vector<Inequality> known_;
  std::vector<std::vector<std::int32_t>> known_of_;  // by continuous variable: its rows among them
};

}  // namespace switchyard::mip
