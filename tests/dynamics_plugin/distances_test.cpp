// Distances of bodies in closed form, their gradients by differences.
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "engine.hpp"
#include "robots.hpp"

namespace switchyard::dynamics_plugin {
namespace {

std::string Shape(const std::string& geometry) {
  return "<collision><geometry>" + geometry + "</geometry></collision>";
}

std::string Ball(double radius) {
  return Shape("<sphere radius=\"" + std::to_string(radius) + "\"/>");
}

/// Three sliders, each along an axis of the world, carry a shape past one that is fixed: the first
/// and the last body are not adjacent, and q is the displacement.
Source Sliders(const std::string& fixed, const std::string& moving) {
  return {.text = Robot("<link name=\"base\">" + fixed + "</link>\n" + Link("a", 1, 0, 1) +
                        Link("b", 1, 0, 1) + Link("c", 1, 0, 1, moving) +
                        Joint("x", "prismatic", "base", "a", "0 0 0", "1 0 0") +
                        Joint("y", "prismatic", "a", "b", "0 0 0", "0 1 0") +
                        Joint("z", "prismatic", "b", "c", "0 0 0", "0 0 1")),
          .geometry = true};
}

TEST(Distances, TwoSpheresAreAsFarApartAsTheirCentresLessTheirRadii) {
  const Model model(Sliders(Ball(0.3), Ball(0.2)));
  ASSERT_EQ(model.facts().num_pairs, 1);
  EXPECT_STREQ(model.facts().pair_first[0], "base_0");
  EXPECT_STREQ(model.facts().pair_second[0], "c_0");
  for (const Vector3d& q : {Vector3d(1, 0.5, -0.3), Vector3d(0.2, 0.1, 0.1), Vector3d(0, 0, 2)}) {
    const auto apart = model.Distances(q, {0});  // the second of them: they meet
    EXPECT_NEAR(apart.distances[0], q.norm() - 0.5, 1e-12);
    ExpectNear(apart.gradients, q.normalized().transpose(), 1e-12, "gradient");
  }
}

TEST(Distances, TwoBoxesAreAsFarApartAsTheirFaces) {
  const Model model(
      Sliders(Shape("<box size=\"0.4 0.6 0.8\"/>"), Shape("<box size=\"0.2 0.2 0.2\"/>")));
  const auto apart = model.Distances(Vector3d(1.0, 0.05, -0.1), {0});
  EXPECT_NEAR(apart.distances[0], 1.0 - 0.2 - 0.1, 1e-7);
  ExpectNear(apart.gradients, Eigen::RowVector3d(1, 0, 0), 1e-6, "gradient");
  // They meet, 0.05 deep along x and more along the others.
  const auto within = model.Distances(Vector3d(-0.25, 0.05, -0.1), {0});
  EXPECT_NEAR(within.distances[0], -0.05, 1e-6);
  ExpectNear(within.gradients, Eigen::RowVector3d(-1, 0, 0), 1e-5, "gradient within");
}

TEST(Distances, GradientsAgreeWithDifferencesThroughTurningJoints) {
  const Model model(
      {.text =
           Robot("<link name=\"base\">" + Ball(0.1) + "</link>\n" + Link("a", 1, 0, 1, Ball(0.05)) +
                 Link("b", 1, 0, 1, Shape("<cylinder radius=\"0.05\" length=\"0.3\"/>")) +
                 Link("c", 1, 0, 1, Ball(0.1)) + Link("d", 1, 0, 1, Ball(0.12)) +
                 Joint("j", "continuous", "base", "a", "0.5 0 0", "0.2 1 0.1") +
                 Joint("k", "continuous", "a", "b", "0 0.7 0", "1 0.5 -0.3") +
                 Joint("l", "prismatic", "b", "c", "0 0.4 0.5", "0 1 1") +
                 Joint("m", "revolute", "base", "d", "0 -0.7 0.5", "0.3 0.1 0.2")),
       .geometry = true});
  ASSERT_EQ(model.facts().num_pairs, 6);  // ten, less four of bodies that a joint connects
  const std::vector<std::int32_t> all = {5, 0, 1, 2, 3, 4};
  for (int seed = 0; seed < 5; ++seed) {
    const VectorXd q = Numbers(4, seed);
    const auto apart = model.Distances(q, all);
    EXPECT_GT(apart.distances.minCoeff(), 0.0);
    ExpectNear(
        apart.gradients,
        Differences([&](const VectorXd& at) { return model.Distances(at, all).distances; }, q),
        1e-6, "gradients");
  }
}

TEST(Distances, GeometryIsThereWhereItIsAskedFor) {
  Source source = Sliders(Ball(0.3), Ball(0.2));
  source.geometry = false;
  EXPECT_EQ(Model(source).facts().num_pairs, 0);
  source.geometry = true;
  source.locked = {{"x", 0.7}, {"y", 0.0}};  // then the two are neighbours
  EXPECT_EQ(Model(source).facts().num_pairs, 0);
  source.locked = {{"x", 0.7}};
  const Model model(source);
  ASSERT_EQ(model.facts().num_pairs, 1);
  EXPECT_NEAR(model.Distances(Eigen::Vector2d(0, 0), {0}).distances[0], 0.2, 1e-12);
  const VectorXd q = VectorXd::Zero(2);
  const std::int32_t pair = 1;
  double distance = 0;
  sy_error error{};
  EXPECT_EQ(Table().distances(model.get(), q.data(), &pair, 1, &distance, nullptr, &error),
            SY_E_ARGUMENT);
  EXPECT_STREQ(error.text, "pair 1 is not there: there are 1");
}

// The corner of a tetrahedron whose other three lie in the plane x = 0.
constexpr const char* kTetrahedron = R"(solid t
facet normal 0 0 0
outer loop
vertex 0.5 0 0
vertex 0 0.5 -0.5
vertex 0 0 0.5
endloop
endfacet
facet normal 0 0 0
outer loop
vertex 0.5 0 0
vertex 0 0 0.5
vertex 0 -0.5 -0.5
endloop
endfacet
facet normal 0 0 0
outer loop
vertex 0.5 0 0
vertex 0 -0.5 -0.5
vertex 0 0.5 -0.5
endloop
endfacet
facet normal 0 0 0
outer loop
vertex 0 0.5 -0.5
vertex 0 -0.5 -0.5
vertex 0 0 0.5
endloop
endfacet
endsolid t
)";

TEST(Distances, AMeshOfAPackageIsFoundAndStandsForItsHull) {
  const std::string folder = testing::TempDir() + "switchyard_dynamics_meshes";
  std::filesystem::create_directories(folder + "/shapes");
  std::ofstream(folder + "/shapes/t.stl") << kTetrahedron;
  Source source = Sliders(Shape("<mesh filename=\"package://shapes/t.stl\"/>"), Ball(0.1));
  source.packages = {"/nowhere", folder};
  {
    const Model model(source);
    const auto apart = model.Distances(Vector3d(2, 0, 0), {0});
    EXPECT_NEAR(apart.distances[0], 1.4, 1e-7);
    ExpectNear(apart.gradients, Eigen::RowVector3d(1, 0, 0), 1e-6, "gradient");
    EXPECT_NEAR(model.Distances(Vector3d(-1, 0, 0), {0}).distances[0], 0.9, 1e-7);
    EXPECT_LT(model.Distances(Vector3d(0.1, 0, 0), {0}).distances[0], -0.1);
  }
  std::filesystem::remove_all(folder);
  const Failed absent = Refusal(source);
  EXPECT_EQ(absent.code, SY_E_ARGUMENT);
  EXPECT_EQ(absent.text, "URDF: Mesh package://shapes/t.stl could not be found.");
}

// An ellipsoid of half axes 0.1, 0.2 and 0.3 m, 2.7 m and q above the ground, that turns about x.
TEST(Distances, ShapesOfAnMjcfAreItsOwn) {
  const Model model({.format = SY_MODEL_MJCF,
                     .text =
                         "<mujoco><compiler angle=\"radian\"/><worldbody>"
                         "<geom name=\"ground\" type=\"plane\" size=\"1 1 1\"/>"
                         "<body name=\"a\" pos=\"0 0 2\"><joint name=\"up\" type=\"slide\"/>"
                         "<geom name=\"rod\" type=\"capsule\" size=\"0.1 0.5\"/>"
                         "<body name=\"b\" pos=\"0 0 0.7\"><joint name=\"turn\" axis=\"1 0 0\"/>"
                         "<geom name=\"egg\" type=\"ellipsoid\" size=\"0.1 0.2 0.3\"/>"
                         "</body></body></worldbody></mujoco>",
                     .geometry = true});
  ASSERT_EQ(model.facts().num_pairs, 1);
  for (const double turn : {0.0, 0.4, 1.5}) {
    const auto apart = model.Distances(Eigen::Vector2d(0.2, turn), {0});
    const double half = std::hypot(0.2 * std::sin(turn), 0.3 * std::cos(turn));
    const double slope = (0.09 - 0.04) * std::sin(turn) * std::cos(turn) / half;
    EXPECT_NEAR(apart.distances[0], 2.9 - half, 1e-9);
    ExpectNear(apart.gradients, Eigen::RowVector2d(1.0, slope), 1e-6, "gradient");
  }
}

TEST(Distances, AShapeThatIsNotUnderstoodIsNotPassedOver) {
  const Failed failed = Refusal(Sliders(Ball(0.3), Shape("<torus radius=\"1\"/>")));
  EXPECT_EQ(failed.code, SY_E_ARGUMENT);
  EXPECT_EQ(failed.text,
            "URDF: Unknown geometry type 'torus'; Could not parse collision element for Link [c]");
}

TEST(Distances, EightThreadsOnOneModelAreAsOne) {
  const Model model(Sliders(Shape("<box size=\"0.4 0.6 0.8\"/>"),
                            Shape("<cylinder radius=\"0.1\" length=\"0.5\"/>")));
  std::vector<double> alone;
  for (int i = 0; i < 30; ++i) alone.push_back(model.Distances(Numbers(3, i), {0}).distances[0]);
  std::vector<int> different(8, 0);
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < different.size(); ++t) {
    threads.emplace_back([&, t] {
      for (std::size_t i = 0; i < 300; ++i) {
        const std::size_t at = (11 * t + 7 * i) % alone.size();
        const auto apart = model.Distances(Numbers(3, static_cast<int>(at)), {0});
        if (apart.distances[0] != alone[at]) ++different[t];
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(different, std::vector<int>(8, 0));
}

}  // namespace
}  // namespace switchyard::dynamics_plugin
