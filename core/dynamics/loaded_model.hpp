// core/dynamics/loaded_model.hpp - a model that an engine holds, and calls of the engine's table.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "switchyard/dynamics.h"
#include "switchyard/dynamics/rigid_body_model.hpp"
#include "switchyard/error.hpp"

namespace switchyard {

/// Owns the engine's model. The calls throw InvalidArgument with the engine's words where it fails.
struct LoadedModel {
  /// Takes the model over; `table` is whole.
  LoadedModel(const sy_dynamics& table, sy_dynamics_model* model);
  LoadedModel(const LoadedModel&) = delete;
  LoadedModel& operator=(const LoadedModel&) = delete;
  ~LoadedModel();

  [[nodiscard]] int num_positions() const { return static_cast<int>(joints.size()); }
  void InverseDynamics(const double* q, const double* v, const double* a, double* tau, double* d_q,
                       double* d_v, double* d_a) const;
  void Hessian(const double* q, const double* v, const double* a, const double* w,
               double* hessian) const;
  void Frame(int frame, const double* q, double* position, double* rotation,
             double* jacobian) const;
  /// `gradients` row-major, or null.
  void Distances(const double* q, const std::vector<int>& pairs, double* distances,
                 double* gradients) const;
  /// Throws, in a sentence that begins with `call`.
  void CheckPairs(const char* call, const std::vector<int>& indices) const;

  sy_dynamics table;
  sy_dynamics_model* model;
  std::string name;
  std::string engine;
  std::vector<RigidBodyJoint> joints;
  std::vector<std::string> frames;
  std::vector<std::pair<std::string, std::string>> pairs;

 private:
  template <class Call>
  void Ask(const char* what, Call call) const;
};

}  // namespace switchyard
