#include "switchyard/trajectory/bspline_basis.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace switchyard {
namespace {

template <class T>
std::vector<T> EvenKnots(int order, int num_basis_functions, KnotVectorType type, const T& initial,
                         const T& final) {
  Require(order >= 1, "the order of a B-spline basis needs to be 1 or more, got ", order);
  Require(num_basis_functions >= order, "a B-spline basis of order ", order, " needs ", order,
          " functions or more, got ", num_basis_functions);
  Require(std::isfinite(initial) && std::isfinite(final) && initial < final,
          "a B-spline basis needs finite parameters, the final one above the initial one, got ",
          initial, " to ", final);
  const int intervals = num_basis_functions - order + 1;
  std::vector<T> knots(static_cast<std::size_t>(num_basis_functions) +
                       static_cast<std::size_t>(order));
  int i = 1 - order;  // of the interval that starts there; 0 is the first inside
  for (T& knot : knots) {
    const int inside = type == KnotVectorType::kUniform ? i : std::clamp(i, 0, intervals);
    knot = std::lerp(initial, final, static_cast<T>(inside) / intervals);
    ++i;
  }
  return knots;
}

}  // namespace

template <class T>
BsplineBasis<T>::BsplineBasis() : BsplineBasis(1, std::vector<T>{0, 1}) {}

template <class T>
BsplineBasis<T>::BsplineBasis(int order, std::vector<T> knots)
    : order_(order), knots_(std::move(knots)) {
  Require(order >= 1, "the order of a B-spline basis needs to be 1 or more, got ", order);
  Require(knots_.size() >= 2 * static_cast<std::size_t>(order), "a B-spline basis of order ", order,
          " needs ", 2 * static_cast<std::int64_t>(order), " knots or more, got ", knots_.size());
  for (std::size_t i = 0; i < knots_.size(); ++i) {
    Require(std::isfinite(knots_[i]), "knots: knots[", i, "] needs to be finite, got ", knots_[i]);
    Require(i == 0 || knots_[i - 1] <= knots_[i], "knots: knots[", i, "] = ", knots_[i],
            " is below knots[", i - 1, "] = ", knots_[i - 1]);
  }
  Require(initial_parameter_value() < final_parameter_value(), "a B-spline basis of order ", order,
          " needs knots[", num_basis_functions(), "] above knots[", order - 1, "], got ",
          final_parameter_value(), " for both");
}

template <class T>
BsplineBasis<T>::BsplineBasis(int order, int num_basis_functions, KnotVectorType type,
                              const T& initial_parameter_value, const T& final_parameter_value)
    : BsplineBasis(order, EvenKnots(order, num_basis_functions, type, initial_parameter_value,
                                    final_parameter_value)) {}

template <class T>
int BsplineBasis<T>::FindContainingInterval(const T& parameter_value) const {
  const T& final = final_parameter_value();
  Require(parameter_value >= initial_parameter_value() && parameter_value <= final,
          "a parameter from ", initial_parameter_value(), " to ", final, " is needed, got ",
          parameter_value);
  const auto first = knots_.begin() + degree();
  const auto end = knots_.begin() + num_basis_functions();
  const auto behind = parameter_value == final ? std::lower_bound(first, end, final)
                                               : std::upper_bound(first, end, parameter_value);
  return static_cast<int>(behind - knots_.begin()) - 1;
}

template <class T>
std::vector<int> BsplineBasis<T>::ComputeActiveBasisFunctionIndices(
    const std::array<T, 2>& parameter_interval) const {
  Require(parameter_interval[0] <= parameter_interval[1],
          "an interval needs a lower end first, got ", parameter_interval[0], " to ",
          parameter_interval[1]);
  const int first = FindContainingInterval(parameter_interval[0]) - degree();
  const int last = FindContainingInterval(parameter_interval[1]);
  std::vector<int> indices(static_cast<std::size_t>(last - first) + 1);
  std::iota(indices.begin(), indices.end(), first);
  return indices;
}

template <class T>
std::vector<int> BsplineBasis<T>::ComputeActiveBasisFunctionIndices(
    const T& parameter_value) const {
  return ComputeActiveBasisFunctionIndices(std::array<T, 2>{parameter_value, parameter_value});
}

