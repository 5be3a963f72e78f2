// run.hpp - a program is given to Ipopt and run.
#pragma once

#include <cstdint>

#include "functions.hpp"
#include "linear/watch.hpp"
#include "nlp.hpp"
#include "options.hpp"
#include "switchyard/abi.h"

namespace switchyard::ipopt {

/// What all runs of one solve share.
struct Session {
  const Options& options;
  const sy_host& host;
  linear::Watch& watch;
};

/// Runs Ipopt from `start`: from its duals too where it has all of them; else a convex program
/// without functions runs without a line search first, which is fast and mostly succeeds. Where
/// that led nowhere it runs again with a line search. Throws Failure where Ipopt broke down.
/// `before`: iterations of earlier runs.
Found Run(const sy_problem& problem, Functions& functions, const Point& start,
          const Session& session, std::int64_t before = 0);

}  // namespace switchyard::ipopt
