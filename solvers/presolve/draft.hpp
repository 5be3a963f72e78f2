// solvers/presolve/draft.hpp - a problem while it is being reduced.
#pragma once

#include <cmath>
#include <vector>

#include "solvers/presolve/row_store.hpp"
#include "solvers/presolve/split_cones.hpp"
#include "solvers/presolve/undo.hpp"
#include "switchyard/problem.hpp"

namespace switchyard::presolve {

/// What the reductions may rely on: numbers that will change with the next update are not to be
/// looked at, so that the same is reduced whatever they are.
struct Limits {
  bool bounds_stay = true;   // of variables and rows
  bool vectors_stay = true;  // q, g
  bool values_stay = true;   // of the matrices
};

/// Variables and rows are numbered as in the whole problem; what is gone is not alive. The linear
/// rows are those of A and, behind them, those of cones that are rows: zero, nonnegative, and small
/// cones taken apart.
struct Draft {
  Draft(const ProblemData& problem, const Limits& limits);
  Draft(const ProblemData& problem, const Limits& limits, ConesSplit cones_of);

  // Columns.
  std::vector<double> q;        // without what P adds
  std::vector<double> p_shift;  // what P adds for fixed variables
  std::vector<double> lower, upper;
  std::vector<std::uint8_t> column_alive;
  Csc P;                             // both triangles
  std::vector<std::uint8_t> curved;  // has entries in P
  double offset = 0;

  // Linear rows.
  RowStore rows;
  std::vector<double> row_lower, row_upper;
  std::vector<double> row_size;  // the largest number, from 1 on, that its sides were moved by
  std::vector<std::uint8_t> row_alive;
  Index rows_of_a;            // the first rows
  std::vector<Index> source;  // of the other rows: a row of F that stands in it

  // Cones that are none of rows.
  RowStore cone_rows;
  std::vector<double> g;
  std::vector<sy_cone> cones;

  UndoList undo;
  Limits limits;
  bool contradiction = false;  // found: then the whole problem is to be solved, for its proof

  [[nodiscard]] Index num_columns() const { return static_cast<Index>(q.size()); }
  [[nodiscard]] Index num_rows() const { return static_cast<Index>(row_lower.size()); }
  [[nodiscard]] bool IsFree(Index j) const {
    return lower[j] == -kInfinity && upper[j] == kInfinity;
  }

  /// Will the sides of a row be what they are? Those of cones are g.
  [[nodiscard]] bool SidesStay(Index row) const {
    return row < rows_of_a ? limits.bounds_stay : limits.bounds_stay && limits.vectors_stay;
  }

  /// Calls back with the entries of a row that are alive.
  template <class Take>
  void EachIn(Index row, Take&& take) const {
    for (const Entry& e : rows.Row(row)) {
      if (column_alive[e.column] != 0) take(e);
    }
  }
  /// The entries of a column in linear rows that are alive, and (~) in rows of cones.
  [[nodiscard]] std::vector<Entry> Column(Index j) const;
  void Column(Index j, std::vector<Entry>& column) const;
  /// How many there are, 2 for more; one of them in `entry`, if any.
  [[nodiscard]] int FewEntries(Index j, Entry& entry) const;

  void Fix(Index j, double value);
  void DropRow(Index row) { row_alive[row] = 0; }
  void ReduceCost(Index j, double by);
  /// Of a linear row (>= 0), or a row of a cone (~): a term of this value is no longer in it.
  void TakeConstant(Index row, double value);
  /// Takes factor times `what` from a linear row (>= 0) or a row of a cone (~), column `gone` of it
  /// to vanish.
  void SubtractFrom(Index row, double factor, std::span<const Entry> what, Index gone);
};

}  // namespace switchyard::presolve
