// switchyard/trajectory/piecewise_polynomial.hpp - a polynomial on each segment.
#pragma once

#include <vector>

#include "switchyard/trajectory/piecewise_trajectory.hpp"
#include "switchyard/trajectory/polynomial.hpp"

namespace switchyard {

/// On segment i, q(t) = sum_k C_ik (t - t_i)^k, t_i its start. Nothing makes it continuous but how
/// it is made.
template <class T>
class SWITCHYARD_EXPORT PiecewisePolynomial final : public PiecewiseTrajectory<T> {
 public:
  using PolynomialMatrix = Eigen::MatrixX<Polynomial<T>>;

  /// Without segments.
  PiecewisePolynomial() = default;
  /// Constant, from minus infinity to infinity.
  template <class Derived>
  explicit PiecewisePolynomial(const Eigen::MatrixBase<Derived>& constant_value)
      : PiecewisePolynomial(Constant(constant_value)) {}
  /// polynomials_matrix[i] is of t - breaks[i]. Throws InvalidArgument where there is not one break
  /// more than matrices, sizes differ, or breaks do not rise by kEpsilonTime. A segment from minus
  /// infinity on is of degree 0.
  PiecewisePolynomial(const std::vector<PolynomialMatrix>& polynomials_matrix,
                      const std::vector<T>& breaks);
  /// Of 1 x 1.
  PiecewisePolynomial(const std::vector<Polynomial<T>>& polynomials, const std::vector<T>& breaks);
  /// coefficients[i] has a column for each power of t - breaks[i], from 0: C_ik column by column,
  /// rows * cols numbers. Throws InvalidArgument as above.
  [[nodiscard]] static PiecewisePolynomial<T> FromCoefficients(
      int rows, int cols, std::vector<Eigen::MatrixX<T>> coefficients, std::vector<T> breaks);
  /// As FromCoefficients takes it.
  [[nodiscard]] const Eigen::MatrixX<T>& coefficients(int segment_number) const;

  /// Straight from sample to sample; samples are one matrix for each break, or the columns of one.
  /// Here and below: throws InvalidArgument where there is not one sample for each break, there are
  /// fewer than two, sizes differ, a break is not finite or they do not rise.
  [[nodiscard]] static PiecewisePolynomial<T> FirstOrderHold(
      const std::vector<T>& breaks, const std::vector<Eigen::MatrixX<T>>& samples);
  [[nodiscard]] static PiecewisePolynomial<T> FirstOrderHold(
      const Eigen::Ref<const Eigen::VectorX<T>>& breaks,
      const Eigen::Ref<const Eigen::MatrixX<T>>& samples);
  /// The cubics with these values and first derivatives at the breaks.
  [[nodiscard]] static PiecewisePolynomial<T> CubicHermite(
      const std::vector<T>& breaks, const std::vector<Eigen::MatrixX<T>>& samples,
      const std::vector<Eigen::MatrixX<T>>& samples_dot);
  /// The cubics with these values, continuous first derivatives, and monotone in each entry where
  /// the samples are. Slopes at inner breaks: 0 where the data turn, else the weighted harmonic
  /// mean of the slopes at both sides (Fritsch and Butland 1984); at the ends a formula of three
  /// points, cut back to keep the shape (Moler, Numerical Computing with MATLAB, 3.4), or 0 with
  /// zero_end_point_derivatives, which two breaks are enough for. Else throws InvalidArgument for
  /// fewer than three.
  [[nodiscard]] static PiecewisePolynomial<T> CubicShapePreserving(
      const std::vector<T>& breaks, const std::vector<Eigen::MatrixX<T>>& samples,
      bool zero_end_point_derivatives = false);
  [[nodiscard]] static PiecewisePolynomial<T> CubicShapePreserving(
      const Eigen::Ref<const Eigen::VectorX<T>>& breaks,
      const Eigen::Ref<const Eigen::MatrixX<T>>& samples, bool zero_end_point_derivatives = false);

  [[nodiscard]] std::string Kind() const override { return "piecewise polynomial"; }
  [[nodiscard]] PiecewisePolynomial<T> derivative(int derivative_order = 1) const;
  /// The continuous antiderivative with this value at start_time(), a number standing for a matrix
  /// of it. Throws InvalidArgument where the start is not finite, or sizes differ.
  [[nodiscard]] PiecewisePolynomial<T> integral(const T& value_at_start_time = 0.0) const;
  [[nodiscard]] PiecewisePolynomial<T> integral(
      const Eigen::Ref<const Eigen::MatrixX<T>>& value_at_start_time) const;
  /// The same entries, column by column, as a matrix of another shape. Throws InvalidArgument where
  /// rows * cols is not the number of entries.
  void Reshape(int rows, int cols);
  /// Throws InvalidArgument where the block is not inside.
  [[nodiscard]] PiecewisePolynomial Block(int start_row, int start_col, int block_rows,
                                          int block_cols) const;

 private:
  PiecewisePolynomial(int rows, int cols, std::vector<Eigen::MatrixX<T>> coefficients,
                      std::vector<T> breaks);
  [[nodiscard]] static PiecewisePolynomial<T> Constant(
      const Eigen::Ref<const Eigen::MatrixX<T>>& constant_value);
  [[nodiscard]] std::unique_ptr<Trajectory<T>> DoClone() const override;
  [[nodiscard]] Eigen::MatrixX<T> do_value(const T& t) const override;
  [[nodiscard]] bool do_has_derivative() const override { return true; }
  [[nodiscard]] Eigen::MatrixX<T> DoEvalDerivative(const T& t, int derivative_order) const override;
  [[nodiscard]] std::unique_ptr<Trajectory<T>> DoMakeDerivative(
      int derivative_order) const override;
  [[nodiscard]] std::unique_ptr<Trajectory<T>> DoStartingAt(const T& time) const override;
  [[nodiscard]] Eigen::Index do_rows() const override;
  [[nodiscard]] Eigen::Index do_cols() const override;

  int rows_ = 0;
  int cols_ = 0;
  std::vector<Eigen::MatrixX<T>> coefficients_;  // rows * cols x (degree + 1), by segment
};

extern template class PiecewisePolynomial<double>;

}  // namespace switchyard
