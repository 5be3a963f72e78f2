// switchyard/solve/choose_solver.hpp - which backends there are, and which serves a program.
#pragma once

#include <memory>
#include <set>
#include <vector>

#include "switchyard/export.hpp"
#include "switchyard/host/host.hpp"
#include "switchyard/host/program_type.hpp"
#include "switchyard/model/program.hpp"
#include "switchyard/solve/solve.hpp"

namespace switchyard {

/// The class of a program, as it is lowered.
SWITCHYARD_EXPORT ProgramType GetProgramType(const MathematicalProgram& program);

/// Every backend and whether it would serve the program, best first; the first that would is the
/// one that Solve takes. Host::Prefer and the configuration change the order.
SWITCHYARD_EXPORT std::vector<Considered> ExplainChoice(const MathematicalProgram& program,
                                                        const Host& host = Host::Default());
/// The first of them. Throws InvalidArgument with every reason where none serves.
SWITCHYARD_EXPORT SolverId ChooseBestSolver(const MathematicalProgram& program,
                                            const Host& host = Host::Default());

/// All backends that are there, ready or not, by id.
SWITCHYARD_EXPORT std::set<SolverId> GetKnownSolvers(const Host& host = Host::Default());
/// Those that are ready and take programs of a class, perhaps by bridges.
SWITCHYARD_EXPORT std::vector<SolverId> GetAvailableSolvers(ProgramType type,
                                                            const Host& host = Host::Default());
/// Throws InvalidArgument, with the nearest name, where no backend has that id or short name.
SWITCHYARD_EXPORT std::unique_ptr<SolverInterface> MakeSolver(const SolverId& id,
                                                              Host& host = Host::Default());
/// Of the first that is ready. Throws InvalidArgument with the state of each where none is.
SWITCHYARD_EXPORT std::unique_ptr<SolverInterface> MakeFirstAvailableSolver(
    const std::vector<SolverId>& ids, Host& host = Host::Default());

}  // namespace switchyard
