// solvers/presolve/answer.hpp - a point and its duals, over a problem of abi.h.
#pragma once

#include <vector>

namespace switchyard::presolve {

/// What vectors of an Answer are. Of a certificate (see sy_result) only its own side is meant.
enum class Meaning { kOptimum, kRay, kContradiction };

struct Answer {
  std::vector<double> x, x_dual, row_dual, cone_dual;
  Meaning meaning = Meaning::kOptimum;
};

}  // namespace switchyard::presolve
