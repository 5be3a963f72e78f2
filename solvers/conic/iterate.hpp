// solvers/conic/iterate.hpp - where the interior-point method stands, and how far from an answer.
#pragma once

#include "solvers/conic/form.hpp"
#include "solvers/conic/kkt.hpp"

namespace switchyard::conic {

/// A point of the homogeneous embedding: x / tau, y / tau, z / tau are the problem's.
struct Iterate {
  Vector x, y, z, s;
  double tau = 1, kappa = 1;
};

/// How far an iterate is from an answer, in the units of the problem.
struct Distance {
  /// What is left of the rows and of stationarity, beside 1 + the largest entry of what they sum to
  /// (Ax, s and b; Px and q), and of the gap, beside 1 + the objective.
  double primal = 0, dual = 0, gap = 0;
  /// The same beside 1 + the largest term of the sums: what rounding in these may leave.
  double primal_terms = 0, dual_terms = 0;
  double primal_objective = 0, dual_objective = 0;  // without the problem's offset
  /// How well it certifies that there is no point, or no optimum: what is left beside what is
  /// gained.
  double infeasible = 0, unbounded = 0;

  [[nodiscard]] double Worst() const;
  [[nodiscard]] double WorstByTerms() const;
};

/// What the embedding's equations leave at an iterate:
///   P x + q tau - E'y - G'z,   E x - e tau,   G x - h tau - s,
///   -q'x - x'Px / tau + e'y + h'z - kappa.
class Residuals {
 public:
  explicit Residuals(const Form& form, linalg::Workers* workers = nullptr);

  void Compute(const Iterate& at);

  Triple r;
  double tau = 0;
  double norm_dual = 0, norm_primal = 0;  // largest entries of r.x; of r.y and r.z
  Vector p_x, a_x;                        // P x, A x
  double quadratic = 0;                   // x'Px
  Distance distance;
  /// h of all slacks.
  Vector h;

 private:
  void MeasureRows(const Iterate& at);
  void MeasureColumns(const Iterate& at);

  const Form& form_;
  linalg::Workers* const workers_;
  Vector row_unit_, column_unit_;        // the problem's unit over ours
  Vector row_largest_, column_largest_;  // largest entries of the problem's A
  Vector rows_, columns_;
  double cost_ = 0, worth_ = 0;  // q'x; e'y + h'z
};

}  // namespace switchyard::conic
