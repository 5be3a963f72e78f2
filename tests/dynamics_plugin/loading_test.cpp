// What is loaded and what is refused: the order of coordinates, limits, locked joints, joints that
// follow others, MJCF beside URDF, and the sentences of what cannot be loaded.
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

using testing::HasSubstr;
using testing::StartsWith;

std::vector<std::string> JointNames(const Model& model) {
  std::vector<std::string> names;
  for (int i = 0; i < model.n(); ++i) names.emplace_back(model.joint(i).name);
  return names;
}

void ExpectSame(const Model& one, const Model& other, double tolerance) {
  const int n = one.n();
  ASSERT_EQ(n, other.n());
  for (int seed = 0; seed < 3; ++seed) {
    const VectorXd q = Numbers(n, seed), v = Numbers(n, seed + 1), a = Numbers(n, seed + 2),
                   w = Numbers(n, seed + 3);
    ExpectNear(one.Tau(q, v, a), other.Tau(q, v, a), tolerance, "tau");
    ExpectNear(one.Hessian(q, v, a, w), other.Hessian(q, v, a, w), tolerance, "Hessian");
  }
}

TEST(Loading, TheModelSaysWhatItIs) {
  const Model model({.text = TwoLinkPendulum("<dynamics damping=\"0.5\"/>")});
  EXPECT_STREQ(model.facts().name, "robot");
  EXPECT_EQ(JointNames(model), (std::vector<std::string>{"shoulder", "elbow"}));
  const sy_joint& shoulder = model.joint(0);
  EXPECT_EQ(shoulder.type, SY_JOINT_REVOLUTE);
  EXPECT_EQ(shoulder.position_lower, -3.0);
  EXPECT_EQ(shoulder.position_upper, 2.5);
  EXPECT_EQ(shoulder.velocity, 7.0);
  EXPECT_EQ(shoulder.effort, 40.0);
  EXPECT_EQ(shoulder.armature, 0.0);
  EXPECT_EQ(shoulder.damping, 0.5);
  std::vector<std::string> frames(model.facts().frames,
                                  model.facts().frames + model.facts().num_frames);
  EXPECT_THAT(frames, testing::IsSupersetOf({"base", "shoulder", "upper", "elbow", "end", "tip"}));
  EXPECT_STREQ(Table().name, "pinocchio");
  EXPECT_THAT(Table().version, StartsWith("4."));
}

// The library sorts branches by name; the file has turn before bend, and lift at the end.
TEST(Loading, CoordinatesStandInTheOrderOfTheFileFromTheRootOutwards) {
  const Model model({.text = Branched()});
  EXPECT_EQ(JointNames(model),
            (std::vector<std::string>{"turn", "zigzag", "bend", "spin", "lift"}));
  EXPECT_EQ(model.joint(1).type, SY_JOINT_PRISMATIC);
  EXPECT_EQ(model.joint(2).type, SY_JOINT_REVOLUTE);
  EXPECT_EQ(model.joint(3).type, SY_JOINT_CONTINUOUS);
  // Sliding moves what slides alone.
  const auto slid = model.Frame(model.FrameNamed("b"), Numbers(5, 1));
  EXPECT_NEAR(slid.jacobian.col(1).head<3>().norm(), 1.0, 1e-14);
  EXPECT_EQ(slid.jacobian.col(1).tail<3>().norm(), 0.0);
  EXPECT_EQ(slid.jacobian.rightCols(3).norm(), 0.0);
}

