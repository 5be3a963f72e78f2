// The solvers of solvers/ as one module. They need no library but those of the tree itself.
#include "solvers/rounding/relax_and_round.hpp"
#include "switchyard/plugin.hpp"

SY_PLUGIN("native", "1.0", switchyard::rounding::RelaxAndRound)
