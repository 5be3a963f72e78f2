// An engine of rigid-body dynamics with two models in closed form, by the "text" of their files:
//
//   two_link  point masses at the ends of two links that swing in the plane of x and z, angles from
//             straight down, the second relative to the first; damped; a ball of radius 0.1 at the
//             tip, and one of 0.2 that stands at (0.8, 0, 1.45)
//   pan_tilt  a link of 0.8 m turned about z, then about its own y; frames alone
//   folded    likewise, and the first coordinate turns both joints
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "switchyard/dynamics.h"
#include "switchyard/dynamics/rigid_body_model.hpp"
#include "switchyard/functions/make_function.hpp"
#include "switchyard/host/host.hpp"
#include "switchyard/plugin.hpp"

namespace switchyard::testing {

struct TwoLink {
  static constexpr double kMass[2] = {1.5, 0.7};     // kg
  static constexpr double kLength[2] = {0.9, 0.6};   // m
  static constexpr double kDamping[2] = {0.2, 0.1};  // N m s
  static constexpr double kGravity = 9.81;
  static constexpr double kEffort[2] = {25, 8};
  static constexpr double kVelocity[2] = {4, 6};

  /// tau of x = (q, v, a), by Lagrange's equations; m = m_1 l_0 l_1, with derivatives by tracing.
  template <class T>
  static std::vector<T> Efforts(const Eigen::VectorX<T>& x) {
    using std::cos, std::sin;
    const double m0 = kMass[0], m1 = kMass[1], l0 = kLength[0], l1 = kLength[1];
    const T c = cos(x[1]), s = sin(x[1]);
    const T M00 = (m0 + m1) * l0 * l0 + m1 * l1 * l1 + 2 * m1 * l0 * l1 * c;
    const T M01 = m1 * l1 * l1 + m1 * l0 * l1 * c;
    const T h = m1 * l0 * l1 * s;
    const T weight = m1 * kGravity * l1 * sin(x[0] + x[1]);
    return {M00 * x[4] + M01 * x[5] - h * (2 * x[2] * x[3] + x[3] * x[3]) +
                (m0 + m1) * kGravity * l0 * sin(x[0]) + weight + kDamping[0] * x[2],
            M01 * x[4] + m1 * l1 * l1 * x[5] + h * x[2] * x[2] + weight + kDamping[1] * x[3]};
  }
  static std::shared_ptr<const Function> EffortFunction() {
    return MakeFunction(6, [](const auto& x) { return Efforts(x.eval()); });
  }
  /// Kinetic and potential.
  static double Energy(const Eigen::Vector2d& q, const Eigen::Vector2d& v) {
    const Eigen::Vector2d elbow = kLength[0] * Eigen::Vector2d(std::sin(q[0]), -std::cos(q[0]));
    const double a = q[0] + q[1];
    const Eigen::Vector2d tip = elbow + kLength[1] * Eigen::Vector2d(std::sin(a), -std::cos(a));
    const Eigen::Vector2d u = kLength[0] * v[0] * Eigen::Vector2d(std::cos(q[0]), std::sin(q[0]));
    const Eigen::Vector2d w =
        u + kLength[1] * (v[0] + v[1]) * Eigen::Vector2d(std::cos(a), std::sin(a));
    return kMass[0] * (u.squaredNorm() / 2 + kGravity * elbow[1]) +
           kMass[1] * (w.squaredNorm() / 2 + kGravity * tip[1]);
  }
};

}  // namespace switchyard::testing

// Of a C table, at the global scope as the header declares it.
struct sy_dynamics_model {
  bool pan_tilt = false;
  bool folded = false;
  std::vector<sy_joint> joints;
  std::vector<const sy_joint*> joint_list;
  std::vector<const char*> frames, first, second;
  sy_model_facts facts{};
  std::shared_ptr<const switchyard::Function> efforts;
};

