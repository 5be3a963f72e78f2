#include "starts.hpp"

#include <algorithm>

#include "switchyard/solve/multi_start.hpp"

namespace switchyard::cli {
namespace {

constexpr double kApart = 1e-4;  // relative to the largest entry, which counts as 1 at least

StartCounts CountsOf(const std::vector<MathematicalProgramResult>& results) {
  StartCounts counts{static_cast<int>(results.size()), 0, 0};
  std::vector<const Eigen::VectorXd*> points;
  for (const MathematicalProgramResult& result : results) {
    if (!result.is_success()) continue;
    ++counts.answered;
    const Eigen::VectorXd& x = result.get_x_val();
    const bool known = std::any_of(points.begin(), points.end(), [&](const Eigen::VectorXd* y) {
      return (x - *y).lpNorm<Eigen::Infinity>() <=
             kApart * std::max(1.0, y->lpNorm<Eigen::Infinity>());
    });
    if (!known) points.push_back(&x);
  }
  counts.distinct = static_cast<int>(points.size());
  return counts;
}

}  // namespace

MathematicalProgramResult SolveFromStarts(const MathematicalProgram& program,
                                          const SolveOptions& options, SolverOptions given,
                                          StartCounts* counts) {
  MultiStartOptions many;
  many.num_starts = options.starts;
  many.seed = options.seed;
  if (!options.solver.empty()) many.solver = SolverId(options.solver);
  if (options.threads > 0) many.parallelism = Parallelism(options.threads);
  const int at_once = many.parallelism.num_threads();
  given.time_limit /= (options.starts + at_once - 1) / at_once;
  given.threads = 0;         // of each: one
  given.progress = nullptr;  // of several solves at once it would be a line of none
  many.solver_options = std::move(given);
  MultiStartResult found = SolveFromManyStarts(program, many);
  *counts = CountsOf(found.results);
  return std::move(found.best);
}

}  // namespace switchyard::cli
