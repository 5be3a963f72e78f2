// switchyard/symbolic/eigen_traits.hpp - what Eigen needs to know of Variable and Expression as
// entries of matrices. Stands before both, so that no matrix of them is made without it.
#pragma once

#include <Eigen/Core>

namespace switchyard {

class Variable;
class Expression;

}  // namespace switchyard

namespace Eigen {

/// Numbers that stand beside variables are doubles, and whatever is computed is an expression.
template <>
struct NumTraits<switchyard::Expression> : GenericNumTraits<double> {
  using Real = switchyard::Expression;
  using NonInteger = switchyard::Expression;
  using Nested = switchyard::Expression;
  enum { RequireInitialization = 1, ReadCost = 10, AddCost = 100, MulCost = 100 };
  static constexpr int digits10() { return 0; }
};
template <>
struct NumTraits<switchyard::Variable> : NumTraits<switchyard::Expression> {
  using Nested = switchyard::Variable;
  enum { ReadCost = 1 };
};

template <class Op>
struct ScalarBinaryOpTraits<switchyard::Variable, double, Op> {
  using ReturnType = switchyard::Expression;
};
template <class Op>
struct ScalarBinaryOpTraits<double, switchyard::Variable, Op> {
  using ReturnType = switchyard::Expression;
};
template <class Op>
struct ScalarBinaryOpTraits<switchyard::Expression, double, Op> {
  using ReturnType = switchyard::Expression;
};
template <class Op>
struct ScalarBinaryOpTraits<double, switchyard::Expression, Op> {
  using ReturnType = switchyard::Expression;
};
template <class Op>
struct ScalarBinaryOpTraits<switchyard::Expression, switchyard::Variable, Op> {
  using ReturnType = switchyard::Expression;
};
template <class Op>
struct ScalarBinaryOpTraits<switchyard::Variable, switchyard::Expression, Op> {
  using ReturnType = switchyard::Expression;
};
/// Of two variables arithmetic alone gives an expression: what else Eigen does with them (choosing,
/// comparing) gives one.
template <>
struct ScalarBinaryOpTraits<switchyard::Variable, switchyard::Variable,
                            internal::scalar_sum_op<switchyard::Variable>> {
  using ReturnType = switchyard::Expression;
};
template <>
struct ScalarBinaryOpTraits<switchyard::Variable, switchyard::Variable,
                            internal::scalar_difference_op<switchyard::Variable>> {
  using ReturnType = switchyard::Expression;
};
template <>
struct ScalarBinaryOpTraits<
    switchyard::Variable, switchyard::Variable,
    internal::scalar_product_op<switchyard::Variable, switchyard::Variable>> {
  using ReturnType = switchyard::Expression;
};
template <>
struct ScalarBinaryOpTraits<
    switchyard::Variable, switchyard::Variable,
    internal::scalar_conj_product_op<switchyard::Variable, switchyard::Variable>> {
  using ReturnType = switchyard::Expression;
};
template <>
struct ScalarBinaryOpTraits<switchyard::Variable, switchyard::Variable,
                            internal::scalar_quotient_op<switchyard::Variable>> {
  using ReturnType = switchyard::Expression;
};

}  // namespace Eigen
