// core/trajectory/derivative_trajectory.hpp - a derivative of a trajectory that has no closed form.
#pragma once

#include "switchyard/trajectory/trajectory.hpp"

namespace switchyard {

template <class T>
class DerivativeTrajectory final : public Trajectory<T> {
 public:
  DerivativeTrajectory(TrajectoryPointer<T> nominal, int derivative_order)
      : nominal_(std::move(nominal)), order_(derivative_order) {}
  [[nodiscard]] std::string Kind() const override {
    return Text("derivative of a ", nominal_->Kind());
  }

 private:
  [[nodiscard]] std::unique_ptr<Trajectory<T>> DoClone() const override {
    return std::make_unique<DerivativeTrajectory>(*this);
  }
  [[nodiscard]] Eigen::MatrixX<T> do_value(const T& t) const override {
    return nominal_->EvalDerivative(t, order_);
  }
  [[nodiscard]] bool do_has_derivative() const override { return true; }
  [[nodiscard]] Eigen::MatrixX<T> DoEvalDerivative(const T& t,
                                                   int derivative_order) const override {
    return nominal_->EvalDerivative(t, order_ + derivative_order);
  }
  [[nodiscard]] std::unique_ptr<Trajectory<T>> DoMakeDerivative(
      int derivative_order) const override {
    return std::make_unique<DerivativeTrajectory>(nominal_, order_ + derivative_order);
  }
  [[nodiscard]] std::unique_ptr<Trajectory<T>> DoStartingAt(const T& time) const override {
    return std::make_unique<DerivativeTrajectory>(nominal_->StartingAt(time), order_);
  }
  [[nodiscard]] Eigen::Index do_rows() const override { return nominal_->rows(); }
  [[nodiscard]] Eigen::Index do_cols() const override { return nominal_->cols(); }
  [[nodiscard]] T do_start_time() const override { return nominal_->start_time(); }
  [[nodiscard]] T do_end_time() const override { return nominal_->end_time(); }

  TrajectoryPointer<T> nominal_;
  int order_;
};

}  // namespace switchyard
