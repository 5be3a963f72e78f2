#include "switchyard/functions/traced.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <optional>
#include <sstream>
#include <vector>

#include "switchyard/functions/check_derivatives.hpp"
#include "switchyard/functions/make_function.hpp"
#include "tests/functions/evaluated.hpp"
#include "tests/model/said.hpp"

namespace switchyard {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::VectorX;
using Eigen::VectorXd;

// Traces f, which must decide by no value, and expects of the tape the values of f on doubles and
// the derivatives of differences.
template <class F>
std::shared_ptr<const Function> ExpectTraced(const VectorXd& x, const F& f) {
  Recording recording(x);
  VectorX<Traced> inputs(x.size());
  for (int i = 0; i < x.size(); ++i) inputs[i] = recording.input(i);
  for (const Traced& y : functions_detail::Listed<Traced>(f(inputs))) recording.AddOutput(y);
  EXPECT_FALSE(recording.has_decisions());
  const auto compiled = CompileTape(recording.TakeTape());
  const std::vector<double> expected = functions_detail::Listed<double>(f(x));
  const Evaluated at = At(*compiled, x);
  EXPECT_EQ(static_cast<std::size_t>(at.values.size()), expected.size());
  for (int i = 0; i < at.values.size(); ++i) {
    EXPECT_NEAR(at.values[i], expected[i], 1e-14 * (1 + std::abs(expected[i])));
    EXPECT_NEAR(recording.outputs()[i], expected[i], 1e-14 * (1 + std::abs(expected[i])));
  }
  const DerivativeReport report = CheckDerivatives(*compiled, x);
  EXPECT_TRUE(report.agrees()) << to_string(report);
  return compiled;
}

VectorXd Generic(int n) {
  return VectorXd::NullaryExpr(n,
                               [](Eigen::Index i) { return 0.3 + 0.13 * static_cast<double>(i); });
}

TEST(Traced, HasTheOperatorsOfDoubles) {
  ExpectTraced(Generic(2), [](const auto& x) {
    auto y = x[0];
    y += x[1];
    y *= 2;
    y -= 0.5;
    y /= x[1];
    y = -y + 1;
    return +y * x[0] - 3.0 / x[1] + 2 * x[0] / 3.0f - (1 - x[0]) * (x[1] - 1u);
  });
}

TEST(Traced, HasTheFunctionsOfDoubles) {
  ExpectTraced(Generic(2), [](const auto& x) {
    using std::abs, std::acos, std::asin, std::atan, std::atan2, std::cos, std::cosh, std::exp,
        std::fabs, std::hypot, std::log, std::log10, std::log2, std::pow, std::sin, std::sinh,
        std::sqrt, std::tan, std::tanh;
    using T = std::decay_t<decltype(x[0])>;
    const T a = x[0];
    const T b = x[1];
    return std::vector<T>{sqrt(a),       exp(a),      log(a),    sin(a),      cos(a),
                          tan(a),        asin(a),     acos(a),   atan(a),     sinh(a),
                          cosh(a),       tanh(a),     abs(-a),   fabs(a),     pow(a, b),
                          pow(a, 2.5),   pow(a, 3),   pow(2, a), pow(2.0, b), atan2(a, b),
                          atan2(a, 2.0), hypot(a, b), log2(a),   log10(b)};
  });
}

TEST(Traced, SelectsAndRoundsWithoutDeciding) {
  ExpectTraced(Generic(2), [](const auto& x) {
    using std::ceil, std::floor, std::max, std::min;
    using T = std::decay_t<decltype(x[0])>;
    return std::vector<T>{min(x[0], x[1]) * 3, max(x[0], T(0.1)) * x[1], floor(x[0] * 7) + x[1],
                          ceil(x[1])};
  });
}

TEST(Traced, GoesThroughEigen) {
  const Matrix3d A = (Matrix3d() << 1, 2, 0, -1, 0.5, 3, 0, 4, -2).finished();
  const VectorXd x = Generic(3);
  ExpectTraced(x, [&](const auto& v) { return v.dot(v); });
  ExpectTraced(x, [&](const auto& v) { return v.norm(); });
  ExpectTraced(x, [&](const auto& v) { return v.squaredNorm() + v.sum() + v.prod(); });
  ExpectTraced(x, [&](const auto& v) { return (A * v).eval(); });
  ExpectTraced(x, [&](const auto& v) { return (2 * v + v * 3.0 - v / 2).eval(); });
  ExpectTraced(x, [&](const auto& v) { return v.cwiseAbs().eval(); });
  ExpectTraced(x, [&](const auto& v) { return (v.array() * v.array().sin() + 1.0).eval(); });
  ExpectTraced(x, [&](const auto& v) { return v.dot(A * v); });
  ExpectTraced(x, [&](const auto& v) { return v.transpose() * A * v; });
  ExpectTraced(x, [&](const auto& v) { return v.maxCoeff() - v.minCoeff(); });
  ExpectTraced(x, [&](const auto& v) { return (v.array() - 1.0).matrix().eval(); });
  ExpectTraced(x, [&](const auto& v) { return (v - VectorXd::Ones(3)).eval(); });
  ExpectTraced(x, [&](const auto& v) { return v.template lpNorm<1>(); });
  ExpectTraced(x, [&](const auto& v) { return v.template lpNorm<Eigen::Infinity>(); });
  ExpectTraced(x, [&](const auto& v) { return (v.asDiagonal() * A * v).eval(); });
  ExpectTraced(x, [&](const auto& v) { return v.mean(); });
  ExpectTraced(Generic(6), [&](const auto& v) {
    return v.template head<3>().cross(v.template tail<3>()).eval();
  });
}

TEST(Traced, GoesThroughProductsOfAnySize) {
  for (const int n : {2, 5, 20, 40}) {
    const MatrixXd A = MatrixXd::NullaryExpr(n, n, [](Eigen::Index i, Eigen::Index j) {
      return std::sin(static_cast<double>(3 * i + 5 * j));
    });
    Recording recording(VectorXd::Ones(n));
    VectorX<Traced> x(n);
    for (int i = 0; i < n; ++i) x[i] = recording.input(i);
    Eigen::MatrixX<Traced> X = x * x.transpose();
    const VectorX<Traced> y = A * (X * A) * x;
    for (const Traced& v : y) recording.AddOutput(v);
    EXPECT_FALSE(recording.has_decisions());
    const VectorXd at = VectorXd::LinSpaced(n, -1, 1);
    const VectorXd expected = A * at * (at.transpose() * A * at);
    const VectorXd ours = At(*CompileTape(recording.TakeTape()), at).values;
    EXPECT_LE((ours - expected).norm(), 1e-12 * (1 + expected.norm())) << n;
  }
}

template <class T>
Eigen::Matrix3<T> Rotation(const T& roll, const T& pitch, const T& yaw) {
  using std::cos, std::sin;
  Eigen::Matrix3<T> X, Y, Z;
  X << T(1), T(0), T(0), T(0), cos(roll), -sin(roll), T(0), sin(roll), cos(roll);
  Y << cos(pitch), T(0), sin(pitch), T(0), T(1), T(0), -sin(pitch), T(0), cos(pitch);
  Z << cos(yaw), -sin(yaw), T(0), sin(yaw), cos(yaw), T(0), T(0), T(0), T(1);
  return Z * Y * X;
}

TEST(Traced, MultipliesRotations) {
  const auto f = ExpectTraced(Generic(3), [](const auto& x) {
    using T = std::decay_t<decltype(x[0])>;
    const Eigen::Matrix3<T> R = Rotation<T>(x[0], x[1], x[2]);
    return (R * R.transpose() * Eigen::Vector3d(1, 2, 3)).eval();
  });
  EXPECT_NEAR(At(*f, Generic(3)).jacobian.norm(), 0, 1e-13);  // R R' v = v
  ExpectTraced(Generic(3), [](const auto& x) {
    using T = std::decay_t<decltype(x[0])>;
    return (Rotation<T>(x[0], x[1], x[2]) * Eigen::Vector3d(1, 2, 3)).eval();
  });
}

TEST(Traced, NotesWhatDecides) {
  const auto decides = [](const std::function<void(const Traced&)>& use) {
    Recording recording(Eigen::Vector2d(1, 2));
    use(recording.input(0));
    return recording.has_decisions();
  };
  EXPECT_TRUE(decides([](const Traced& x) { (void)(x < 1); }));
  EXPECT_TRUE(decides([](const Traced& x) { (void)(2.0 == x); }));
  EXPECT_TRUE(decides([](const Traced& x) { (void)x.value(); }));
  EXPECT_TRUE(decides([](const Traced& x) { (void)static_cast<double>(x); }));
  EXPECT_TRUE(decides([](const Traced& x) { (void)isfinite(x * 2); }));
  EXPECT_FALSE(decides([](const Traced& x) {
    (void)(Traced(1) < Traced(2));
    (void)x;
  }));
  EXPECT_FALSE(decides([](const Traced& x) { (void)(x * 0 == 0); }));
  EXPECT_FALSE(decides([](const Traced& x) { std::ostringstream() << x; }));
}

TEST(Traced, IsANumberWithoutARecording) {
  const Traced a = 3;
  EXPECT_EQ((a * a + sqrt(Traced(16))).value(), 13);
  EXPECT_TRUE(max(a, Traced(4)) == 4);
}

TEST(Traced, KeepsNestedRecordingsApart) {
  Recording outer(Eigen::Vector2d(1, 2));
  const Traced x = outer.input(0);
  {
    Recording inner(VectorXd::Constant(1, 5));
    const Traced y = inner.input(0);
    EXPECT_EQ(Said([&] { (void)(x * y); }),
              "Traced: a number of one recording was used in another; a function that is made "
              "inside another one may take its .value()");
    inner.AddOutput(y * y);
    outer.AddOutput(sin(x));  // to each its own
    EXPECT_EQ(inner.TakeTape().outputs().size(), 1u);
  }
  outer.AddOutput(x * outer.input(1));
  EXPECT_FALSE(outer.has_decisions());
  EXPECT_EQ(outer.outputs()[1], 2);
}

TEST(Traced, SaysThatItsRecordingHasEnded) {
  std::optional<Traced> kept;
  {
    Recording recording(VectorXd::Ones(1));
    kept = recording.input(0);
  }
  EXPECT_EQ(Said([&] { (void)(*kept + 1); }),
            "Traced: the recording of an operand of add has ended; keep numbers of one call out of "
            "the next");
  EXPECT_EQ(kept->value(), 1);
}

}  // namespace
}  // namespace switchyard
