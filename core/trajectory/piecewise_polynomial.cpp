#include "switchyard/trajectory/piecewise_polynomial.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/trajectory/powers.hpp"

namespace switchyard {
namespace {

// Entry (i, j) of the matrix of polynomials in row i + j rows.
template <class T>
Eigen::MatrixX<T> CoefficientsOf(const Eigen::MatrixX<Polynomial<T>>& polynomials) {
  Eigen::Index powers = 1;
  for (Eigen::Index i = 0; i < polynomials.size(); ++i) {
    powers = std::max<Eigen::Index>(powers, polynomials.data()[i].GetCoefficients().size());
  }
  Eigen::MatrixX<T> coefficients = Eigen::MatrixX<T>::Zero(polynomials.size(), powers);
  for (Eigen::Index i = 0; i < polynomials.size(); ++i) {
    const Eigen::VectorX<T>& entry = polynomials.data()[i].GetCoefficients();
    coefficients.row(i).head(entry.size()) = entry;
  }
  return coefficients;
}

template <class T>
std::vector<Eigen::MatrixX<T>> CoefficientsOf(
    const std::vector<Eigen::MatrixX<Polynomial<T>>>& polynomials) {
  std::vector<Eigen::MatrixX<T>> coefficients;
  coefficients.reserve(polynomials.size());
  for (const auto& segment : polynomials) {
    Require(segment.rows() == polynomials[0].rows() && segment.cols() == polynomials[0].cols(),
            "polynomials: segment ", coefficients.size(), " needs to be ", polynomials[0].rows(),
            " x ", polynomials[0].cols(), " as the first, got ", segment.rows(), " x ",
            segment.cols());
    coefficients.push_back(CoefficientsOf<T>(segment));
  }
  return coefficients;
}

template <class T>
std::vector<Eigen::MatrixX<T>> CoefficientsOf(const std::vector<Polynomial<T>>& polynomials) {
  std::vector<Eigen::MatrixX<T>> coefficients;
  coefficients.reserve(polynomials.size());
  for (const auto& one : polynomials) coefficients.emplace_back(one.GetCoefficients().transpose());
  return coefficients;
}

template <class T>
void CheckSamples(const std::vector<T>& breaks, const std::vector<Eigen::MatrixX<T>>& samples,
                  std::size_t least, const char* what) {
  Require(breaks.size() >= least, "breaks: ", least, " or more are needed, got ", breaks.size());
  Require(samples.size() == breaks.size(), what, ": ", breaks.size(),
          " are needed, one for each break, got ", samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    Require(std::isfinite(breaks[i]), "breaks: breaks[", i, "] needs to be finite, got ",
            breaks[i]);
    Require(samples[i].rows() == samples[0].rows() && samples[i].cols() == samples[0].cols(), what,
            ": number ", i, " needs to be ", samples[0].rows(), " x ", samples[0].cols(),
            " as the first, got ", samples[i].rows(), " x ", samples[i].cols());
  }
}

template <class T>
std::vector<T> Listed(const Eigen::Ref<const Eigen::VectorX<T>>& numbers) {
  return {numbers.data(), numbers.data() + numbers.size()};
}

template <class T>
std::vector<Eigen::MatrixX<T>> Columns(const Eigen::Ref<const Eigen::MatrixX<T>>& samples) {
  std::vector<Eigen::MatrixX<T>> columns;
  columns.reserve(static_cast<std::size_t>(samples.cols()));
  for (Eigen::Index j = 0; j < samples.cols(); ++j) columns.emplace_back(samples.col(j));
  return columns;
}

// The slope at a break between intervals of lengths h0, h1 on which the data rise by d0, d1 per
// second: 0 where they turn, else between the two, nearer to the smaller.
template <class T>
T InnerSlope(const T& h0, const T& d0, const T& h1, const T& d1) {
  if (!(d0 * d1 > 0)) return 0;
  const T w0 = 2 * h1 + h0;
  const T w1 = h1 + 2 * h0;
  return (w0 + w1) / (w0 / d0 + w1 / d1);
}

// The slope at the end of an interval (h0, d0) whose neighbour is (h1, d1): that of the parabola
// through three points, cut back where it would not keep the shape.
template <class T>
T EndSlope(const T& h0, const T& d0, const T& h1, const T& d1) {
  const T slope = ((2 * h0 + h1) * d0 - h0 * d1) / (h0 + h1);
  if (!(slope * d0 > 0)) return 0;
  if (d0 * d1 <= 0 && std::abs(slope) > std::abs(3 * d0)) return 3 * d0;
  return slope;
}

}  // namespace

template <class T>
PiecewisePolynomial<T>::PiecewisePolynomial(int rows, int cols,
                                            std::vector<Eigen::MatrixX<T>> coefficients,
                                            std::vector<T> breaks)
    : PiecewiseTrajectory<T>(std::move(breaks)),
      rows_(rows),
      cols_(cols),
      coefficients_(std::move(coefficients)) {
  Require(rows >= 0 && cols >= 0, "a matrix needs 0 rows and columns or more, got ", rows, " x ",
          cols);
  const auto segments = static_cast<std::size_t>(this->get_number_of_segments());
  Require(coefficients_.size() == segments, "polynomials: ", segments,
          " are needed, one for each segment between breaks, got ", coefficients_.size());
  for (std::size_t i = 0; i < segments; ++i) {
    const auto& segment = coefficients_[i];
    Require(segment.rows() == static_cast<Eigen::Index>(rows) * cols && segment.cols() > 0,
            "coefficients: segment ", i, " needs ", static_cast<Eigen::Index>(rows) * cols,
            " rows and a column or more, got ", segment.rows(), " x ", segment.cols());
    const T start = this->start_time(static_cast<int>(i));
    Require(std::isfinite(start) || segment.cols() == 1, "a segment that starts at ", start,
            " needs degree 0, got ", segment.cols() - 1);
  }
}

template <class T>
PiecewisePolynomial<T>::PiecewisePolynomial(const std::vector<PolynomialMatrix>& polynomials_matrix,
                                            const std::vector<T>& breaks)
    : PiecewisePolynomial(
          polynomials_matrix.empty() ? 0 : static_cast<int>(polynomials_matrix[0].rows()),
          polynomials_matrix.empty() ? 0 : static_cast<int>(polynomials_matrix[0].cols()),
          CoefficientsOf<T>(polynomials_matrix), breaks) {}

template <class T>
PiecewisePolynomial<T>::PiecewisePolynomial(const std::vector<Polynomial<T>>& polynomials,
                                            const std::vector<T>& breaks)
    : PiecewisePolynomial(1, 1, CoefficientsOf<T>(polynomials), breaks) {}

template <class T>
PiecewisePolynomial<T> PiecewisePolynomial<T>::FromCoefficients(
    int rows, int cols, std::vector<Eigen::MatrixX<T>> coefficients, std::vector<T> breaks) {
  return {rows, cols, std::move(coefficients), std::move(breaks)};
}

template <class T>
PiecewisePolynomial<T> PiecewisePolynomial<T>::Constant(
    const Eigen::Ref<const Eigen::MatrixX<T>>& constant_value) {
  constexpr T kInfinity = std::numeric_limits<T>::infinity();
  const Eigen::MatrixX<T> value = constant_value;
  return {static_cast<int>(value.rows()),
          static_cast<int>(value.cols()),
          {Eigen::Map<const Eigen::VectorX<T>>(value.data(), value.size())},
          {-kInfinity, kInfinity}};
}

template <class T>
const Eigen::MatrixX<T>& PiecewisePolynomial<T>::coefficients(int segment_number) const {
  this->segment_number_range_check(segment_number);
  return coefficients_[static_cast<std::size_t>(segment_number)];
}

// ---- From samples ----

template <class T>
PiecewisePolynomial<T> PiecewisePolynomial<T>::FirstOrderHold(
    const std::vector<T>& breaks, const std::vector<Eigen::MatrixX<T>>& samples) {
  CheckSamples(breaks, samples, 2, "samples");
  std::vector<Eigen::MatrixX<T>> coefficients;
  coefficients.reserve(samples.size() - 1);
  for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
    Eigen::MatrixX<T> segment(samples[i].size(), 2);
    segment << samples[i].reshaped(),
        ((samples[i + 1] - samples[i]) / (breaks[i + 1] - breaks[i])).reshaped();
    coefficients.push_back(std::move(segment));
  }
  return {static_cast<int>(samples[0].rows()), static_cast<int>(samples[0].cols()),
          std::move(coefficients), breaks};
}

