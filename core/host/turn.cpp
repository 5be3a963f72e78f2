#include "core/host/turn.hpp"

#include "switchyard/plugin.hpp"

namespace switchyard {
namespace {

thread_local const Inside* innermost = nullptr;

}  // namespace

Inside::Inside(const TurnQueue& queue) : queue_(&queue), below_(innermost) {
  for (const Inside* i = below_; i != nullptr && !again_; i = i->below_) {
    again_ = i->queue_ == queue_;
  }
  innermost = this;
}

Inside::~Inside() { innermost = below_; }

Turn::Turn(TurnQueue& queue, Use use) : inside_(queue) {
  if (!queue.serial) return;
  if (!inside_.again()) {
    lock_ = std::unique_lock(queue.mutex);
  } else if (use == Use::kCall) {
    throw plugin::Failure(SY_E_STATE, queue.who +
                                          " runs one at a time and is already running in this "
                                          "thread: it cannot be used from inside its own solve");
  }
}

}  // namespace switchyard
