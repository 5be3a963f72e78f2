// run.hpp - one run of NLopt from one point.
#pragma once

#include <string>
#include <vector>

#include "options.hpp"
#include "program.hpp"

namespace switchyard::nlopt {

/// How NLopt is to go about it.
struct Order {
  std::vector<nlopt_algorithm> nest;  // from the outside in
  Aim aim = Aim::kObjective;
  Equations equations = Equations::kAsTheyAre;
  double tightest = 1;      // a relative tolerance is no larger
  double initial_step = 0;  // 0: NLopt's own choice
  int maxeval = 0;          // 0: no limit
};

/// The algorithms by name.
std::string NameOf(const Order& order);

struct Ended {
  nlopt_result result = NLOPT_FAILURE;
  std::vector<double> x;  // all variables

  /// Did NLopt find no way on, of its own accord?
  [[nodiscard]] bool converged() const {
    return result == NLOPT_SUCCESS || result == NLOPT_FTOL_REACHED ||
           result == NLOPT_XTOL_REACHED || result == NLOPT_ROUNDOFF_LIMITED;
  }
};

/// Runs NLopt from x (all variables, within their bounds) within what is left of the budget.
Ended Run(const Order& order, const Options& options, double constraint_tolerance,
          const std::vector<double>& x, const linear::Watch& watch, Program& program);

}  // namespace switchyard::nlopt
