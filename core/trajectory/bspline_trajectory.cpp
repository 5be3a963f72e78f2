#include "switchyard/trajectory/bspline_trajectory.hpp"

#include <algorithm>

namespace switchyard {
namespace {

template <class T>
Eigen::MatrixX<T> Weighted(const std::vector<Eigen::MatrixX<T>>& points,
                           const typename BsplineBasis<T>::Active& active) {
  const auto* const first = points.data() + active.first;
  Eigen::MatrixX<T> sum = active.weights(0) * first[0];
  for (Eigen::Index i = 1; i < active.weights.size(); ++i) sum += active.weights(i) * first[i];
  return sum;
}

}  // namespace

template <class T>
BsplineTrajectory<T>::BsplineTrajectory()
    : BsplineTrajectory(BsplineBasis<T>(), {Eigen::MatrixX<T>(0, 1)}) {}

template <class T>
BsplineTrajectory<T>::BsplineTrajectory(BsplineBasis<T> basis,
                                        std::vector<Eigen::MatrixX<T>> control_points)
    : basis_(std::move(basis)), control_points_(std::move(control_points)) {
  Require(control_points_.size() == static_cast<std::size_t>(num_control_points()),
          "a B-spline trajectory needs ", num_control_points(),
          " control points, one for each basis function, got ", control_points_.size());
  const auto& first = control_points_[0];
  for (std::size_t i = 1; i < control_points_.size(); ++i) {
    const auto& point = control_points_[i];
    Require(point.rows() == first.rows() && point.cols() == first.cols(),
            "control points: control point ", i, " needs to be ", first.rows(), " x ", first.cols(),
            " as the first, got ", point.rows(), " x ", point.cols());
  }
}

template <class T>
Eigen::SparseMatrix<T> BsplineTrajectory<T>::AsLinearInControlPoints(int derivative_order) const {
  return basis_.DerivativeMap(derivative_order);
}

template <class T>
Eigen::VectorX<T> BsplineTrajectory<T>::EvaluateLinearInControlPoints(const T& t,
                                                                      int derivative_order) const {
  return basis_.EvaluateLinearInControlPoints(t, derivative_order);
}

template <class T>
void BsplineTrajectory<T>::InsertKnots(const std::vector<T>& additional_knots) {
  for (const T& knot : additional_knots) {
    Require(knot >= this->start_time() && knot <= this->end_time(),
            "a knot to insert needs to be from ", this->start_time(), " to ", this->end_time(),
            ", got ", knot);
  }
  for (const T& knot : additional_knots) InsertKnot(knot);
}

// The new point i is a P_i + (1 - a) P_{i-1}, a the part of the support of P_i's function, of a
// degree lower, that lies before the knot: all of it for those before the interval, none behind.
template <class T>
void BsplineTrajectory<T>::InsertKnot(const T& knot) {
  std::vector<T> knots = basis_.knots();
  const int interval = basis_.FindContainingInterval(knot);
  std::vector<Eigen::MatrixX<T>> points = control_points_;
  points.insert(points.begin() + interval + 1, control_points_[static_cast<std::size_t>(interval)]);
  for (int at = interval - basis_.degree() + 1; at <= interval; ++at) {
    const auto i = static_cast<std::size_t>(at);
    const T& start = knots[i];
    const T share = (knot - start) / (knots[i + static_cast<std::size_t>(basis_.degree())] - start);
    points[i] = share * control_points_[i] + (1 - share) * control_points_[i - 1];
  }
  knots.insert(std::upper_bound(knots.begin(), knots.end(), knot), knot);
  *this = BsplineTrajectory(BsplineBasis<T>(basis_.order(), std::move(knots)), std::move(points));
}

template <class T>
BsplineTrajectory<T> BsplineTrajectory<T>::CopyWithSelector(
    const std::function<Eigen::MatrixX<T>(const Eigen::MatrixX<T>&)>& select) const {
  std::vector<Eigen::MatrixX<T>> selected;
  selected.reserve(control_points_.size());
  for (const auto& point : control_points_) selected.push_back(select(point));
  return {basis_, std::move(selected)};
}

template <class T>
BsplineTrajectory<T> BsplineTrajectory<T>::CopyBlock(int start_row, int start_col, int block_rows,
                                                     int block_cols) const {
  Require(start_row >= 0 && block_rows >= 0 && block_rows <= this->rows() - start_row &&
              start_col >= 0 && block_cols >= 0 && block_cols <= this->cols() - start_col,
          "a block of ", block_rows, " x ", block_cols, " from (", start_row, ", ", start_col,
          ") on is not inside values of ", this->rows(), " x ", this->cols());
  return CopyWithSelector([=](const Eigen::MatrixX<T>& point) {
    return Eigen::MatrixX<T>(point.block(start_row, start_col, block_rows, block_cols));
  });
}

template <class T>
BsplineTrajectory<T> BsplineTrajectory<T>::CopyHead(int n) const {
  Require(this->cols() == 1, "CopyHead needs values of one column, got ", this->rows(), " x ",
          this->cols());
  return CopyBlock(0, 0, n, 1);
}

template <class T>
bool BsplineTrajectory<T>::operator==(const BsplineTrajectory<T>& other) const {
  return basis_ == other.basis_ && this->rows() == other.rows() && this->cols() == other.cols() &&
         control_points_ == other.control_points_;
}

template <class T>
std::unique_ptr<Trajectory<T>> BsplineTrajectory<T>::DoClone() const {
  return std::make_unique<BsplineTrajectory>(*this);
}

template <class T>
Eigen::MatrixX<T> BsplineTrajectory<T>::do_value(const T& t) const {
  return Weighted<T>(control_points_, basis_.ActiveAt(t));
}

template <class T>
Eigen::MatrixX<T> BsplineTrajectory<T>::DoEvalDerivative(const T& t, int derivative_order) const {
  return Weighted<T>(control_points_, basis_.ActiveAt(t, derivative_order));
}

template <class T>
std::unique_ptr<Trajectory<T>> BsplineTrajectory<T>::DoMakeDerivative(int derivative_order) const {
  const Eigen::MatrixX<T> zero = Eigen::MatrixX<T>::Zero(this->rows(), this->cols());
  if (derivative_order >= basis_.order()) {
    const BsplineBasis<T> constant(1, {this->start_time(), this->end_time()});
    return std::make_unique<BsplineTrajectory>(constant, std::vector{zero});
  }
  const Eigen::SparseMatrix<T> map = AsLinearInControlPoints(derivative_order);
  std::vector<Eigen::MatrixX<T>> points(static_cast<std::size_t>(map.cols()), zero);
  for (int j = 0; j < map.outerSize(); ++j) {
    for (typename Eigen::SparseMatrix<T>::InnerIterator it(map, j); it; ++it) {
      points[static_cast<std::size_t>(j)] +=
          it.value() * control_points_[static_cast<std::size_t>(it.row())];
    }
  }
  return std::make_unique<BsplineTrajectory>(basis_.DerivativeBasis(derivative_order),
                                             std::move(points));
}

template <class T>
std::unique_ptr<Trajectory<T>> BsplineTrajectory<T>::DoStartingAt(const T& time) const {
  std::vector<T> knots = basis_.knots();
  for (T& knot : knots) knot = time + (knot - this->start_time());
  return std::make_unique<BsplineTrajectory>(BsplineBasis<T>(basis_.order(), std::move(knots)),
                                             control_points_);
}

template class BsplineTrajectory<double>;

}  // namespace switchyard
