// Inverse dynamics, its derivatives and its Hessian: against the two-link pendulum in closed form,
// the balance of energy and differences.
#include <cmath>
#include <string>

#include "engine.hpp"
#include "robots.hpp"

namespace switchyard::dynamics_plugin {
namespace {

constexpr double kG = 9.81;

// Of TwoLinkPendulum, by hand: with m, c, I of the bars and L the length of the first,
//   M11 = I1 + I2 + m1 c1^2 + m2 (L^2 + c2^2 + 2 L c2 cos q2), M12 = I2 + m2 (c2^2 + L c2 cos q2),
//   M22 = I2 + m2 c2^2, h = -m2 L c2 sin q2,
//   C v = (h (2 v1 v2 + v2^2), -h v1^2), and gravity along -z.
VectorXd ClosedForm(const VectorXd& q, const VectorXd& v, const VectorXd& a) {
  const double m1 = 2.0, c1 = 0.3, i1 = 0.05, m2 = 1.5, c2 = 0.25, i2 = 0.03, l = 0.8;
  const double m12 = i2 + m2 * (c2 * c2 + l * c2 * std::cos(q[1]));
  const double m22 = i2 + m2 * c2 * c2;
  const double m11 = i1 + m1 * c1 * c1 + m2 * l * l + 2 * m12 - m22;
  const double h = -m2 * l * c2 * std::sin(q[1]);
  const double outer = m2 * c2 * kG * std::cos(q[0] + q[1]);
  VectorXd tau(2);
  tau[0] = m11 * a[0] + m12 * a[1] + h * (2 * v[0] * v[1] + v[1] * v[1]) +
           (m1 * c1 + m2 * l) * kG * std::cos(q[0]) + outer;
  tau[1] = m12 * a[0] + m22 * a[1] - h * v[0] * v[0] + outer;
  return tau;
}

VectorXd Stacked(const VectorXd& q, const VectorXd& v, const VectorXd& a) {
  VectorXd x(q.size() + v.size() + a.size());
  x << q, v, a;
  return x;
}

void ExpectDerivatives(const Model& model, int seed) {
  const int n = model.n();
  const VectorXd x =
      1.3 * Stacked(Numbers(n, seed), 2.0 * Numbers(n, seed + 1), 3.0 * Numbers(n, seed + 2));
  const auto derivatives = [&](const VectorXd& at) {
    return model.Derivatives(at.head(n), at.segment(n, n), at.tail(n));
  };
  const auto found = derivatives(x);
  MatrixXd jacobian(n, 3 * n);
  jacobian << found.d_q, found.d_v, found.d_a;
  ExpectNear(found.tau, model.Tau(x.head(n), x.segment(n, n), x.tail(n)), 1e-13, "tau");
  ExpectNear(jacobian, Differences([&](const VectorXd& at) { return derivatives(at).tau; }, x),
             1e-9, "derivatives");
  ExpectNear(found.d_a, found.d_a.transpose(), 1e-14, "the mass matrix and its transpose");

  const VectorXd w = Numbers(n, seed + 3);
  const MatrixXd hessian = model.Hessian(x.head(n), x.segment(n, n), x.tail(n), w);
  const auto gradient = [&](const VectorXd& at) {
    const auto d = derivatives(at);
    return Stacked(d.d_q.transpose() * w, d.d_v.transpose() * w, d.d_a.transpose() * w);
  };
  ExpectNear(hessian, Differences(gradient, x), 1e-9, "Hessian");
  ExpectNear(hessian, hessian.transpose(), 0.0, "the Hessian and its transpose");
}

TEST(InverseDynamics, IsThatOfATwoLinkPendulumInClosedForm) {
  const Model model({.text = TwoLinkPendulum()});
  ASSERT_EQ(model.n(), 2);
  for (int seed = 0; seed < 10; ++seed) {
    const VectorXd q = 3.0 * Numbers(2, seed), v = 2.0 * Numbers(2, seed + 20),
                   a = 4.0 * Numbers(2, seed + 40);
    ExpectNear(model.Tau(q, v, a), ClosedForm(q, v, a), 1e-13, "tau");
  }
}

TEST(InverseDynamics, DerivativesAgreeWithDifferences) {
  const Model pendulum({.text = TwoLinkPendulum()});
  const Model branched({.text = Branched()});
  for (int seed = 0; seed < 5; ++seed) {
    ExpectDerivatives(pendulum, seed);
    ExpectDerivatives(branched, seed);
  }
}

// Power that the joints give is the rate of kinetic and potential energy: along q(t) = q0 + sin(t
// d), the integral of tau'v over [0, T] is the difference of energies. Without gravity M = d_a is
// the same, so the potential is found apart: tau at rest is its gradient.
TEST(InverseDynamics, BalancesEnergyAlongATrajectory) {
  const Model model(
      {.text = Robot("<link name=\"base\"/>\n" + Link("a", 2.0, 0.3, 0.05) +
                     Link("b", 1.5, 0.2, 0.04) + Link("c", 1.0, -0.1, 0.02) +
                     Joint("turn", "continuous", "base", "a", "0 0 0", "0.2 1 0.1") +
                     Joint("slide", "prismatic", "a", "b", "0.3 0.1 0", "1 0.5 -0.3") +
                     Joint("bend", "revolute", "b", "c", "0 0.4 0.1", "0 1 0"))});
  const VectorXd q0 = Numbers(3, 1), d = Numbers(3, 2), zero = VectorXd::Zero(3);
  const int steps = 400;  // Simpson's rule
  const double end = 2.0, h = end / steps;
  double work = 0.0, of_gravity = 0.0;
  const auto kinetic = [&](double t) {
    const VectorXd q = q0 + (t * d).array().sin().matrix();
    const VectorXd v = d.cwiseProduct((t * d).array().cos().matrix());
    return 0.5 * v.dot(model.Derivatives(q, v, zero).d_a * v);
  };
  for (int i = 0; i <= steps; ++i) {
    const double t = i * h, weight = h / 3.0 * (i == 0 || i == steps ? 1 : i % 2 == 1 ? 4 : 2);
    const VectorXd q = q0 + (t * d).array().sin().matrix();
    const VectorXd v = d.cwiseProduct((t * d).array().cos().matrix());
    const VectorXd a = -d.cwiseProduct(d).cwiseProduct((t * d).array().sin().matrix());
    work += weight * v.dot(model.Tau(q, v, a));
    of_gravity += weight * v.dot(model.Tau(q, zero, zero));
  }
  EXPECT_NEAR(work, kinetic(end) - kinetic(0.0) + of_gravity, 1e-9);

  // The potential is that of the masses: their heights, by the frames of their bodies.
  const auto potential = [&](double t) {
    const VectorXd q = q0 + (t * d).array().sin().matrix();
    double sum = 0.0;
    const std::pair<const char*, Eigen::Vector2d> bodies[] = {
        {"a", {2.0, 0.3}}, {"b", {1.5, 0.2}}, {"c", {1.0, -0.1}}};
    for (const auto& [name, body] : bodies) {
      const auto placed = model.Frame(model.FrameNamed(name), q);
      sum += body[0] * kG * (placed.position + placed.rotation * Vector3d(body[1], 0, 0))[2];
    }
    return sum;
  };
  EXPECT_NEAR(of_gravity, potential(end) - potential(0.0), 1e-9);
}

TEST(InverseDynamics, DampingIsAddedAndFrictionIsOnlyReported) {
  const Model plain({.text = TwoLinkPendulum()});
  const Model damped({.text = TwoLinkPendulum("<dynamics damping=\"0.4\" friction=\"0.7\"/>")});
  EXPECT_EQ(damped.joint(0).damping, 0.4);
  EXPECT_EQ(damped.joint(1).friction, 0.7);
  EXPECT_EQ(plain.joint(1).damping, 0.0);
  const VectorXd q = Numbers(2, 3), v = Numbers(2, 4), a = Numbers(2, 5);
  ExpectNear(damped.Tau(q, v, a), plain.Tau(q, v, a) + 0.4 * v, 1e-14, "tau");
  ExpectDerivatives(damped, 3);
}

TEST(InverseDynamics, ArmatureIsPartOfTheMassMatrix) {
  const auto text = [](const std::string& armature) {
    return "<mujoco><worldbody><body name=\"a\"><joint name=\"j\" type=\"hinge\" axis=\"0 1 0\"" +
           armature + "/><inertial pos=\"0.2 0 0\" mass=\"2\" diaginertia=\"0.1 0.1 0.1\"/>" +
           "<body name=\"b\" pos=\"0 0 1\"><joint name=\"k\" type=\"slide\" axis=\"1 0 0\"" +
           armature + "/><inertial pos=\"0 0 0.1\" mass=\"1\" diaginertia=\"0.1 0.1 0.1\"/>" +
           "</body></body></worldbody></mujoco>";
  };
  const Model plain({.format = SY_MODEL_MJCF, .text = text("")});
  const Model heavy({.format = SY_MODEL_MJCF, .text = text(" armature=\"0.6\"")});
  ASSERT_EQ(heavy.n(), 2);
  EXPECT_EQ(heavy.joint(1).armature, 0.6);
  const VectorXd q = Numbers(2, 3), v = Numbers(2, 4), a = Numbers(2, 5);
  ExpectNear(heavy.Tau(q, v, a), plain.Tau(q, v, a) + 0.6 * a, 1e-14, "tau");
  ExpectNear(heavy.Derivatives(q, v, a).d_a,
             plain.Derivatives(q, v, a).d_a + 0.6 * MatrixXd::Identity(2, 2), 1e-14, "mass matrix");
  ExpectDerivatives(heavy, 2);
}

TEST(InverseDynamics, GravityIsTheOneAskedFor) {
  const VectorXd q = Numbers(2, 7), zero = VectorXd::Zero(2);
  const Model still({.text = TwoLinkPendulum(), .gravity = Vector3d::Zero()});
  EXPECT_EQ(still.Tau(q, zero, zero), zero);
  const Model twice({.text = TwoLinkPendulum(), .gravity = {0.0, 0.0, -2 * kG}});
  ExpectNear(twice.Tau(q, zero, zero), 2.0 * ClosedForm(q, zero, zero), 1e-14, "tau");
}

TEST(InverseDynamics, ContinuousJointsArePeriodicAngles) {
  const Model model({.text = Branched()});
  ASSERT_EQ(model.n(), 5);
  EXPECT_EQ(model.joint(0).type, SY_JOINT_CONTINUOUS);
  EXPECT_EQ(model.joint(0).position_upper, std::numeric_limits<double>::infinity());
  VectorXd q = Numbers(5, 1);
  const VectorXd v = Numbers(5, 2), a = Numbers(5, 3), tau = model.Tau(q, v, a);
  q[0] += 2.0 * M_PI;
  ExpectNear(model.Tau(q, v, a), tau, 1e-13, "tau a turn on");
  q[0] -= M_PI;
  EXPECT_GT((model.Tau(q, v, a) - tau).norm(), 0.1);
}

TEST(InverseDynamics, OnlyWhatIsWantedIsWritten) {
  const Model model({.text = TwoLinkPendulum()});
  const VectorXd q = Numbers(2, 1), v = Numbers(2, 2), a = Numbers(2, 3);
  const auto all = model.Derivatives(q, v, a);
  MatrixXd d_v(2, 2);
  sy_error error{};
  ASSERT_EQ(Table().inverse_dynamics(model.get(), q.data(), v.data(), a.data(), nullptr, nullptr,
                                     d_v.data(), nullptr, &error),
            SY_OK);
  EXPECT_EQ(d_v, all.d_v);
}

}  // namespace
}  // namespace switchyard::dynamics_plugin
