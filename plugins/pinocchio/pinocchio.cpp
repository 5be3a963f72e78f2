// The module: one table, "sy.dynamics/1", over Pinocchio.
#include <cstring>
#include <memory>

#include "model.hpp"
#include "switchyard/plugin.hpp"

namespace switchyard::dynamics {
namespace {

using plugin::Guarded;

const Model& As(const sy_dynamics_model* model) { return *reinterpret_cast<const Model*>(model); }

sy_dynamics Table() {
  sy_dynamics t{};
  t.size = sizeof t;
  t.name = "pinocchio";
  t.version = SWITCHYARD_PINOCCHIO_VERSION;
  t.load = [](const sy_dynamics_source* source, sy_dynamics_model** out, sy_error* error) noexcept {
    return Guarded(error, [&] {
      *out = reinterpret_cast<sy_dynamics_model*>(
          std::make_unique<Model>(plugin::Whole(*source)).release());
    });
  };
  t.destroy = [](sy_dynamics_model* model) noexcept { delete reinterpret_cast<Model*>(model); };
  t.facts = [](const sy_dynamics_model* model) noexcept { return &As(model).facts(); };
  t.inverse_dynamics = [](const sy_dynamics_model* model, const double* q, const double* v,
                          const double* a, double* tau, double* d_q, double* d_v, double* d_a,
                          sy_error* error) noexcept {
    return Guarded(error, [&] { As(model).InverseDynamics(q, v, a, tau, d_q, d_v, d_a); });
  };
  t.inverse_dynamics_hessian = [](const sy_dynamics_model* model, const double* q, const double* v,
                                  const double* a, const double* w, double* hessian,
                                  sy_error* error) noexcept {
    return Guarded(error, [&] { As(model).InverseDynamicsHessian(q, v, a, w, hessian); });
  };
  t.frame = [](const sy_dynamics_model* model, std::int32_t frame, const double* q,
               double* position, double* rotation, double* jacobian, sy_error* error) noexcept {
    return Guarded(error, [&] { As(model).Frame(frame, q, position, rotation, jacobian); });
  };
  t.distances = [](const sy_dynamics_model* model, const double* q, const std::int32_t* pairs,
                   std::int32_t num, double* distances, double* gradients,
                   sy_error* error) noexcept {
    return Guarded(error, [&] { As(model).Distances(q, pairs, num, distances, gradients); });
  };
  return t;
}

const void* Extension(const char* id) noexcept {
  static const sy_dynamics table = Table();
  return std::strcmp(id, "sy.dynamics/1") == 0 ? &table : nullptr;
}

}  // namespace
}  // namespace switchyard::dynamics

const sy_plugin* switchyard_plugin_v1() noexcept {
  static const sy_plugin plugin = {sizeof(sy_plugin),
                                   SY_ABI_MAJOR,
                                   SY_ABI_MINOR,
                                   "pinocchio",
                                   SWITCHYARD_PINOCCHIO_VERSION,
                                   nullptr,
                                   switchyard::dynamics::Extension};
  return &plugin;
}
