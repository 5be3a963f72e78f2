// core/io/cbf_layout.hpp - which variables of a program CBF has as scalars, which in matrices.
#pragma once

#include <vector>

#include "core/io/cbf_cones.hpp"
#include "switchyard/model/program.hpp"

namespace switchyard::io {

/// Where a variable is: scalar number `scalar`, or place (a, b), a >= b, of a matrix of PSDVAR.
struct CbfPlace {
  int scalar = -1;
  int matrix = -1;
  int a = 0;
  int b = 0;
  /// The entry that gives the variable the factor `value`: <C, X> counts (a, b) and (b, a).
  [[nodiscard]] double Share(double value) const { return a == b ? value : value / 2; }
};

/// A matrix of variables that is semidefinite becomes a matrix of PSDVAR where its variables are
/// continuous, one for each pair of places, and in no other semidefinite constraint: matrices of
/// PSDCON are made of scalars. All other variables are scalars, in the program's order.
class CbfLayout {
 public:
  explicit CbfLayout(const MathematicalProgram& program);

  [[nodiscard]] const CbfPlace& place(int variable) const {
    return places_[static_cast<std::size_t>(variable)];
  }
  [[nodiscard]] bool IsMatrixVariable(const Binding<ConeConstraint>& binding) const;
  [[nodiscard]] const std::vector<int>& matrix_sizes() const { return matrix_sizes_; }
  [[nodiscard]] int num_scalars() const { return num_scalars_; }
  /// Does a reader number the variables otherwise than the program?
  [[nodiscard]] bool reordered() const { return reordered_; }

 private:
  std::vector<CbfPlace> places_;
  std::vector<Binding<ConeConstraint>> matrices_;
  std::vector<int> matrix_sizes_;
  int num_scalars_ = 0;
  bool reordered_ = false;
};

}  // namespace switchyard::io