namespace switchyard::testing {

class FakeDynamics {
 public:
  FakeDynamics() {
    table_.size = sizeof table_;
    table_.name = "closed_forms";
    table_.version = "1.0";
    table_.load = &Load;
    table_.destroy = [](sy_dynamics_model* model) noexcept { delete model; };
    table_.facts = [](const sy_dynamics_model* model) noexcept { return &model->facts; };
    table_.inverse_dynamics = &InverseDynamics;
    table_.inverse_dynamics_hessian = &Hessian;
    table_.frame = &Frame;
    table_.distances = &Distances;
    plugin_ = {sizeof(sy_plugin),
               SY_ABI_MAJOR,
               SY_ABI_MINOR,
               "fakes",
               "1.0",
               nullptr,
               [](const char* id) noexcept -> const void* {
                 return std::strcmp(id, "sy.dynamics/1") == 0 ? &table_ : nullptr;
               }};
    host_.Register(plugin_);
  }
  [[nodiscard]] const Host& host() const { return host_; }

 private:
  static sy_status Load(const sy_dynamics_source* source, sy_dynamics_model** out,
                        sy_error* error) noexcept {
    return plugin::Guarded(error, [&] {
      if (source->path != nullptr) {
        throw plugin::Failure(SY_E_RESOURCE, Text("\"", source->path, "\" cannot be read"));
      }
      const std::string text = source->text;
      if (text != "two_link" && text != "pan_tilt" && text != "folded") {
        throw plugin::Failure(SY_E_ARGUMENT, "line 1: not a model: " + text);
      }
      if (source->num_locked > 0) {
        throw plugin::Failure(SY_E_ARGUMENT,
                              Text("there is no joint \"", source->locked[0], "\" to lock"));
      }
      auto model = std::make_unique<sy_dynamics_model>();
      model->folded = text == "folded";
      model->pan_tilt = text == "pan_tilt" || model->folded;
      Describe(*model, source->geometry != 0);
      *out = model.release();
    });
  }

