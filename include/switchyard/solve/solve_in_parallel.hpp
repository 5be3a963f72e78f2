// switchyard/solve/solve_in_parallel.hpp - many programs solved at once.
#pragma once

#include <optional>
#include <vector>

#include "switchyard/export.hpp"
#include "switchyard/model/parallelism.hpp"
#include "switchyard/model/program.hpp"
#include "switchyard/model/solver_options.hpp"
#include "switchyard/solve/result.hpp"

namespace switchyard {

/// Solves each program, some at once; result k is that of program k, and the same for any number of
/// threads, since each solve runs with one thread of its own unless its options say another number.
///
/// Programs with a function that is not thread-safe are solved one after the other by the calling
/// thread. What a solve throws is thrown when all have ended, that of the first program first.
/// A null entry of a list stands for none; where a list is not empty it has as many entries as
/// there are programs, else InvalidArgument. `dynamic_schedule`: threads take the next program when
/// they are free, instead of every n-th.
SWITCHYARD_EXPORT std::vector<MathematicalProgramResult> SolveInParallel(
    const std::vector<const MathematicalProgram*>& programs,
    const std::vector<const Eigen::VectorXd*>* initial_guesses,
    const std::vector<const SolverOptions*>* solver_options,
    const std::vector<std::optional<SolverId>>* solver_ids,
    Parallelism parallelism = Parallelism::Max(), bool dynamic_schedule = true);
SWITCHYARD_EXPORT std::vector<MathematicalProgramResult> SolveInParallel(
    const std::vector<const MathematicalProgram*>& programs,
    const std::vector<const Eigen::VectorXd*>* initial_guesses = nullptr,
    const SolverOptions* solver_options = nullptr,
    const std::optional<SolverId>& solver_id = std::nullopt,
    Parallelism parallelism = Parallelism::Max(), bool dynamic_schedule = true);

}  // namespace switchyard