TEST(Loading, LockedJointsAreWelded) {
  const double at = 0.7;
  const Model locked({.text = TwoLinkPendulum(), .locked = {{"elbow", at}}});
  EXPECT_EQ(JointNames(locked), std::vector<std::string>{"shoulder"});
  const std::string welded =
      "<joint name=\"elbow\" type=\"fixed\"><parent link=\"upper\"/><child link=\"lower\"/>"
      "<origin xyz=\"0.8 0 0\" rpy=\"0 " +
      std::to_string(-at) + " 0\"/></joint>\n";
  const Model by_hand(
      {.text = Robot("<link name=\"base\"/>\n" + Link("upper", 2.0, 0.3, 0.05) +
                     Link("lower", 1.5, 0.25, 0.03) +
                     Joint("shoulder", "revolute", "base", "upper", "0 0 0", "0 -1 0") + welded)});
  ExpectSame(locked, by_hand, 1e-13);
  EXPECT_EQ(locked.joint(0).effort, by_hand.joint(0).effort);
  const VectorXd q = Numbers(1, 2);
  ExpectNear(locked.Frame(locked.FrameNamed("lower"), q).rotation,
             by_hand.Frame(by_hand.FrameNamed("lower"), q).rotation, 1e-14, "pose");
}

TEST(Loading, LockedContinuousJointsAreWeldedAtTheirAngle) {
  const Model whole({.text = Branched()});
  const Model locked({.text = Branched(), .locked = {{"spin", 2.0}, {"zigzag", -0.4}}});
  EXPECT_EQ(JointNames(locked), (std::vector<std::string>{"turn", "bend", "lift"}));
  EXPECT_EQ(locked.joint(2).damping, 0.3);
  VectorXd q(5), rates(5);
  const VectorXd in = Numbers(3, 1), v = Numbers(3, 2), zero = VectorXd::Zero(3);
  q << in[0], -0.4, in[1], 2.0, in[2];
  rates << v[0], 0.0, v[1], 0.0, v[2];
  const VectorXd tau = whole.Tau(q, rates, VectorXd::Zero(5)), of_locked = locked.Tau(in, v, zero);
  ExpectNear(of_locked, Vector3d(tau[0], tau[2], tau[4]), 1e-13, "tau");
}

// q2 = -2 q1 + 0.3: efforts are J'tau of the joint that is not coupled, limits those of both.
TEST(Loading, AJointThatMimicsIsCarriedByTheCoordinateItFollows) {
  const auto text = [](const std::string& more) {
    return Robot("<link name=\"base\"/>\n" + Link("upper", 2.0, 0.3, 0.05) +
                 Link("lower", 1.5, 0.25, 0.03) +
                 Joint("shoulder", "revolute", "base", "upper", "0 0 0", "0 -1 0") +
                 Joint("elbow", "continuous", "upper", "lower", "0.8 0 0", "0 -1 0", more));
  };
  const Model free({.text = text("<dynamics damping=\"0.5\"/>")});
  const Model coupled({.text = text("<dynamics damping=\"0.5\"/><mimic joint=\"shoulder\" "
                                    "multiplier=\"-2\" offset=\"0.3\"/>")});
  ASSERT_EQ(JointNames(coupled), std::vector<std::string>{"shoulder"});
  EXPECT_EQ(coupled.joint(0).damping, 4 * 0.5);
  EXPECT_EQ(coupled.joint(0).velocity, 3.5);
  const Eigen::Vector2d lead(1.0, -2.0), offset(0.0, 0.3);
  for (const double x : {-0.4, 0.2, 1.1}) {
    const VectorXd q = VectorXd::Constant(1, x), v = Numbers(1, 3), a = Numbers(1, 4),
                   w = Numbers(1, 5);
    const VectorXd whole_q = lead * x + offset, whole_v = lead * v[0], whole_a = lead * a[0],
                   whole_w = lead * w[0];
    const auto one = coupled.Derivatives(q, v, a);
    const auto all = free.Derivatives(whole_q, whole_v, whole_a);
    ExpectNear(one.tau, lead.transpose() * all.tau, 1e-14, "tau");
    ExpectNear(one.d_q, lead.transpose() * all.d_q * lead, 1e-14, "d_q");
    ExpectNear(one.d_v, lead.transpose() * all.d_v * lead, 1e-14, "d_v");
    ExpectNear(one.d_a, lead.transpose() * all.d_a * lead, 1e-14, "d_a");
    const MatrixXd hessian = free.Hessian(whole_q, whole_v, whole_a, whole_w);
    MatrixXd leads = MatrixXd::Zero(6, 3);
    for (int i = 0; i < 3; ++i) leads.block(2 * i, i, 2, 1) = lead;
    ExpectNear(coupled.Hessian(q, v, a, w), leads.transpose() * hessian * leads, 1e-13, "Hessian");
    const int frame = coupled.FrameNamed("lower");
    ExpectNear(coupled.Frame(frame, q).jacobian,
               free.Frame(free.FrameNamed("lower"), whole_q).jacobian * lead, 1e-14, "Jacobian");
  }
  const Model locked({.text = text("<mimic joint=\"shoulder\" multiplier=\"-2\" offset=\"0.3\"/>"),
                      .locked = {{"shoulder", 0.5}}});
  EXPECT_EQ(locked.n(), 0);
}

