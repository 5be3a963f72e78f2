// Poses of frames in closed form, their Jacobians by differences.
#include <cmath>
#include <string>
#include <thread>
#include <vector>

#include "engine.hpp"
#include "robots.hpp"

namespace switchyard::dynamics_plugin {
namespace {

TEST(Frames, TheTipOfAPendulumIsWhereGeometryPutsIt) {
  const Model model({.text = TwoLinkPendulum()});
  const int tip = model.FrameNamed("tip");
  for (int seed = 0; seed < 5; ++seed) {
    const VectorXd q = 3.0 * Numbers(2, seed);
    const double one = q[0], both = q[0] + q[1];
    const auto placed = model.Frame(tip, q);
    ExpectNear(placed.position,
               Vector3d(0.8 * std::cos(one) + 0.6 * std::cos(both), 0.0,
                        0.8 * std::sin(one) + 0.6 * std::sin(both)),
               1e-14, "position");
    Matrix3d rotation;
    rotation << std::cos(both), 0, -std::sin(both), 0, 1, 0, std::sin(both), 0, std::cos(both);
    ExpectNear(placed.rotation, rotation, 1e-14, "rotation");
    ExpectNear(placed.jacobian.col(1).tail<3>(), Vector3d(0, -1, 0), 1e-14, "turning");
  }
}

TEST(Frames, JacobiansAgreeWithDifferences) {
  const Model model({.text = Branched()});
  const VectorXd q = 2.0 * Numbers(5, 3);
  for (int frame = 0; frame < model.facts().num_frames; ++frame) {
    const auto placed = model.Frame(frame, q);
    EXPECT_NEAR((placed.rotation.transpose() * placed.rotation - Matrix3d::Identity()).norm(), 0.0,
                1e-13);
    const MatrixXd position = Differences(
        [&](const VectorXd& at) { return VectorXd(model.Frame(frame, at).position); }, q);
    const MatrixXd axes = Differences(
        [&](const VectorXd& at) {
          const Matrix3d rotation = model.Frame(frame, at).rotation;
          return VectorXd(rotation.reshaped());
        },
        q);
    ExpectNear(placed.jacobian.topRows(3), position, 1e-9, model.facts().frames[frame]);
    for (int i = 0; i < 5; ++i) {  // dR = omega x R
      for (int axis = 0; axis < 3; ++axis) {
        const Vector3d turn = placed.jacobian.col(i).tail<3>();
        ExpectNear(axes.col(i).segment<3>(3 * axis),
                   turn.cross(Vector3d(placed.rotation.col(axis))), 1e-9,
                   model.facts().frames[frame]);
      }
    }
  }
}

TEST(Frames, OnlyThoseThatAreThereAreTaken) {
  const Model model({.text = TwoLinkPendulum()});
  const VectorXd q = Numbers(2, 1);
  sy_error error{};
  Vector3d position;
  EXPECT_EQ(Table().frame(model.get(), model.FrameNamed("tip"), q.data(), position.data(), nullptr,
                          nullptr, &error),
            SY_OK);
  EXPECT_EQ(position, model.Frame(model.FrameNamed("tip"), q).position);
  const int num = model.facts().num_frames;
  EXPECT_EQ(Table().frame(model.get(), num, q.data(), nullptr, nullptr, nullptr, &error),
            SY_E_ARGUMENT);
  EXPECT_EQ(std::string(error.text),
            "frame " + std::to_string(num) + " is not there: there are " + std::to_string(num));
}

// Each thread computes all of it, in an order of its own; one model serves them all.
TEST(Frames, EightThreadsOnOneModelAreAsOne) {
  const Model model({.text = Branched()});
  constexpr int kPoints = 40;
  const auto evaluate = [&](int seed) {
    const VectorXd q = 2.0 * Numbers(5, seed), v = Numbers(5, seed + 1), a = Numbers(5, seed + 2);
    const auto efforts = model.Derivatives(q, v, a);
    const auto placed = model.Frame(seed % model.facts().num_frames, q);
    MatrixXd all(5 + 15 + 15, 15);
    all.setZero();
    all.topLeftCorner(5, 15) << efforts.d_q, efforts.d_v, efforts.d_a;
    all.middleRows(5, 15) = model.Hessian(q, v, a, Numbers(5, seed + 3));
    all.block(20, 0, 6, 5) = placed.jacobian;
    all.block(20, 5, 3, 1) = placed.position;
    all.block(26, 0, 5, 1) = efforts.tau;
    all.block(26, 1, 5, 1) = model.Tau(q, v, a);
    return all;
  };
  std::vector<MatrixXd> alone;
  for (int seed = 0; seed < kPoints; ++seed) alone.push_back(evaluate(seed));
  std::vector<int> different(8, 0);
  std::vector<std::thread> threads;
  for (int t = 0; t < 8; ++t) {
    threads.emplace_back([&, t] {
      for (int i = 0; i < 10 * kPoints; ++i) {
        const int seed = (7 * t + 3 * i) % kPoints;
        if (evaluate(seed) != alone[static_cast<std::size_t>(seed)]) {
          ++different[static_cast<std::size_t>(t)];
        }
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(different, std::vector<int>(8, 0));
}

}  // namespace
}  // namespace switchyard::dynamics_plugin