template <class T>
PiecewisePolynomial<T> PiecewisePolynomial<T>::FirstOrderHold(
    const Eigen::Ref<const Eigen::VectorX<T>>& breaks,
    const Eigen::Ref<const Eigen::MatrixX<T>>& samples) {
  return FirstOrderHold(Listed<T>(breaks), Columns<T>(samples));
}

// With h the duration, d = (y1 - y0) / h and slopes m0, m1: y0 + m0 x + (3 d - 2 m0 - m1) / h x^2 +
// (m0 + m1 - 2 d) / h^2 x^3.
template <class T>
PiecewisePolynomial<T> PiecewisePolynomial<T>::CubicHermite(
    const std::vector<T>& breaks, const std::vector<Eigen::MatrixX<T>>& samples,
    const std::vector<Eigen::MatrixX<T>>& samples_dot) {
  CheckSamples(breaks, samples, 2, "samples");
  CheckSamples(breaks, samples_dot, 2, "samples_dot");
  Require(samples_dot[0].rows() == samples[0].rows() && samples_dot[0].cols() == samples[0].cols(),
          "samples_dot: matrices of ", samples[0].rows(), " x ", samples[0].cols(),
          " are needed, as samples are, got ", samples_dot[0].rows(), " x ", samples_dot[0].cols());
  std::vector<Eigen::MatrixX<T>> coefficients;
  coefficients.reserve(samples.size() - 1);
  for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
    const T h = breaks[i + 1] - breaks[i];
    const Eigen::MatrixX<T>& m0 = samples_dot[i];
    const Eigen::MatrixX<T>& m1 = samples_dot[i + 1];
    const Eigen::MatrixX<T> d = (samples[i + 1] - samples[i]) / h;
    Eigen::MatrixX<T> segment(samples[i].size(), 4);
    segment << samples[i].reshaped(), m0.reshaped(), ((3 * d - 2 * m0 - m1) / h).reshaped(),
        ((m0 + m1 - 2 * d) / (h * h)).reshaped();
    coefficients.push_back(std::move(segment));
  }
  return {static_cast<int>(samples[0].rows()), static_cast<int>(samples[0].cols()),
          std::move(coefficients), breaks};
}

