// solvers/presolve/split_cones.hpp - cones that are rows, and small cones taken apart.
#pragma once

#include <vector>

#include "switchyard/problem.hpp"

namespace switchyard::presolve {

/// Fx + g in K as rows, lower <= linear x <= upper, and other cones, conic x + g:
///   zero, nonnegative                     each row
///   second-order, order 1                 s_0 >= 0
///   second-order, order 2                 s_0 + s_1 >= 0, s_0 - s_1 >= 0
///   rotated, order 2                      s_0 >= 0, s_1 >= 0
///   semidefinite, order 1                 s_0 >= 0
///   semidefinite, order 2                 rotated: (a, sqrt 2 b, c) -> (a, c, sqrt 2 b)
///   others                                as they are
/// Cones that are off are not there. What is taken apart, and where entries may be, does not depend
/// on values.
struct ConesSplit {
  Csc linear;
  std::vector<double> lower, upper;
  std::vector<std::int32_t> source;  // of each linear row: a row of F that stands in it
  Csc conic;
  std::vector<double> g;
  std::vector<sy_cone> cones;
};
ConesSplit SplitCones(const ProblemData& problem);

/// From the duals of both to those of the problem's cones.
void ConeDualsBack(const ProblemData& problem, const double* linear, const double* conic,
                   std::vector<double>& cone_dual);

/// Of the problem's cones, the duals that the rows of `conic` have.
std::vector<double> ConicDuals(const ProblemData& problem, const std::vector<double>& cone_dual);

}  // namespace switchyard::presolve