constexpr const char* kPendulumOfMujoco = R"(<mujoco model="pendulum">
  <compiler angle="radian"/>
  <option gravity="0 0 -9.81"/>
  <default><joint damping="0.5"/></default>
  <worldbody>
    <body name="upper">
      <joint name="shoulder" type="hinge" axis="0 -1 0" range="-3 2.5"/>
      <inertial pos="0.3 0 0" mass="2" diaginertia="0.05 0.05 0.05"/>
      <body name="lower" pos="0.8 0 0">
        <joint name="elbow" type="hinge" axis="0 -1 0"/>
        <inertial pos="0.25 0 0" mass="1.5" diaginertia="0.03 0.03 0.03"/>
      </body>
    </body>
  </worldbody>
</mujoco>
)";

TEST(Loading, MjcfGivesTheSameRobotAsUrdf) {
  const Model urdf({.text = TwoLinkPendulum("<dynamics damping=\"0.5\"/>")});
  const Model mjcf({.format = SY_MODEL_MJCF, .text = kPendulumOfMujoco});
  EXPECT_EQ(JointNames(mjcf), JointNames(urdf));
  EXPECT_STREQ(mjcf.facts().name, "pendulum");
  EXPECT_EQ(mjcf.joint(0).type, SY_JOINT_REVOLUTE);
  EXPECT_EQ(mjcf.joint(0).position_upper, 2.5);
  EXPECT_EQ(mjcf.joint(1).type, SY_JOINT_CONTINUOUS);  // a hinge without a range
  EXPECT_EQ(mjcf.joint(1).effort, std::numeric_limits<double>::infinity());
  ExpectSame(mjcf, urdf, 1e-13);
}

TEST(Loading, GravityOfAnMjcfIsItsOwnUnlessAnotherIsAskedFor) {
  std::string text = kPendulumOfMujoco;
  text.replace(text.find("-9.81"), 5, "-1.62");
  const VectorXd q = Numbers(2, 1), zero = VectorXd::Zero(2);
  const VectorXd own = Model({.format = SY_MODEL_MJCF, .text = text}).Tau(q, zero, zero);
  const Model earth({.format = SY_MODEL_MJCF, .text = text, .gravity = {0.0, 0.0, -9.81}});
  ExpectNear(own / 1.62, earth.Tau(q, zero, zero) / 9.81, 1e-14, "tau over gravity");
}

TEST(Loading, AFileIsReadAsItsText) {
  const std::string folder = testing::TempDir() + "switchyard_dynamics_plugin";
  std::filesystem::create_directories(folder);
  const std::string urdf = folder + "/pendulum.urdf", mjcf = folder + "/pendulum.xml";
  std::ofstream(urdf) << TwoLinkPendulum();
  std::ofstream(mjcf) << kPendulumOfMujoco;
  ExpectSame(Model({.path = urdf}), Model({.text = TwoLinkPendulum()}), 0.0);
  ExpectSame(Model({.format = SY_MODEL_MJCF, .path = mjcf}),
             Model({.format = SY_MODEL_MJCF, .text = kPendulumOfMujoco}), 0.0);
  std::ofstream(urdf) << "<robot>\n<link>\n</robot>";
  EXPECT_EQ(Refusal({.path = urdf}).text, urdf + ":2: not well-formed XML: mismatched element");
  std::filesystem::remove_all(folder);
  const Failed absent = Refusal({.path = urdf});
  EXPECT_EQ(absent.code, SY_E_RESOURCE);
  EXPECT_EQ(absent.text, urdf + ": No such file or directory");
}

