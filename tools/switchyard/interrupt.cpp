#include "interrupt.hpp"

#include <unistd.h>

#include <csignal>

namespace switchyard::cli {
namespace {

std::atomic<bool> interrupted = false;
static_assert(std::atomic<bool>::is_always_lock_free);
constexpr int kSignalExit = 128;

}  // namespace

const std::atomic<bool>& Interrupted() { return interrupted; }

void WatchInterrupts() {
  struct sigaction action {};
  action.sa_handler = [](int signal) {
    if (interrupted.exchange(true)) _exit(kSignalExit + signal);
  };
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

}  // namespace switchyard::cli
