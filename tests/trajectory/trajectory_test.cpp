// What holds of trajectories of every class, a user's among them.
#include "switchyard/trajectory/trajectory.hpp"

#include <cmath>
#include <limits>

#include "switchyard/trajectory/bezier_curve.hpp"
#include "switchyard/trajectory/piecewise_polynomial.hpp"
#include "tests/model/said.hpp"
#include "tests/trajectory/curves.hpp"

namespace switchyard::testing {
namespace {

// (cos t, sin t), with derivatives or without.
class Circle final : public Trajectory<double> {
 public:
  explicit Circle(bool has_derivative) : has_derivative_(has_derivative) {}

 private:
  [[nodiscard]] std::unique_ptr<Trajectory<double>> DoClone() const override {
    return std::make_unique<Circle>(*this);
  }
  [[nodiscard]] Eigen::MatrixXd do_value(const double& t) const override {
    return Eigen::Vector2d(std::cos(t), std::sin(t));
  }
  [[nodiscard]] bool do_has_derivative() const override { return has_derivative_; }
  [[nodiscard]] Eigen::MatrixXd DoEvalDerivative(const double& t, int order) const override {
    return do_value(t + order * std::acos(-1.0) / 2);
  }
  [[nodiscard]] Eigen::Index do_rows() const override { return 2; }
  [[nodiscard]] Eigen::Index do_cols() const override { return 1; }
  [[nodiscard]] double do_start_time() const override { return 1; }
  [[nodiscard]] double do_end_time() const override { return 4; }
  bool has_derivative_;
};

TEST(Trajectory, OfAUsersClassHasWhatFollowsFromItsOwn) {
  const Circle circle(true);
  EXPECT_TRUE(circle.has_derivative());
  ExpectDerivativesOfDifferences(circle, 4, {1.1, 2, 3.7}, 1e-8);
  const auto twice = circle.MakeDerivative(2)->MakeDerivative(2);
  EXPECT_EQ(twice->start_time(), 1);
  EXPECT_LE(Distance(twice->value(2), circle.value(2)), 1e-14);
  const auto later = circle.StartingAt(11);
  EXPECT_EQ(later->start_time(), 11);
  EXPECT_EQ(later->end_time(), 14);
  EXPECT_LE(Distance(later->value(12.5), circle.value(2.5)), 1e-14);
  EXPECT_LE(Distance(later->EvalDerivative(12.5, 3), circle.EvalDerivative(2.5, 3)), 1e-14);
}

TEST(Trajectory, ManyValuesStandInColumnsOrInRows) {
  const BezierCurve<double> column(0, 2, Eigen::MatrixXd::Identity(3, 3));
  const std::vector<double> times = {0, 0.5, 2};
  const Eigen::MatrixXd values = column.vector_values(times);
  ASSERT_EQ(values.cols(), 3);
  for (Eigen::Index i = 0; i < 3; ++i) {
    EXPECT_EQ(values.col(i), column.value(times[static_cast<std::size_t>(i)]));
  }
  EXPECT_EQ(column.vector_values(Eigen::Vector3d(0, 0.5, 2)), values);
  auto row = PiecewisePolynomial<double>::FirstOrderHold({0, 2}, {values, 2 * values});
  EXPECT_EQ(Said([&] { (void)row.vector_values(times); }),
            "vector_values needs values of one row or one column, this piecewise polynomial has "
            "values of 3 x 3");
  row.Reshape(1, 9);
  EXPECT_EQ(row.vector_values(times).row(1), row.value(0.5));
  EXPECT_EQ(column.vector_values(std::vector<double>()).cols(), 0);
}

TEST(Trajectory, SaysWhatACallerGotWrong) {
  const Circle circle(false);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(Said([&] { (void)circle.EvalDerivative(2); }),
            "a trajectory with a derivative is needed, got a trajectory of a user's class without "
            "one");
  EXPECT_EQ(Said([&] { (void)circle.MakeDerivative(); }),
            Said([&] { (void)circle.EvalDerivative(2); }));
  EXPECT_EQ(Said([&] { (void)circle.EvalDerivative(2, -1); }),
            "the order of a derivative needs to be 0 or more, got -1");
  EXPECT_EQ(Said([&] { (void)BezierCurve<double>().value(nan); }),
            "a Bezier curve needs a time to be evaluated at, got nan");
  EXPECT_EQ(Said([&] { (void)circle.StartingAt(nan); }),
            "a trajectory needs a finite time to start at, got nan");
  EXPECT_EQ(Said([&] { (void)PiecewisePolynomial<double>(Eigen::Vector2d(1, 2)).StartingAt(0); }),
            "a piecewise polynomial that starts at -inf cannot be moved to start at 0");
  EXPECT_EQ(Said([] { TrajectoryPointer<double> none(std::shared_ptr<Circle>{}); }),
            "a trajectory is needed, got a null pointer");
}

}  // namespace
}  // namespace switchyard::testing
