// solvers/linalg/workers.hpp - threads that share a loop.
#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace switchyard::linalg {

/// The thread that asks and `threads` - 1 others, which come with the first loop, sleep between
/// loops and end with the object.
class Workers {
 public:
  explicit Workers(int threads) : threads_(threads) {}
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;
  ~Workers();

  [[nodiscard]] int threads() const { return threads_; }
  /// body(i) once for each i in [0, count), in any order, on any of the threads; it must not throw.
  void Each(std::size_t count, const std::function<void(std::size_t)>& body);

 private:
  void Work();
  void Share();

  const int threads_;
  std::mutex mutex_;
  std::condition_variable begun_, done_;
  const std::function<void(std::size_t)>* body_ = nullptr;
  std::size_t count_ = 0;
  std::atomic<std::size_t> next_ = 0;
  int busy_ = 0;  // of the others
  unsigned loop_ = 0;
  bool over_ = false;
  std::vector<std::thread> others_;
};

}  // namespace switchyard::linalg
