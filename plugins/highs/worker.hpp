// worker.hpp - a thread that runs one call at a time for whoever asks.
#pragma once

#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <utility>

namespace switchyard::highs {

class Worker {
 public:
  Worker() : thread_([this] { Loop(); }) {}
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;
  ~Worker() {
    {
      const std::lock_guard lock(mutex_);
      ending_ = true;
    }
    changed_.notify_all();
    thread_.join();
  }

  /// Runs `call` on the thread, waits for it, and throws what it threw. Whoever waits calls
  /// `meanwhile` now and then.
  void Run(std::function<void()> call, const std::function<void()>& meanwhile = {}) {
    constexpr std::chrono::milliseconds kNowAndThen(10);
    std::unique_lock lock(mutex_);
    call_ = std::move(call);
    changed_.notify_all();
    while (!changed_.wait_for(lock, kNowAndThen, [this] { return call_ == nullptr; })) {
      if (!meanwhile) continue;
      lock.unlock();
      meanwhile();
      lock.lock();
    }
    if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
  }

 private:
  void Loop() {
    std::unique_lock lock(mutex_);
    for (;;) {
      changed_.wait(lock, [this] { return ending_ || call_ != nullptr; });
      if (ending_) return;
      lock.unlock();
      std::exception_ptr thrown;
      try {
        call_();
      } catch (...) {
        thrown = std::current_exception();
      }
      lock.lock();
      thrown_ = thrown;
      call_ = nullptr;
      changed_.notify_all();
    }
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::function<void()> call_;
  std::exception_ptr thrown_;
  bool ending_ = false;
  std::thread thread_;
};

}  // namespace switchyard::highs
