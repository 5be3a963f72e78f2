// solvers/presolve/reductions.hpp - what makes a draft smaller: a file for each. Each says how much
// it removed.
#pragma once

#include "solvers/presolve/draft.hpp"

namespace switchyard::presolve {

/// Empty rows, rows of one variable, rows that the bounds of their variables imply, or force.
int ReduceRows(Draft& draft);
/// Empty rows alone: what the others left behind.
int DropEmptyRows(Draft& draft);
/// Rows that are multiples of others.
int MergeParallelRows(Draft& draft);
/// Fixed columns, columns that stand nowhere, free columns that stand in one row.
int ReduceColumns(Draft& draft);
/// Free columns of equations, replaced by the rest of the equation where that fills in little.
int SubstituteFreeColumns(Draft& draft);

}  // namespace switchyard::presolve
