// plan.hpp - which algorithms a search goes through.
#pragma once

#include <vector>

#include "options.hpp"
#include "program.hpp"
#include "run.hpp"

namespace switchyard::nlopt {

/// The run that the options ask for. Throws Failure where its algorithm cannot take the program:
/// it asks for derivatives that are not there, or for a finite box.
Order FirstOrder(const Options& options, Program& program);

/// What is tried from where that led, by derivatives, one after the other, until a point passes.
std::vector<Order> LaterOrders(const Options& options, const Order& first, Program& program);

/// Without derivatives, from the x where `before` led: with a first step that is short beside x.
/// Where a search has converged, it stays. LN_COBYLA, where `before` failed or is global.
Order AgainOrder(const Options& options, const Order& before, bool failed,
                 const std::vector<double>& x, Program& program);

/// Towards the constraints, whatever the objective.
Order FeasibilityOrder(Program& program);

}  // namespace switchyard::nlopt
