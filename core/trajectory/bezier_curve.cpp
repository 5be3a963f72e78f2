#include "switchyard/trajectory/bezier_curve.hpp"

#include <algorithm>
#include <cmath>

#include "switchyard/model/new_ids.hpp"

namespace switchyard {
namespace {

// The point at s of the curve whose control points are the columns: each round joins neighbours.
template <class T>
Eigen::VectorX<T> DeCasteljau(Eigen::MatrixX<T> points, const T& s) {
  for (Eigen::Index left = points.cols() - 1; left > 0; --left) {
    for (Eigen::Index i = 0; i < left; ++i) {
      points.col(i) = (1 - s) * points.col(i) + s * points.col(i + 1);
    }
  }
  return points.col(0);
}

double Binomial(int n, int k) {
  double value = 1;
  for (int i = 1; i <= std::min(k, n - k); ++i) value = value * (n + 1 - i) / i;
  return value;
}

}  // namespace

Eigen::SparseMatrix<double> BezierDerivativeMap(int order, int k) {
  Require(order >= 0, "the order of a Bezier curve needs to be 0 or more, got ", order);
  Require(k >= 0, "the order of a derivative needs to be 0 or more, got ", k);
  if (k > order) return {order + 1, 0};
  double factor = 1;  // order! / (order - k)!
  for (int i = 0; i < k; ++i) factor *= order - i;
  Eigen::SparseMatrix<double> map(order + 1, order + 1 - k);
  map.reserve(Eigen::VectorXi::Constant(order + 1 - k, k + 1));
  for (int i = 0; i + k <= order; ++i) {
    for (int j = 0; j <= k; ++j) {
      map.insert(i + j, i) = ((k - j) % 2 == 0 ? factor : -factor) * Binomial(k, j);
    }
  }
  map.makeCompressed();
  return map;
}

template <class T>
BezierCurve<T>::BezierCurve() : control_points_(0, 1) {}

template <class T>
BezierCurve<T>::BezierCurve(double start_time, double end_time,
                            const Eigen::Ref<const Eigen::MatrixX<T>>& control_points)
    : start_time_(start_time), end_time_(end_time), control_points_(control_points) {
  Require(control_points.cols() > 0,
          "a Bezier curve needs a control point or more, by columns, got a matrix of ",
          control_points.rows(), " x 0");
  Require(std::isfinite(start_time) && std::isfinite(end_time) && start_time < end_time,
          "a Bezier curve needs finite times, the end after the start, got ", start_time, " to ",
          end_time);
}

template <class T>
T BezierCurve<T>::Parameter(const T& time) const {
  Require(!std::isnan(time), "a Bezier curve needs a time to be evaluated at, got nan");
  return (std::clamp<T>(time, start_time_, end_time_) - start_time_) / (end_time_ - start_time_);
}

template <class T>
T BezierCurve<T>::BernsteinBasis(int i, const T& time, std::optional<int> order) const {
  const int last = order.value_or(this->order());
  Require(i >= 0 && i <= last, "the number of a Bernstein polynomial of order ", last,
          " needs to be from 0 to ", last, ", got ", i);
  return DeCasteljau<T>(Eigen::RowVectorX<T>::Unit(last + 1, i), Parameter(time))(0);
}

template <class T>
Eigen::MatrixX<T> BezierCurve<T>::DerivativeControlPoints(int derivative_order) const {
  if (derivative_order > order()) return Eigen::VectorX<T>::Zero(control_points_.rows());
  Eigen::MatrixX<T> points = control_points_;
  for (int k = 0; k < derivative_order; ++k) {
    const Eigen::Index last = points.cols() - 1;
    const T factor = static_cast<T>(last) / (end_time_ - start_time_);
    points = (factor * (points.rightCols(last) - points.leftCols(last))).eval();
  }
  return points;
}

template <class T>
Eigen::SparseMatrix<double> BezierCurve<T>::AsLinearInControlPoints(int derivative_order) const {
  Eigen::SparseMatrix<double> map = BezierDerivativeMap(order(), derivative_order);
  map *= std::pow(end_time_ - start_time_, -derivative_order);
  return map;
}

template <class T>
Eigen::VectorX<Expression> BezierCurve<T>::GetExpression(Variable time) const {
  const int m = order();
  const Expression s = (Expression(time) - start_time_) / Expression(end_time_ - start_time_);
  Eigen::VectorX<Expression> value(control_points_.rows());
  for (int i = 0; i <= m; ++i) {
    const Expression basis = Binomial(m, i) * pow(s, i) * pow(1 - s, m - i);
    for (Eigen::Index row = 0; row < value.size(); ++row) {
      value(row).Add(control_points_(row, i), basis);
    }
  }
  return value;
}

template <class T>
Eigen::VectorX<Expression> BezierCurve<T>::GetExpression() const {
  return GetExpression(Variable(NewVariableIds(1)));
}

// q_i = i / (m + 1) p_{i-1} + (1 - i / (m + 1)) p_i (Farin, 6.1).
template <class T>
void BezierCurve<T>::ElevateOrder() {
  const Eigen::Index count = control_points_.cols();
  Eigen::MatrixX<T> elevated(control_points_.rows(), count + 1);
  elevated.col(0) = control_points_.col(0);
  for (Eigen::Index i = 1; i < count; ++i) {
    const T share = static_cast<T>(i) / static_cast<T>(count);
    elevated.col(i) = share * control_points_.col(i - 1) + (1 - share) * control_points_.col(i);
  }
  elevated.col(count) = control_points_.col(count - 1);
  control_points_ = std::move(elevated);
}

template <class T>
std::unique_ptr<Trajectory<T>> BezierCurve<T>::DoClone() const {
  return std::make_unique<BezierCurve>(*this);
}

template <class T>
Eigen::MatrixX<T> BezierCurve<T>::do_value(const T& t) const {
  return DeCasteljau<T>(control_points_, Parameter(t));
}

template <class T>
Eigen::MatrixX<T> BezierCurve<T>::DoEvalDerivative(const T& t, int derivative_order) const {
  return DeCasteljau<T>(DerivativeControlPoints(derivative_order), Parameter(t));
}

template <class T>
std::unique_ptr<Trajectory<T>> BezierCurve<T>::DoMakeDerivative(int derivative_order) const {
  return std::make_unique<BezierCurve>(start_time_, end_time_,
                                       DerivativeControlPoints(derivative_order));
}

template <class T>
std::unique_ptr<Trajectory<T>> BezierCurve<T>::DoStartingAt(const T& time) const {
  return std::make_unique<BezierCurve>(time, time + (end_time_ - start_time_), control_points_);
}

template class BezierCurve<double>;

}  // namespace switchyard