template <class T>
PiecewisePolynomial<T> PiecewisePolynomial<T>::CubicShapePreserving(
    const std::vector<T>& breaks, const std::vector<Eigen::MatrixX<T>>& samples,
    bool zero_end_point_derivatives) {
  CheckSamples(breaks, samples, zero_end_point_derivatives ? 2 : 3, "samples");
  const std::size_t last = samples.size() - 1;
  const Eigen::MatrixX<T> zero = Eigen::MatrixX<T>::Zero(samples[0].rows(), samples[0].cols());
  std::vector<Eigen::MatrixX<T>> slopes(samples.size(), zero);
  const auto h = [&](std::size_t i) { return breaks[i + 1] - breaks[i]; };
  for (Eigen::Index e = 0; e < zero.size(); ++e) {
    const auto d = [&](std::size_t i) {
      return (samples[i + 1].data()[e] - samples[i].data()[e]) / h(i);
    };
    for (std::size_t i = 1; i < last; ++i) {
      slopes[i].data()[e] = InnerSlope<T>(h(i - 1), d(i - 1), h(i), d(i));
    }
    if (zero_end_point_derivatives) continue;
    slopes[0].data()[e] = EndSlope<T>(h(0), d(0), h(1), d(1));
    slopes[last].data()[e] = EndSlope<T>(h(last - 1), d(last - 1), h(last - 2), d(last - 2));
  }
  return CubicHermite(breaks, samples, slopes);
}

template <class T>
PiecewisePolynomial<T> PiecewisePolynomial<T>::CubicShapePreserving(
    const Eigen::Ref<const Eigen::VectorX<T>>& breaks,
    const Eigen::Ref<const Eigen::MatrixX<T>>& samples, bool zero_end_point_derivatives) {
  return CubicShapePreserving(Listed<T>(breaks), Columns<T>(samples), zero_end_point_derivatives);
}

// ---- Of what is there ----

template <class T>
PiecewisePolynomial<T> PiecewisePolynomial<T>::derivative(int derivative_order) const {
  Require(derivative_order >= 0, "the order of a derivative needs to be 0 or more, got ",
          derivative_order);
  PiecewisePolynomial derivative = *this;
  for (auto& segment : derivative.coefficients_) {
    segment = DerivativeOfPowers<T>(segment, derivative_order);
  }
  return derivative;
}

template <class T>
PiecewisePolynomial<T> PiecewisePolynomial<T>::integral(const T& value_at_start_time) const {
  return integral(Eigen::MatrixX<T>::Constant(this->rows(), this->cols(), value_at_start_time));
}

