// A complete plugin: linear programs over a box, minimize q'x + offset with lower <= x <= upper.
//
// Each variable stands alone: it goes to its lower bound where q[i] > 0, to its upper one where
// q[i] < 0. The dual of the bounds is q itself, so the answer carries its own proof.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

#include "switchyard/plugin.hpp"

namespace {

using switchyard::plugin::Failure;

class Signs {
 public:
  static sy_solver Describe() {
    sy_solver solver{};
    solver.id = "org.example.signs";
    solver.name = "signs";
    solver.version = "1.0";
    solver.license = "BSD-3-Clause";
    solver.accepts = SY_ACCEPTS_BOUNDS;
    solver.traits = SY_PROVES_GLOBAL | SY_GIVES_DUALS;
    return solver;
  }

  explicit Signs(const sy_host&) {}

  void SetOption(std::string_view name, const sy_value&) {
    throw Failure(SY_E_ARGUMENT, "signs has no options, so none named " + std::string(name));
  }

  // The problem stays in place until the next load, so its arrays need no copy.
  void Load(const sy_problem& problem, std::uint64_t /*updates*/) { problem_ = problem; }

  void Solve(const sy_control&, sy_result& result) {
    double objective = problem_.offset;
    for (int i = 0; i < problem_.num_vars; ++i) objective += Cost(i) != 0 ? Cost(i) * At(i) : 0;
    if (std::isinf(objective)) {  // it falls without end along some axis
      result.termination = SY_UNBOUNDED;
      return;
    }
    result.termination = SY_OPTIMAL;
    result.primal = SY_FEASIBLE;
    result.dual = SY_FEASIBLE;
    result.objective = result.bound = objective;
    for (int i = 0; i < problem_.num_vars; ++i) {
      if (result.x != nullptr) result.x[i] = At(i);
      if (result.x_dual != nullptr) result.x_dual[i] = Cost(i);
    }
  }

 private:
  double Cost(int i) const { return problem_.q != nullptr ? problem_.q[i] : 0; }

  // The best value of x[i]; where it costs nothing, the one of its box that is nearest to 0.
  double At(int i) const {
    const double infinity = std::numeric_limits<double>::infinity();
    const double lower = problem_.x_lower != nullptr ? problem_.x_lower[i] : -infinity;
    const double upper = problem_.x_upper != nullptr ? problem_.x_upper[i] : infinity;
    if (Cost(i) != 0) return Cost(i) > 0 ? lower : upper;
    return std::clamp(0.0, lower, upper);
  }

  sy_problem problem_{};
};

}  // namespace

SY_PLUGIN("signs", "1.0", Signs)
