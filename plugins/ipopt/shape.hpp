// shape.hpp - what Ipopt sees of a problem: which constraints, in which order, and the places of
// its derivatives' entries.
#pragma once

#include <cstdint>
#include <vector>

#include "switchyard/abi.h"

namespace switchyard::ipopt {

/// The places of a sparse matrix; doubles add up.
struct Places {
  std::vector<std::int32_t> row, col;

  void Add(std::int32_t i, std::int32_t j) {
    row.push_back(i);
    col.push_back(j);
  }
  [[nodiscard]] std::size_t size() const { return row.size(); }
};

/// Ipopt's constraints are the linear rows that say something of the variables, then the entries of
/// c that have a finite side. A row says nothing without a finite side, or where its variables are
/// all fixed.
struct Shape {
  /// `uses_hessian`: else there are no second derivatives.
  Shape(const sy_problem& problem, bool uses_hessian);

  std::vector<std::int32_t> rows;         // Ipopt's first constraints
  std::vector<std::int32_t> constraints;  // the indices in c of those behind
  Places jacobian;                        // of the linear rows, then of c
  std::vector<double> row_values;         // of the entries of the linear rows
  std::vector<std::int32_t> entries;      // in nlp->jacobian, of those of c
  Places hessian;                         // lower triangle: of P, then of the nlp
  std::vector<std::uint8_t> is_equation;  // of each of Ipopt's constraints
  std::int32_t equations = 0;             // among them
  std::int32_t unfixed = 0;               // variables

  /// Ipopt takes no more equations than variables: where there are, they are loosened a little and
  /// are none to it.
  [[nodiscard]] bool loosens_equations() const { return equations > unfixed; }

 private:
  void Count(double lower, double upper) {
    is_equation.push_back(lower == upper ? 1 : 0);
    equations += is_equation.back();
  }
  void PlaceRows(const sy_problem& problem);
  void PlaceConstraints(const sy_problem& problem);
};

/// Does the problem have a nonlinear objective f, constraints c, any of both?
bool HasObjective(const sy_problem& problem);
bool HasConstraints(const sy_problem& problem);
bool HasFunctions(const sy_problem& problem);

}  // namespace switchyard::ipopt
