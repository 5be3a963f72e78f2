#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "switchyard/dynamics.h"

namespace switchyard::dynamics {

struct Tree;
class Workspaces;

/// What stands behind a sy_dynamics_model: a robot, and workspaces to evaluate it in, one a thread.
class Model {
 public:
  explicit Model(const sy_dynamics_source& source);
  Model(const Model&) = delete;
  Model& operator=(const Model&) = delete;
  ~Model();

  [[nodiscard]] const sy_model_facts& facts() const { return facts_; }
  void InverseDynamics(const double* q, const double* v, const double* a, double* tau, double* d_q,
                       double* d_v, double* d_a) const;
  void InverseDynamicsHessian(const double* q, const double* v, const double* a, const double* w,
                              double* hessian) const;
  void Frame(std::int32_t frame, const double* q, double* position, double* rotation,
             double* jacobian) const;
  void Distances(const double* q, const std::int32_t* pairs, std::int32_t num, double* distances,
                 double* gradients) const;

 private:
  void WriteFacts();

  std::unique_ptr<Tree> tree_;
  std::unique_ptr<Workspaces> workspaces_;
  sy_model_facts facts_{};
  std::vector<const sy_joint*> joints_;
  std::vector<const char*> frames_, pair_first_, pair_second_;
};

}  // namespace switchyard::dynamics
