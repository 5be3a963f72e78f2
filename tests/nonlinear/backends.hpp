// tests/nonlinear/backends.hpp - the backends that the build made.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "switchyard/host/host.hpp"

namespace switchyard::testing {

inline Host& Built() {
  static Host& host = []() -> Host& {
    setenv("SWITCHYARD_PLUGIN_PATH", SWITCHYARD_PLUGIN_FOLDER, 0);
    unsetenv("SWITCHYARD_SOLVERS");
    setenv("XDG_CONFIG_HOME", "/nonexistent", 1);
    return Host::Default();
  }();
  return host;
}

inline bool IsThere(const std::string& name) {
  const Backend* backend = Built().Find(name);
  return backend != nullptr && Built().Ready(*backend).ready;
}

#define SKIP_WITHOUT(name) \
  if (!IsThere(name)) GTEST_SKIP() << name << " was not built"

}  // namespace switchyard::testing