// Up from the function of degree 0 on the interval to those of degree() - j, then, by the stages j,
// ..., 1 of the derivative, to weights of the functions of full degree. In each step `weights`
// holds as many numbers as there are functions on the interval, the last of which starts at its
// left end.
template <class T>
auto BsplineBasis<T>::ActiveAt(const T& parameter_value, int derivative_order) const -> Active {
  Require(derivative_order >= 0, "the order of a derivative needs to be 0 or more, got ",
          derivative_order);
  const T t = std::clamp(parameter_value, initial_parameter_value(), final_parameter_value());
  const int interval = FindContainingInterval(t);
  Active active{interval - degree(), Eigen::VectorX<T>::Zero(order_)};
  if (derivative_order >= order_) return active;
  Eigen::VectorX<T>& weights = active.weights;
  weights(0) = 1;
  for (int d = 1; d <= degree() - derivative_order; ++d) {
    T handed = 0;
    for (int r = 0; r < d; ++r) {
      const T& start = knot(interval - d + 1 + r);
      const T share = (t - start) / (knot(interval + 1 + r) - start);
      const T given = share * weights(r);
      weights(r) = handed + (1 - share) * weights(r);
      handed = given;
    }
    weights(d) = handed;
  }
  for (int stage = derivative_order; stage >= 1; --stage) {
    T handed = 0;
    for (int r = 0; r < order_ - stage; ++r) {
      const int i = active.first + r;
      const T given = (order_ - stage) / (knot(i + order_) - knot(i + stage)) * weights(r);
      weights(r) = handed - given;
      handed = given;
    }
    weights(order_ - stage) = handed;
  }
  return active;
}

template <class T>
Eigen::VectorX<T> BsplineBasis<T>::EvaluateLinearInControlPoints(const T& parameter_value,
                                                                 int derivative_order) const {
  const Active active = ActiveAt(parameter_value, derivative_order);
  Eigen::VectorX<T> weights = Eigen::VectorX<T>::Zero(num_basis_functions());
  weights.segment(active.first, order_) = active.weights;
  return weights;
}

template <class T>
T BsplineBasis<T>::EvaluateBasisFunctionI(int i, const T& parameter_value) const {
  Require(i >= 0 && i < num_basis_functions(),
          "the number of a basis function needs to be from 0 to ", num_basis_functions() - 1,
          ", got ", i);
  const Active active = ActiveAt(parameter_value);
  return i < active.first || i >= active.first + order_ ? T(0) : active.weights(i - active.first);
}

template <class T>
Eigen::SparseMatrix<T> BsplineBasis<T>::DerivativeMap(int derivative_order) const {
  Require(derivative_order >= 0, "the order of a derivative needs to be 0 or more, got ",
          derivative_order);
  const int n = num_basis_functions();
  if (derivative_order >= order_) return {n, 0};
  Eigen::SparseMatrix<T> map(n, n);
  map.setIdentity();
  for (int stage = 1; stage <= derivative_order; ++stage) {
    Eigen::SparseMatrix<T> differences(n - stage + 1, n - stage);
    differences.reserve(Eigen::VectorXi::Constant(n - stage, 2));
    for (int i = 0; i < n - stage; ++i) {
      const T length = knot(i + order_) - knot(i + stage);
      const T a = length > 0 ? (order_ - stage) / length : T(0);
      differences.insert(i, i) = -a;
      differences.insert(i + 1, i) = a;
    }
    map = (map * differences).eval();
  }
  return map;
}

template <class T>
BsplineBasis<T> BsplineBasis<T>::DerivativeBasis(int derivative_order) const {
  Require(derivative_order >= 0 && derivative_order < order_,
          "the derivative of a B-spline basis of order ", order_, " needs an order from 0 to ",
          degree(), ", got ", derivative_order);
  return BsplineBasis(order_ - derivative_order, std::vector<T>(knots_.begin() + derivative_order,
                                                                knots_.end() - derivative_order));
}

template class BsplineBasis<double>;

}  // namespace switchyard
