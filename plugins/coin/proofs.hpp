// coin/proofs.hpp - what CLP says of a linear program, with the ray that proves it.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "ClpSimplex.hpp"
#include "linear/duals.hpp"
#include "linear/watch.hpp"
#include "switchyard/abi.h"

namespace switchyard::coin {

inline std::vector<double> WithInfinity(const double* sides, int count) {
  constexpr double kInfinite = 1e27;  // CLP's
  std::vector<double> out(sides, sides + count);
  for (double& side : out) {
    if (std::abs(side) >= kInfinite) side = std::copysign(kInfinity, side);
  }
  return out;
}

/// The model that CLP holds, as a problem with infinite sides where CLP has its largest numbers;
/// borrows it.
struct ModelView {
  explicit ModelView(ClpSimplex& model)
      : x_lower(WithInfinity(model.columnLower(), model.numberColumns())),
        x_upper(WithInfinity(model.columnUpper(), model.numberColumns())),
        row_lower(WithInfinity(model.rowLower(), model.numberRows())),
        row_upper(WithInfinity(model.rowUpper(), model.numberRows())),
        A{},
        problem{} {
    problem.size = sizeof problem;
    problem.num_vars = model.numberColumns();
    problem.num_rows = model.numberRows();
    problem.q = model.objective();
    problem.offset = -model.objectiveOffset();
    problem.x_lower = x_lower.data();
    problem.x_upper = x_upper.data();
    problem.row_lower = row_lower.data();
    problem.row_upper = row_upper.data();
    CoinPackedMatrix* matrix = model.matrix();
    if (problem.num_rows == 0 || matrix == nullptr) return;
    matrix->removeGaps();
    A = {problem.num_rows, problem.num_vars, matrix->getVectorStarts(), matrix->getIndices(),
         matrix->getElements()};
    problem.A = &A;
  }

  std::vector<double> x_lower, x_upper, row_lower, row_upper;
  sy_csc A;
  sy_problem problem;
};

inline std::optional<linear::Duals> Farkas(ClpSimplex& model) {
  const std::unique_ptr<double[]> ray(model.infeasibilityRay());
  if (ray == nullptr) return std::nullopt;
  return linear::Farkas(ModelView(model).problem, {ray.get(), ray.get() + model.numberRows()});
}

inline std::optional<std::vector<double>> Ray(ClpSimplex& model) {
  const std::unique_ptr<double[]> ray(model.unboundedRay());
  if (ray == nullptr) return std::nullopt;
  return linear::FallingRay(ModelView(model).problem,
                            {ray.get(), ray.get() + model.numberColumns()});
}

/// Is there a ray to its word infeasible or unbounded? Any other word needs none.
inline bool ProvesItsVerdict(ClpSimplex& model) {
  if (model.problemStatus() == 1) return Farkas(model).has_value();
  return model.problemStatus() != 2 || Ray(model).has_value();
}

/// Back to the slack basis, and to where a fresh load begins.
inline void ForgetBasis(ClpSimplex& model) {
  model.createStatus();
  double* x = model.primalColumnSolution();
  for (int j = 0; j < model.numberColumns(); ++j) {
    x[j] = std::clamp(0.0, model.columnLower()[j], model.columnUpper()[j]);
  }
  std::fill_n(model.primalRowSolution(), model.numberRows(), 0.0);
  std::fill_n(model.dualRowSolution(), model.numberRows(), 0.0);
}

/// Presolve proves without a ray, and where numbers are bad CLP calls a problem infeasible that is
/// not. Solves again without presolve, then by the primal method, then without the objective where
/// that is what hides an infeasibility; the last word stands.
inline void SeekProof(ClpSimplex& model, linear::Watch& watch) {
  ForgetBasis(model);
  model.dual();
  if (ProvesItsVerdict(model) || watch.Stopped()) return;
  ForgetBasis(model);
  model.primal();
  if (ProvesItsVerdict(model) || watch.Stopped()) return;
  const std::vector<double> costs(model.objective(), model.objective() + model.numberColumns());
  std::fill_n(model.objective(), model.numberColumns(), 0.0);
  ForgetBasis(model);
  model.primal();
  const bool infeasible = model.problemStatus() == 1;
  std::copy(costs.begin(), costs.end(), model.objective());
  if (!infeasible && !watch.Stopped()) model.primal();
}

}  // namespace switchyard::coin
