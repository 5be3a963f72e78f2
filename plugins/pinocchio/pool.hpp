#pragma once

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace switchyard::dynamics {

/// A pool: each evaluation borrows one, so any number of threads evaluate at once, and nothing is
/// allocated once there are as many as threads.
template <class T>
class Pool {
 public:
  class Lease {
   public:
    Lease(Pool& pool, std::unique_ptr<T> lent) : pool_(pool), lent_(std::move(lent)) {}
    Lease(const Lease&) = delete;
    Lease& operator=(const Lease&) = delete;
    ~Lease() { pool_.Return(std::move(lent_)); }
    T& operator*() const { return *lent_; }

   private:
    Pool& pool_;
    std::unique_ptr<T> lent_;
  };

  /// `make` is called where none is free.
  template <class Make>
  Lease Borrow(const Make& make) {
    {
      const std::lock_guard lock(mutex_);
      if (!free_.empty()) {
        std::unique_ptr<T> one = std::move(free_.back());
        free_.pop_back();
        return Lease(*this, std::move(one));
      }
      free_.reserve(++made_);  // so that Return does not allocate
    }
    return Lease(*this, make());
  }

 private:
  void Return(std::unique_ptr<T> one) {
    const std::lock_guard lock(mutex_);
    free_.push_back(std::move(one));
  }

  std::mutex mutex_;
  std::vector<std::unique_ptr<T>> free_;
  std::size_t made_ = 0;
};

}  // namespace switchyard::dynamics
