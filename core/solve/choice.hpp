// core/solve/choice.hpp - the backend that takes a problem, loaded with it.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/host/instance.hpp"
#include "switchyard/host/host.hpp"
#include "switchyard/solve/result.hpp"

namespace switchyard {

/// What is asked for.
struct BackendWish {
  std::string names;  // in order of preference, comma-separated; "": the best
  const SolverOptions* options = nullptr;
  const sy_host* table = nullptr;  // what instances are given
  std::uint64_t updates = 0;       // that are to follow
  /// A backend's text about x[3] or row[3] in the user's names.
  std::function<std::string(const std::string&)> with_names;
};

/// What was found: no backend, and why, or an instance of the host's table over one.
struct BackendChoice {
  const Backend* backend = nullptr;
  std::unique_ptr<Instance> instance;
  std::vector<Considered> considered;
  std::string why_none;
};

/// The first that loads. Throws InvalidArgument for an option that the backend does not have.
BackendChoice ChooseBackend(const Host& host, const sy_problem& problem, const BackendWish& wish);

/// The user's options of a backend, by its id, its short name or "".
void SetOptions(const SolverOptions& options, const Backend& backend, Instance& instance);

}  // namespace switchyard
