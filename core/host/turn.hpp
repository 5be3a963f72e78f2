// core/host/turn.hpp - the turn of a backend that runs one at a time.
#pragma once

#include <mutex>
#include <string>

namespace switchyard {

/// What stands in line before a backend that declares SY_ONE_AT_A_TIME; of others it is not used.
struct TurnQueue {
  bool serial = false;
  std::string who;  // the backend's id
  std::mutex mutex;
};

/// This thread is inside a backend, for the life of this object: during a call of it, and during
/// the hooks that it calls, from whichever of its threads. Objects end in the reverse of their
/// order, so they are a list on the stack.
class Inside {
 public:
  explicit Inside(const TurnQueue& queue);
  Inside(const Inside&) = delete;
  Inside& operator=(const Inside&) = delete;
  ~Inside();

  /// Was it inside already?
  [[nodiscard]] bool again() const { return again_; }

 private:
  const TurnQueue* queue_;
  const Inside* below_;
  bool again_ = false;
};

/// Holds a backend for one call. In a thread that is inside it already waiting would be for ever:
/// then throws plugin::Failure (SY_E_STATE), or, to end an instance, goes ahead.
class Turn {
 public:
  enum class Use { kCall, kEnd };
  explicit Turn(TurnQueue& queue, Use use = Use::kCall);

 private:
  Inside inside_;
  std::unique_lock<std::mutex> lock_;
};

}  // namespace switchyard