template <class T>
PiecewisePolynomial<T> PiecewisePolynomial<T>::integral(
    const Eigen::Ref<const Eigen::MatrixX<T>>& value_at_start_time) const {
  Require(std::isfinite(this->start_time()), "an integral needs a finite time to start at, got ",
          this->start_time());
  Require(value_at_start_time.rows() == this->rows() && value_at_start_time.cols() == this->cols(),
          "value_at_start_time needs to be ", this->rows(), " x ", this->cols(), ", got ",
          value_at_start_time.rows(), " x ", value_at_start_time.cols());
  PiecewisePolynomial integral = *this;
  Eigen::VectorX<T> value = value_at_start_time.reshaped();
  for (int i = 0; i < this->get_number_of_segments(); ++i) {
    auto& segment = integral.coefficients_[static_cast<std::size_t>(i)];
    segment = IntegralOfPowers<T>(segment);
    segment.col(0) = value;
    value = SumOfPowers<T>(segment, this->duration(i), 0);
  }
  return integral;
}

template <class T>
void PiecewisePolynomial<T>::Reshape(int rows, int cols) {
  const auto entries = this->rows() * this->cols();
  Require(rows >= 0 && cols >= 0 && static_cast<std::int64_t>(rows) * cols == entries,
          "a shape for ", this->rows(), " x ", this->cols(), " entries is needed, got ", rows,
          " x ", cols);
  rows_ = rows;
  cols_ = cols;
}

template <class T>
PiecewisePolynomial<T> PiecewisePolynomial<T>::Block(int start_row, int start_col, int block_rows,
                                                     int block_cols) const {
  Require(start_row >= 0 && block_rows >= 0 && block_rows <= this->rows() - start_row &&
              start_col >= 0 && block_cols >= 0 && block_cols <= this->cols() - start_col,
          "a block of ", block_rows, " x ", block_cols, " from (", start_row, ", ", start_col,
          ") on is not inside values of ", this->rows(), " x ", this->cols());
  PiecewisePolynomial block = *this;
  block.rows_ = block_rows;
  block.cols_ = block_cols;
  for (std::size_t i = 0; i < coefficients_.size(); ++i) {
    Eigen::MatrixX<T> part(static_cast<Eigen::Index>(block_rows) * block_cols,
                           coefficients_[i].cols());
    for (int j = 0; j < block_cols; ++j) {
      const Eigen::Index from = start_row + static_cast<Eigen::Index>(rows_) * (start_col + j);
      part.middleRows(static_cast<Eigen::Index>(block_rows) * j, block_rows) =
          coefficients_[i].middleRows(from, block_rows);
    }
    block.coefficients_[i] = std::move(part);
  }
  return block;
}

template <class T>
std::unique_ptr<Trajectory<T>> PiecewisePolynomial<T>::DoClone() const {
  return std::make_unique<PiecewisePolynomial>(*this);
}

template <class T>
Eigen::MatrixX<T> PiecewisePolynomial<T>::do_value(const T& t) const {
  return DoEvalDerivative(t, 0);
}

template <class T>
Eigen::MatrixX<T> PiecewisePolynomial<T>::DoEvalDerivative(const T& t, int derivative_order) const {
  const T inside = std::clamp(t, this->start_time(), this->end_time());
  const int i = this->get_segment_index(inside);
  return SumOfPowers<T>(coefficients(i), inside - this->start_time(i), derivative_order)
      .reshaped(rows_, cols_);
}

template <class T>
std::unique_ptr<Trajectory<T>> PiecewisePolynomial<T>::DoMakeDerivative(
    int derivative_order) const {
  return std::make_unique<PiecewisePolynomial>(derivative(derivative_order));
}

template <class T>
std::unique_ptr<Trajectory<T>> PiecewisePolynomial<T>::DoStartingAt(const T& time) const {
  std::vector<T> breaks = this->get_segment_times();
  for (T& one : breaks) one = time + (one - this->start_time());
  return std::make_unique<PiecewisePolynomial>(
      FromCoefficients(rows_, cols_, coefficients_, std::move(breaks)));
}

template <class T>
Eigen::Index PiecewisePolynomial<T>::do_rows() const {
  this->RequireSegments();
  return rows_;
}

template <class T>
Eigen::Index PiecewisePolynomial<T>::do_cols() const {
  this->RequireSegments();
  return cols_;
}

template class PiecewisePolynomial<double>;

}  // namespace switchyard
