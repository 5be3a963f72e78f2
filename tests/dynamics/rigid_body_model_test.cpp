// A model through an engine's table: what it is told, what it answers, and its derivatives.
#include "switchyard/dynamics/rigid_body_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <thread>

#include "switchyard/dynamics/model_functions.hpp"
#include "switchyard/functions/check_derivatives.hpp"
#include "tests/model/said.hpp"
#include "tests/support/fake_dynamics.hpp"

namespace switchyard::testing {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kExact = 1e-7;

const Vector2d kQ(0.4, -1.1), kV(0.7, 1.9), kA(-2.1, 0.8);

void ExpectExact(const Function& f, const VectorXd& x, const VectorXd& weights) {
  const auto report = CheckDerivatives(f, x, weights, kExact);
  EXPECT_TRUE(report.agrees()) << to_string(report);
}

TEST(RigidBodyModel, SaysWhatTheFileSays) {
  const RigidBodyModel model = Fake("two_link");
  EXPECT_EQ(model.name(), "two_link");
  EXPECT_EQ(model.engine(), "closed_forms 1.0");
  ASSERT_EQ(model.num_positions(), 2);
  EXPECT_EQ(model.joints()[0].type, RigidBodyJoint::Type::kContinuous);
  EXPECT_EQ(model.JointIndex("elbow"), 1);
  EXPECT_EQ(model.position_lower_limits(), Vector2d(-kInfinity, -2.5));
  EXPECT_EQ(model.position_upper_limits(), Vector2d(kInfinity, 2.5));
  EXPECT_EQ(model.velocity_limits(), Vector2d(4, 6));
  EXPECT_EQ(model.effort_limits(), Vector2d(25, 8));
  EXPECT_EQ(model.FrameIndex("tip"), 2);
  EXPECT_TRUE(model.pairs().empty());
  EXPECT_EQ(Fake("two_link", true).PairIndex("standing_ball", "tip_ball"), 0);
}

// Its power is the rate of its energy, and what damping takes.
TEST(RigidBodyModel, TakesTheEffortsThatChangeItsEnergy) {
  const RigidBodyModel model = Fake("two_link");
  const double h = 1e-4;
  const auto energy = [&](double t) {
    return TwoLink::Energy(kQ + t * kV + t * t / 2 * kA, kV + t * kA);
  };
  const double rate = (8 * (energy(h) - energy(-h)) - (energy(2 * h) - energy(-2 * h))) / (12 * h);
  const double lost = TwoLink::kDamping[0] * kV[0] * kV[0] + TwoLink::kDamping[1] * kV[1] * kV[1];
  EXPECT_NEAR(model.InverseDynamics(kQ, kV, kA).dot(kV), rate + lost, 1e-8);
}

TEST(RigidBodyModel, HasDerivativesOfEffortsInTheirOwnPlaces) {
  const RigidBodyModel model = Fake("two_link");
  const auto all = model.DerivativesOfInverseDynamics(kQ, kV, kA);
  EXPECT_EQ(all.tau, model.InverseDynamics(kQ, kV, kA));
  EXPECT_LE((all.d_a - all.d_a.transpose()).norm(), 1e-15);
  const Vector2d zero = Vector2d::Zero();
  EXPECT_LE((all.d_a * kA - (all.tau - model.InverseDynamics(kQ, kV, zero))).norm(), 1e-12);
  const double h = 1e-6;
  const Vector2d up(0, h);
  const auto slope = [&](const VectorXd& a, const VectorXd& b) { return (a - b) / (2 * h); };
  EXPECT_LE((slope(model.InverseDynamics(kQ + up, kV, kA), model.InverseDynamics(kQ - up, kV, kA)) -
             all.d_q.col(1))
                .norm(),
            1e-7);
  EXPECT_LE((slope(model.InverseDynamics(kQ, kV + up, kA), model.InverseDynamics(kQ, kV - up, kA)) -
             all.d_v.col(1))
                .norm(),
            1e-7);
  const MatrixXd H = model.HessianOfInverseDynamics(kQ, kV, kA, Vector2d(1, 0));
  EXPECT_EQ(H, H.transpose());
  EXPECT_NEAR(H(1, 4),
              -2 * TwoLink::kMass[1] * TwoLink::kLength[0] * TwoLink::kLength[1] * std::sin(kQ[1]),
              1e-12);
}

TEST(ModelFunctions, OfEffortsHaveExactDerivatives) {
  const RigidBodyModel model = Fake("two_link");
  VectorXd x(6);
  x << kQ, kV, kA;
  ExpectExact(*InverseDynamicsFunction(model, {0, 1}), x, Vector2d(0.3, -1.2));
  ExpectExact(*InverseDynamicsFunction(model, {1}), x, VectorXd::Ones(1));
  const auto swapped = InverseDynamicsFunction(model, {1, 0});
  ExpectExact(*swapped, x, Vector2d(2, 0.5));
  Vector2d y;
  swapped->Evaluate({.x = x.data(), .values = y.data()});
  EXPECT_EQ(y.reverse(), model.InverseDynamics(kQ, kV, kA));
}

TEST(ModelFunctions, OfFramesHaveExactDerivatives) {
  Eigen::Matrix3d A, B;
  A << 1, -2, 0.5, 0.3, 0.7, -1.1, 2, 0.1, -0.4;
  B << -0.6, 0.2, 1.5, -1, 0.9, 0.8, 0.4, -1.3, 0.25;
  for (const char* text : {"two_link", "pan_tilt"}) {
    const RigidBodyModel model = Fake(text);
    for (int frame = 0; frame < 3; ++frame) {
      const auto f = FrameFunction(model, frame,
                                   {{Vector3d(1, 2, -1), A, 0.5}, {Vector3d(-0.3, 0.4, 2), B, 0}});
      ExpectExact(*f, kQ, Vector2d(1.3, -0.7));
      ExpectExact(*f, kA, Vector2d(0.2, 1));
    }
  }
}

TEST(ModelFunctions, OfFramesHaveNoSecondDerivativesWhereACoordinateMovesTwoJoints) {
  const RigidBodyModel model = Fake("folded");
  const Vector3d c(1, 2, -1);
  EXPECT_TRUE(FrameFunction(model, 0, {{c, Eigen::Matrix3d::Zero(), 0}})->has_hessian());
  const auto f = FrameFunction(model, 2, {{c, Eigen::Matrix3d::Identity(), 0}});
  EXPECT_FALSE(f->has_hessian());
  ExpectExact(*f, kQ, {});
}

TEST(ModelFunctions, OfDistancesHaveTheirDerivatives) {
  const RigidBodyModel model = Fake("two_link", true);
  const auto f = DistanceFunction(model, {0, 0});
  ExpectExact(*f, kQ, {});
  const auto all = model.DerivativesOfDistances(kQ, {0});
  EXPECT_EQ(all.distance, model.Distances(kQ, {0}));
  const Vector3d tip = model.PoseOf("tip", kQ).position;
  EXPECT_NEAR(all.distance[0], (tip - Vector3d(0.8, 0, 1.45)).norm() - 0.3, 1e-14);
}

TEST(RigidBodyModel, MovesItsFramesByTheirJacobian) {
  const RigidBodyModel model = Fake("pan_tilt");
  const FrameMotion motion = model.MotionOf("tip", kQ);
  const double h = 1e-6;
  const FramePose ahead = model.PoseOf("tip", kQ + h * kV),
                  behind = model.PoseOf("tip", kQ - h * kV);
  const VectorXd twist = motion.jacobian * kV;
  EXPECT_LE(((ahead.position - behind.position) / (2 * h) - twist.head<3>()).norm(), 1e-8);
  const Eigen::Matrix3d turned = (ahead.rotation - behind.rotation) / (2 * h);
  const Eigen::Matrix3d spin = turned * motion.pose.rotation.transpose();
  EXPECT_LE((Vector3d(spin(2, 1), spin(0, 2), spin(1, 0)) - twist.tail<3>()).norm(), 1e-8);
}

TEST(RigidBodyModel, AnswersManyThreadsAtOnce) {
  const RigidBodyModel model = Fake("two_link");
  const VectorXd expected = model.InverseDynamics(kQ, kV, kA);
  std::vector<int> wrong(4, 0);
  std::vector<std::thread> threads;
  for (int& count : wrong) {
    threads.emplace_back([&, own = model] {
      for (int i = 0; i < 200; ++i) count += own.InverseDynamics(kQ, kV, kA) == expected ? 0 : 1;
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, std::vector<int>(4, 0));
}

// ---- Mistakes ----

TEST(RigidBodyMistakes, OfAnEngineThatIsNotThere) {
  const Host none(HostOptions{{}, std::vector<std::string>{"/nowhere", "/nor/here"}, {}});
  RigidBodyOptions options;
  options.host = &none;
  EXPECT_TRUE(RigidBodyModel::Engines(&none).empty());
  EXPECT_EQ(Said([&] { (void)RigidBodyModel::LoadUrdf("arm.urdf", options); }),
            "LoadUrdf: no loaded plugin offers rigid-body dynamics (sy.dynamics/1); the plugin "
            "pinocchio does, and was looked for in /nowhere, /nor/here");
  const FakeDynamics fakes;
  options.host = &fakes.host();
  EXPECT_EQ(RigidBodyModel::Engines(&fakes.host()), std::vector<std::string>{"closed_forms"});
  options.engine = "open_forms";
  EXPECT_EQ(
      Said([&] { (void)RigidBodyModel::ParseUrdf("two_link", options); }),
      "ParseUrdf: there is no engine \"open_forms\" of rigid-body dynamics, but closed_forms");
  for (const char* name : {"closed_forms", "fakes"}) {
    options.engine = name;
    EXPECT_EQ(RigidBodyModel::ParseUrdf("two_link", options).num_positions(), 2);
  }
}

TEST(RigidBodyMistakes, OfFilesAndTheirJoints) {
  const FakeDynamics fakes;
  RigidBodyOptions options;
  options.host = &fakes.host();
  EXPECT_EQ(Said([&] { (void)RigidBodyModel::LoadMjcf("absent.xml", options); }),
            "LoadMjcf: \"absent.xml\" cannot be read");
  EXPECT_EQ(Said([&] { (void)RigidBodyModel::ParseMjcf("<robot", options); }),
            "ParseMjcf: line 1: not a model: <robot");
  options.locked = {{"finger", kInfinity}};
  EXPECT_EQ(Said([&] { (void)RigidBodyModel::ParseUrdf("two_link", options); }),
            "ParseUrdf: the locked joint \"finger\" needs a finite position, got inf");
  options.locked = {{"finger", 0}};
  EXPECT_EQ(Said([&] { (void)RigidBodyModel::ParseUrdf("two_link", options); }),
            "ParseUrdf: there is no joint \"finger\" to lock");
  options.gravity = Vector3d(0, kInfinity, 0);
  options.locked.clear();
  EXPECT_EQ(Said([&] { (void)RigidBodyModel::ParseUrdf("two_link", options); }),
            "ParseUrdf: gravity[1] needs to be finite, got inf");
}

TEST(RigidBodyMistakes, OfNamesIndicesAndSizes) {
  const RigidBodyModel model = Fake("two_link");
  EXPECT_EQ(Said([&] { (void)model.PoseOf("tap", kQ); }),
            "\"two_link\" has no frame \"tap\"; is \"tip\" meant?");
  EXPECT_EQ(Said([&] { (void)model.JointIndex("shouder"); }),
            "\"two_link\" has no joint \"shouder\"; is \"shoulder\" meant?");
  EXPECT_EQ(Said([&] { (void)model.InverseDynamics(kQ, Vector3d::Zero(), kA); }),
            "InverseDynamics: v needs 2 entries, one for each joint of \"two_link\", got 3");
  EXPECT_EQ(Said([&] { (void)model.PairIndex("a", "b"); }),
            "PairIndex: \"two_link\" has no pairs of shapes; load the model with geometry");
  EXPECT_EQ(Said([&] { (void)model.Distances(kQ, {0}); }),
            "Distances: a pair of \"two_link\" needs an index from 0 to below 0, got 0; load the "
            "model with geometry");
  const RigidBodyModel shaped = Fake("two_link", true);
  EXPECT_EQ(Said([&] { (void)DistanceFunction(shaped, {1}); }),
            "DistanceFunction: a pair of \"two_link\" needs an index from 0 to below 1, got 1");
  EXPECT_EQ(Said([&] { (void)shaped.PairIndex("tip_ball", "standing_bal"); }),
            "\"two_link\" has no shape \"standing_bal\"; is \"standing_ball\" meant?");
  EXPECT_EQ(Said([&] { (void)InverseDynamicsFunction(model, {2}); }),
            "InverseDynamicsFunction: a joint of \"two_link\" needs an index from 0 to below 2, "
            "got 2");
  EXPECT_EQ(Said([&] { (void)Fake("pan_tilt").InverseDynamics(kQ, kV, kA); }),
            "inverse dynamics of \"pan_tilt\", by closed_forms 1.0: a pan and tilt has no masses");
}

}  // namespace
}  // namespace switchyard::testing
