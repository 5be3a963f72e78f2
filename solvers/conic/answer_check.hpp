// solvers/conic/answer_check.hpp - an answer held against the problem as it was given.
#pragma once

#include "solvers/presolve/answer.hpp"
#include "switchyard/problem.hpp"

namespace switchyard::conic {

/// What is left of rows, bounds and cones; of stationarity and the duals' signs; of the gap: each
/// beside 1 + the largest term that meets in it.
struct AnswerErrors {
  double primal = 0, dual = 0, gap = 0;
  double objective = 0, dual_objective = 0;
  [[nodiscard]] double Worst() const;
};

AnswerErrors ErrorsOf(const ProblemData& problem, const presolve::Answer& answer);

/// Puts what is left of stationarity into x_dual, so that the dual objective of abi.h bounds the
/// optimum wherever no side is infinite. `Meaning::kContradiction`: stationarity without costs.
void CloseStationarity(const ProblemData& problem, presolve::Answer& answer);

/// Do its duals, scaled to a largest entry of 1, leave no point of the problem, or none of size up
/// to about 1e9?
bool IsContradiction(const ProblemData& problem, const presolve::Answer& answer);

/// Is x a direction along which the objective falls for ever?
bool IsRay(const ProblemData& problem, const presolve::Answer& answer);

}  // namespace switchyard::conic
