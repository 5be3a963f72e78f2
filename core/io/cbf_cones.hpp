// core/io/cbf_cones.hpp - the one table of the cones of CBF.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include "switchyard/model/program.hpp"

namespace switchyard::io {

/// z[to] gets factor * x[from], where x is in the cone as CBF has it and z as the program has it.
struct CbfLink {
  int to;
  int from;
  double factor;
};

/// A linear cone is a box [lower, upper] for each entry; another is a constraint of the program on
/// z = Tx, whose T `links` gives. alpha is the share of the first entry of a power cone.
struct CbfConeFacts {
  std::string_view name;
  bool linear;
  double lower;
  double upper;
  int least_size;
  int most_size;
  bool parametric;  // "@k:NAME"
  std::vector<CbfLink> (*links)(int size, double alpha);
  void (*add)(MathematicalProgram* program, SparseMatrix A, const Eigen::VectorXd& b, double alpha,
              const VectorXDecisionVariable& x);
};

extern const std::array<CbfConeFacts, 10> kCbfCones;

/// nullptr: there is none.
const CbfConeFacts* FindCbfCone(std::string_view name);

}  // namespace switchyard::io
