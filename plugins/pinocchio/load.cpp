#include <coal/BVH/BVH_model.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "captured_log.hpp"
#include "pinocchio/algorithm/joint-configuration.hpp"
#include "pinocchio/algorithm/kinematics.hpp"
#include "pinocchio/algorithm/model.hpp"
#include "switchyard/plugin.hpp"
#include "tree.hpp"

namespace switchyard::dynamics {
namespace {

using pinocchio::JointIndex;
using plugin::Failure;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::string Quoted(const std::string& name) { return "\"" + name + "\""; }

// One velocity a joint, of a kind that dynamics.h has.
sy_joint_type Type(const Description& d, const pinocchio::Model& model, JointIndex j) {
  const std::string kind = model.joints[j].shortname();
  if (model.nvs[j] == 1 && kind.starts_with("JointModelR")) {
    const auto q = model.idx_qs[j];
    const bool limited = model.nqs[j] == 1 && (model.lowerPositionLimit[q] > -kInfinity ||
                                               model.upperPositionLimit[q] < kInfinity);
    return limited ? SY_JOINT_REVOLUTE : SY_JOINT_CONTINUOUS;
  }
  if (model.nvs[j] == 1 && kind.starts_with("JointModelP")) return SY_JOINT_PRISMATIC;
  throw Failure(SY_E_UNSUPPORTED, d.origin + ": joint " + Quoted(model.names[j]) + " has " +
                                      std::to_string(model.nvs[j]) +
                                      " degrees of freedom; joints of one are taken");
}

std::string MovingJoints(const pinocchio::Model& model) {
  std::string all;
  for (JointIndex j = 1; j < model.names.size(); ++j) {
    if (all.size() > 400) return all + ", ...";
    all += (j > 1 ? ", " : "") + model.names[j];
  }
  return all.empty() ? "none moves" : "those that move are " + all;
}

// Where the joints to lock are, by name, and those that follow them.
std::map<std::string, double> Locked(const Description& d, const sy_dynamics_source& source,
                                     const pinocchio::Model& model) {
  std::map<std::string, double> locked;
  const auto refuse = [&](const std::string& text) {
    throw Failure(SY_E_ARGUMENT, d.origin + ": " + text);
  };
  const std::map<std::string, Mimic> followers = Followers(d);
  for (int i = 0; i < source.num_locked; ++i) {
    const std::string name = source.locked[i];
    const double at = source.locked_position[i];
    if (!model.existJointName(name) || name == model.names[0]) {
      refuse("there is no joint " + Quoted(name) + " to lock; " + MovingJoints(model));
    }
    const auto found = followers.find(name);
    if (found != followers.end()) {
      refuse("joint " + Quoted(name) + " mimics " + Quoted(found->second.joint) +
             ": lock that one");
    }
    if (!std::isfinite(at))
      refuse("joint " + Quoted(name) + " is to be locked at no finite number");
    if (!locked.emplace(name, at).second)
      refuse("joint " + Quoted(name) + " is to be locked twice");
  }
  for (const auto& [name, mimic] : followers) {
    const auto found = locked.find(mimic.joint);
    if (found != locked.end()) locked[name] = mimic.factor * found->second + mimic.offset;
  }
  return locked;
}

void Weld(const std::map<std::string, double>& locked, Tree& tree) {
  if (locked.empty()) return;
  Eigen::VectorXd at = pinocchio::neutral(tree.model);
  std::vector<JointIndex> gone;
  for (const auto& [name, position] : locked) {
    gone.push_back(tree.model.getJointId(name));
    const auto q = tree.model.idx_qs[gone.back()];
    if (tree.model.nqs[gone.back()] == 2) {
      at[q] = std::cos(position);
      at[q + 1] = std::sin(position);
    } else {
      at[q] = position;
    }
  }
  pinocchio::Model model;
  pinocchio::GeometryModel geometry;
  pinocchio::buildReducedModel(tree.model, tree.geometry, gone, at, model, geometry);
  tree.model = model;
  tree.geometry = geometry;
}

// GJK sees convex shapes: a mesh is taken for its convex hull, so distances are never too large.
void TakeHulls(const Description& d, pinocchio::GeometryModel& geometry) {
  for (pinocchio::GeometryObject& object : geometry.geometryObjects) {
    auto* const mesh = dynamic_cast<coal::BVHModelBase*>(object.geometry.get());
    if (mesh == nullptr) continue;
    try {
      try {
        mesh->buildConvexHull(false, "Qt");  // facets in triangles
      } catch (const std::logic_error&) {    // too many of them at a corner: a little apart
        mesh->buildConvexHull(false, "QJ");
      }
    } catch (const std::exception& e) {
      throw Failure(SY_E_ARGUMENT, d.origin + ": the mesh " + object.meshPath +
                                       " has no convex hull: " + Sentence(e.what()));
    }
    object.geometry = mesh->convex;
  }
}

void AddPairs(const pinocchio::Model& model, pinocchio::GeometryModel& geometry) {
  const auto& objects = geometry.geometryObjects;
  for (std::size_t a = 0; a < objects.size(); ++a) {
    for (std::size_t b = a + 1; b < objects.size(); ++b) {
      const JointIndex of_a = objects[a].parentJoint, of_b = objects[b].parentJoint;
      if (of_a == of_b || model.parents[of_a] == of_b || model.parents[of_b] == of_a) continue;
      geometry.addCollisionPair(pinocchio::CollisionPair(a, b));
    }
  }
}

sy_joint Facts(const Description& d, const pinocchio::Model& model, JointIndex j) {
  const auto v = model.idx_vs[j];
  const auto q = model.idx_qs[j];
  sy_joint facts{};
  facts.size = sizeof facts;
  facts.type = Type(d, model, j);
  const bool free = facts.type == SY_JOINT_CONTINUOUS;
  facts.position_lower = free ? -kInfinity : model.lowerPositionLimit[q];
  facts.position_upper = free ? kInfinity : model.upperPositionLimit[q];
  const auto within = [](double limit) {
    return limit < std::numeric_limits<double>::max() ? limit : kInfinity;
  };
  facts.velocity = within(model.upperVelocityLimit[v]);
  facts.effort = within(model.upperEffortLimit[v]);
  facts.armature = model.armature[v];
  facts.damping = model.damping[v];
  facts.friction = model.upperDryFrictionLimit[v];
  if (!(facts.position_lower <= facts.position_upper) || !(facts.velocity >= 0.0) ||
      !(facts.effort >= 0.0) || !(std::abs(facts.armature) + std::abs(facts.damping) < kInfinity)) {
    throw Failure(SY_E_ARGUMENT, d.origin + ": joint " + Quoted(model.names[j]) +
                                     " has crossed or negative limits, or a number that is none");
  }
  return facts;
}

// What a follower has is felt at the coordinate: its limits, and by the square of the factor its
// armature and damping, which are bilinear in velocities.
void Follow(const sy_joint& joint, double factor, double offset, sy_joint& facts) {
  facts.armature += factor * factor * joint.armature;
  facts.damping += factor * factor * joint.damping;
  facts.friction += std::abs(factor) * joint.friction;
  if (factor == 0.0) return;
  const double a = (joint.position_lower - offset) / factor;
  const double b = (joint.position_upper - offset) / factor;
  facts.position_lower = std::max(facts.position_lower, std::min(a, b));
  facts.position_upper = std::min(facts.position_upper, std::max(a, b));
  facts.velocity = std::min(facts.velocity, joint.velocity / std::abs(factor));
}

// Coordinates are the joints that follow none, in the file's order.
void Number(const Description& d, Tree& tree) {
  const pinocchio::Model& model = tree.model;
  const std::map<std::string, Mimic> followers = Followers(d);
  const auto take = [&](const std::string& name) {
    if (model.existJointName(name) && followers.count(name) == 0) tree.names.push_back(name);
  };
  for (const DescribedJoint& joint : d.joints) take(joint.name);
  if (d.format == SY_MODEL_MJCF) {
    for (JointIndex j = 1; j < model.names.size(); ++j) take(model.names[j]);
  }
  std::map<std::string, Follows> coordinate;
  for (const std::string& name : tree.names) {
    coordinate[name].coordinate = static_cast<int>(tree.coordinates.size());
    tree.coordinates.push_back(Facts(d, model, model.getJointId(name)));
  }
  for (const auto& [name, mimic] : followers) {
    if (!model.existJointName(name)) continue;
    const int i = coordinate.at(mimic.joint).coordinate;
    coordinate[name] = {i, mimic.factor, mimic.offset};
    Follow(Facts(d, model, model.getJointId(name)), mimic.factor, mimic.offset,
           tree.coordinates[static_cast<std::size_t>(i)]);
  }
  for (JointIndex j = 1; j < model.names.size(); ++j) {
    tree.joints.push_back(coordinate.at(model.names[j]));
    tree.joints.back().first = model.idx_qs[j];
    tree.joints.back().on_circle = model.nqs[j] == 2;
  }
}

void CheckInertias(const Description& d, const pinocchio::Model& model) {
  for (JointIndex j = 1; j < model.names.size(); ++j) {
    const pinocchio::Inertia& body = model.inertias[j];
    if (body.mass() >= 0.0 && body.toDynamicParameters().allFinite()) continue;
    throw Failure(SY_E_ARGUMENT, d.origin + ": what joint " + Quoted(model.names[j]) +
                                     " moves has a mass that is negative, or an inertia that is "
                                     "not finite");
  }
}

bool IsPose(const pinocchio::SE3& pose) {
  return pose.translation().allFinite() && pose.rotation().isUnitary(1e-6);
}

// An axis of length zero or a bad number shows where everything has turned.
void CheckPoses(const Description& d, const Tree& tree) {
  const pinocchio::Model& model = tree.model;
  Eigen::VectorXd q = Eigen::VectorXd::Ones(model.nq);
  for (JointIndex j = 1; j < model.names.size(); ++j) {
    if (model.nqs[j] == 2) q.segment<2>(model.idx_qs[j]) << std::cos(1.0), std::sin(1.0);
  }
  pinocchio::Data data(model);
  pinocchio::forwardKinematics(model, data, q);
  const auto check = [&](bool good, const char* what, const std::string& name) {
    if (good) return;
    throw Failure(SY_E_ARGUMENT, d.origin + ": " + what + " " + Quoted(name) +
                                     " has a pose or an axis that is none");
  };
  for (JointIndex j = 1; j < model.names.size(); ++j) {
    check(IsPose(data.oMi[j]), "joint", model.names[j]);
  }
  for (const auto& frame : model.frames) check(IsPose(frame.placement), "frame", frame.name);
  for (const auto& object : tree.geometry.geometryObjects) {
    check(IsPose(object.placement), "geometry", object.name);
  }
}

void SetGravity(const Description& d, const sy_dynamics_source& source, pinocchio::Model& model) {
  const bool own = std::isnan(source.gravity[0]);
  for (int i = 0; i < 3; ++i) {
    const double g = own ? d.gravity[static_cast<std::size_t>(i)] : source.gravity[i];
    if (!std::isfinite(g)) {
      throw Failure(SY_E_ARGUMENT, "gravity[" + std::to_string(i) + "] is not finite");
    }
    model.gravity.linear()[i] = g;
  }
}

}  // namespace

Tree LoadTree(const sy_dynamics_source& source) {
  const Description d = Describe(source);
  Tree tree;
  ReadTree(d, source, tree);
  for (JointIndex j = 1; j < tree.model.names.size(); ++j) {
    static_cast<void>(Type(d, tree.model, j));
  }
  CheckInertias(d, tree.model);
  CheckPoses(d, tree);
  Weld(Locked(d, source, tree.model), tree);
  TakeHulls(d, tree.geometry);
  AddPairs(tree.model, tree.geometry);
  SetGravity(d, source, tree.model);
  Number(d, tree);
  return tree;
}

}  // namespace switchyard::dynamics
