// core/host/facade.hpp - the host's table over a backend: the one that everyone but the host calls.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "core/bridges/bridge.hpp"
#include "core/host/instance.hpp"
#include "core/host/turn.hpp"
#include "switchyard/host/host.hpp"
#include "switchyard/plugin.hpp"

namespace switchyard {

/// What a facade's table refers to; lives as long as the host.
struct FacadeContext {
  const Backend* backend = nullptr;
  const sy_host* host = nullptr;
  /// Gives a new instance the user's options for this backend.
  std::function<void(Instance&)> configure;
  mutable TurnQueue turn;
};

/// A sy_solver over a backend that takes every section that bridges reach, and every update.
///
/// It owns one copy of the problem, or borrows it where no update is announced and no bridge stands
/// between. An update is applied to the copy, bridges run again, and what
/// differs is sent: as an update where the backend takes that kind, as a new load where it does
/// not. Bounds of variables pass straight through bridges that keep them as bounds.
class Facade {
 public:
  Facade(const sy_solver& self, const sy_host& host);
  Facade(const Facade&) = delete;
  Facade& operator=(const Facade&) = delete;
  ~Facade();
  static sy_solver Table(const FacadeContext& context);

  void SetOption(std::string_view name, const sy_value& value);
  void Load(const sy_problem& problem, std::uint64_t updates);
  void Update(const sy_update& update);
  void WarmStart(const sy_start& start);
  void Solve(const sy_control& control, sy_result& result);
  /// What else the backend found at the last solve, by its "sy.pool/1"; none where it has no such.
  [[nodiscard]] std::int32_t PoolSize() const;
  /// x and its objective.
  void PoolSolution(std::int32_t i, sy_result& result) const;
  static const void* Extension(const char* id);

  [[nodiscard]] int loads() const { return loads_; }
  [[nodiscard]] int updates() const { return updates_; }
  /// Wall clock spent inside the backend's load, update, warm_start and solve.
  [[nodiscard]] double backend_seconds() const { return backend_seconds_; }

 private:
  /// Runs `call`, which enters the backend, and counts its time.
  template <class C>
  void InBackend(C&& call);
  [[nodiscard]] const sy_solver& facts() const { return context_->backend->facts; }
  std::shared_ptr<Problem> Next(const sy_update& update);
  void Borrow(const sy_problem& problem);
  void Reload();
  void NeedInStep() const;
  void SendDifference(const sy_update& update, const BridgePlan& plan);
  bool PassStraight(const sy_update& update, const BridgePlan& plan);
  void Send(const sy_update& update);
  void Recover(sy_result& found, const Vectors& mapped, sy_result& result) const;
  void CheckAnswer(sy_result& result) const;
  [[nodiscard]] const sy_pool* BackendsPool() const;

  const FacadeContext* context_;
  std::unique_ptr<Instance> instance_;
  [[nodiscard]] const sy_problem& view() const {
    return problem_ != nullptr ? problem_->view() : borrowed_;
  }

  std::shared_ptr<Problem> problem_;  // nullptr: borrowed_
  sy_problem borrowed_{};
  std::shared_ptr<Problem> sent_;   // what the backend was given, where no bridge stands between
  std::shared_ptr<Problem> spare_;  // the one before problem_, where its matrices are the same
  std::unique_ptr<BridgeChain> chain_;
  std::unique_ptr<BridgeChain> held_;  // whose image the backend has, where it is not chain_'s
  BridgePlan plan_;
  bool passed_bounds_ = false;  // bounds went past chain_, whose image does not show them
  bool in_step_ = true;         // the backend holds problem_: no update failed half way
  std::uint64_t declared_ = 0;  // kinds of update that the caller announced
  int loads_ = 0;
  int updates_ = 0;
  double backend_seconds_ = 0;
};

/// "sy.facade/1", of the host's tables: how an instance was served.
struct sy_facade {
  std::uint32_t size;
  std::uint32_t reserved;
  std::int32_t (*loads)(sy_instance*) SY_NOEXCEPT;
  std::int32_t (*updates)(sy_instance*) SY_NOEXCEPT;
  double (*backend_seconds)(sy_instance*) SY_NOEXCEPT;
};

/// Of an instance of one of the host's tables.
inline const sy_facade& ServiceOf(const Instance& instance) {
  return *static_cast<const sy_facade*>(
      instance.solver().extension(&instance.solver(), "sy.facade/1"));
}

/// Throws BackendError (SY_E_UNSUPPORTED) where no chain of bridges reaches the backend.
BridgePlan PlanFor(const sy_problem& problem, const Backend& backend);

}  // namespace switchyard
