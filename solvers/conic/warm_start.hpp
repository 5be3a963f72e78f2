// solvers/conic/warm_start.hpp - what is known of the solution of a problem like the one at hand.
#pragma once

#include "solvers/conic/form.hpp"
#include "solvers/conic/iterate.hpp"
#include "solvers/presolve/answer.hpp"

namespace switchyard::conic {

/// A point and its duals as an iterate, s and z on the boundary of their cones or inside. Cones
/// must be symmetric.
Iterate AsIterate(const presolve::Answer& answer, const Form& form);

/// An iterate of one form as one of another of the same pattern: in its units.
Iterate Carried(const Iterate& at, const Form& from, const Form& to);

}  // namespace switchyard::conic
