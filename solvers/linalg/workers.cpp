#include "solvers/linalg/workers.hpp"

namespace switchyard::linalg {

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
    busy_ = static_cast<int>(others_.size());
    ++loop_;
  }
  begun_.notify_all();
  Share();
  std::unique_lock lock(mutex_);
  done_.wait(lock, [&] { return busy_ == 0; });
}

void Workers::Share() {
  for (std::size_t i = next_++; i < count_; i = next_++) (*body_)(i);
}

void Workers::Work() {
  unsigned seen = 0;
  std::unique_lock lock(mutex_);
  while (true) {
    begun_.wait(lock, [&] { return over_ || loop_ != seen; });
    if (over_) return;
    seen = loop_;
    lock.unlock();
    Share();
    lock.lock();
    if (--busy_ == 0) done_.notify_one();
  }
}

}  // namespace switchyard::linalg
