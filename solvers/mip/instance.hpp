// solvers/mip/instance.hpp - what is the same at all nodes of one solve.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "solvers/mip/engine.hpp"
#include "solvers/mip/node_boxes.hpp"
#include "solvers/mip/options.hpp"
#include "solvers/mip/outer_model.hpp"
#include "solvers/mip/propagation.hpp"
#include "solvers/rounding/integer_problem.hpp"
#include "solvers/rounding/path_problem.hpp"
#include "switchyard/abi.h"

namespace switchyard::mip {

/// Relative, of a point's rows, cones and integers: what is offered as feasible keeps to it.
inline constexpr double kFeasible = 1e-6;

struct Instance {
  const rounding::IntegerProblem& whole;
  const Options& options;
  const sy_host& host;
  const Propagator& propagator;
  NodeBoxes root;                                // boxes of the root
  const rounding::PathProblem* paths = nullptr;  // of a path problem
  const std::int32_t* priority = nullptr;        // by variable
  const sy_solver* conic = nullptr;              // for continuous problems of its shape
  const sy_solver* linear = nullptr;             // for the outer model
  const OuterModel* outer = nullptr;             // nullptr: not of linear and second-order cones
  const Relaxed* relaxed = nullptr;              // the root by conic nodes, where those bound it
  bool outer_nodes = false;  // else conic ones, and the outer model where those fail
  bool has_continuous = false;

  [[nodiscard]] const sy_problem& problem() const { return whole.problem(); }
  /// What the conic engine relaxes.
  [[nodiscard]] const sy_problem& relaxation() const {
    return paths != nullptr ? paths->relaxation() : whole.problem();
  }
};

}  // namespace switchyard::mip
