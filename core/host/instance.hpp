// core/host/instance.hpp - calls through a sy_solver table, from the host's side.
#pragma once

#include <exception>
#include <stdexcept>
#include <string>
#include <utility>

#include "switchyard/abi.h"

namespace switchyard {

/// A call that a backend failed: what() says who, reason() only why.
class BackendError : public std::runtime_error {
 public:
  BackendError(sy_status code, const std::string& who, const std::string& reason)
      : std::runtime_error(who + ": " + reason), code_(code), reason_(reason) {}
  [[nodiscard]] sy_status code() const { return code_; }
  [[nodiscard]] const std::string& reason() const { return reason_; }

 private:
  sy_status code_;
  std::string reason_;
};

/// Calls `function`, which is not to throw, as if it might; what goes wrong is a BackendError that
/// names the solver and the call. The pointer is taken without its noexcept, so that an exception
/// which a module lets out is caught here.
template <class... Parameters, class... Arguments>
void Call(const sy_solver& solver, const char* name, sy_status (*function)(Parameters...),
          Arguments... arguments) {
  const std::string who = solver.id;
  const std::string call = name;
  if (function == nullptr) throw BackendError(SY_E_UNSUPPORTED, who, call + " is not offered");
  sy_error error{};
  sy_status status = SY_OK;
  try {
    status = function(arguments..., &error);
  } catch (const std::exception& e) {
    throw BackendError(SY_E_INTERNAL, who, call + " let an exception out: " + e.what());
  } catch (...) {
    throw BackendError(SY_E_INTERNAL, who, call + " let an exception out");
  }
  if (status >= 0) return;
  error.text[sizeof error.text - 1] = '\0';
  const std::string text = error.text[0] != '\0' ? error.text : "no reason given";
  throw BackendError(status, who, text);
}

/// An instance of a solver, destroyed with it.
class Instance {
 public:
  /// `self`: the author's own table, where `solver` is a copy of it.
  Instance(const sy_solver& solver, const sy_host& host, const sy_solver* self = nullptr)
      : solver_(&solver) {
    Call(solver, "create", solver.create, self != nullptr ? self : &solver, &host, &instance_);
    if (instance_ == nullptr) {
      throw BackendError(SY_E_INTERNAL, solver.id, "create gave no instance");
    }
  }
  Instance(Instance&& other) noexcept
      : solver_(other.solver_), instance_(std::exchange(other.instance_, nullptr)) {}
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;
  ~Instance() {
    if (instance_ == nullptr) return;
    void (*destroy)(sy_instance*) = solver_->destroy;
    try {
      destroy(instance_);
    } catch (...) {  // nothing left to tell it to
    }
  }

  void SetOption(const std::string& name, const sy_value& value) {
    Call(*solver_, "set_option", solver_->set_option, instance_, name.c_str(), &value);
  }
  void Load(const sy_problem& problem, std::uint64_t updates) {
    Call(*solver_, "load", solver_->load, instance_, &problem, updates);
  }
  void Update(const sy_update& update) {
    Call(*solver_, "update", solver_->update, instance_, &update);
  }
  void WarmStart(const sy_start& start) {
    Call(*solver_, "warm_start", solver_->warm_start, instance_, &start);
  }
  void Solve(const sy_control& control, sy_result& result) {
    Call(*solver_, "solve", solver_->solve, instance_, &control, &result);
  }
  [[nodiscard]] const sy_solver& solver() const { return *solver_; }
  [[nodiscard]] sy_instance* get() const { return instance_; }

 private:
  const sy_solver* solver_;
  sy_instance* instance_ = nullptr;
};

}  // namespace switchyard
