// core/io/name_index.hpp - from a name to its number, for the names of one file.
#pragma once

#include <bit>
#include <cstddef>
#include <functional>
#include <string_view>
#include <vector>

namespace switchyard::io {

/// Names numbered in the order they come; views into the file's text. Open addressing with linear
/// probing over a power of two of slots, at most half of them full.
class NameIndex {
 public:
  /// The number of a new name, or -1 where the name is there.
  int Add(std::string_view name) {
    if (2 * (names_.size() + 1) > slots_.size()) Grow();
    int& slot = slots_[SlotOf(name)];
    if (slot >= 0) return -1;
    slot = static_cast<int>(names_.size());
    names_.push_back(name);
    return slot;
  }
  /// -1: there is no such name.
  [[nodiscard]] int Find(std::string_view name) const {
    return slots_.empty() ? -1 : slots_[SlotOf(name)];
  }
  [[nodiscard]] const std::vector<std::string_view>& names() const { return names_; }
  [[nodiscard]] int size() const { return static_cast<int>(names_.size()); }

 private:
  // Where the name is, or the free slot where it would be.
  [[nodiscard]] std::size_t SlotOf(std::string_view name) const {
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t at = std::hash<std::string_view>()(name) & mask;; at = (at + 1) & mask) {
      const int slot = slots_[at];
      if (slot < 0 || names_[static_cast<std::size_t>(slot)] == name) return at;
    }
  }
  void Grow() {
    slots_.assign(std::bit_ceil(4 * (names_.size() + 8)), -1);
    for (std::size_t i = 0; i < names_.size(); ++i) slots_[SlotOf(names_[i])] = static_cast<int>(i);
  }

  std::vector<std::string_view> names_;
  std::vector<int> slots_;
};

}  // namespace switchyard::io
