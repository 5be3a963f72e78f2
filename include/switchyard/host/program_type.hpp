// switchyard/host/program_type.hpp - classes of programs, by which backends are compared and
// preferred.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "switchyard/abi.h"
#include "switchyard/export.hpp"

namespace switchyard {

enum class ProgramType {
  kLP,
  kQP,    // convex
  kSOCP,  // second-order cones, rotated ones among them
  kSDP,   // positive semidefinite cones, and any of the above
  kCGP,   // exponential or power cones, and any of the above
  kMILP,  // the same with integers
  kMIQP,
  kMISOCP,
  kMISDP,
  kMICGP,
  kQuadraticCostConicConstraint,  // a convex quadratic cost over cones that are not linear
  kNLP,                           // functions, or a quadratic cost that is not convex
  kMINLP,
};

/// "lp", "qp", ..., "quadratic_cost_conic_constraint", ...: as preferences name them.
SWITCHYARD_EXPORT std::string_view to_string(ProgramType type);
/// None where no class has that name.
SWITCHYARD_EXPORT std::optional<ProgramType> ProgramTypeNamed(std::string_view name);
/// Of a problem, by the sections that it has.
SWITCHYARD_EXPORT ProgramType ProgramTypeOf(const sy_problem& problem);

}  // namespace switchyard
