// switchyard/trajectory/bspline_basis.hpp - piecewise polynomials that are nonnegative and sum
// to 1.
#pragma once

#include <Eigen/SparseCore>
#include <array>
#include <type_traits>
#include <vector>

#include "switchyard/error.hpp"
#include "switchyard/export.hpp"

namespace switchyard {

enum class KnotVectorType {
  kUniform,         // all intervals are of one length, those outside of the parameters too
  kClampedUniform,  // likewise inside; the first and the last knot stand `order` times
};

/// The basis functions B_i, i < n, of one order k (degree k - 1) on knots t_0 <= ... <= t_{n+k-1}.
/// B_i is positive within (t_i, t_{i+k}) and zero outside. Parameters are from t_{k-1} to t_n;
/// where a function takes another, it takes the nearest of these. At a knot the interval behind it
/// counts, at t_n the last one that is not empty.
///
/// The recurrence is that of Cox and de Boor; here each function of degree d - 1 hands the part
/// (t - t_i) / (t_{i+d} - t_i) of its value to the function of degree d that starts where it does,
/// and the rest to the one before: sums of nonnegative numbers alone. (Piegl and Tiller, The NURBS
/// Book, 2.5, arrange the same in another way.)
template <class T>
class SWITCHYARD_EXPORT BsplineBasis final {
  static_assert(std::is_same_v<T, double>, "a B-spline basis has T = double");

 public:
  /// The functions that are not zero on one interval: weights(i) is that of first + i.
  struct Active {
    int first = 0;
    Eigen::VectorX<T> weights;  // order() of them
  };

  /// One function of order 1 on the knots 0, 1.
  BsplineBasis();
  /// Throws InvalidArgument where order < 1, there are fewer than 2 * order knots, one is not
  /// finite or below the one before, or the parameters are a single one.
  BsplineBasis(int order, std::vector<T> knots);
  /// Throws InvalidArgument where order < 1, there are fewer functions than order, or the final
  /// parameter is not above the initial one.
  BsplineBasis(int order, int num_basis_functions,
               KnotVectorType type = KnotVectorType::kClampedUniform,
               const T& initial_parameter_value = 0, const T& final_parameter_value = 1);

  [[nodiscard]] int order() const { return order_; }
  [[nodiscard]] int degree() const { return order_ - 1; }
  [[nodiscard]] int num_basis_functions() const { return static_cast<int>(knots_.size()) - order_; }
  [[nodiscard]] const std::vector<T>& knots() const { return knots_; }
  [[nodiscard]] const T& initial_parameter_value() const { return knot(order_ - 1); }
  [[nodiscard]] const T& final_parameter_value() const { return knot(num_basis_functions()); }

  /// The i with t_i <= t < t_{i+1}; at the final parameter with t_i < t <= t_{i+1}. Throws
  /// InvalidArgument where t is no parameter.
  [[nodiscard]] int FindContainingInterval(const T& parameter_value) const;
  /// The functions that are not zero at some t with interval[0] <= t <= interval[1], and those
  /// alone but for knots, where one that vanishes may be among them. Throw InvalidArgument where an
  /// end is no parameter or the ends are in the wrong order.
  [[nodiscard]] std::vector<int> ComputeActiveBasisFunctionIndices(
      const std::array<T, 2>& parameter_interval) const;
  [[nodiscard]] std::vector<int> ComputeActiveBasisFunctionIndices(const T& parameter_value) const;

  /// sum_i B_i(t) control_points[i], for numbers, vectors, matrices, and those of expressions.
  /// Throws InvalidArgument where there is not one control point for each function.
  template <class T_control_point>
  [[nodiscard]] T_control_point EvaluateCurve(const std::vector<T_control_point>& control_points,
                                              const T& parameter_value) const {
    Require(control_points.size() == static_cast<std::size_t>(num_basis_functions()),
            "EvaluateCurve needs ", num_basis_functions(),
            " control points, one for each basis function, got ", control_points.size());
    const Active active = ActiveAt(parameter_value);
    const auto* const points = control_points.data() + active.first;
    T_control_point point = active.weights(0) * points[0];
    for (int i = 1; i < order_; ++i) point += active.weights(i) * points[i];
    return point;
  }
  /// (B_0(t), ..., B_{n-1}(t)), or their derivatives of an order >= 0: the curve of control points
  /// P by columns, or its derivative, is P times that.
  [[nodiscard]] Eigen::VectorX<T> EvaluateLinearInControlPoints(const T& parameter_value,
                                                                int derivative_order = 0) const;
  /// Throws InvalidArgument where there is no such function.
  [[nodiscard]] T EvaluateBasisFunctionI(int i, const T& parameter_value) const;
  /// The entries of EvaluateLinearInControlPoints that are not zero for their index.
  [[nodiscard]] Active ActiveAt(const T& parameter_value, int derivative_order = 0) const;

  /// M_j of n x (n - j): the control points of the j-th derivative are P M_j, in the basis
  /// DerivativeBasis(j). It is the product of stages, the i-th column of stage s with -a and a in
  /// rows i and i + 1, a = (order - s) / (t_{i+order} - t_{i+s}), 0 where the knots are one (de
  /// Boor, A Practical Guide to Splines, X). n x 0 where j >= order: the derivative is zero.
  [[nodiscard]] Eigen::SparseMatrix<T> DerivativeMap(int derivative_order) const;
  /// Of order() - j, without j knots at either end. Throws InvalidArgument where j >= order().
  [[nodiscard]] BsplineBasis DerivativeBasis(int derivative_order) const;

  /// The same order and equal knots.
  [[nodiscard]] bool operator==(const BsplineBasis& other) const = default;

 private:
  [[nodiscard]] const T& knot(int i) const { return knots_[static_cast<std::size_t>(i)]; }

  int order_ = 1;
  std::vector<T> knots_;
};

extern template class BsplineBasis<double>;

}  // namespace switchyard
