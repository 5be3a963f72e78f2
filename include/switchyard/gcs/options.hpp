// switchyard/gcs/options.hpp - how a shortest path is to be found.
#pragma once

#include <optional>
#include <string>

#include "switchyard/export.hpp"
#include "switchyard/model/parallelism.hpp"
#include "switchyard/solve/solve.hpp"

namespace switchyard {

struct GraphOfConvexSetsOptions {
  /// true: the convex relaxation, rounded; with max_rounded_paths = 0 the relaxation alone. false:
  /// the integer program whole, by a backend that takes it. Unset: as true.
  std::optional<bool> convex_relaxation;
  /// Distinct paths to be tried; unset: 10.
  std::optional<int> max_rounded_paths;
  /// Unset or true: edges that are on no path are left out, by reachability and dominators.
  std::optional<bool> preprocessing;
  int max_rounding_trials = 100;
  double flow_tolerance = 1e-5;
  int rounding_seed = 0;
  /// The backend of the relaxation, or of the whole integer program; nullptr: the best.
  const SolverInterface* solver = nullptr;
  /// Of restrictions; nullptr: `solver`'s.
  const SolverInterface* restriction_solver = nullptr;
  const SolverInterface* preprocessing_solver = nullptr;
  SolverOptions solver_options;
  std::optional<SolverOptions> restriction_solver_options;
  std::optional<SolverOptions> preprocessing_solver_options;
  Parallelism parallelism = Parallelism::Max();
  /// A file for the transcribed problem, for a bug report; empty: none.
  std::string dump;
};

}  // namespace switchyard
