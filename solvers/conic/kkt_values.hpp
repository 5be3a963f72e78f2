// solvers/conic/kkt_values.hpp - the numbers of the matrix of a step's equations.
#pragma once

#include <vector>

#include "solvers/conic/form.hpp"
#include "solvers/conic/kkt_plan.hpp"
#include "solvers/linalg/twofold.hpp"

namespace switchyard::conic {

/// What the equations weigh at the current scaling: (H + r)^-1 and r.
struct KktWeights {
  double proximal = 0;  // r
  double uncurved = 0;  // in its place, for variables without a curvature of their own
  Vector slack;         // of the slacks behind the cones
  Vector cone_row;      // of cones' rows: the diagonal part
  struct Part {
    Vector v, w;  // the rest: see cones::Group::Inverse
  };
  std::vector<Part> cones;  // of each part of the product
};

/// Adds to one for each entry of the plan's pattern what weighs. Twofold ones are the sums of
/// products of doubles that they stand for, to all their digits.
void FillValues(const Form& form, const KktPlan& plan, const KktWeights& weights,
                const linalg::NumbersOf<double>& value);
void FillTwofoldValues(const Form& form, const KktPlan& plan, const KktWeights& weights,
                       const linalg::NumbersOf<double>& value);

}  // namespace switchyard::conic
