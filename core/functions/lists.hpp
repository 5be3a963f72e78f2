// core/functions/lists.hpp - many short lists that grow, and are taken one after the other.
#pragma once

#include <cstdint>
#include <vector>

namespace switchyard {

/// A list of T for each of a number of keys. The room of a list that was taken is used again.
template <class T>
class Lists {
 public:
  explicit Lists(int num_keys) : head_(num_keys, kNone) {}

  [[nodiscard]] bool IsEmpty(int key) const { return head_[key] == kNone; }

  void Add(int key, const T& item) {
    std::int64_t at = free_;
    if (at == kNone) {
      at = std::ssize(links_);
      links_.push_back({item, head_[key]});
    } else {
      free_ = links_[at].next;
      links_[at] = {item, head_[key]};
    }
    head_[key] = at;
  }

  /// Moves the list of `key` into `items`, the last added first.
  void Take(int key, std::vector<T>* items) {
    items->clear();
    for (std::int64_t at = head_[key]; at != kNone;) {
      items->push_back(links_[at].item);
      const std::int64_t next = links_[at].next;
      links_[at].next = free_;
      free_ = at;
      at = next;
    }
    head_[key] = kNone;
  }

 private:
  static constexpr std::int64_t kNone = -1;
  struct Link {
    T item;
    std::int64_t next;
  };
  std::vector<std::int64_t> head_;
  std::vector<Link> links_;
  std::int64_t free_ = kNone;
};

}  // namespace switchyard
