// solvers/conic/form.hpp - a problem as the interior-point method sees it: rows sorted by what they
// say, everything scaled.
#pragma once

#include <vector>

#include "solvers/cones/group.hpp"
#include "solvers/linalg/sparse.hpp"
#include "switchyard/problem.hpp"

namespace switchyard::conic {

using linalg::Index;
using linalg::Vector;

/// Cones of one kind, dimension and parameter.
struct ConeGroup {
  sy_cone_kind kind;
  double parameter;
  cones::Layout layout;
  Index first;  // row
  bool operator==(const ConeGroup&) const = default;
};

/// Numbers of rows and variables of each sort.
struct Shape {
  bool operator==(const Shape&) const = default;
  Index vars = 0;
  Index boxed = 0;    // the first variables: bounded on both sides
  Index bounded = 0;  // the first variables: bounded below
  Index cone_rows = 0;
  Index ranges = 0;        // the first inequalities: bounded on both sides
  Index inequalities = 0;  // behind the cones' rows
  Index equations = 0;     // behind these
  [[nodiscard]] Index conic_rows() const { return cone_rows + inequalities; }
  [[nodiscard]] Index rows() const { return conic_rows() + equations; }
  /// Of the slacks s: rows of cones, inequalities, lower bounds, ranges from above, upper bounds.
  [[nodiscard]] Index slacks() const { return conic_rows() + bounded + ranges + boxed; }
  [[nodiscard]] Index lower_bounds() const { return conic_rows(); }
  [[nodiscard]] Index range_tops() const { return conic_rows() + bounded; }
  [[nodiscard]] Index upper_bounds() const { return range_tops() + ranges; }
};

/// minimize 1/2 x'Px + q'x over x with
///   A x - b in K x R_+ x {0}  (cones, inequalities, equations),
///   range_top - A x >= 0      (the first inequalities),
///   x >= lower                (the first variables),  upper - x >= 0  (the first of them).
/// A variable or row that only has an upper side stands here with its sign changed. Rotated cones
/// are second-order ones, turned by an eighth.
class Form {
 public:
  /// Cones of order 1 and 2 and fixed variables should be gone: they are taken, not looked for.
  explicit Form(const ProblemData& problem);

  Shape shape;
  linalg::SymmetricMatrix P;
  Vector q;
  linalg::SparseMatrix A;
  Vector b;          // all rows
  Vector range_top;  // ranges
  Vector lower;      // bounded
  Vector upper;      // boxed
  std::vector<ConeGroup> cones;

  // Back to the problem: a variable of it is column_scale times ours, a row of ours is row_scale
  // times its row, our objective is objective_scale times its own.
  std::vector<Index> variable;  // of the problem, for each of ours
  std::vector<Index> source;    // row of A, or ~row of F, for each of our rows
  Vector column_scale, row_scale;
  double objective_scale = 1;
  double offset = 0;           // of the problem's objective
  std::vector<Index> rotated;  // the first rows of cones that were turned (of the problem's F)

  /// Is everything but numbers the same?
  [[nodiscard]] bool SamePattern(const Form& other) const;

  /// Ours: a point, or a ray.
  void PointBack(const Vector& x, double* original) const;
  /// The other way.
  [[nodiscard]] Vector PointForth(const double* original) const;
  [[nodiscard]] Vector RowDualsForth(const double* row_dual, const double* cone_dual) const;
  /// Ours: multipliers of all rows and of the bounds (lower minus upper), by variable.
  void DualsBack(const Vector& y, const Vector& bounds, double* x_dual, double* row_dual,
                 double* cone_dual, Index num_vars, Index num_rows, Index num_cone_rows) const;

 private:
  void SortVariables(const ProblemData& d);
  void SortRows(const ProblemData& d);
  void SortCones(const ProblemData& d);
  /// `place`: of each variable of the problem, ours.
  void TakeP(const ProblemData& d, const std::vector<Index>& place);
  void TakeA(const ProblemData& d, const std::vector<Index>& place);
  void TakeSides(const ProblemData& d);
  void Equilibrate();
  void Scale(const Vector& rows, const Vector& columns);
};

}  // namespace switchyard::conic
