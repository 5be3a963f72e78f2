// tests/support/fake_backend.hpp - a backend registered as a table whose every answer a test can
// choose: an honest solver of problems with bounds alone, or whatever the test puts in its place.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "switchyard/host/host.hpp"
#include "switchyard/model/program.hpp"
#include "switchyard/plugin.hpp"
#include "switchyard/problem_update.hpp"
#include "switchyard/solve/solve.hpp"

namespace switchyard::testing {

using Answer = std::function<void(const sy_problem&, const sy_control&, sy_result&)>;

/// min q'x + offset over a box: each x_j at the side that its q_j names; rows, cones and P are
/// not looked at.
inline void SolveBox(const sy_problem& p, const sy_control&, sy_result& result) {
  result.termination = SY_OPTIMAL;
  result.primal = result.dual = SY_FEASIBLE;
  for (std::int32_t j = 0; j < p.num_vars; ++j) {
    const double lower = p.x_lower != nullptr ? p.x_lower[j] : -kInfinity;
    const double upper = p.x_upper != nullptr ? p.x_upper[j] : kInfinity;
    double side = std::max(lower, std::min(0.0, upper));
    if (p.q[j] != 0) side = p.q[j] > 0 ? lower : upper;
    result.x[j] = side;
    result.x_dual[j] = p.q[j];
    if (std::isfinite(side)) continue;
    std::fill(result.x, result.x + p.num_vars, 0.0);
    result.x[j] = p.q[j] > 0 ? -1 : 1;
    result.termination = SY_UNBOUNDED;
    result.primal = SY_CERTIFICATE;
    result.dual = SY_NO_POINT;
    return;
  }
  result.objective = Objective(p, result.x);
}

/// What a fake does and what it was asked; shared by all of its instances.
struct Behaviour {
  Answer answer = SolveBox;
  std::string supports;  // why it does not take a problem; "": it does
  std::string not_ready;

  int loads = 0;
  int updates = 0;
  int solves = 0;
  std::uint64_t declared = 0;  // the kinds of update that the last load announced
  std::vector<double> start;   // x of the last warm start
  std::vector<std::string> options;
  sy_control control{};  // of the last solve
};

class FakeSolver {
 public:
  FakeSolver(const sy_solver& self, const sy_host&)
      : behaviour_(*static_cast<Behaviour*>(const_cast<void*>(self.context))) {}
  void SetOption(std::string_view name, const sy_value& value) {
    behaviour_.options.push_back(std::string(name) + "=" +
                                 (value.type == SY_INTEGER ? std::to_string(value.as.integer)
                                  : value.type == SY_REAL  ? std::to_string(value.as.real)
                                                           : std::string(value.as.text)));
  }
  void Load(const sy_problem& problem, std::uint64_t updates) {
    ++behaviour_.loads;
    behaviour_.declared = updates;
    problem_ = Problem(problem);
  }
  void Update(const sy_update& update) {
    ++behaviour_.updates;
    problem_.Apply(update);
  }
  void WarmStart(const sy_start& start) {
    behaviour_.start.clear();
    if (start.x == nullptr) return;
    behaviour_.start.assign(start.x, start.x + problem_.data().num_vars);
  }
  void Solve(const sy_control& control, sy_result& result) {
    ++behaviour_.solves;
    behaviour_.control = control;
    behaviour_.answer(problem_.view(), control, result);
  }

 private:
  Behaviour& behaviour_;
  Problem problem_;
};

/// A host that has the fake alone, under the id "test.fake", and takes every section but nlp.
class FakeBackend {
 public:
  explicit FakeBackend(const std::function<void(sy_solver&)>& edit = {}) {
    Describe();
    if (edit) edit(table_);
    plugin::WriteFunctions<FakeSolver>(table_);
    table_.ready = [](const sy_solver* self, const sy_host*, sy_facts*, sy_error* error) noexcept {
      const auto& b = *static_cast<const Behaviour*>(self->context);
      return b.not_ready.empty() ? SY_OK
                                 : plugin::Report(error, SY_E_RESOURCE, b.not_ready.c_str());
    };
    table_.supports = [](const sy_solver* self, const sy_host*, const sy_problem*,
                         sy_error* error) noexcept {
      const auto& b = *static_cast<const Behaviour*>(self->context);
      return b.supports.empty() ? SY_OK
                                : plugin::Report(error, SY_E_UNSUPPORTED, b.supports.c_str());
    };
    host_.Register(plugin_);
  }
  FakeBackend(const FakeBackend&) = delete;
  FakeBackend& operator=(const FakeBackend&) = delete;

  Behaviour& behaviour() { return *behaviour_; }
  Host& host() { return host_; }
  MathematicalProgramResult Solve(const MathematicalProgram& program,
                                  const SolverOptions& options = {},
                                  const std::string& names = "") {
    return SolverInterface(names, host_).Solve(program, std::nullopt, options);
  }

 private:
  void Describe() {
    table_.size = sizeof table_;
    table_.id = "test.fake";
    table_.name = "Fake";
    table_.version = "1.0";
    table_.license = "BSD-3-Clause";
    table_.accepts = SY_ACCEPTS_BOUNDS | SY_ACCEPTS_ROWS | SY_ACCEPTS_QUADRATIC_OBJECTIVE |
                     SY_ACCEPTS_NONCONVEX_OBJECTIVE;
    table_.integer_accepts = table_.accepts | SY_ACCEPTS_INTEGER;
    table_.cones = table_.integer_cones = 0x7f;
    table_.traits = SY_GIVES_DUALS | SY_GIVES_CERTIFICATES | SY_GIVES_BOUND;
    table_.updates = SY_UPDATES_BOUNDS | SY_UPDATES_VECTORS | SY_UPDATES_VALUES;
    table_.context = behaviour_.get();
    speed_.size = mode_.size = sizeof speed_;
    speed_.name = "speed";
    speed_.fallback.type = SY_INTEGER;
    speed_.lower = 0;
    speed_.upper = 10;
    mode_.name = "mode";
    mode_.fallback.type = SY_TEXT;
    table_.options = options_;
  }

  std::unique_ptr<Behaviour> behaviour_ = std::make_unique<Behaviour>();
  sy_option speed_{};
  sy_option mode_{};
  const sy_option* options_[3] = {&speed_, &mode_, nullptr};
  sy_solver table_{};
  const sy_solver* solvers_[2] = {&table_, nullptr};
  sy_plugin plugin_ = {sizeof(sy_plugin), SY_ABI_MAJOR, SY_ABI_MINOR, "fakes", "1.0",
                       solvers_,          nullptr};
  Host host_{HostOptions{{}, std::vector<std::string>{}, {}}};
};

/// Options of which `edit` sets some.
template <class Edit>
SolverOptions With(Edit&& edit) {
  SolverOptions options;
  edit(options);
  return options;
}

/// What a call that must throw said.
template <class Call>
std::string Thrown(Call&& call) {
  try {
    call();
  } catch (const std::exception& e) {
    return e.what();
  }
  return "(nothing was thrown)";
}

}  // namespace switchyard::testing
