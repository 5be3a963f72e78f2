// terms.hpp - short ways to write the terms of the suite's programs.
#pragma once

#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "switchyard/model/program.hpp"

namespace switchyard::testing {

using ProgramPtr = std::unique_ptr<MathematicalProgram>;

inline constexpr double kInf = std::numeric_limits<double>::infinity();

inline Eigen::VectorXd OneNumber(double value) { return Eigen::VectorXd::Constant(1, value); }

enum class Curvature { kAny, kConvex };

/// Rows f(x) <= upper, f(x) >= lower, f(x) = value; kConvex: the caller knows that they are convex.
template <class F>
void AddAtMost(MathematicalProgram& program, F f, double upper, const VariableList& x,
               Curvature curvature = Curvature::kAny) {
  program.AddConstraint(std::move(f), OneNumber(-kInf), OneNumber(upper), x,
                        {.is_convex = curvature == Curvature::kConvex});
}
template <class F>
void AddAtLeast(MathematicalProgram& program, F f, double lower, const VariableList& x,
                Curvature curvature = Curvature::kAny) {
  program.AddConstraint(std::move(f), OneNumber(lower), OneNumber(kInf), x,
                        {.is_convex = curvature == Curvature::kConvex});
}
template <class F>
void AddEqual(MathematicalProgram& program, F f, double value, const VariableList& x) {
  program.AddConstraint(std::move(f), OneNumber(value), OneNumber(value), x);
}

template <class F>
void AddConvexCost(MathematicalProgram& program, F f, const VariableList& x) {
  program.AddCost(std::move(f), x, {.is_convex = true});
}

/// Rows d'(x^2) + b'x <= upper, with d the squares' coefficients.
inline void AddSquaresAtMost(MathematicalProgram& program, const Eigen::VectorXd& squares,
                             const Eigen::VectorXd& linear, double upper, const VariableList& x) {
  program.AddQuadraticConstraint(Eigen::MatrixXd((2 * squares).asDiagonal()), linear, -kInf, upper,
                                 x);
}

}  // namespace switchyard::testing
