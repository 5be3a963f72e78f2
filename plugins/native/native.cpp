// The solvers of solvers/ as one module.
#include "solvers/conic/conic.hpp"
#include "solvers/mip/branch_and_bound.hpp"
#include "solvers/rounding/relax_and_round.hpp"
#include "switchyard/plugin.hpp"

SY_PLUGIN("native", "1.0", switchyard::conic::Conic, switchyard::rounding::RelaxAndRound,
          switchyard::mip::BranchAndBound)
