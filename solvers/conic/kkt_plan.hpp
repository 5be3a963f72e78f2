// solvers/conic/kkt_plan.hpp - where everything stands in the matrix of a step's equations.
#pragma once

#include <cstdint>
#include <vector>

#include "solvers/conic/blocks.hpp"
#include "solvers/conic/form.hpp"
#include "solvers/linalg/symmetric_pattern.hpp"

namespace switchyard::conic {

/// The matrix
///
///   [ P + sum of w_i g_i g_i' over condensed rows   E'   kept rows' ]
///   [ E                                             0               ]
///   [ kept rows                                         -1 / w      ]
///
/// where the rows g_i are those of A, and for each cone a few combinations of its own. A short row
/// is condensed; a longer one where it would be eliminated before any of its variables anyway,
/// which comes to the same, and kept where it would not. Columns: variables, equations, kept rows,
/// one for each combination of a kept cone. What is kept has a multiplier of its own, which is then
/// known better than from the difference of its sides.
///
/// All of this follows from patterns: forms of one pattern (see Form::SamePattern) may share a
/// plan.
struct KktPlan {
  /// With blocks, a row or cone within one is condensed, and a row that joins blocks is kept.
  KktPlan(const Form& form, const Blocks& blocks);

  /// A cone whose rows meet `num_columns` variables.
  struct Cone {
    std::size_t part;                 // of the product
    Index cone;                       // of that
    Index first_column, num_columns;  // in cone_column
    std::int64_t local;      // of its rows' entries in local_place: which of these columns it is
    std::int64_t target;     // condensed: products of column k with columns 0..k, in `target`
    Index kept_entry = -1;   // kept: of the first combination's column, the others' follow
    Index kept_column = -1;  // that column
    [[nodiscard]] bool kept() const { return kept_entry >= 0; }
  };

  linalg::SymmetricPattern pattern;
  std::vector<std::int8_t> sign;
  std::vector<Index> group;  // 0: variables with a curvature of their own, 1: the rest
  std::vector<Index> block;  // of each column; -1: of none
  Index num_blocks = 0;
  std::vector<Index> p_entry;   // of each entry of P
  std::vector<Index> diagonal;  // entries of variables and equations
  /// Of each conic row's products in `target`, -1: none; the same for rows in a row over the same
  /// variables.
  std::vector<std::int64_t> row_target;
  std::vector<Index> kept_row, kept_pivot;  // rows, and entries; the first column is kept_column
  Index kept_column = 0;
  std::vector<Cone> cones;
  std::vector<Index> cone_column, local_place;
  std::vector<Index> target;  // entries

  /// The entries that no weight changes; 0 elsewhere.
  [[nodiscard]] Vector Constant(const Form& form) const;
  /// A curvature that P alone gives to whatever is condensed; infinity where nothing is. Beside
  /// less than the rounding of a weight, condensing loses what P and the light rows say.
  [[nodiscard]] double LeastCurvature(const Form& form) const;
};

}  // namespace switchyard::conic
