#include "core/dynamics/loaded_model.hpp"

#include "switchyard/plugin.hpp"

namespace switchyard {
namespace {

RigidBodyJoint::Type TypeOf(sy_joint_type type) {
  switch (type) {
    case SY_JOINT_CONTINUOUS:
      return RigidBodyJoint::Type::kContinuous;
    case SY_JOINT_PRISMATIC:
      return RigidBodyJoint::Type::kPrismatic;
    default:
      return RigidBodyJoint::Type::kRevolute;
  }
}

RigidBodyJoint JointOf(const sy_joint& given) {
  const sy_joint joint = plugin::Whole(given);
  return {joint.name,           TypeOf(joint.type), joint.position_lower,
          joint.position_upper, joint.velocity,     joint.effort,
          joint.armature,       joint.damping,      joint.friction};
}

}  // namespace

LoadedModel::LoadedModel(const sy_dynamics& of, sy_dynamics_model* held)
    : table(of), model(held), engine(Text(of.name, " ", of.version)) {
  const sy_model_facts facts = plugin::Whole(*table.facts(model));
  name = facts.name != nullptr ? facts.name : "";
  for (int i = 0; i < facts.num_positions; ++i) joints.push_back(JointOf(*facts.joints[i]));
  frames.assign(facts.frames, facts.frames + facts.num_frames);
  for (int i = 0; i < facts.num_pairs; ++i) {
    pairs.emplace_back(facts.pair_first[i], facts.pair_second[i]);
  }
}

LoadedModel::~LoadedModel() { table.destroy(model); }

template <class Call>
void LoadedModel::Ask(const char* what, Call call) const {
  sy_error error{};
  if (call(&error) < 0) Refuse(what, " of \"", name, "\", by ", engine, ": ", error.text);
}

void LoadedModel::InverseDynamics(const double* q, const double* v, const double* a, double* tau,
                                  double* d_q, double* d_v, double* d_a) const {
  Ask("inverse dynamics", [&](sy_error* error) {
    return table.inverse_dynamics(model, q, v, a, tau, d_q, d_v, d_a, error);
  });
}

void LoadedModel::Hessian(const double* q, const double* v, const double* a, const double* w,
                          double* hessian) const {
  Ask("second derivatives", [&](sy_error* error) {
    return table.inverse_dynamics_hessian(model, q, v, a, w, hessian, error);
  });
}

void LoadedModel::Frame(int frame, const double* q, double* position, double* rotation,
                        double* jacobian) const {
  Ask("a frame", [&](sy_error* error) {
    return table.frame(model, frame, q, position, rotation, jacobian, error);
  });
}

void LoadedModel::Distances(const double* q, const std::vector<int>& indices, double* distances,
                            double* gradients) const {
  Ask("distances", [&](sy_error* error) {
    return table.distances(model, q, indices.data(), static_cast<int>(indices.size()), distances,
                           gradients, error);
  });
}

void LoadedModel::CheckPairs(const char* call, const std::vector<int>& indices) const {
  for (const int index : indices) {
    Require(index >= 0 && index < std::ssize(pairs), call, ": a pair of \"", name,
            "\" needs an index from 0 to below ", pairs.size(), ", got ", index,
            pairs.empty() ? "; load the model with geometry" : "");
  }
}

}  // namespace switchyard
