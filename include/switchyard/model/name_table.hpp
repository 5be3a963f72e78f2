// switchyard/model/name_table.hpp - names of numbered things, made when asked for.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "switchyard/export.hpp"

namespace switchyard {

/// Names in blocks: a base and a shape ("X(1,2)"), or one for each as a file gives them. A block of
/// a million variables is one entry.
class SWITCHYARD_EXPORT NameTable {
 public:
  /// rows x cols names "base(i,j)", column by column; "base(i)" where cols is 0, "base" for 1 x 0.
  void AddShaped(std::string base, int rows, int cols);
  /// The lower triangle of a symmetric matrix, column by column.
  void AddSymmetric(std::string base, int rows);
  void AddListed(std::vector<std::string> names);

  [[nodiscard]] int size() const { return size_; }
  [[nodiscard]] std::string Name(int i) const;

 private:
  enum class Form { kShaped, kSymmetric, kListed };
  struct Block {
    int first;
    Form form;
    std::string base;
    int rows;
    int cols;
    std::vector<std::string> listed;
  };
  std::vector<Block> blocks_;
  int size_ = 0;
};

}  // namespace switchyard
