// solvers/linalg/workers.hpp - threads that share a loop.
#pragma once

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace switchyard::linalg {

/// The thread that asks and `threads` - 1 others, which come with the first loop, wait awake for a
/// moment and then asleep between loops, and end with the object. Who comes late to a loop finds it
/// closed, and is not waited for.
class Workers {
 public:
  explicit Workers(int threads) : threads_(std::max(1, threads)) {}
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;
  ~Workers();

  [[nodiscard]] int threads() const { return threads_; }
  /// body(i) once for each i in [0, count), in any order, on any of the threads; it must not throw.
  void Each(std::size_t count, const std::function<void(std::size_t)>& body);

 private:
  void Work();
  void Share(const std::function<void(std::size_t)>& body);

  const int threads_;
  std::mutex mutex_;
  std::condition_variable begun_;
  const std::function<void(std::size_t)>* body_ = nullptr;  // null: the loop is closed
  std::size_t count_ = 0;
  std::atomic<std::size_t> next_ = 0;
  std::atomic<int> busy_ = 0;  // of the others: who is in the loop
  std::atomic<unsigned> loop_ = 0;
  std::atomic<bool> over_ = false;
  std::vector<std::thread> others_;
};

/// body(begin, end) for parts of [0, count), shared by `workers` where there are any, and more than
/// one part of `grain`. What body does to one i must not depend on how they are parted.
template <class Body>
void EachPart(Workers* workers, std::size_t count, std::size_t grain, Body&& body) {
  if (workers == nullptr || workers->threads() == 1 || count <= grain) {
    if (count > 0) body(std::size_t{0}, count);
    return;
  }
  workers->Each((count + grain - 1) / grain,
                [&](std::size_t part) { body(part * grain, std::min(count, (part + 1) * grain)); });
}

}  // namespace switchyard::linalg