  static void Describe(sy_dynamics_model& model, bool geometry) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 2; ++i) {
      sy_joint joint{};
      joint.size = sizeof joint;
      joint.type = i == 0 ? SY_JOINT_CONTINUOUS : SY_JOINT_REVOLUTE;
      joint.name = i == 0 ? "shoulder" : "elbow";
      joint.position_lower = i == 0 ? -kInfinity : -2.5;
      joint.position_upper = i == 0 ? kInfinity : 2.5;
      joint.velocity = TwoLink::kVelocity[i];
      joint.effort = model.pan_tilt ? kInfinity : TwoLink::kEffort[i];
      joint.damping = TwoLink::kDamping[i];
      model.joints.push_back(joint);
    }
    for (const sy_joint& joint : model.joints) model.joint_list.push_back(&joint);
    model.frames = {"upper_arm", "forearm", "tip"};
    if (geometry) {
      model.first = {"tip_ball"};
      model.second = {"standing_ball"};
    }
    model.facts = {sizeof(sy_model_facts),
                   2,
                   model.pan_tilt ? "pan_tilt" : "two_link",
                   model.joint_list.data(),
                   model.frames.data(),
                   3,
                   static_cast<int>(model.first.size()),
                   model.first.data(),
                   model.second.data()};
    if (!model.pan_tilt) model.efforts = TwoLink::EffortFunction();
  }

  static const Function& EffortsOf(const sy_dynamics_model& model) {
    if (model.efforts == nullptr) {
      throw plugin::Failure(SY_E_UNSUPPORTED, "a pan and tilt has no masses");
    }
    return *model.efforts;
  }
  static Eigen::Vector<double, 6> Stacked(const double* q, const double* v, const double* a) {
    return {q[0], q[1], v[0], v[1], a[0], a[1]};
  }

  static sy_status InverseDynamics(const sy_dynamics_model* model, const double* q, const double* v,
                                   const double* a, double* tau, double* d_q, double* d_v,
                                   double* d_a, sy_error* error) noexcept {
    return plugin::Guarded(error, [&] {
      const Function& f = EffortsOf(*model);
      const auto x = Stacked(q, v, a);
      std::vector<double> J(static_cast<std::size_t>(f.jacobian().size()));
      f.Evaluate({.x = x.data(), .values = tau, .jacobian = J.data()});
      double* const to[] = {d_q, d_v, d_a};
      for (double* one : to) {
        if (one != nullptr) std::fill_n(one, 4, 0.0);
      }
      for (std::size_t k = 0; k < J.size(); ++k) {
        double* const one = to[f.jacobian().col[k] / 2];
        if (one != nullptr) one[f.jacobian().row[k] + 2 * (f.jacobian().col[k] % 2)] = J[k];
      }
    });
  }

  static sy_status Hessian(const sy_dynamics_model* model, const double* q, const double* v,
                           const double* a, const double* w, double* hessian,
                           sy_error* error) noexcept {
    return plugin::Guarded(error, [&] {
      const Function& f = EffortsOf(*model);
      const auto x = Stacked(q, v, a);
      std::vector<double> H(static_cast<std::size_t>(f.hessian().size()));
      f.Evaluate({.x = x.data(), .weights = w, .hessian = H.data()});
      Eigen::Map<Eigen::Matrix<double, 6, 6>> whole(hessian);
      whole.setZero();
      for (std::size_t k = 0; k < H.size(); ++k) {
        const int i = f.hessian().row[k], j = f.hessian().col[k];
        whole(i, j) = whole(j, i) = H[k];
      }
    });
  }

  /// Frames: 0 is where joint 0 is, 1 where joint 1 is, 2 the tip.
  static sy_status Frame(const sy_dynamics_model* model, int32_t frame, const double* q,
                         double* position, double* rotation, double* jacobian,
                         sy_error* error) noexcept {
    return plugin::Guarded(error, [&] {
      Eigen::Vector3d axis[2], at[2], o, link0, link1;
      Eigen::Matrix3d first, R;
      if (model->pan_tilt) {
        axis[0] = Eigen::Vector3d::UnitZ();
        link0.setZero();
        link1 = {0.8, 0, 0};
      } else {
        axis[0] = -Eigen::Vector3d::UnitY();
        link0 = {0, 0, -TwoLink::kLength[0]};
        link1 = {0, 0, -TwoLink::kLength[1]};
      }
      first = Eigen::AngleAxisd(q[0], axis[0]).toRotationMatrix();
      const Eigen::Vector3d own = model->pan_tilt ? Eigen::Vector3d::UnitY() : axis[0];
      axis[1] = first * own;
      at[0].setZero();
      at[1] = first * link0;
      R = first * Eigen::AngleAxisd(model->folded ? q[0] + q[1] : q[1], own).toRotationMatrix();
      o = frame == 0 ? at[0] : frame == 1 ? at[1] : (at[1] + R * link1).eval();
      if (frame == 0) R = first;
      if (position != nullptr) Eigen::Map<Eigen::Vector3d>{position} = o;
      if (rotation != nullptr) Eigen::Map<Eigen::Matrix3d>{rotation} = R;
      if (jacobian == nullptr) return;
      Eigen::Map<Eigen::Matrix<double, 6, 2>> J(jacobian);
      J.setZero();
      for (int i = 0; i < (frame == 0 ? 1 : 2); ++i) {
        J.col(i) << axis[i].cross(o - at[i]), axis[i];
      }
      if (model->folded) J.col(0) += J.col(1);
    });
  }

  static sy_status Distances(const sy_dynamics_model* model, const double* q, const int32_t* pairs,
                             int32_t num, double* distances, double* gradients,
                             sy_error* error) noexcept {
    return plugin::Guarded(error, [&] {
      Eigen::Vector3d tip;
      Eigen::Matrix<double, 6, 2> J;
      const sy_status status = Frame(model, 2, q, tip.data(), nullptr, J.data(), error);
      if (status < 0) throw plugin::Failure(status, error->text);
      const Eigen::Vector3d apart = tip - Eigen::Vector3d(0.8, 0, 1.45);
      for (int k = 0; k < num; ++k) {
        if (pairs[k] != 0) throw plugin::Failure(SY_E_ARGUMENT, "there is one pair");
        distances[k] = apart.norm() - 0.3;
        if (gradients == nullptr) continue;
        Eigen::Map<Eigen::RowVector2d>{gradients + 2 * k} =
            apart.normalized().transpose() * J.topRows<3>();
      }
    });
  }

  static inline sy_dynamics table_{};
  static inline sy_plugin plugin_{};
  Host host_{HostOptions{{}, std::vector<std::string>{}, {}}};
};

/// One of its models.
inline RigidBodyModel Fake(const std::string& text, bool geometry = false) {
  static const FakeDynamics engine;
  RigidBodyOptions options;
  options.geometry = geometry;
  options.host = &engine.host();
  return RigidBodyModel::ParseUrdf(text, options);
}

}  // namespace switchyard::testing
