// tools/switchyard/interrupt.hpp - Ctrl-C: once stops the solve, twice leaves.
#pragma once

#include <atomic>

namespace switchyard::cli {

/// Set by the first SIGINT or SIGTERM after WatchInterrupts(); the second ends the process.
const std::atomic<bool>& Interrupted();
void WatchInterrupts();

}  // namespace switchyard::cli
