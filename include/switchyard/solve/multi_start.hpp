// switchyard/solve/multi_start.hpp - a nonconvex program solved from many points.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "switchyard/export.hpp"
#include "switchyard/model/parallelism.hpp"
#include "switchyard/model/program.hpp"
#include "switchyard/solve/result.hpp"

namespace switchyard {

struct MultiStartOptions {
  int num_starts = 10;  // the program's own guess is the first, where it has one
  std::uint64_t seed = 0;
  /// Of a variable without two finite bounds: a normal deviate about its guess (else about its
  /// finite bound, else about 0), times spread max(1, |guess|), put back within its bounds.
  double spread = 1;
  /// The k-th start, in place of the above; it is called in order, by the calling thread.
  std::function<Eigen::VectorXd(int k)> sample;
  std::optional<SolverId> solver;
  SolverOptions solver_options;
  Parallelism parallelism = Parallelism::Max();
};

struct MultiStartResult {
  /// The best of `results`: of those that succeeded the one of best objective, else of those with a
  /// feasible point, else the first.
  MathematicalProgramResult best;
  int best_start = -1;
  std::vector<Eigen::VectorXd> starts;
  std::vector<MathematicalProgramResult> results;
};

/// Solves the program from each of its starts. The same for any number of threads.
SWITCHYARD_EXPORT MultiStartResult SolveFromManyStarts(const MathematicalProgram& program,
                                                       const MultiStartOptions& options = {});

}  // namespace switchyard