std::string Said(const Source& source, sy_status code = SY_E_ARGUMENT) {
  const Failed failed = Refusal(source);
  EXPECT_EQ(failed.code, code) << failed.text;
  return failed.text;
}

TEST(Loading, EachWayOfBeingNoUrdfIsSaidWithItsLine) {
  EXPECT_EQ(Said({.text = "<robot name=\"r\">\n  <link name=\"a\">\n</robot>\n"}),
            "URDF:2: not well-formed XML: mismatched element");
  EXPECT_EQ(Said({.text = "<robot name=\"r\">\n  <link name=\"a\"/>\n"}),
            "URDF:1: not well-formed XML: parsing");
  EXPECT_EQ(Said({.text = "no XML at all"}), "URDF:1: not well-formed XML: parsing text");
  EXPECT_EQ(Said({.text = ""}), "URDF:1: not well-formed XML: empty document");
  EXPECT_EQ(Said({.text = "\n<mujoco/>"}), "URDF:2: the root is <mujoco>, that of URDF is <robot>");
  EXPECT_EQ(Said({.text = Robot("<link name=\"a\"/>\n<link name=\"b\"/>\n")}),
            "URDF: Failed to find root link: Two root links found: [a] and [b]");
  EXPECT_EQ(Said({.text = Robot("<link name=\"a\"/>\n<link name=\"a\"/>\n")}),
            "URDF:3: a second link is called \"a\"");
  EXPECT_EQ(Said({.text = Robot("<link name=\"a\"/>\n" +
                                Joint("j", "revolute", "a", "b", "0 0 0", "0 0 1"))}),
            "URDF:3: joint \"j\" has the child link \"b\", which is not there");
  EXPECT_EQ(Said({.text = Robot("<link name=\"a\"/>\n<joint name=\"j\" type=\"fixed\"/>\n")}),
            "URDF:3: joint \"j\" names no parent link");
  EXPECT_EQ(
      Said({.text = Robot("<link name=\"a\"/><link name=\"b\"/>\n<joint name=\"j\" "
                          "type=\"revolute\"><parent link=\"a\"/><child link=\"b\"/></joint>")}),
      "URDF: Joint [j] is of type REVOLUTE but it does not specify limits; joint xml is not "
      "initialized correctly");
}

// The library leaves them out and goes on, with a body that weighs nothing.
TEST(Loading, PartsThatAreNotUnderstoodAreNotLeftOut) {
  std::string text = TwoLinkPendulum();
  text.replace(text.find("2.000000"), 8, "two     ");
  EXPECT_EQ(Said({.text = text}),
            "URDF: Inertial: mass [two     ] is not a float; Could not parse inertial element for "
            "Link [upper]");
}

TEST(Loading, JointsOfOtherKindsAreRefusedByName) {
  const auto with = [](const std::string& type) {
    return Robot("<link name=\"a\"/>\n" + Link("b", 1, 0, 1) +
                 Joint("base", type, "a", "b", "0 0 0", "0 0 1"));
  };
  EXPECT_EQ(Said({.text = with("floating")}, SY_E_UNSUPPORTED),
            "URDF:4: joint \"base\" is floating; revolute, continuous, prismatic and fixed joints "
            "are taken");
  EXPECT_EQ(Said({.text = with("planar")}, SY_E_UNSUPPORTED),
            "URDF:4: joint \"base\" is planar; revolute, continuous, prismatic and fixed joints "
            "are taken");
  const auto mujoco = [](const std::string& joint) {
    return Source{.format = SY_MODEL_MJCF,
                  .text = "<mujoco>\n<worldbody>\n<body name=\"b\">\n" + joint +
                          "\n<inertial pos=\"0 0 0\" mass=\"1\" diaginertia=\"1 1 1\"/></body>\n"
                          "</worldbody>\n</mujoco>\n"};
  };
  EXPECT_EQ(Said(mujoco("<freejoint/>"), SY_E_UNSUPPORTED),
            "MJCF:4: a joint is free; hinge and slide joints are taken");
  EXPECT_EQ(Said(mujoco("<joint name=\"hip\" type=\"ball\"/>"), SY_E_UNSUPPORTED),
            "MJCF:4: joint \"hip\" is ball; hinge and slide joints are taken");
  EXPECT_EQ(Said(mujoco("<joint name=\"x\" type=\"slide\"/><joint name=\"y\" type=\"slide\" "
                        "axis=\"0 1 0\"/>"),
                 SY_E_UNSUPPORTED),
            "MJCF:3: body \"b\" has 2 joints; a body is taken with one at most");
}

