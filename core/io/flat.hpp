// core/io/flat.hpp - a program's bindings put together over all of its variables: what writers say.
#pragma once

#include <string>
#include <vector>

#include "core/io/text.hpp"
#include "switchyard/model/program.hpp"

namespace switchyard::io {

/// minimize (or maximize) 1/2 x'Qx + c'x + constant subject to lower <= x <= upper and
/// row_lower <= Ax <= row_upper; cones, norms, functions and quadratic constraints aside. Of a
/// binary variable the bounds are within [0, 1].
struct FlatProgram {
  Eigen::VectorXd lower;
  Eigen::VectorXd upper;
  Eigen::VectorXd c;
  double constant = 0;
  SparseMatrix Q;
  SparseMatrix A;
  std::vector<double> row_lower;
  std::vector<double> row_upper;
  std::vector<std::string> row_names;  // "" where there is none
};

FlatProgram Flattened(const MathematicalProgram& program);

/// The indices of a binding's variables.
template <class C>
std::vector<int> IndicesOf(const MathematicalProgram& program, const Binding<C>& binding) {
  return program.FindDecisionVariableIndices(binding.variables());
}

/// The shortest text that reads back to the same number.
void AppendNumber(double value, std::string* text);

/// How often each kind of term is there that only program/1 holds, in words: costs that are norms
/// or functions, constraints that are functions or quadratic forms. None where there is none.
std::vector<std::string> OtherTermsInWords(const MathematicalProgram& program);

}  // namespace switchyard::io
