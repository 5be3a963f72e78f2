// The support function of a set: a linear function maximized over it.
#include <algorithm>
#include <cmath>

#include "core/sets/section_lp.hpp"
#include "core/sets/set_program.hpp"
#include "switchyard/error.hpp"
#include "switchyard/sets/convex_set.hpp"
#include "switchyard/solve/solve.hpp"

namespace switchyard {
namespace {

constexpr double kGoesThatWay = 1e-6;  // per unit of the direction

}  // namespace

double ConvexSet::SupportFunction(const VectorRef& direction) const {
  Require(direction.size() == dimension_, "a direction for a ", Kind(), " needs ", dimension_,
          " entries, got ", direction.size());
  for (Eigen::Index i = 0; i < direction.size(); ++i) {
    Require(std::isfinite(direction[i]), "direction[", i, "] must be a finite number, got ",
            direction[i]);
  }
  if (dimension_ == 0) return IsEmpty() ? -kInfinity : 0;
  return DoSupport(direction);
}

// The bound that the duals prove is above the optimum; the backend's value may be below it.
double ConvexSet::DoSupport(const Eigen::VectorXd& direction) const {
  if (IsSmallPolyhedron(scaled())) {
    if (const auto value = SupportByLp(scaled(), direction)) return *value;
  }
  SetProgram maximize(*this);
  maximize.program.AddLinearCost(direction, maximize.x);
  maximize.program.set_objective_sense(ObjectiveSense::kMaximize);
  const MathematicalProgramResult result = Solve(maximize.program);
  if (result.is_success()) {
    return std::isnan(result.bound) ? result.objective : std::max(result.objective, result.bound);
  }
  if (result.termination == Termination::kInfeasible) return -kInfinity;
  if (result.termination == Termination::kUnbounded) return kInfinity;
  if (IsEmpty()) return -kInfinity;
  const RecessionProgram away(*this, direction);
  if (away.Value(Solve(away.program)) > kGoesThatWay * direction.lpNorm<1>()) return kInfinity;
  CouldNotTell(Kind(), "the support function", result);
}

}  // namespace switchyard