TEST(Loading, WhatAnMjcfHasAndTheDynamicsLackIsRefused) {
  std::string text = kPendulumOfMujoco;
  text.replace(text.find("damping"), 7, "stiffness");
  EXPECT_EQ(Said({.format = SY_MODEL_MJCF, .text = text}, SY_E_UNSUPPORTED),
            "MJCF:4: <joint stiffness=\"0.5\"> is a spring, which is no part of the dynamics here");
  text = kPendulumOfMujoco;
  text.replace(text.find("</mujoco>"), 9,
               "<equality><joint joint1=\"shoulder\" joint2=\"elbow\"/></equality></mujoco>");
  EXPECT_EQ(Said({.format = SY_MODEL_MJCF, .text = text}, SY_E_UNSUPPORTED),
            "MJCF:15: <joint> of <equality> is not taken: bodies and joints are a tree");
  const auto mujoco = [](const std::string& in_world, const std::string& beside = "") {
    return Source{.format = SY_MODEL_MJCF,
                  .text = "<mujoco>\n<worldbody>\n<body name=\"b\"><geom size=\"1\"/>" + in_world +
                          "</body>\n</worldbody>\n" + beside + "</mujoco>",
                  .geometry = true};
  };
  EXPECT_EQ(Model(mujoco("")).n(), 0);
  EXPECT_EQ(Said(mujoco("", "<include file=\"a.xml\"/>"), SY_E_UNSUPPORTED),
            "MJCF:5: <include> is not taken: a model is one file");
  EXPECT_EQ(Said(mujoco("<frame/>"), SY_E_UNSUPPORTED), "MJCF:3: <frame> in a body is not taken");
  EXPECT_EQ(Said(mujoco("", "<option gravity=\"0 1\"/>")),
            "MJCF:5: gravity is \"0 1\", not three numbers");
  EXPECT_EQ(Said(mujoco("", "<option viscosity=\"0.1\"/>"), SY_E_UNSUPPORTED),
            "MJCF:5: <option viscosity=\"0.1\"> is a fluid, which is no part of the dynamics here");
  EXPECT_EQ(Said(mujoco("<body><geom size=\"1\"/></body>")), "MJCF:3: a body has no name");
  EXPECT_EQ(Said(mujoco("<joint name=\"j\" class=\"x\"/>")), "MJCF:3: there is no class \"x\"");
  EXPECT_EQ(Said(mujoco("<geom type=\"mesh\" mesh=\"none\"/>")),
            "MJCF: Cannot find mesh none for geometry bGeom_1");
  EXPECT_EQ(Said({.format = SY_MODEL_MJCF, .text = "<mujoco><worldbody/></mujoco>"}),
            "MJCF:1: there is no body in <worldbody>");
}

TEST(Loading, JointsToLockAreThere) {
  EXPECT_EQ(Said({.text = TwoLinkPendulum(), .locked = {{"wrist", 0.0}}}),
            "URDF: there is no joint \"wrist\" to lock; those that move are shoulder, elbow");
  EXPECT_EQ(Said({.text = TwoLinkPendulum(), .locked = {{"end", 0.0}}}),
            "URDF: there is no joint \"end\" to lock; those that move are shoulder, elbow");
  EXPECT_EQ(Said({.text = TwoLinkPendulum(), .locked = {{"elbow", 0.0}, {"elbow", 1.0}}}),
            "URDF: joint \"elbow\" is to be locked twice");
  EXPECT_EQ(Said({.text = TwoLinkPendulum(), .locked = {{"elbow", NAN}}}),
            "URDF: joint \"elbow\" is to be locked at no finite number");
}

