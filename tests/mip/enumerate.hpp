// tests/mip/enumerate.hpp - the optimum of a small mixed-integer program by all its integers, the
// continuous rest of each solved by a continuous backend whose answer is not believed.
#pragma once

#include <string>
#include <vector>

#include "switchyard/host/host.hpp"
#include "switchyard/problem.hpp"

namespace switchyard::testing {

/// What a backend answers through the host's table.
struct BackendAnswer {
  sy_status status = SY_OK;
  std::string error, text;
  sy_result result{};
  std::vector<double> x, x_dual, row_dual, cone_dual;
};
/// `options` as "name=value". Gaps and tolerances as they stand in `control`.
BackendAnswer SolveThroughHost(Host& host, const std::string& backend, const sy_problem& problem,
                               const sy_control& control,
                               const std::vector<std::string>& options = {});
/// A control that limits nothing.
sy_control Unlimited(int threads = 1);

struct Enumerated {
  double optimum = kInfinity;    // where there is none
  std::vector<double> integers;  // of the best assignment
  /// For how many assignments nothing was proven, so that the optimum is not known: 0 in general.
  int undecided = 0;
};

/// Over all assignments of the integers, whose bounds are finite. The rest that an assignment
/// leaves counts only with its certificate: of an optimum with its duals, or of a contradiction.
/// Where an integer makes a cone's head 0, the cone is what that leaves of it: linear rows.
Enumerated Enumerate(Host& host, const ProblemData& problem,
                     const std::vector<std::string>& continuous = {"conic", "clarabel"});

}  // namespace switchyard::testing
