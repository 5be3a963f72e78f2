// core/problem/vectors.hpp - vectors over one problem: a point with its duals, or a ray.
#pragma once

#include <vector>

namespace switchyard {

/// Empty: not there.
struct Vectors {
  std::vector<double> x;
  std::vector<double> x_dual;
  std::vector<double> row_dual;
  std::vector<double> cone_dual;
  std::vector<double> nlp_dual = {};
};

}  // namespace switchyard