TEST(Loading, AJointMimicsOneThatMoves) {
  const auto mimic = [](const std::string& joint, const std::string& more = "") {
    return Source{.text = TwoLinkPendulum("<mimic joint=\"" + joint + "\"" + more + "/>")};
  };
  EXPECT_EQ(Said(mimic("wrist")), "URDF: joint \"elbow\" mimics \"wrist\", which is not there");
  EXPECT_EQ(Said(mimic("end")), "URDF: joint \"elbow\" mimics \"end\", which is fixed");
  EXPECT_EQ(Said(mimic("elbow")), "URDF: joint \"elbow\" mimics itself in the end");
  EXPECT_EQ(Said(mimic("end", " multiplier=\"x\"")), "URDF:6: multiplier is \"x\", no number");
}

TEST(Loading, BadNumbersAreRefused) {
  EXPECT_EQ(Said({.text = TwoLinkPendulum(), .gravity = {0.0, INFINITY, 0.0}}),
            "gravity[1] is not finite");
  std::string text = TwoLinkPendulum();
  text.replace(text.find("2.000000"), 8, "-2.00000");
  EXPECT_EQ(
      Said({.text = text}),
      "URDF: what joint \"shoulder\" moves has a mass that is negative, or an inertia that is "
      "not finite");
  text = TwoLinkPendulum();
  text.replace(text.find("lower=\"-3\""), 10, "lower=\"3\" ");
  EXPECT_EQ(Said({.text = text}),
            "URDF: joint \"shoulder\" has crossed or negative limits, or a number that is none");
  text = TwoLinkPendulum();
  text.replace(text.find("axis xyz=\"0 -1 0\""), 17, "axis xyz=\"0 0 0\"");
  EXPECT_EQ(Said({.text = text}), "URDF: joint \"shoulder\" has a pose or an axis that is none");
  Source unknown{.text = text};
  unknown.format = 7;
  EXPECT_EQ(Said(unknown), "format 7 is not known: SY_MODEL_URDF is 0, SY_MODEL_MJCF is 1");
}

TEST(Loading, NothingIsWrittenToTheUsersStreams) {
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  static_cast<void>(Refusal({.text = Robot("<link name=\"a\"/>\n<link name=\"b\"/>\n")}));
  static_cast<void>(Refusal({.text = TwoLinkPendulum("<mimic/>")}));
  static_cast<void>(Refusal({.text = Branched(), .geometry = true}));
  static_cast<void>(
      Refusal({.format = SY_MODEL_MJCF, .text = kPendulumOfMujoco, .geometry = true}));
  const std::string looks =
      "<mujoco><asset><texture name=\"t\" type=\"2d\" builtin=\"checker\" width=\"9\"/>"
      "<material name=\"m\" texture=\"t\"/></asset><worldbody><body name=\"b\">"
      "<geom size=\"1\" material=\"m\"/></body></worldbody></mujoco>";
  EXPECT_EQ(Refusal({.format = SY_MODEL_MJCF, .text = looks, .geometry = true}).code, SY_OK);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

TEST(Loading, ManyThreadsLoadAtOnce) {
  std::vector<std::thread> threads;
  std::vector<std::string> said(8);
  for (std::size_t i = 0; i < said.size(); ++i) {
    threads.emplace_back([&said, i] {
      const std::string names[] = {"a" + std::to_string(i), "b" + std::to_string(i)};
      for (int k = 0; k < 20; ++k) {
        said[i] = Refusal({.text = Robot("<link name=\"" + names[0] + "\"/><link name=\"" +
                                         names[1] + "\"/>")})
                      .text;
        const Model model({.text = Branched()});
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (std::size_t i = 0; i < said.size(); ++i) {
    const std::string number = std::to_string(i);
    EXPECT_EQ(said[i], "URDF: Failed to find root link: Two root links found: [a" + number +
                           "] and [b" + number + "]");
  }
}

}  // namespace
}  // namespace switchyard::dynamics_plugin
