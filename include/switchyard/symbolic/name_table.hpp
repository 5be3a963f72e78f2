// switchyard/symbolic/name_table.hpp - names of numbered things, made when asked for.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "switchyard/export.hpp"

namespace switchyard {

/// The names of consecutive things: a base and a shape ("X(1,2)"), or one for each as a file gives
/// them. Constant once it is made.
class SWITCHYARD_EXPORT NameBlock {
 public:
  /// rows x cols names "base(i,j)", column by column; "base(i)" where cols is 0, "base" for 1 x 0.
  static NameBlock Shaped(std::string base, int rows, int cols);
  /// The lower triangle of a symmetric matrix, column by column.
  static NameBlock Symmetric(std::string base, int rows);
  static NameBlock Listed(std::vector<std::string> names);

  [[nodiscard]] int size() const { return size_; }
  [[nodiscard]] std::string Name(int k) const;

 private:
  enum class Form { kShaped, kSymmetric, kListed };
  NameBlock(Form form, int size, std::string base, int rows, int cols)
      : form_(form), size_(size), base_(std::move(base)), rows_(rows), cols_(cols) {}

  Form form_;
  int size_;
  std::string base_;
  int rows_;
  int cols_;
  std::vector<std::string> listed_;
};

/// Names in blocks, one behind the other. A block of a million names is one entry; copies of a
/// table share it.
class SWITCHYARD_EXPORT NameTable {
 public:
  void Add(std::shared_ptr<const NameBlock> block);

  [[nodiscard]] int size() const { return size_; }
  [[nodiscard]] std::string Name(int i) const;

 private:
  struct Entry {
    int first;
    std::shared_ptr<const NameBlock> block;
  };
  std::vector<Entry> entries_;
  int size_ = 0;
};

}  // namespace switchyard
