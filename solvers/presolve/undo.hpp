// solvers/presolve/undo.hpp - from an answer to the reduced problem to one of the whole.
#pragma once

#include <variant>
#include <vector>

#include "solvers/presolve/answer.hpp"
#include "solvers/presolve/row_store.hpp"

namespace switchyard::presolve {

/// A number of entries of a list.
struct Slice {
  std::size_t first = 0, count = 0;
};

/// A column as it was when it went: its cost without what P adds, and its entries in linear rows
/// (their number) and in rows of cones (~ their number).
struct GoneColumn {
  Index column;
  double cost;
  Slice entries;
};

/// x_j had one value; its dual is what stationarity leaves.
struct FixedColumn {
  GoneColumn gone;
  double value;
};
/// a x_j within the sides of a row became bounds of x_j.
struct SingletonRow {
  Index row, column;
  double coefficient;
  bool lower, upper;  // which of the column's bounds are the row's
};
/// lower <= a x_j + (others of the row) <= upper, x_j free: x_j is what the row says. `gone` has
/// the column's entries in other rows.
struct FreeColumn {
  Index row;
  double coefficient, lower, upper;
  Slice others;
  GoneColumn gone;
};
/// Row = factor * kept row.
struct ParallelRow {
  Index row, kept;
  double factor;
  bool lower, upper;  // which of the kept row's sides are this one's
};
/// A row that holds at one end of what its variables can be: they were fixed there.
struct ForcingRow {
  Index row;
  bool at_upper;  // the row's upper side
  Slice entries;
};

/// What was done, undone from behind. Indices are those of the whole problem, rows those of a
/// Draft.
class UndoList {
 public:
  using Step = std::variant<FixedColumn, SingletonRow, FreeColumn, ParallelRow, ForcingRow>;

  void Add(Step step) { steps_.push_back(step); }
  /// Keeps entries for a step.
  template <class Entries>
  Slice Keep(const Entries& entries) {
    const Slice slice{pool_.size(), entries.size()};
    pool_.insert(pool_.end(), entries.begin(), entries.end());
    return slice;
  }
  [[nodiscard]] bool empty() const { return steps_.empty(); }

  /// First the points: duals need all of them.
  void Points(Meaning meaning, std::vector<double>& x) const;
  /// `curved`: P x. `y` of linear rows, `z` of rows of cones.
  void Duals(Meaning meaning, const std::vector<double>& curved, const std::vector<double>& z,
             std::vector<double>& y, std::vector<double>& x_dual) const;

 private:
  std::vector<Step> steps_;
  std::vector<Entry> pool_;
};

}  // namespace switchyard::presolve
