// switchyard/plugin.hpp - writes the C table of switchyard/abi.h for a solver that is an ordinary
// C++ class.
//
//   class Clp {
//    public:
//     static sy_solver Describe();  // id, name, license, accepts, honors, options, ...
//     explicit Clp(const sy_host& host);
//     void SetOption(std::string_view name, const sy_value& value);
//     void Load(const sy_problem& problem, std::uint64_t updates);
//     void Solve(const sy_control& control, sy_result& result);
//     // where the solver offers them: static Ready(host, facts), static Supports(host, problem),
//     // Update(update), WarmStart(start), Clone(), static Extension(id)
//   };
//   SY_PLUGIN("clp", "1.0", Clp, Cbc)
//
// Members throw to fail. Nothing thrown leaves the module. The order of calls (no solve before a
// load) is seen to here: a solver need not check it.
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "switchyard/abi.h"

namespace switchyard::plugin {

/// Thrown by a solver to fail a call with a status of its choice.
class Failure : public std::runtime_error {
 public:
  Failure(sy_status code, const std::string& text) : std::runtime_error(text), code_(code) {}
  [[nodiscard]] sy_status code() const { return code_; }

 private:
  sy_status code_;
};

/// The record with every field of today: those its author did not know are zero.
template <class Record>
Record Whole(const Record& given) noexcept {
  Record whole{};
  std::memcpy(static_cast<void*>(&whole), &given, std::min<std::size_t>(given.size, sizeof whole));
  whole.size = sizeof whole;
  return whole;
}

inline sy_status Report(sy_error* error, sy_status code, const char* text) noexcept {
  if (error != nullptr) {
    error->code = code;
    std::snprintf(error->text, sizeof error->text, "%s", text);
  }
  return code;
}

/// Runs `body`; what it throws becomes a status and a text.
template <class Body>
sy_status Guarded(sy_error* error, Body&& body) noexcept {
  try {
    body();
    return SY_OK;
  } catch (const Failure& e) {
    return Report(error, e.code(), e.what());
  } catch (const std::bad_alloc&) {
    return Report(error, SY_E_RESOURCE, "out of memory");
  } catch (const std::exception& e) {
    return Report(error, SY_E_INTERNAL, e.what());
  } catch (...) {
    return Report(error, SY_E_INTERNAL, "an exception of unknown type");
  }
}

/// What a class needs to stand behind a table. It is made from the host, or from the table and the
/// host where one class serves several tables.
template <class S>
concept Solver = (std::constructible_from<S, const sy_host&> ||
                  std::constructible_from<S, const sy_solver&,
                                          const sy_host&>)&&requires(S& s,
                                                                     const sy_problem& problem,
                                                                     const sy_control& control,
                                                                     sy_result& result,
                                                                     const sy_value& value) {
  s.SetOption(std::string_view(), value);
  s.Load(problem, std::uint64_t{});
  s.Solve(control, result);
};

/// What an instance points to: the solver, and how far its life has come.
template <class S>
struct Instance {
  std::unique_ptr<S> solver;
  bool loaded = false;
};

template <class S>
Instance<S>& As(sy_instance* instance) noexcept {
  return *reinterpret_cast<Instance<S>*>(instance);
}

template <class S>
sy_instance* NewInstance(std::unique_ptr<S> solver, bool loaded) {
  return reinterpret_cast<sy_instance*>(new Instance<S>{std::move(solver), loaded});
}

/// The solver of an instance that holds a problem.
template <class S>
S& Loaded(sy_instance* instance, const char* call) {
  if (!As<S>(instance).loaded) {
    throw Failure(SY_E_STATE, std::string(call) + " needs a problem: call load first");
  }
  return *As<S>(instance).solver;
}

template <Solver S>
void WriteRequired(sy_solver& t) {
  t.create = [](const sy_solver* self, const sy_host* host, sy_instance** out,
                sy_error* error) noexcept {
    return Guarded(error, [&] {
      if constexpr (std::constructible_from<S, const sy_solver&, const sy_host&>) {
        *out = NewInstance(std::make_unique<S>(*self, *host), false);
      } else {
        static_cast<void>(self);
        *out = NewInstance(std::make_unique<S>(*host), false);
      }
    });
  };
  t.destroy = [](sy_instance* p) noexcept { delete &As<S>(p); };
  t.set_option = [](sy_instance* p, const char* name, const sy_value* value,
                    sy_error* error) noexcept {
    return Guarded(error, [&] { As<S>(p).solver->SetOption(name, *value); });
  };
  t.load = [](sy_instance* p, const sy_problem* problem, std::uint64_t updates,
              sy_error* error) noexcept {
    return Guarded(error, [&] {
      As<S>(p).loaded = false;
      As<S>(p).solver->Load(Whole(*problem), updates);
      As<S>(p).loaded = true;
    });
  };
  t.solve = [](sy_instance* p, const sy_control* control, sy_result* result,
               sy_error* error) noexcept {
    return Guarded(error, [&] {
      sy_result found = Whole(*result);
      Loaded<S>(p, "solve").Solve(Whole(*control), found);
      found.size = result->size;
      std::memcpy(static_cast<void*>(result), &found,
                  std::min<std::size_t>(found.size, sizeof found));
    });
  };
}

template <Solver S>
void WriteBeforeCreation(sy_solver& t) {
  if constexpr (requires(const sy_host& h, sy_facts& f) { S::Ready(h, f); }) {
    t.ready = [](const sy_solver*, const sy_host* host, sy_facts* facts, sy_error* error) noexcept {
      return Guarded(error, [&] { S::Ready(*host, *facts); });
    };
  }
  if constexpr (requires(const sy_host& h, const sy_problem& p) { S::Supports(h, p); }) {
    t.supports = [](const sy_solver*, const sy_host* host, const sy_problem* problem,
                    sy_error* error) noexcept {
      return Guarded(error, [&] { S::Supports(*host, Whole(*problem)); });
    };
  }
  if constexpr (requires { S::Extension(""); }) {
    t.extension = [](const sy_solver*, const char* id) noexcept { return S::Extension(id); };
  }
}

template <Solver S>
void WriteOptional(sy_solver& t) {
  if constexpr (requires(S & s, const sy_update& u) { s.Update(u); }) {
    t.update = [](sy_instance* p, const sy_update* update, sy_error* error) noexcept {
      return Guarded(error, [&] { Loaded<S>(p, "update").Update(Whole(*update)); });
    };
  }
  if constexpr (requires(S & s, const sy_start& start) { s.WarmStart(start); }) {
    t.warm_start = [](sy_instance* p, const sy_start* start, sy_error* error) noexcept {
      return Guarded(error, [&] { Loaded<S>(p, "warm_start").WarmStart(Whole(*start)); });
    };
  }
  if constexpr (requires(S & s) {
                  { s.Clone() } -> std::same_as<std::unique_ptr<S>>;
                }) {
    t.clone = [](sy_instance* p, sy_instance** out, sy_error* error) noexcept {
      return Guarded(error, [&] { *out = NewInstance(As<S>(p).solver->Clone(), As<S>(p).loaded); });
    };
  }
}

/// The functions of a table whose data is already there.
template <Solver S>
void WriteFunctions(sy_solver& t) {
  t.size = sizeof t;
  WriteRequired<S>(t);
  WriteBeforeCreation<S>(t);
  WriteOptional<S>(t);
}

template <Solver S>
sy_solver Table() {
  sy_solver t = S::Describe();
  WriteFunctions<S>(t);
  return t;
}

/// The tables of one module's solvers, without an exported symbol: what a statically linked host
/// or a test registers.
template <Solver... S>
const sy_plugin& Plugin(const char* name, const char* version) {
  static const std::array<sy_solver, sizeof...(S)> tables = {Table<S>()...};
  static const auto solvers = [] {
    std::array<const sy_solver*, sizeof...(S) + 1> list{};
    for (std::size_t i = 0; i < tables.size(); ++i) list[i] = &tables[i];
    return list;
  }();
  static const sy_plugin plugin = {sizeof(sy_plugin), SY_ABI_MAJOR,   SY_ABI_MINOR, name,
                                   version,           solvers.data(), nullptr};
  return plugin;
}

}  // namespace switchyard::plugin

/// Defines the module's one exported function.
#define SY_PLUGIN(name, version, ...)                               \
  const sy_plugin* switchyard_plugin_v1() noexcept {                \
    return &switchyard::plugin::Plugin<__VA_ARGS__>(name, version); \
  }
