// switchyard/trajectory/bezier_curve.hpp - a polynomial by its control points.
#pragma once

#include <Eigen/SparseCore>
#include <optional>

#include "switchyard/symbolic/expression.hpp"
#include "switchyard/trajectory/trajectory.hpp"

namespace switchyard {

/// The sparse M_k of (order + 1) x (order + 1 - k): for control points P by columns, those of
/// d^k r / ds^k of r(s) = sum_i P_i B_i(s), s in [0, 1], are P M_k. No duration is in it. Entry
/// (i + j, i) is order! / (order - k)! (-1)^(k - j) binomial(k, j), by k-fold forward differences
/// (Farin, Curves and Surfaces for CAGD, 5.3). Where k > order the derivative is zero and has no
/// control points: (order + 1) x 0. Throws InvalidArgument where order < 0 or k < 0.
SWITCHYARD_EXPORT Eigen::SparseMatrix<double> BezierDerivativeMap(int order, int k);

/// q(t) = sum_i P_i B_i(s), s = (t - start) / (end - start), with the Bernstein polynomials
/// B_i(s) = binomial(m, i) s^i (1 - s)^(m - i) of order m. The value is in the convex hull of the
/// control points P_i, the first and last of which are its ends.
template <class T>
class SWITCHYARD_EXPORT BezierCurve final : public Trajectory<T> {
 public:
  /// One point of R^0, over [0, 1].
  BezierCurve();
  /// Control points by columns, order + 1 of them. Throws InvalidArgument where there is none, a
  /// time is not finite, or end_time is not after start_time.
  BezierCurve(double start_time, double end_time,
              const Eigen::Ref<const Eigen::MatrixX<T>>& control_points);

  [[nodiscard]] std::string Kind() const override { return "Bezier curve"; }
  [[nodiscard]] int order() const { return static_cast<int>(control_points_.cols()) - 1; }
  /// B_i at `time`, of another order where one is given. Throws InvalidArgument where i is not from
  /// 0 to that order.
  [[nodiscard]] T BernsteinBasis(int i, const T& time,
                                 std::optional<int> order = std::nullopt) const;
  [[nodiscard]] const Eigen::MatrixX<T>& control_points() const { return control_points_; }
  /// A with MakeDerivative(k)->control_points() = control_points() A: BezierDerivativeMap(order(),
  /// k) / (end_time() - start_time())^k, the derivative being by time. (order() + 1) x 0 where
  /// k > order(). Throws InvalidArgument where k < 0.
  [[nodiscard]] Eigen::SparseMatrix<double> AsLinearInControlPoints(int derivative_order = 1) const;
  /// The value as polynomials of `time`, which is not kept within the curve's times. Without an
  /// argument: of a new variable, which the expressions name.
  [[nodiscard]] Eigen::VectorX<Expression> GetExpression(Variable time) const;
  [[nodiscard]] Eigen::VectorX<Expression> GetExpression() const;
  /// The same curve by one control point more.
  void ElevateOrder();

 private:
  [[nodiscard]] std::unique_ptr<Trajectory<T>> DoClone() const override;
  [[nodiscard]] Eigen::MatrixX<T> do_value(const T& t) const override;
  [[nodiscard]] bool do_has_derivative() const override { return true; }
  [[nodiscard]] Eigen::MatrixX<T> DoEvalDerivative(const T& t, int derivative_order) const override;
  [[nodiscard]] std::unique_ptr<Trajectory<T>> DoMakeDerivative(
      int derivative_order) const override;
  [[nodiscard]] std::unique_ptr<Trajectory<T>> DoStartingAt(const T& time) const override;
  [[nodiscard]] Eigen::Index do_rows() const override { return control_points_.rows(); }
  [[nodiscard]] Eigen::Index do_cols() const override { return 1; }
  [[nodiscard]] T do_start_time() const override { return start_time_; }
  [[nodiscard]] T do_end_time() const override { return end_time_; }
  // s of a time, within [0, 1].
  [[nodiscard]] T Parameter(const T& time) const;
  [[nodiscard]] Eigen::MatrixX<T> DerivativeControlPoints(int derivative_order) const;

  double start_time_ = 0;
  double end_time_ = 1;
  Eigen::MatrixX<T> control_points_;
};

extern template class BezierCurve<double>;

}  // namespace switchyard
