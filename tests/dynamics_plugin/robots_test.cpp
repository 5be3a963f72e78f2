// Robots of example-robot-data: what the mathematics of every robot demands.
#include <Eigen/Eigenvalues>
#include <cmath>
#include <filesystem>
#include <string>

#include "engine.hpp"

namespace switchyard::dynamics_plugin {
namespace {

const std::string kShare = SWITCHYARD_ROBOTS;
const std::string kRobots = kShare + "/example-robot-data/robots/";

Source Panda() {
  return {.path = kRobots + "panda_description/urdf/panda.urdf",
          .packages = {kShare},
          .locked = {{"panda_finger_joint1", 0.02}},
          .geometry = true};
}

class Robots : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(kRobots)) GTEST_SKIP() << "no example-robot-data in " << kShare;
  }
};

TEST_F(Robots, AnArmOfSevenJointsIsAMechanicalSystem) {
  const Model model(Panda());
  ASSERT_EQ(model.n(), 7);
  for (int i = 0; i < 7; ++i) {
    EXPECT_TRUE(std::isfinite(model.joint(i).effort)) << model.joint(i).name;
    EXPECT_TRUE(std::isfinite(model.joint(i).velocity)) << model.joint(i).name;
    EXPECT_LT(model.joint(i).position_lower, model.joint(i).position_upper);
  }
  const VectorXd q = Numbers(7, 1), v = Numbers(7, 2), a = Numbers(7, 3), w = Numbers(7, 4);
  const auto efforts = model.Derivatives(q, v, a);
  ExpectNear(efforts.d_a, efforts.d_a.transpose(), 1e-14, "the mass matrix and its transpose");
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<MatrixXd>(efforts.d_a).eigenvalues().minCoeff(), 1e-4);
  VectorXd x(21);
  x << q, v, a;
  const auto at = [&](const VectorXd& y) {
    return model.Derivatives(y.head(7), y.segment(7, 7), y.tail(7));
  };
  MatrixXd jacobian(7, 21);
  jacobian << efforts.d_q, efforts.d_v, efforts.d_a;
  ExpectNear(jacobian, Differences([&](const VectorXd& y) { return at(y).tau; }, x), 1e-9, "d tau");
  const auto gradient = [&](const VectorXd& y) {
    const auto d = at(y);
    VectorXd g(21);
    g << d.d_q.transpose() * w, d.d_v.transpose() * w, d.d_a.transpose() * w;
    return g;
  };
  ExpectNear(model.Hessian(q, v, a, w), Differences(gradient, x), 1e-9, "Hessian");
}

TEST_F(Robots, TheDistancesOfAnArmHaveTheirGradients) {
  const Model model(Panda());
  const VectorXd q = 0.5 * Numbers(7, 6);
  std::vector<std::int32_t> pairs;
  for (std::int32_t i = 0; i < model.facts().num_pairs; ++i) pairs.push_back(i);
  ASSERT_GT(pairs.size(), 10u);
  const auto apart = model.Distances(q, pairs);
  // Where two features are nearly as near the differences straddle: most agree to what GJK sees.
  const MatrixXd differences = Differences(
      [&](const VectorXd& at) { return model.Distances(at, pairs).distances; }, q, 1e-4);
  int near = 0;
  for (Eigen::Index i = 0; i < apart.distances.size(); ++i) {
    EXPECT_LT(apart.gradients.row(i).cwiseAbs().maxCoeff(), 3.0);  // no point is further out
    if ((apart.gradients.row(i) - differences.row(i)).norm() < 1e-3) ++near;
  }
  EXPECT_GT(near, 9 * static_cast<int>(pairs.size()) / 10);
}

TEST_F(Robots, EveryArmOfTheSetLoads) {
  const std::pair<const char*, int> arms[] = {
      {"panda_description/urdf/panda.urdf", 8},
      {"ur_description/urdf/ur5_robot.urdf", 6},
      {"kinova_description/robots/kinova.urdf", 6},
      {"xarm_description/urdf/xarm7.urdf", 7},
      {"double_pendulum_description/urdf/double_pendulum.urdf", 2}};
  for (const auto& [path, n] : arms) {
    try {
      EXPECT_EQ(Model({.path = kRobots + path, .packages = {kShare}, .geometry = true}).n(), n)
          << path;
    } catch (const Failed& failed) {
      ADD_FAILURE() << path << ": " << failed.text;
    }
  }
}

}  // namespace
}  // namespace switchyard::dynamics_plugin
