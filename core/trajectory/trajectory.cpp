#include "switchyard/trajectory/trajectory.hpp"

#include <cmath>

#include "core/trajectory/derivative_trajectory.hpp"
#include "switchyard/trajectory/path_parameterized_trajectory.hpp"
#include "switchyard/trajectory/piecewise_polynomial.hpp"

namespace switchyard {

template <class T>
Trajectory<T>::~Trajectory() = default;

template <class T>
Eigen::MatrixX<T> Trajectory<T>::value(const T& t) const {
  Require(!std::isnan(t), "a ", Kind(), " needs a time to be evaluated at, got nan");
  return do_value(t);
}

template <class T>
Eigen::MatrixX<T> Trajectory<T>::vector_values(const std::vector<T>& t) const {
  return vector_values(
      Eigen::Map<const Eigen::VectorX<T>>(t.data(), static_cast<Eigen::Index>(t.size())));
}

template <class T>
Eigen::MatrixX<T> Trajectory<T>::vector_values(const Eigen::Ref<const Eigen::VectorX<T>>& t) const {
  const bool by_columns = cols() == 1;
  Require(by_columns || rows() == 1, "vector_values needs values of one row or one column, this ",
          Kind(), " has values of ", rows(), " x ", cols());
  Eigen::MatrixX<T> values(by_columns ? rows() : t.size(), by_columns ? t.size() : cols());
  for (Eigen::Index i = 0; i < t.size(); ++i) {
    if (by_columns) {
      values.col(i) = value(t(i));
    } else {
      values.row(i) = value(t(i));
    }
  }
  return values;
}

template <class T>
Eigen::MatrixX<T> Trajectory<T>::EvalDerivative(const T& t, int derivative_order) const {
  Require(derivative_order >= 0, "the order of a derivative needs to be 0 or more, got ",
          derivative_order);
  if (derivative_order == 0) return value(t);
  Require(has_derivative(), "a trajectory with a derivative is needed, got a ", Kind(),
          " without one");
  Require(!std::isnan(t), "a ", Kind(), " needs a time to be evaluated at, got nan");
  return DoEvalDerivative(t, derivative_order);
}

template <class T>
std::unique_ptr<Trajectory<T>> Trajectory<T>::MakeDerivative(int derivative_order) const {
  Require(derivative_order >= 0, "the order of a derivative needs to be 0 or more, got ",
          derivative_order);
  if (derivative_order == 0) return Clone();
  Require(has_derivative(), "a trajectory with a derivative is needed, got a ", Kind(),
          " without one");
  return DoMakeDerivative(derivative_order);
}

template <class T>
std::unique_ptr<Trajectory<T>> Trajectory<T>::StartingAt(const T& time) const {
  Require(std::isfinite(time), "a trajectory needs a finite time to start at, got ", time);
  Require(std::isfinite(start_time()), "a ", Kind(), " that starts at ", start_time(),
          " cannot be moved to start at ", time);
  return DoStartingAt(time);
}

template <class T>
Eigen::MatrixX<T> Trajectory<T>::DoEvalDerivative(const T& /*t*/, int /*derivative_order*/) const {
  Refuse("a ", Kind(), " says that it has derivatives, and needs to override DoEvalDerivative");
}

template <class T>
std::unique_ptr<Trajectory<T>> Trajectory<T>::DoMakeDerivative(int derivative_order) const {
  return std::make_unique<DerivativeTrajectory<T>>(*this, derivative_order);
}

template <class T>
std::unique_ptr<Trajectory<T>> Trajectory<T>::DoStartingAt(const T& time) const {
  const T start = start_time();
  const auto same_pace = PiecewisePolynomial<T>::FromCoefficients(
      1, 1, {Eigen::RowVector2<T>(start, 1)}, {time, time + (end_time() - start)});
  return std::make_unique<PathParameterizedTrajectory<T>>(*this, same_pace);
}

template class Trajectory<double>;

}  // namespace switchyard
