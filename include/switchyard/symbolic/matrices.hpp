// switchyard/symbolic/matrices.hpp - matrices of variables and expressions: products, sums,
// comparisons entry by entry, values.
//
// Sums, differences, multiples, dot products and norms are Eigen's own, by eigen_traits.hpp. What
// stands here takes the exact types of its operands, so that it is chosen before Eigen's members.
#pragma once

#include <Eigen/SparseCore>
#include <concepts>
#include <type_traits>
#include <vector>

#include "switchyard/error.hpp"
#include "switchyard/symbolic/expression.hpp"
#include "switchyard/symbolic/formula.hpp"

namespace switchyard {

namespace matrices {

template <class T>
concept Symbol = std::same_as<T, Variable> || std::same_as<T, Expression>;
template <class T>
concept Entry = Symbol<T> || std::same_as<T, double>;

template <class Derived>
void TakeMatrix(const Eigen::MatrixBase<Derived>&);
template <class Derived>
void TakeArray(const Eigen::ArrayBase<Derived>&);
template <class Derived>
void TakeSparse(const Eigen::SparseMatrixBase<Derived>&);
template <class T>
concept Matrix = requires(const T& t) {
  TakeMatrix(t);
}
&&Entry<typename T::Scalar>;
template <class T>
concept Array = requires(const T& t) {
  TakeArray(t);
}
&&Entry<typename T::Scalar>;
template <class T>
concept SparseNumbers = requires(const T& t) {
  TakeSparse(t);
}
&&std::same_as<typename T::Scalar, double>;

// Two of a kind, at least one of them symbolic.
template <class A, class B>
concept MatrixPair = Matrix<A> && Matrix<B> &&
    (Symbol<typename A::Scalar> || Symbol<typename B::Scalar>);
template <class A, class B>
concept ArrayPair = Array<A> && Array<B> &&
    (Symbol<typename A::Scalar> || Symbol<typename B::Scalar>);
template <class A, class B>
concept ArrayAndScalar = Array<A> && std::convertible_to<B, Expression> && !Matrix<B> &&
                         (Symbol<typename A::Scalar> || !std::is_arithmetic_v<B>);

template <class A, class B>
using Product = Eigen::Matrix<Expression, A::RowsAtCompileTime, B::ColsAtCompileTime>;

// What costs something for each entry, evaluated once; else the thing itself. By derived(), since a
// segment of a vector is a class of its own that Eigen evaluates as its base.
template <class A>
using Evaluated = typename Eigen::internal::nested_eval<
    std::remove_cvref_t<decltype(std::declval<const A&>().derived())>, 8>::type;

// sum += a * b.
inline void AddProduct(double a, Variable b, Expression* sum) {
  if (a != 0) sum->Add(a, b);
}
inline void AddProduct(double a, const Expression& b, Expression* sum) {
  if (a != 0) sum->Add(a, b);
}
template <Symbol S>
void AddProduct(const S& a, double b, Expression* sum) {
  AddProduct(b, a, sum);
}
template <Symbol S, Symbol T>
void AddProduct(const S& a, const T& b, Expression* sum) {
  *sum += Expression(a) * Expression(b);
}

// The sums of a product get their room at once: as many terms as the row of A has entries.
template <class A, class P>
void ReserveRows(const A& a, P* product) {
  std::vector<std::size_t> count(static_cast<std::size_t>(a.rows()), 0);
  for (Eigen::Index k = 0; k < a.cols(); ++k) {
    for (Eigen::Index i = 0; i < a.rows(); ++i) count[static_cast<std::size_t>(i)] += a(i, k) != 0;
  }
  for (Eigen::Index j = 0; j < product->cols(); ++j) {
    for (Eigen::Index i = 0; i < a.rows(); ++i) {
      (*product)(i, j).Reserve(count[static_cast<std::size_t>(i)]);
    }
  }
}

template <class A, class B>
void RequireSameSize(const A& a, const B& b, const char* what) {
  Require(a.rows() == b.rows() && a.cols() == b.cols(), "a ", a.rows(), " x ", a.cols(), " ", what,
          " compared with one of ", b.rows(), " x ", b.cols());
}

// The comparison of each pair of entries, column by column.
template <class A, class B>
Eigen::Array<Formula, A::RowsAtCompileTime, A::ColsAtCompileTime> Compared(Formula::Kind kind,
                                                                           const A& a, const B& b) {
  RequireSameSize(a, b, "array");
  Eigen::Array<Formula, A::RowsAtCompileTime, A::ColsAtCompileTime> compared(a.rows(), a.cols());
  for (Eigen::Index j = 0; j < a.cols(); ++j) {
    for (Eigen::Index i = 0; i < a.rows(); ++i) {
      compared(i, j) = Formula(kind, Expression(a(i, j)), Expression(b(i, j)));
    }
  }
  return compared;
}

// The value at every place of an array.
template <class S, class A>
auto Repeated(const S& value, const A& like) {
  using Array = Eigen::Array<Expression, A::RowsAtCompileTime, A::ColsAtCompileTime>;
  return Array::Constant(like.rows(), like.cols(), Expression(value));
}

// All entries compare so.
template <class A, class B>
Formula AllCompared(Formula::Kind kind, const A& a, const B& b) {
  RequireSameSize(a, b, "matrix");
  std::vector<Formula> formulas;
  formulas.reserve(static_cast<std::size_t>(a.size()));
  for (Eigen::Index j = 0; j < a.cols(); ++j) {
    for (Eigen::Index i = 0; i < a.rows(); ++i) {
      formulas.emplace_back(kind, Expression(a(i, j)), Expression(b(i, j)));
    }
  }
  return Formula::All(formulas);
}

}  // namespace matrices

/// The matrix product, one sum for each entry; zeros of a matrix of numbers give no term.
template <class A, class B>
requires matrices::MatrixPair<A, B> matrices::Product<A, B>
operator*(const A& left, const B& right) {
  Require(left.cols() == right.rows(), "a product of a ", left.rows(), " x ", left.cols(),
          " matrix with one of ", right.rows(), " x ", right.cols());
  const matrices::Evaluated<A> a(left.derived());
  const matrices::Evaluated<B> b(right.derived());
  matrices::Product<A, B> product(left.rows(), right.cols());
  if constexpr (std::same_as<typename A::Scalar, double>) matrices::ReserveRows(a, &product);
  for (Eigen::Index j = 0; j < product.cols(); ++j) {
    for (Eigen::Index k = 0; k < left.cols(); ++k) {
      for (Eigen::Index i = 0; i < product.rows(); ++i) {
        matrices::AddProduct(a(i, k), b(k, j), &product(i, j));
      }
    }
  }
  return product;
}

template <class A, class B>
requires(matrices::SparseNumbers<A>&& matrices::Matrix<B>&& matrices::Symbol<typename B::Scalar>)
    matrices::Product<A, B>
operator*(const A& left, const B& right) {
  Require(left.cols() == right.rows(), "a product of a ", left.rows(), " x ", left.cols(),
          " sparse matrix with one of ", right.rows(), " x ", right.cols());
  const Eigen::SparseMatrix<double> a(left);
  matrices::Product<A, B> product(left.rows(), right.cols());
  for (Eigen::Index j = 0; j < product.cols(); ++j) {
    for (Eigen::Index k = 0; k < a.outerSize(); ++k) {
      for (Eigen::SparseMatrix<double>::InnerIterator it(a, k); it; ++it) {
        matrices::AddProduct(it.value(), right(k, j), &product(it.row(), j));
      }
    }
  }
  return product;
}

/// Comparisons. Of arrays, and of an array with one value: an array of formulas. Of matrices: the
/// one formula that all pairs of entries compare so; for != that not all are equal.
#define SWITCHYARD_COMPARE_ARRAYS(sign, kind)                                           \
  template <class A, class B>                                                           \
  requires matrices::ArrayPair<A, B>                                                    \
  auto operator sign(const A& a, const B& b) { return matrices::Compared(kind, a, b); } \
  template <class A, class B>                                                           \
  requires matrices::ArrayAndScalar<A, B>                                               \
  auto operator sign(const A& a, const B& b) {                                          \
    return matrices::Compared(kind, a, matrices::Repeated(b, a));                       \
  }                                                                                     \
  template <class A, class B>                                                           \
  requires matrices::ArrayAndScalar<B, A>                                               \
  auto operator sign(const A& a, const B& b) {                                          \
    return matrices::Compared(kind, matrices::Repeated(a, b), b);                       \
  }
#define SWITCHYARD_COMPARE_MATRICES(sign, kind)                                       \
  template <class A, class B>                                                         \
  requires matrices::MatrixPair<A, B> Formula operator sign(const A& a, const B& b) { \
    return matrices::AllCompared(kind, a, b);                                         \
  }
SWITCHYARD_COMPARE_ARRAYS(==, Formula::Kind::kEqual)
SWITCHYARD_COMPARE_ARRAYS(!=, Formula::Kind::kNotEqual)
SWITCHYARD_COMPARE_ARRAYS(<=, Formula::Kind::kLessEqual)
SWITCHYARD_COMPARE_ARRAYS(>=, Formula::Kind::kGreaterEqual)
SWITCHYARD_COMPARE_ARRAYS(<, Formula::Kind::kLess)
SWITCHYARD_COMPARE_ARRAYS(>, Formula::Kind::kGreater)
SWITCHYARD_COMPARE_MATRICES(==, Formula::Kind::kEqual)
SWITCHYARD_COMPARE_MATRICES(<=, Formula::Kind::kLessEqual)
SWITCHYARD_COMPARE_MATRICES(>=, Formula::Kind::kGreaterEqual)
SWITCHYARD_COMPARE_MATRICES(<, Formula::Kind::kLess)
SWITCHYARD_COMPARE_MATRICES(>, Formula::Kind::kGreater)
#undef SWITCHYARD_COMPARE_ARRAYS
#undef SWITCHYARD_COMPARE_MATRICES
template <class A, class B>
requires matrices::MatrixPair<A, B> Formula operator!=(const A& a, const B& b) {
  return !matrices::AllCompared(Formula::Kind::kEqual, a, b);
}

/// The value of each entry.
template <class Derived>
requires std::same_as<typename Derived::Scalar, Expression>
    Eigen::Matrix<double, Derived::RowsAtCompileTime, Derived::ColsAtCompileTime> Evaluate(
        const Eigen::MatrixBase<Derived>& m, const Expression::Values& values = {}) {
  Eigen::Matrix<double, Derived::RowsAtCompileTime, Derived::ColsAtCompileTime> evaluated(m.rows(),
                                                                                          m.cols());
  for (Eigen::Index j = 0; j < m.cols(); ++j) {
    for (Eigen::Index i = 0; i < m.rows(); ++i) evaluated(i, j) = m(i, j).Evaluate(values);
  }
  return evaluated;
}

}  // namespace switchyard

namespace Eigen::internal {

/// The factor of a dot product of variables, whose product is not of their own type.
template <>
struct conj_helper<switchyard::Variable, switchyard::Variable, false, false> {
  static switchyard::Expression pmul(switchyard::Variable a, switchyard::Variable b) {
    return switchyard::Expression(a) * switchyard::Expression(b);
  }
};

/// Sums of entries append to one expression, where Eigen's own loop would copy it at each step.
template <class Evaluator>
struct redux_impl<scalar_sum_op<switchyard::Expression, switchyard::Expression>, Evaluator,
                  DefaultTraversal, NoUnrolling> {
  using Sum = scalar_sum_op<switchyard::Expression, switchyard::Expression>;
  template <class Xpr>
  static switchyard::Expression run(const Evaluator& evaluator, const Sum&, const Xpr& xpr) {
    switchyard::Expression sum;
    for (Index i = 0; i < xpr.outerSize(); ++i) {
      for (Index j = 0; j < xpr.innerSize(); ++j) sum += evaluator.coeffByOuterInner(i, j);
    }
    return sum;
  }
};

}  // namespace Eigen::internal
