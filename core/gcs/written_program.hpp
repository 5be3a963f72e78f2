// core/gcs/written_program.hpp - what is kept of a transcription, so that the next one of the same
// graph writes only what is new.
#pragma once

#include <cstdint>
#include <vector>

#include "core/gcs/block_program.hpp"
#include "core/gcs/set_records.hpp"
#include "core/gcs/term_block.hpp"
#include "switchyard/problem.hpp"

namespace switchyard {

/// What the hints of a program point to.
struct PathLists {
  std::vector<std::int32_t> flow, scale, arc_in, arc_out, dim;
  Csc tail_point, head_point;
  std::vector<const sy_set*> sets;

  /// Nothing; the memory stays.
  void Clear();
};

/// What one transcription of a graph leaves to the next: blocks of terms, and the program, of which
/// what is the same is copied. Stays in place while the transcription does.
struct WrittenProgram {
  explicit WrittenProgram(GraphOfConvexSets::Transcription as) : blocks(as) {}

  TermBlocks blocks;
  BlockPrograms programs;
  Problem problem;    // the last one
  bool lent = false;  // are lists of programs.now in it?
  PathLists lists;
  SetRecords sets;

  /// Gives the problem the lists of programs.now that are the problem's as they are, or takes them
  /// back.
  void SwapLists(ProblemData& d);
  /// The program that was written last becomes the one before, and the next one is empty.
  void BeginNext();
};

}  // namespace switchyard
