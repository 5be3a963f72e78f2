// core/gcs/block_program.hpp - a program that is written block by block, and copied from the one
// before it where a block is the same.
#pragma once

#include <cstdint>
#include <vector>

#include "core/problem/row_matrix.hpp"
#include "switchyard/problem.hpp"

namespace switchyard {

/// Factor times variable; -1: of none.
struct Column {
  std::int32_t variable;
  double factor;
};

/// What a block was written from. Two with equal keys are the same but for where they stand.
struct BlockKey {
  std::uint64_t owner = 0;  // edges: 2 id; vertices, of transitions: 2 id + 1
  std::uint64_t stamp = 0;  // of the terms
  std::uint32_t shape = 0;  // which of them the block holds
  bool operator==(const BlockKey&) const = default;
};

/// The lists of a program, each block's entries of each list next to each other, and behind all
/// blocks what belongs to none. A block's rows and cones have its own variables alone, so that it
/// can stand anywhere: a change of place is a shift.
struct BlockProgram {
  /// Where a block begins in each list.
  struct Place {
    std::int32_t x = 0, row = 0, cone = 0, cone_row = 0, end = 0;
    std::int32_t slack = -1;  // of an edge: its first slack variable, from x on; -1: none
  };

  std::vector<double> q, x_lower, x_upper;
  std::vector<std::uint8_t> integer;
  RowMatrix A, F;
  std::vector<double> row_lower, row_upper;
  std::vector<sy_cone> cones;
  std::vector<std::int32_t> block_of_x, block_of_row, block_of_cone;
  std::vector<Column> ends;   // the coordinates of edges' end points
  std::vector<Place> places;  // of each block, and where the last one ends

  /// Begins a block; what follows belongs to it.
  void Begin(const BlockKey& key);
  /// What follows belongs to no block.
  void EndBlocks();
  [[nodiscard]] std::int32_t num_blocks() const { return static_cast<std::int32_t>(keys_.size()); }

  /// The n-th block of the key's owner, or its first where it has fewer; -1: there is none, it was
  /// written from something else, or the blocks have not ended.
  [[nodiscard]] std::int32_t Find(const BlockKey& key, std::int32_t n = 0) const;
  /// Appends the blocks [first, last) of a program whose blocks have ended.
  void Append(const BlockProgram& from, std::int32_t first, std::int32_t last);
  /// Nothing; the memory stays.
  void Clear();

 private:
  [[nodiscard]] Place Here() const;
  void List(std::uint64_t owner);

  std::vector<BlockKey> keys_;
  std::vector<std::int32_t> first_of_;  // the first block of each owner, + 1; 0: none
};

/// Appends blocks of the program before, as many at a time as stood together in it.
class BlockCopies {
 public:
  BlockCopies(const BlockProgram& from, BlockProgram& to) : from_(from), to_(to) {}
  /// Appends, at the latest when Flush is called.
  void Add(std::int32_t block);
  void Flush();

 private:
  const BlockProgram& from_;
  BlockProgram& to_;
  std::int32_t first_ = 0, last_ = 0;
};

/// A program and the one before it, which lend each other memory.
struct BlockPrograms {
  BlockProgram now, before;
};

}  // namespace switchyard
