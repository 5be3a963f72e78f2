// core/trajectory/kinematic_point.hpp - a point of the curve and its derivatives in time, as
// functions of control points and duration.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "switchyard/functions/function.hpp"
#include "switchyard/model/binding.hpp"
#include "switchyard/model/cost.hpp"
#include "switchyard/trajectory/bspline_basis.hpp"

namespace switchyard {

/// Values w_m = T^-d a_d' P_i at one s, d and i those of m: derivative d of q_i in time, d <= 2.
/// The variables of P_i are those of `columns` control points, of which a_d has the weights, 0
/// where derivative d does not see one.
///
/// The variables are numbered: joint by joint of those in use, `columns` each, then T where a
/// derivative needs it.
class CurvePoint {
 public:
  struct Value {
    int derivative = 0;
    int joint = 0;
  };
  CurvePoint(const BsplineBasis<double>& basis, double s, std::vector<Value> values);

  [[nodiscard]] int num_values() const { return static_cast<int>(values_.size()); }
  [[nodiscard]] const std::vector<Value>& values() const { return values_; }
  /// The control point of the first column.
  [[nodiscard]] int first() const { return first_; }
  [[nodiscard]] int columns() const { return static_cast<int>(weights_[0].size()); }
  /// Ascending.
  [[nodiscard]] const std::vector<int>& joints() const { return joints_; }
  [[nodiscard]] const Eigen::VectorXd& weights(int derivative) const {
    return weights_[static_cast<std::size_t>(derivative)];
  }
  /// Is any of them a derivative in time?
  [[nodiscard]] bool moves() const { return highest_ > 0; }
  /// Are all of them of derivative d?
  [[nodiscard]] bool AllAre(int d) const { return lowest_ == d && highest_ == d; }
  /// Of control points alone.
  [[nodiscard]] int num_point_vars() const { return static_cast<int>(joints_.size()) * columns(); }
  /// The variable of the first column of value m's joint.
  [[nodiscard]] int FirstVar(int m) const { return first_var_[static_cast<std::size_t>(m)]; }
  /// W with T^d w = W p, num_values() x num_point_vars().
  [[nodiscard]] SparseMatrix Map() const;

 private:
  int first_ = 0;
  std::array<Eigen::VectorXd, 3> weights_;
  std::vector<Value> values_;
  std::vector<int> joints_;
  std::vector<int> first_var_;  // of each value
  int lowest_ = 0;
  int highest_ = 0;
};

/// weight f(w(x)), or weight T f(w(x)) where `timed`; f as it is, with its derivatives where it has
/// them. x are the point's variables, with T where it moves or f is timed.
std::shared_ptr<const Function> AtCurvePoint(std::shared_ptr<const EvaluatorBase> f,
                                             const CurvePoint& point, double weight = 1,
                                             bool timed = false);

}  // namespace switchyard
