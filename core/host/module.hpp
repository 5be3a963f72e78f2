// core/host/module.hpp - from a file to a plugin's tables, or to the reason why not.
#pragma once

#include <string>

#include "switchyard/host/host.hpp"

namespace switchyard {

struct Module {
  const sy_plugin* plugin = nullptr;
  BackendState state = BackendState::kNotLoadable;  // where plugin is null
  std::string reason;
};

/// Opens a file as a plugin. Whatever it is, the answer is a Module: what the dynamic loader would
/// crash on (a file cut short) is seen before the loader gets it. Never closed again.
Module OpenModule(const std::string& path);

/// Empty, or what is wrong with the tables of a plugin.
std::string TableFault(const sy_plugin& plugin);
std::string TableFault(const sy_solver& solver);

}  // namespace switchyard
