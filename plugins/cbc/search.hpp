// search.hpp - one branch and bound of CBC: preprocessing, cuts, heuristics, tree.
#pragma once

#include <optional>
#include <vector>

#include "CglPreProcess.hpp"
#include "OsiClpSolverInterface.hpp"
#include "coin/clp_watch.hpp"
#include "linear/settings.hpp"
#include "switchyard/abi.h"

namespace switchyard::cbc {

/// The table of CBC's own options.
const sy_option* const* OptionTable();

struct Found {
  sy_termination termination = SY_NOT_SOLVED;
  std::optional<std::vector<double>> x;
  double bound = -kInfinity;
  std::int64_t iterations = 0;
  std::int64_t nodes = 0;
  std::string text;
};

/// Searches below `cutoff`, from the solved relaxation in `solver`; ends with that in pieces. A
/// complete search without a point is SY_INFEASIBLE: nothing is below the cutoff. `log` hears the
/// search; the linear programs within speak to `quiet`, as CLP at any level above 0 prints on its
/// own where it fathoms subtrees.
Found Search(OsiClpSolverInterface& solver, const linear::Settings& settings, double cutoff,
             CoinMessageHandler& log, CoinMessageHandler& quiet, coin::ClpSession& session);

}  // namespace switchyard::cbc
