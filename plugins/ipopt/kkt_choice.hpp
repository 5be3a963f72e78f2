// kkt_choice.hpp - in which form Ipopt's linear systems are solved.
#pragma once

#include "condensed_kkt.hpp"
#include "shape.hpp"
#include "switchyard/abi.h"

namespace switchyard::ipopt {

/// What of a program decides it.
struct KktShape {
  CondensedKkt::Counts counts;
  bool condensed_is_cheaper = false;
  /// Does a column of the augmented system meet so many rows that orderings which do not set it
  /// apart fill the factors?
  bool has_dense_column = false;
};

/// The condensed form is cheaper where forming and factoring its matrix takes no more
/// multiplications than factoring the augmented one, each in a minimum degree order, and 1000 for
/// each of its columns: MUMPS spends that time on a column at least, in bookkeeping. It is not
/// cheaper where inequalities of many variables fill J' S J.
KktShape KktShapeOf(const sy_problem& problem, const Shape& shape);

}  // namespace switchyard::ipopt
