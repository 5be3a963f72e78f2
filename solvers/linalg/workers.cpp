#include "solvers/linalg/workers.hpp"

#include <chrono>

namespace switchyard::linalg {
namespace {

// Loops follow each other within a step of a method: to fall asleep in between, and be woken, takes
// longer than many a loop.
constexpr std::chrono::microseconds kAwake{200};

/// Until done() says so, or for kAwake.
template <class Done>
bool WaitAwake(Done&& done) {
  constexpr int kTurns = 64;  // between looks at the clock
  const auto begin = std::chrono::steady_clock::now();
  do {
    for (int k = 0; k < kTurns; ++k) {
      if (done()) return true;
#if defined(__x86_64__)
      __builtin_ia32_pause();
#endif
    }
  } while (std::chrono::steady_clock::now() - begin < kAwake);
  return done();
}

}  // namespace

Workers::~Workers() {
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
  }
  begun_.notify_all();
  for (std::thread& other : others_) other.join();
}

void Workers::Each(std::size_t count, const std::function<void(std::size_t)>& body) {
  while (static_cast<int>(others_.size()) + 1 < threads_) {
    others_.emplace_back([this] { Work(); });
  }
  {
    const std::lock_guard lock(mutex_);
    body_ = &body;
    count_ = count;
    next_ = 0;
    ++loop_;
  }
  begun_.notify_all();
  Share(body);
  {
    const std::lock_guard lock(mutex_);
    body_ = nullptr;
  }
  while (!WaitAwake([&] { return busy_ == 0; })) std::this_thread::yield();
}

void Workers::Share(const std::function<void(std::size_t)>& body) {
  for (std::size_t i = next_++; i < count_; i = next_++) body(i);
}

void Workers::Work() {
  unsigned seen = 0;
  const auto called = [&] { return over_ || loop_ != seen; };
  while (true) {
    WaitAwake(called);
    const std::function<void(std::size_t)>* body = nullptr;
    {
      std::unique_lock lock(mutex_);
      begun_.wait(lock, called);
      if (over_) return;
      seen = loop_;
      body = body_;
      if (body == nullptr) continue;
      ++busy_;
    }
    Share(*body);
    --busy_;
  }
}

}  // namespace switchyard::linalg
