// switchyard/trajectory/bspline_trajectory.hpp - a curve of B-splines, whose parameter is the time.
#pragma once

#include <functional>
#include <vector>

#include "switchyard/trajectory/bspline_basis.hpp"
#include "switchyard/trajectory/trajectory.hpp"

namespace switchyard {

/// q(t) = sum_i P_i B_i(t), the control points P_i matrices of one size. The value is in the convex
/// hull of the order() control points whose functions are not zero there.
template <class T>
class SWITCHYARD_EXPORT BsplineTrajectory final : public Trajectory<T> {
 public:
  /// One point of R^0, over [0, 1].
  BsplineTrajectory();
  /// Throws InvalidArgument where there is not one control point for each basis function, or their
  /// sizes differ.
  BsplineTrajectory(BsplineBasis<T> basis, std::vector<Eigen::MatrixX<T>> control_points);

  [[nodiscard]] std::string Kind() const override { return "B-spline trajectory"; }
  /// A of num_control_points() x (num_control_points() - k): the control points of
  /// MakeDerivative(k), written as columns, are those of this times A. No columns where k is the
  /// basis' order or more: that derivative is zero, and MakeDerivative has one control point.
  [[nodiscard]] Eigen::SparseMatrix<T> AsLinearInControlPoints(int derivative_order = 1) const;
  /// a(t) with EvalDerivative(t, k) = sum_i a_i P_i.
  [[nodiscard]] Eigen::VectorX<T> EvaluateLinearInControlPoints(const T& t,
                                                                int derivative_order = 0) const;
  [[nodiscard]] int num_control_points() const { return basis_.num_basis_functions(); }
  [[nodiscard]] const std::vector<Eigen::MatrixX<T>>& control_points() const {
    return control_points_;
  }
  [[nodiscard]] Eigen::MatrixX<T> InitialValue() const { return this->value(this->start_time()); }
  [[nodiscard]] Eigen::MatrixX<T> FinalValue() const { return this->value(this->end_time()); }
  [[nodiscard]] const BsplineBasis<T>& basis() const { return basis_; }

  /// The same curve on more knots (Boehm 1980; Piegl and Tiller, The NURBS Book, 5.2), in any
  /// order. Throws InvalidArgument where one is not from start_time() to end_time().
  void InsertKnots(const std::vector<T>& additional_knots);
  /// The curve of the control points select(P_i). Throws InvalidArgument where their sizes differ.
  [[nodiscard]] BsplineTrajectory<T> CopyWithSelector(
      const std::function<Eigen::MatrixX<T>(const Eigen::MatrixX<T>&)>& select) const;
  /// Throws InvalidArgument where the block is not inside.
  [[nodiscard]] BsplineTrajectory<T> CopyBlock(int start_row, int start_col, int block_rows,
                                               int block_cols) const;
  /// The first n rows. Throws InvalidArgument where there is more than one column.
  [[nodiscard]] BsplineTrajectory<T> CopyHead(int n) const;
  /// Equal bases and equal control points.
  [[nodiscard]] bool operator==(const BsplineTrajectory<T>& other) const;

 private:
  [[nodiscard]] std::unique_ptr<Trajectory<T>> DoClone() const override;
  [[nodiscard]] Eigen::MatrixX<T> do_value(const T& t) const override;
  [[nodiscard]] bool do_has_derivative() const override { return true; }
  [[nodiscard]] Eigen::MatrixX<T> DoEvalDerivative(const T& t, int derivative_order) const override;
  [[nodiscard]] std::unique_ptr<Trajectory<T>> DoMakeDerivative(
      int derivative_order) const override;
  [[nodiscard]] std::unique_ptr<Trajectory<T>> DoStartingAt(const T& time) const override;
  [[nodiscard]] Eigen::Index do_rows() const override { return control_points_[0].rows(); }
  [[nodiscard]] Eigen::Index do_cols() const override { return control_points_[0].cols(); }
  [[nodiscard]] T do_start_time() const override { return basis_.initial_parameter_value(); }
  [[nodiscard]] T do_end_time() const override { return basis_.final_parameter_value(); }
  void InsertKnot(const T& knot);

  BsplineBasis<T> basis_;
  std::vector<Eigen::MatrixX<T>> control_points_;
};

extern template class BsplineTrajectory<double>;

}  // namespace switchyard
